SetFactory("OpenCASCADE");
DefineConstant[ whole = 1, clearance = 0.03 ];
// A pin in a lug. Whole: the surfaces that may touch are all of both bodies but the loaded and the fixed faces; otherwise the bore and the side of the pin.
Box(1) = {-10, -8, 0, 30, 16, 5};
Cylinder(2) = {0, 0, -1, 0, 0, 7, 4};
Cylinder(3) = {0, 0, -2, 0, 0, 9, 4 - clearance};
lug() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("lug") = {lug()};
Physical Volume("pin") = {3};
e = 1e-3;
pull() = Surface In BoundingBox{20 - e, -9, -1, 20 + e, 9, 6};
ends() = Surface In BoundingBox{-5, -5, -2 - e, 5, 5, -2 + e};
ends() += Surface In BoundingBox{-5, -5, 7 - e, 5, 5, 7 + e};
bore() = Abs(Boundary{ Volume{lug()}; });
bore() -= pull();
If (!whole)
  bore() = Surface In BoundingBox{-4 - e, -4 - e, -e, 4 + e, 4 + e, 5 + e};
EndIf
side() = Abs(Boundary{ Volume{3}; });
side() -= ends();
Physical Surface("pull") = {pull()};
Physical Surface("ends") = {ends()};
Physical Surface("lug skin") = {bore()};
Physical Surface("pin skin") = {side()};
Mesh.CharacteristicLengthMin = 1.2;
Mesh.CharacteristicLengthMax = 1.2;
