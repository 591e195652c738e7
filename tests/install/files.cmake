# The installed library, and the tutorials built from it with nothing else in view.
add_test(NAME install/tutorials COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/install/run_install.py
                                        ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}/tests/install)
set_tests_properties(install/tutorials PROPERTIES TIMEOUT 600 PROCESSORS 2)
if(CCACHE_PROGRAM)
  set_tests_properties(install/tutorials PROPERTIES ENVIRONMENT CMAKE_CXX_COMPILER_LAUNCHER=${CCACHE_PROGRAM})
endif()
