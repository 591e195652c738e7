// A pin of radius 5 with chamfered ends through the bores (radius 5.02) of a lug between two forks; the mouths of all bores have chamfers of 45 degrees.
SetFactory("OpenCASCADE");
DefineConstant[ h = 2, c = 0.8 ];
r = 5.02;
Cylinder(1) = {0, -11.5, 0, 0, 23, 0, 5};
Cone(2) = {0, -12.5, 0, 0, 1, 0, 4, 5};
Cone(3) = {0, 11.5, 0, 0, 1, 0, 5, 4};
pin() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Macro Bore
  Cylinder(90) = {0, y, 0, 0, t, 0, r};
  Cone(91) = {0, y, 0, 0, c, 0, r + c, r};
  Cone(92) = {0, y + t - c, 0, 0, c, 0, r, r + c};
  BooleanDifference{ Volume{n}; Delete; }{ Volume{90, 91, 92}; Delete; }
Return
n = 11; y = -5; t = 10; Box(n) = {-9, y, -22, 18, t, 31}; Call Bore;
n = 12; y = -11.1; t = 6; Box(n) = {-9, y, -9, 18, t, 29}; Call Bore;
n = 13; y = 5.1; t = 6; Box(n) = {-9, y, -9, 18, t, 29}; Call Bore;
load() = Surface In BoundingBox {-10, -6, -22.1, 10, 6, -21.9};
left() = Surface In BoundingBox {-10, -12, 19.9, 10, 0, 20.1};
right() = Surface In BoundingBox {-10, 0, 19.9, 10, 12, 20.1};
lug() = Abs(Boundary{ Volume{11}; }); lug() -= {load()};
one() = Abs(Boundary{ Volume{12}; }); one() -= {left()};
two() = Abs(Boundary{ Volume{13}; }); two() -= {right()};
skin() = Abs(Boundary{ Volume{pin(0)}; });
Physical Volume("pin") = {pin(0)}; Physical Surface("pin skin") = {skin()};
Physical Volume("lug") = {11}; Physical Surface("load") = {load()}; Physical Surface("lug skin") = {lug()};
Physical Volume("one") = {12}; Physical Surface("left") = {left()}; Physical Surface("one skin") = {one()};
Physical Volume("two") = {13}; Physical Surface("right") = {right()}; Physical Surface("two skin") = {two()};
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumElementsPerTwoPi = 16;
