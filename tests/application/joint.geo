// A ball (R = 10) with a shaft in a spherical socket (R = 10.02): gmsh -3 joint.geo -o joint.msh
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 10};
Cylinder(2) = {0, 0, 5, 0, 0, 20, 4};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-16, -16, -18, 32, 32, 20};
Sphere(5) = {0, 0, 0, 10.02};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
e = 1e-3;
Physical Volume("ball") = {3};
Physical Volume("socket") = {6};
Physical Surface("end") = Surface In BoundingBox{-4 - e, -4 - e, 25 - e, 4 + e, 4 + e, 25 + e};
Physical Surface("head") = Surface In BoundingBox{-10 - e, -10 - e, -10 - e, 10 + e, 10 + e, 10};
Physical Surface("foot") = Surface In BoundingBox{-16 - e, -16 - e, -18 - e, 16 + e, 16 + e, -18 + e};
Physical Surface("bowl") = Surface In BoundingBox{-10.02 - e, -10.02 - e, -10.02 - e, 10.02 + e, 10.02 + e, 2 + e};
Mesh.CharacteristicLengthMin = 3;
Mesh.CharacteristicLengthMax = 3;
