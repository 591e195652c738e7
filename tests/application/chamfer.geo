SetFactory("OpenCASCADE");
DefineConstant[ h = 1.3 ];
// A block with chamfers along two edges of its foot, on a plate. The creases are within the faces of the plate.
Point(1) = {-4.3, -5, 0}; Point(2) = {4.3, -5, 0}; Point(3) = {5, -5, 0.25}; Point(4) = {5, -5, 6}; Point(5) = {-5, -5, 6}; Point(6) = {-5, -5, 0.25};
For i In {1:5}
  Line(i) = {i, i + 1};
EndFor
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
block() = Extrude {0, 10, 0} { Surface{1}; };
Box(2) = {-9.3, -8.1, -6, 18, 17, 6};
Physical Volume("block") = {1};
Physical Volume("plate") = {2};
e = 1e-3;
foot() = Surface In BoundingBox{-5 - e, -5 - e, -e, 5 + e, 5 + e, 0.25 + e};
Physical Surface("foot") = {foot()};
head() = Surface In BoundingBox{-5 - e, -5 - e, 6 - e, 5 + e, 5 + e, 6 + e};
Physical Surface("head") = {head()};
top() = Surface In BoundingBox{-10, -10, -e, 10, 10, e};
top() -= Surface In BoundingBox{-5 - e, -5 - e, -e, 5 + e, 5 + e, e};
Physical Surface("top") = {top()};
ground() = Surface In BoundingBox{-10, -10, -6 - e, 10, 10, -6 + e};
Physical Surface("ground") = {ground()};
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
