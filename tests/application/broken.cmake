# Programs that are broken on purpose: one source with one change, the rest as it is. A case that passes otherwise has to
# notice them. The object comes before the archive, which has the same symbols and is not asked for them any more: its source
# compiles alone there (SKIP_UNITY_BUILD_INCLUSION in its files.cmake).
function(signorini_add_broken_program name case source right wrong)
  set(original ${PROJECT_SOURCE_DIR}/source/${source})
  set(copy ${CMAKE_CURRENT_BINARY_DIR}/broken/${name}.cc)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${original})
  file(READ ${original} text)
  string(FIND "${text}" "${right}" first)
  string(FIND "${text}" "${right}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "tests/application/broken.cmake: \"${right}\" should be in ${source} once.")
  endif()
  string(REPLACE "${right}" "${wrong}" text "${text}")
  file(CONFIGURE OUTPUT ${copy} CONTENT "${text}" @ONLY)
  set(target signorini_broken_${name})
  add_executable(${target} ${copy} $<TARGET_OBJECTS:signorini_program>)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  get_filename_component(folder ${original} DIRECTORY)
  target_include_directories(${target} PRIVATE ${folder})
  signorini_compile(${target} COLD)
  target_link_libraries(${target} signorini Eigen3::Eigen)
  add_test(NAME application/${case}.${name}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/application/run_case.py $<TARGET_FILE:${target}> ${case} 1)
  set_tests_properties(application/${case}.${name} PROPERTIES TIMEOUT 600)
endfunction()

# The gap counts with the wrong sign.
signorini_add_broken_program(gap verify_broken mortar/pair_coupling.cc
  "(prescribed_gap ? gap[0] : gap_along(normal, gap, normals)) / weight"
  "-(prescribed_gap ? gap[0] : gap_along(normal, gap, normals)) / weight")
# Contact forces act on the mortar side in the wrong direction.
signorini_add_broken_program(coupling verify_broken mortar/pair_coupling.cc
  "m_sum.values[q] / weight" "-m_sum.values[q] / weight")
# The weighted gap may be below the gap.
signorini_add_broken_program(crease chamfered_block_broken mortar/gap_fit.cc
  "std::max(0., raise)" "0. * raise")
