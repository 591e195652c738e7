SetFactory("OpenCASCADE");
DefineConstant[ angle = 20, h = 2 ];
// A quarter of a conical plug, in a conical socket that ends before it at both ends.
t = Tan(angle * Pi / 180);
Point(1) = {1, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {5 + 10 * t, 0, 10}; Point(4) = {1, 0, 10};
Point(11) = {5 + t, 0, 1}; Point(12) = {13, 0, 1}; Point(13) = {13, 0, 9}; Point(14) = {5 + 9 * t, 0, 9};
For k In {0:1}
  For i In {1:4}
    Line(10*k + i) = {10*k + i, 10*k + i%4 + 1};
  EndFor
  Curve Loop(k + 1) = {10*k + 1:10*k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
plug() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{1}; };
socket() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{2}; };
// Volume and sides, in the order of the lines.
Physical Volume("plug") = {plug(1)};
Physical Volume("socket") = {socket(1)};
Physical Surface("taper") = {plug(3)};
Physical Surface("head") = {plug(4)};
Physical Surface("seat") = {socket(5)};
Physical Surface("foot") = {socket(2)};
e = 1e-3;
Physical Surface("at y") = {Surface In BoundingBox{-e, -e, -e, 14, e, 11}};
Physical Surface("at x") = {Surface In BoundingBox{-e, -e, -e, e, 14, 11}};
MeshSize{ PointsOf{ Volume{plug(1)}; } } = h;
MeshSize{ PointsOf{ Volume{socket(1)}; } } = 0.7 * h;
Mesh.CharacteristicLengthExtendFromBoundary = 1;
