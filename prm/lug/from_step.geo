// The same bodies from a STEP file of a program for CAD.
//   gmsh -3 -format msh41 from_step.geo -o lug.msh
SetFactory("OpenCASCADE");
DefineConstant[ h = 2.5 ];
e = 1e-3;

// Lengths in a STEP file come as mm. The solids become volumes 1, 2, ... in the order of the file.
Merge "part.step";
lug = 1;
pin = 2;
Include "names.geo";

Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
