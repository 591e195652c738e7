// A pin (R = 10, z = -16 ... 16) in the bore (R = 10.025) of a lug 80 x 40 x 12: mm.
//   gmsh -3 -format msh41 lug.geo -o lug.msh        finer: -setnumber h 1
SetFactory("OpenCASCADE");
DefineConstant[ h = 2.5 ];
e = 1e-3;

Box(1) = {-20, -20, -6, 80, 40, 12};
Cylinder(2) = {0, 0, -6, 0, 0, 12, 10.025};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -16, 0, 0, 32, 10};

// Names for what the parameter file speaks of. A surface is found by the box that it fits into.
Physical Volume("lug") = {3};
Physical Volume("pin") = {4};
Physical Surface("pull") = Surface In BoundingBox{60-e, -20-e, -6-e, 60+e, 20+e, 6+e};
Physical Surface("bore") = Surface In BoundingBox{-10.025-e, -10.025-e, -6-e, 10.025+e, 10.025+e, 6+e};
Physical Surface("ends") = {Surface In BoundingBox{-11, -11, -16-e, 11, 11, -16+e}, Surface In BoundingBox{-11, -11, 16-e, 11, 11, 16+e}};
all() = Boundary{ Volume{4}; };
For i In {0:#all()-1}
  b() = BoundingBox Surface{all(i)};
  If (b(2) < -15 && b(5) > 15)
    Physical Surface("shank") = all(i);
  EndIf
EndFor

Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
