// A hub on a shaft with a key between them. Each body has one boundary, but for what is held or loaded.
SetFactory("OpenCASCADE");
DefineConstant[ h = 2 ];
Cylinder(1) = {0, 0, 0, 40, 0, 0, 15};
Box(2) = {8, -4, 10.5, 24, 8, 10};
shaft() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(11) = {10, 0, 0, 20, 0, 0, 30};
Cylinder(12) = {10, 0, 0, 20, 0, 0, 15};
Box(13) = {9, -4, 0, 22, 8, 18.6};
hub() = BooleanDifference{ Volume{11}; Delete; }{ Volume{12, 13}; Delete; };
Box(21) = {8, -4, 10.5, 24, 8, 7.6};
e = 1e-3;
Physical Volume("shaft") = {shaft()};
Physical Volume("hub") = {hub()};
Physical Volume("key") = {21};
end() = Surface In BoundingBox{-e, -16, -16, e, 16, 16};
s() = Abs(Boundary{ Volume{shaft()}; });
s() -= end();
u() = Abs(Boundary{ Volume{hub()}; });
rim = 0;
For i In {0 : #u() - 1}
  b() = BoundingBox Surface{u(i)};
  If (b(5) > 29.9 && b(3) - b(0) > 1)
    rim = u(i);
  EndIf
EndFor
u() -= {rim};
k() = Abs(Boundary{ Volume{21}; });
Physical Surface("shaft end") = {end()};
Physical Surface("rim") = {rim};
Physical Surface("shaft skin") = {s()};
Physical Surface("hub skin") = {u()};
Physical Surface("key skin") = {k()};
Mesh.MeshSizeMax = h;
