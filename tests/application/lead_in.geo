SetFactory("OpenCASCADE");
DefineConstant[ angle = 30, h = 2 ];
// A quarter of a hollow shaft that is too thick for its hub by 0.02, with a chamfer at its end, in the hub.
c = 3;
d = c * Tan(angle * Pi / 180);
r = 10.02;
Point(1) = {4, 0, 0}; Point(2) = {r, 0, 0}; Point(3) = {r, 0, 30 - c}; Point(4) = {r - d, 0, 30}; Point(5) = {4, 0, 30};
For i In {1:4}
  Line(i) = {i, i + 1};
EndFor
Line(5) = {5, 1};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};
shaft() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{1}; };
Point(11) = {10, 0, 15}; Point(12) = {20, 0, 15}; Point(13) = {20, 0, 40}; Point(14) = {10, 0, 40};
For i In {11:13}
  Line(newl) = {i, i + 1};
EndFor
n = newl;
Line(n) = {14, 11};
Curve Loop(99) = {n - 3, n - 2, n - 1, n};
Plane Surface(99) = {99};
hub() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{99}; };
Physical Volume("shaft") = {shaft(1)};
Physical Volume("hub") = {hub(1)};
e = 1e-3;
Physical Surface("start") = {Surface In BoundingBox{-e, -e, -e, 11, 11, e}};
Physical Surface("end") = {Surface In BoundingBox{-e, -e, 40 - e, 21, 21, 40 + e}};
Physical Surface("at y") = {Surface In BoundingBox{-e, -e, -e, 21, e, 41}};
Physical Surface("at x") = {Surface In BoundingBox{-e, -e, -e, e, 21, 41}};
outer() = Surface In BoundingBox{-e, -e, -e, 11, 11, 30 + e};
outer() -= {Surface In BoundingBox{-e, -e, -e, 11, 11, e}, Surface In BoundingBox{-e, -e, -e, 21, e, 41}, Surface In BoundingBox{-e, -e, -e, e, 21, 41}};
bore() = Surface In BoundingBox{-e, -e, 15 - e, 10 + e, 10 + e, 40 + e};
bore() -= {Surface In BoundingBox{-e, -e, -e, 21, e, 41}, Surface In BoundingBox{-e, -e, -e, e, 21, 41}, outer()};
Physical Surface("outer") = {outer()};
Physical Surface("bore") = {bore()};
Mesh.CharacteristicLengthMin = 0.3 * h;
Mesh.CharacteristicLengthMax = h;
