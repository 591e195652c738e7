# The module for Python, from the build tree, and what the documents say of it.
if(TARGET signorini_python)
  function(signorini_add_python_test name script)
    add_test(NAME python/${name} COMMAND ${SIGNORINI_PYTHON_EXECUTABLE} ${script} ${ARGN}
             WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    set_tests_properties(python/${name} PROPERTIES TIMEOUT 300
      ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;SIGNORINI_PROGRAM=$<TARGET_FILE:signorini_program>;OMPI_MCA_ess_singleton_isolated=1;OMPI_MCA_orte_tmpdir_base=${PROJECT_BINARY_DIR}/tests/mpi/${name};PRTE_MCA_prte_tmpdir_base=${PROJECT_BINARY_DIR}/tests/mpi/${name}")
  endfunction()
  foreach(cases run mapping obstacle document)
    signorini_add_python_test(${cases} ${CMAKE_CURRENT_SOURCE_DIR}/python/${cases}_cases.py)
  endforeach()
  set_tests_properties(python/run PROPERTIES PROCESSORS 2)
  signorini_add_python_test(press_fit_study ${PROJECT_SOURCE_DIR}/doc/tutorial/press-fit-study/press_fit_study.py
                            ${PROJECT_BINARY_DIR}/tests/press-fit-study.png)
endif()
