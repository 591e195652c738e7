// Names for what the parameter file speaks of. A surface is found by the box that it fits into.
Physical Volume("lug") = {lug};
Physical Volume("pin") = {pin};
Physical Surface("pull") = Surface In BoundingBox{60-e, -20-e, -6-e, 60+e, 20+e, 6+e};
Physical Surface("bore") = Surface In BoundingBox{-10.025-e, -10.025-e, -6-e, 10.025+e, 10.025+e, 6+e};
ends() = {Surface In BoundingBox{-11, -11, -16-e, 11, 11, -16+e}, Surface In BoundingBox{-11, -11, 16-e, 11, 11, 16+e}};
Physical Surface("ends") = ends();
// What else bounds the pin. Newer versions of gmsh (4.13) give Boundary{} signs for orientation.
shank() = Abs(Boundary{ Volume{pin}; });
shank() -= ends();
Physical Surface("shank") = shank();
