SetFactory("OpenCASCADE");
// A bolt with five ring grooves in a nut, a clearance of 0.05 along the radius, an eighth of both. All of their skin may touch.
DefineConstant[ h = 0.35 ];
p = 2.5; n = 5; rb = 8.5; rt = 9.8; c = 0.05;
b() = {}; m() = {};
q = newp; Point(q) = {0, 0, -6}; b() += q;
q = newp; Point(q) = {rb, 0, -6}; b() += q;
q = newp; Point(q) = {16, 0, 0}; m() += q;
For k In {0 : n - 1}
  z = k * p;
  q = newp; Point(q) = {rb, 0, z + 0.15}; b() += q;
  q = newp; Point(q) = {rt, 0, z + 0.9}; b() += q;
  q = newp; Point(q) = {rt, 0, z + 1.15}; b() += q;
  q = newp; Point(q) = {rb, 0, z + 1.9}; b() += q;
  q = newp; Point(q) = {rb + c, 0, z}; m() += q;
  q = newp; Point(q) = {rb + c, 0, z + 0.15}; m() += q;
  q = newp; Point(q) = {rt + c, 0, z + 0.9}; m() += q;
  q = newp; Point(q) = {rt + c, 0, z + 1.2}; m() += q;
  q = newp; Point(q) = {rb + c, 0, z + 1.95}; m() += q;
EndFor
q = newp; Point(q) = {rb, 0, n * p + 6}; b() += q;
q = newp; Point(q) = {0, 0, n * p + 6}; b() += q;
q = newp; Point(q) = {rb + c, 0, n * p}; m() += q;
q = newp; Point(q) = {16, 0, n * p}; m() += q;
lb() = {}; lm() = {};
For i In {0 : #b[] - 1}
  q = newl; Line(q) = {b[i], b[(i + 1) % #b[]]}; lb() += q;
EndFor
For i In {0 : #m[] - 1}
  q = newl; Line(q) = {m[i], m[(i + 1) % #m[]]}; lm() += q;
EndFor
Curve Loop(1) = {lb[]}; Plane Surface(1) = {1};
Curve Loop(2) = {lm[]}; Plane Surface(2) = {2};
bolt() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 4 } { Surface{1}; };
nut() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 4 } { Surface{2}; };
Physical Volume("bolt") = {bolt[1]};
Physical Volume("nut") = {nut[1]};
Physical Surface("bolt skin") = {1, bolt[{0, 2 : #bolt[] - 1}]};
Physical Surface("nut skin") = {2, nut[{0, 2 : #nut[] - 1}]};
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.25 * Fabs(Sqrt(x * x + y * y) - 9.2)", h);
Background Field = 1;
Mesh.CharacteristicLengthMin = 0;
Mesh.CharacteristicLengthMax = 2.5;
