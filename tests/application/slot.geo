SetFactory("OpenCASCADE");
DefineConstant[ h = 1.1, walls = 1 ];
// A block on a plate with a slot. With walls: the surfaces that may touch are all of both bodies but the loaded and the fixed face.
Box(1) = {-5, -5, 0, 10, 10, 5};
Box(2) = {-9.3, -8.1, -6, 18, 17, 6};
Box(3) = {-1.37, -8.1, -2, 2.9, 17, 2};
plate() = BooleanDifference{ Volume{2}; Delete; }{ Volume{3}; Delete; };
Physical Volume("block") = {1};
Physical Volume("plate") = {plate()};
e = 1e-3;
head() = Surface In BoundingBox{-5 - e, -5 - e, 5 - e, 5 + e, 5 + e, 5 + e};
ground() = Surface In BoundingBox{-10, -10, -6 - e, 10, 10, -6 + e};
If (walls)
  foot() = Abs(Boundary{ Volume{1}; });
  foot() -= head();
  top() = Abs(Boundary{ Volume{plate()}; });
  top() -= ground();
Else
  foot() = Surface In BoundingBox{-5 - e, -5 - e, -e, 5 + e, 5 + e, e};
  top() = Surface In BoundingBox{-10, -10, -e, 10, 10, e};
  top() -= foot();
EndIf
Physical Surface("head") = {head()};
Physical Surface("ground") = {ground()};
Physical Surface("foot") = {foot()};
Physical Surface("top") = {top()};
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
