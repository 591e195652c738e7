SetFactory("OpenCASCADE");
// A bolt in a nut, ridges around instead of a helix: flanks at 30 degrees, a clearance of c along the axis and of 0.15 along the radius. All of
// the thread may touch. Crests are 0.25 wide, the faces of the mesh up to three times that.
p = 2; n = 3; rmin = 6.8; rmaj = 8; c = 0.02; t = p / 8; s = Sqrt(3);
ri = rmin + 0.15; ro = rmaj + 0.15;
pb() = {}; pn() = {};
q = newp; Point(q) = {4, 0, -3}; pb() += q;
q = newp; Point(q) = {rmin, 0, -3}; pb() += q;
q = newp; Point(q) = {11, 0, n * p}; pn() += q;
q = newp; Point(q) = {11, 0, 0}; pn() += q;
q = newp; Point(q) = {ri, 0, 0}; pn() += q;
For k In {0 : n - 1}
  z = k * p + p / 2;
  // Half of what is between the flanks, by radius.
  q = newp; Point(q) = {rmin, 0, z - t / 2 - (rmaj - rmin) / s}; pb() += q;
  q = newp; Point(q) = {rmaj, 0, z - t / 2}; pb() += q;
  q = newp; Point(q) = {rmaj, 0, z + t / 2}; pb() += q;
  q = newp; Point(q) = {rmin, 0, z + t / 2 + (rmaj - rmin) / s}; pb() += q;
  q = newp; Point(q) = {ri, 0, z - t / 2 - (rmaj - ri) / s - c}; pn() += q;
  q = newp; Point(q) = {ro, 0, z - t / 2 - (rmaj - ro) / s - c}; pn() += q;
  q = newp; Point(q) = {ro, 0, z + t / 2 + (rmaj - ro) / s + c}; pn() += q;
  q = newp; Point(q) = {ri, 0, z + t / 2 + (rmaj - ri) / s + c}; pn() += q;
EndFor
q = newp; Point(q) = {rmin, 0, n * p + 1}; pb() += q;
q = newp; Point(q) = {4, 0, n * p + 1}; pb() += q;
q = newp; Point(q) = {ri, 0, n * p}; pn() += q;
lb() = {}; ln() = {};
For k In {0 : #pb() - 1}
  l = newl; Line(l) = {pb(k), pb((k + 1) % #pb())}; lb() += l;
EndFor
For k In {0 : #pn() - 1}
  l = newl; Line(l) = {pn(k), pn((k + 1) % #pn())}; ln() += l;
EndFor
Curve Loop(1) = lb(); Plane Surface(1) = {1};
Curve Loop(2) = ln(); Plane Surface(2) = {2};
b() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{1}; };
m() = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{2}; };
e = 1e-3;
Physical Volume("bolt") = {b(1)}; Physical Volume("nut") = {m(1)};
ub() = Abs(Boundary{ Volume{b(1)}; }); un() = Abs(Boundary{ Volume{m(1)}; });
bx() = {1, b(0)}; nx() = {2, m(0)};
pull() = Surface In BoundingBox{-e, -e, -3 - e, 7, 7, -3 + e};
seat() = Surface In BoundingBox{-e, -e, -e, 12, 12, e}; seat() -= ub();
top() = Surface In BoundingBox{-e, -e, n * p - e, 12, 12, n * p + e}; top() -= ub();
rim() = Surface In BoundingBox{-e, -e, -e, 12, 12, n * p + e}; rim() -= ub(); rim() -= nx(); rim() -= seat(); rim() -= top();
inner() = Surface In BoundingBox{-e, -e, -e, 8.5, 8.5, n * p + e}; 
tb() = inner(); tb() -= un(); tb() -= bx();
tn() = inner(); tn() -= ub(); tn() -= nx(); tn() -= seat(); tn() -= top();
Physical Surface("bolt y") = {1}; Physical Surface("bolt x") = {b(0)}; Physical Surface("nut y") = {2}; Physical Surface("nut x") = {m(0)};
Physical Surface("pulled") = {pull()}; Physical Surface("seat") = {seat()};
Physical Surface("bolt thread") = {tb()}; Physical Surface("nut thread") = {tn()};
Field[1] = MathEval; Field[1].F = "0.6*(1+1.2*Fabs(Sqrt(x*x+y*y)-7.4))"; Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeFromCurvature = 0;
