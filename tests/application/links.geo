// Two halves of oval chain links, of round wire, crossed: they touch at one point inside their bends, where
// the principal curvatures of the gap are both 1/r - 1/(R - r).
SetFactory("OpenCASCADE");
If (!Exists(h)) h = .16; EndIf
r = 3; R = 8; L = 6;
For k In {0:1}
  turn = k == 0 ? -Pi/2 : Pi/2;
  x = k == 0 ? L/2 : -L/2;
  Torus(10*k + 1) = {0, 0, 0, R, r, Pi};
  Rotate { {0, 0, 1}, {0, 0, 0}, turn } { Volume{10*k + 1}; }
  Translate { x, 0, 0 } { Volume{10*k + 1}; }
  Cylinder(10*k + 2) = {-L/2, R, 0, L, 0, 0, r};
  Cylinder(10*k + 3) = {-L/2, -R, 0, L, 0, 0, r};
EndFor
a() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
b() = BooleanFragments{ Volume{11}; Delete; }{ Volume{12, 13}; Delete; };
Rotate { {1, 0, 0}, {0, 0, 0}, Pi/2 } { Volume{b()}; }
Translate { L + 2*(R - r), 0, 0 } { Volume{b()}; }
e = 1e-3;
end = 3*L/2 + 2*(R - r);
left() = Surface In BoundingBox{-L/2 - e, -30, -30, -L/2 + e, 30, 30};
right() = Surface In BoundingBox{end - e, -30, -30, end + e, 30, 30};
Physical Volume("left") = {a()};
Physical Volume("right") = {b()};
all() = Abs(CombinedBoundary{ Volume{a()}; });
all() -= left();
Physical Surface("left skin") = {all()};
all() = Abs(CombinedBoundary{ Volume{b()}; });
all() -= right();
Physical Surface("right skin") = {all()};
Physical Surface("left ends") = {left()};
Physical Surface("right ends") = {right()};
Field[1] = Ball;
Field[1].XCenter = L/2 + R - r;
Field[1].Radius = .9;
Field[1].Thickness = 2;
Field[1].VIn = h;
Field[1].VOut = 1.6;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
