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
