# The checks of contrib/utilities, and that they see what they should.
add_test(NAME utilities/check_layers COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/contrib/utilities/check_layers.py)
add_test(NAME utilities/check_layers.planted
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/check_layers_cases.py)
# What the compiler says of each header and each source alone: six minutes. utilities/includes sees nearly all of it in seconds.
if(SIGNORINI_TESTS_ALONE)
  add_test(NAME utilities/headers_alone
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/headers_alone.py ${PROJECT_BINARY_DIR})
  set_tests_properties(utilities/headers_alone PROPERTIES PROCESSORS 2)
  if(SIGNORINI_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_test(NAME utilities/sources_alone
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/sources_alone.py ${PROJECT_BINARY_DIR})
    set_tests_properties(utilities/sources_alone PROPERTIES PROCESSORS 2 TIMEOUT 900)
  endif()
endif()
if(DOXYGEN_FOUND)
  add_test(NAME utilities/doxygen COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/doxygen_log.py
                                          $<TARGET_FILE:Doxygen::doxygen> ${PROJECT_BINARY_DIR}/doc/Doxyfile)
endif()
find_program(CTAGS_PROGRAM ctags)
if(CTAGS_PROGRAM)
  add_test(NAME utilities/function_lines
           COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/contrib/utilities/function_lines.py --check)
  add_test(NAME utilities/function_lines.cases
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/function_lines_cases.py)
  add_test(NAME utilities/includes COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/contrib/utilities/includes.py)
  add_test(NAME utilities/includes.cases COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/includes_cases.py)
  add_test(NAME utilities/local_names COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/contrib/utilities/local_names.py)
  add_test(NAME utilities/local_names.cases COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/local_names_cases.py)
endif()
# The pictures of contrib/plots; those by VTK where it is installed.
foreach(kind matplotlib vtk)
  add_test(NAME utilities/plots_${kind}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/plots.py $<TARGET_FILE:signorini_program> ${kind})
  set_tests_properties(utilities/plots_${kind} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
endforeach()

# Documents: links, spelling, every command and parameter file, the reference of parameters, the site, the catalogue of messages.
foreach(what links spelling)
  add_test(NAME utilities/documents.${what} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/documents.py ${what})
endforeach()
foreach(what parameters run)
  add_test(NAME utilities/documents.${what}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/documents.py ${what} $<TARGET_FILE:signorini_program>)
endforeach()
set_tests_properties(utilities/documents.run PROPERTIES PROCESSORS 2)
add_test(NAME utilities/documents.cases COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/documents_cases.py)
if(NOT SPHINX_MISSING)
  add_test(NAME utilities/site COMMAND ${SIGNORINI_SITE})
endif()
add_test(NAME utilities/messages COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/utilities/messages.py $<TARGET_FILE:signorini_program>)
set_tests_properties(utilities/messages PROPERTIES PROCESSORS 2 TIMEOUT 900)
