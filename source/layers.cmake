# The layers, lowest first. Each folder lists its sources, explicit and sorted, in files.cmake.
foreach(layer algebra surface solvers mesh discretization mortar output application verification)
  include(${layer}/files.cmake)
endforeach()
