// A pin (R = 10, z = -16 ... 16) in the bore (R = 10.025) of a lug 80 x 40 x 12: mm.
//   gmsh -3 -format msh41 lug.geo -o lug.msh        finer: -setnumber h 1
SetFactory("OpenCASCADE");
DefineConstant[ h = 2.5 ];
e = 1e-3;

Box(1) = {-20, -20, -6, 80, 40, 12};
Cylinder(2) = {0, 0, -6, 0, 0, 12, 10.025};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -16, 0, 0, 32, 10};

lug = 3;
pin = 4;
Include "names.geo";

Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
