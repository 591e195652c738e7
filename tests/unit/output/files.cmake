signorini_add_unit_tests(output RANKS "1;2" checkpoint_file.cc final_words.cc output_folder.cc report.cc vtu_file.cc)
