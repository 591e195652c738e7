// A quarter of a shaft (R = 10.01) in a hub (10 ... 20), length 20: mm. The shaft is thicker than the bore by 0.02.
//   gmsh -3 -format msh41 press.geo -o press.msh        finer: -setnumber h 1
SetFactory("OpenCASCADE");
DefineConstant[ h = 2 ];
e = 1e-3;

Cylinder(1) = {0, 0, 0, 0, 0, 20, 10.01, Pi/2};
Cylinder(2) = {0, 0, 0, 0, 0, 20, 20, Pi/2};
Cylinder(3) = {0, 0, 0, 0, 0, 20, 10.0, Pi/2};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };

// The flat faces have any names: the program knows them by where they face (-x, -y, -z, +z).
Physical Volume("shaft") = {1};
Physical Volume("hub") = {4};
// Surfaces are found by the boxes that they fit into. What is flat fits into a thin one; the rest is round.
flat() = {Surface In BoundingBox{-e, -e, -e, e, 20+e, 20+e}, Surface In BoundingBox{-e, -e, -e, 20+e, e, 20+e},
          Surface In BoundingBox{-e, -e, -e, 20+e, 20+e, e}, Surface In BoundingBox{-e, -e, 20-e, 20+e, 20+e, 20+e}};
// The shaft is thicker than the bore: nothing of it fits into the box of that.
bore() = Surface In BoundingBox{-e, -e, -e, 10+e, 10+e, 20+e};
shaft() = Surface In BoundingBox{-e, -e, -e, 10.01+e, 10.01+e, 20+e};
shaft() -= bore();
hub() = Surface{:};
hub() -= bore();
hub() -= shaft();
journal() = shaft();
journal() -= flat();
outside() = hub();
outside() -= flat();
shaft() -= journal();
hub() -= outside();
Physical Surface("journal") = journal();
Physical Surface("bore") = bore();
Physical Surface("outside") = outside();
For i In {0:#shaft()-1}
  Physical Surface(Sprintf("shaft face %g", i)) = shaft(i);
EndFor
For i In {0:#hub()-1}
  Physical Surface(Sprintf("hub face %g", i)) = hub(i);
EndFor

Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
