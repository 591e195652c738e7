# Readers on damaged files: tests/fuzz/README.md.
add_executable(fuzz_read_files fuzz/read_files.cc fuzz/read_input.cc)
set_target_properties(fuzz_read_files PROPERTIES OUTPUT_NAME read_files RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
target_precompile_headers(fuzz_read_files REUSE_FROM signorini_headers)
deal_ii_setup_target(fuzz_read_files)
signorini_compile_options(fuzz_read_files)
target_link_libraries(fuzz_read_files signorini)
# A few hundred files; the same each time.
add_test(NAME fuzz/readers COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/mutate.py $<TARGET_FILE:fuzz_read_files> --count 100)
set_tests_properties(fuzz/readers PROPERTIES TIMEOUT 600)

# With AFL++'s compiler (preset fuzz), for follow_coverage.py.
if(CMAKE_CXX_COMPILER MATCHES "/afl-")
  add_executable(fuzz_follow_coverage fuzz/follow_coverage.cc fuzz/read_input.cc)
  set_target_properties(fuzz_follow_coverage PROPERTIES OUTPUT_NAME follow_coverage RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  target_precompile_headers(fuzz_follow_coverage REUSE_FROM signorini_headers)
  deal_ii_setup_target(fuzz_follow_coverage)
  signorini_compile_options(fuzz_follow_coverage)
  target_link_libraries(fuzz_follow_coverage signorini)
endif()
