signorini_add_unit_tests(output RANKS "1;2" nodal_stress.cc output_folder.cc)
