# Stored results of the examples; run_golden.py PROGRAM NAME --update stores anew (say why in the commit).
foreach(name cubes cubes_plain hertz hertz_plain paper paper_contact patch_test)
  add_test(NAME golden/${name} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/golden/run_golden.py
                                       $<TARGET_FILE:signorini_program> ${name})
endforeach()
