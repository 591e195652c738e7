// A core in a sleeve, unstructured tetrahedra that do not match: coarse ones in the core.
SetFactory("OpenCASCADE");
Geometry.OCCBoundsUseStl = 1;
Mesh.MeshSizeExtendFromBoundary = 1;
Cylinder(1) = {0, 0, 8, 0, 6, 0, 8};
Cylinder(2) = {0, 0, 8, 0, 6, 0, 5};
Cylinder(3) = {0, 0, 8, 0, 6, 0, 5};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize { PointsOf { Volume{3}; } } = 4;
MeshSize { PointsOf { Volume{4}; } } = 1.5;
Physical Volume("core") = {3};
Physical Volume("sleeve") = {4};
Macro Names
  // Of volume v: its surface of radius r.
  faces[] = Boundary { Volume{v}; };
  round[] = {};
  For f In {0 : #faces[] - 1}
    box[] = BoundingBox Surface{Abs(faces[f])};
    If (box[4] - box[1] > 1 && Fabs(box[3] - r) < 0.01)
      round[] += Abs(faces[f]);
    EndIf
  EndFor
Return
v = 3; r = 5; Call Names;
Physical Surface("core rim") = round[];
v = 4; r = 5; Call Names;
Physical Surface("sleeve bore") = round[];
v = 4; r = 8; Call Names;
Physical Surface("sleeve rim") = round[];
