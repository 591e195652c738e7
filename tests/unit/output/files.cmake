signorini_add_unit_tests(output RANKS "1;2" output_folder.cc)
