// An eye between the ears of a fork on a pin that nothing but contact holds: mm. The bores are wider than the pin by 0.04.
SetFactory("OpenCASCADE");
DefineConstant[ h = 2.5 ];
e = 0.1;
Box(1) = {-15, -15, -5, 65, 30, 10};
Cylinder(2) = {0, 0, -5, 0, 0, 10, 8.02};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-60, -15, -12, 75, 30, 24};
Box(5) = {-40, -15, -6, 55, 30, 12};
Cylinder(6) = {0, 0, -12, 0, 0, 24, 8.02};
BooleanDifference(7) = { Volume{4}; Delete; }{ Volume{5, 6}; Delete; };
Cylinder(8) = {0, 0, -16, 0, 0, 32, 8};

Physical Volume("eye") = {3};
Physical Volume("fork") = {7};
Physical Volume("pin") = {8};
Physical Surface("eye bore") = {Surface In BoundingBox{-8.02-e, -8.02-e, -5-e, 8.02+e, 8.02+e, 5+e}};
Physical Surface("fork bore") = {Surface In BoundingBox{-8.02-e, -8.02-e, 6-e, 8.02+e, 8.02+e, 12+e},
                                 Surface In BoundingBox{-8.02-e, -8.02-e, -12-e, 8.02+e, 8.02+e, -6+e}};
Physical Surface("pull") = {Surface In BoundingBox{50-e, -15-e, -5-e, 50+e, 15+e, 5+e}};
Physical Surface("base") = {Surface In BoundingBox{-60-e, -15-e, -12-e, -60+e, 15+e, 12+e}};
// Nothing of the bores fits into this box.
shank() = Surface In BoundingBox{-8.01, -8.01, -16-e, 8.01, 8.01, 16+e};
ends() = {Surface In BoundingBox{-8.01, -8.01, 16-e, 8.01, 8.01, 16+e}, Surface In BoundingBox{-8.01, -8.01, -16-e, 8.01, 8.01, -16+e}};
shank() -= ends();
Physical Surface("shank") = shank();
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
