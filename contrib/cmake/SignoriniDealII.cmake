# Signorini::dealii: what the headers and archives need of deal.II, in the flavour (DEBUG or RELEASE) that the
# library is built with; mixing flavours in one program breaks it. Used by the build and by the installed package.
function(signorini_add_dealii_target flavour)
  if(TARGET Signorini::dealii)
    return()
  endif()
  if(NOT TARGET ${DEAL_II_TARGET_${flavour}})
    # Up to deal.II 9.4 its own targets are read by deal_ii_setup_target() only.
    include(${DEAL_II_TARGET_CONFIG})
    set(DEAL_II_TARGET_CONFIG_INCLUDED TRUE PARENT_SCOPE)
  endif()
  add_library(Signorini::dealii INTERFACE IMPORTED GLOBAL)
  target_include_directories(Signorini::dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
  target_compile_definitions(Signorini::dealii INTERFACE ${DEAL_II_USER_DEFINITIONS}
                                                         ${DEAL_II_USER_DEFINITIONS_${flavour}})
  target_link_libraries(Signorini::dealii INTERFACE ${DEAL_II_TARGET_${flavour}})
  # deal.II's own linker, where it is installed: with two hundred shared libraries gold takes two seconds, ld half a minute.
  if(NOT CMAKE_LINKER_TYPE AND NOT "${CMAKE_EXE_LINKER_FLAGS}" MATCHES "-fuse-ld" AND DEAL_II_LINKER_FLAGS MATCHES "-fuse-ld=([a-z]+)")
    find_program(SIGNORINI_LINKER ld.${CMAKE_MATCH_1})
    mark_as_advanced(SIGNORINI_LINKER)
    if(SIGNORINI_LINKER)
      target_link_options(Signorini::dealii INTERFACE -fuse-ld=${CMAKE_MATCH_1})
    endif()
  endif()
endfunction()
