# Readers on damaged files: tests/fuzz/README.md.
function(signorini_add_fuzzer _name)
  add_executable(fuzz_${_name} fuzz/${_name}.cc fuzz/read_input.cc)
  set_target_properties(fuzz_${_name} PROPERTIES OUTPUT_NAME ${_name} RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  signorini_compile(fuzz_${_name} COLD)
  target_link_libraries(fuzz_${_name} signorini)
endfunction()

signorini_add_fuzzer(read_files)
# A few hundred files; the same each time.
add_test(NAME fuzz/readers COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/mutate.py $<TARGET_FILE:fuzz_read_files> --count 100)
set_tests_properties(fuzz/readers PROPERTIES TIMEOUT 600)

# With AFL++'s compiler (preset fuzz), for follow_coverage.py.
if(CMAKE_CXX_COMPILER MATCHES "/afl-")
  signorini_add_fuzzer(follow_coverage)
endif()
