# The program loaded once, and what stands for it where tests start it: see server.cc.
add_executable(signorini_server served/server.cc $<TARGET_OBJECTS:signorini_program>)
set_target_properties(signorini_server PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
signorini_compile(signorini_server COLD)
target_link_libraries(signorini_server signorini)
target_link_options(signorini_server PRIVATE -Wl,--wrap=main)
# Tests take a server for what it is only where it is newer than the program.
add_dependencies(signorini_server signorini_program)
add_executable(signorini_client served/client.cc)
set_target_properties(signorini_client PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
signorini_compile_options(signorini_client COLD)
