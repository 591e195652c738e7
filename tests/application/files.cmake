# The program on small problems: run_case.py has the cases and their known answers.
function(signorini_add_application_test case)
  foreach(ranks ${ARGN})
    add_test(NAME application/${case}.np${ranks}
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/application/run_case.py
                     $<TARGET_FILE:signorini_program> ${case} ${ranks})
    set_tests_properties(application/${case}.np${ranks} PROPERTIES TIMEOUT 600 PROCESSORS ${ranks})
  endforeach()
endfunction()

signorini_add_application_test(command_line 1)
signorini_add_application_test(corner 1 2)
signorini_add_application_test(cubes 1 2 4)
signorini_add_application_test(errors 1 2)
signorini_add_application_test(half_model 1)
signorini_add_application_test(hanging_nodes 1 2)
signorini_add_application_test(hertz 1 2)
signorini_add_application_test(inclined 1 2)
signorini_add_application_test(overhang 1)
signorini_add_application_test(patch_test 1 2 4)
signorini_add_application_test(pulled 1 2)
signorini_add_application_test(swapped_sides 1)
signorini_add_application_test(units 1)
