// A disc with a bore in a ring, unstructured tetrahedra; the ring is a little wider.
SetFactory("OpenCASCADE");
Geometry.OCCBoundsUseStl = 1;
Mesh.MeshSizeMax = 5;
Mesh.MeshSizeMin = 3;
Cylinder(1) = {0, 0, 0, 0, 0, 8, 30};
Cylinder(2) = {0, 0, 0, 0, 0, 8, 10};
Cylinder(3) = {0, 0, 0, 0, 0, 8, 45};
Cylinder(4) = {0, 0, 0, 0, 0, 8, 30.02};
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Physical Volume("disc") = {5};
Physical Volume("ring") = {6};
Macro Names
  // Of volume v: its ends, and its surface of radius r.
  faces[] = Boundary { Volume{v}; };
  ends[] = {};
  round[] = {};
  For f In {0 : #faces[] - 1}
    box[] = BoundingBox Surface{Abs(faces[f])};
    If (box[5] - box[2] < 1)
      ends[] += Abs(faces[f]);
    ElseIf (Fabs(box[3] - r) < 0.01)
      round[] += Abs(faces[f]);
    EndIf
  EndFor
Return
v = 5; r = 30; Call Names;
Physical Surface("disc ends") = ends[];
Physical Surface("disc rim") = round[];
v = 6; r = 30.02; Call Names;
Physical Surface("ring ends") = ends[];
Physical Surface("ring bore") = round[];
