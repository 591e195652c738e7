// A quarter of a shaft (R = 10.01) in a hub (10 ... 20), length 20: mm. The shaft is thicker than the bore by 0.02.
//   gmsh -3 -format msh41 press.geo -o press.msh        finer: -setnumber h 1
SetFactory("OpenCASCADE");
DefineConstant[ h = 2 ];
e = 1e-3;

Cylinder(1) = {0, 0, 0, 0, 0, 20, 10.01, Pi/2};
Cylinder(2) = {0, 0, 0, 0, 0, 20, 20, Pi/2};
Cylinder(3) = {0, 0, 0, 0, 0, 20, 10.0, Pi/2};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };

// The flat faces need no names: the program knows them by where they face (-x, -y, -z, +z).
Physical Volume("shaft") = {1};
Physical Volume("hub") = {4};
shaft() = Boundary{ Volume{1}; };
For i In {0:#shaft()-1}
  b() = BoundingBox Surface{shaft(i)};
  If (b(3) > 1 && b(4) > 1 && b(5) - b(2) > 1)
    Physical Surface("journal") = shaft(i);
  Else
    Physical Surface(Sprintf("shaft face %g", i)) = shaft(i);
  EndIf
EndFor
hub() = Boundary{ Volume{4}; };
For i In {0:#hub()-1}
  b() = BoundingBox Surface{hub(i)};
  If (b(3) > 1 && b(4) > 1 && b(5) - b(2) > 1)
    If (b(3) < 15)
      Physical Surface("bore") = hub(i);
    Else
      Physical Surface("outside") = hub(i);
    EndIf
  Else
    Physical Surface(Sprintf("hub face %g", i)) = hub(i);
  EndIf
EndFor

Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
