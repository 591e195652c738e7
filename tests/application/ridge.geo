// Two blocks whose shoulders touch; between them a ridge in a wider groove, farther away than the cells at its crease are wide.
SetFactory("OpenCASCADE");
h = 0.3;
Point(1) = {-4, 0, -4}; Point(2) = {4, 0, -4}; Point(3) = {4, 0, 0}; Point(4) = {2.5, 0, 0}; Point(5) = {0, 0, -2.5}; Point(6) = {-2.5, 0, 0}; Point(7) = {-4, 0, 0};
For i In {1:6}
  Line(i) = {i, i + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1:7};
Plane Surface(1) = {1};
lower() = Extrude {0, 3, 0} { Surface{1}; };
Point(101) = {-4, 0, 0}; Point(102) = {-1.25, 0, 0}; Point(103) = {0, 0, -1}; Point(104) = {1.25, 0, 0}; Point(105) = {4, 0, 0}; Point(106) = {4, 0, 3}; Point(107) = {-4, 0, 3};
For i In {101:106}
  Line(i) = {i, i + 1};
EndFor
Line(107) = {107, 101};
Curve Loop(101) = {101:107};
Plane Surface(101) = {101};
upper() = Extrude {0, 3, 0} { Surface{101}; };
Physical Volume("lower") = {lower(1)};
Physical Volume("upper") = {upper(1)};
// Sides in the order of the lines.
Physical Surface("bottom") = {lower(2)};
Physical Surface("groove") = {lower(4), lower(5), lower(6), lower(7)};
Physical Surface("ridge") = {upper(2), upper(3), upper(4), upper(5)};
Physical Surface("top") = {upper(7)};
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
