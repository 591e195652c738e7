SetFactory("OpenCASCADE");
DefineConstant[ h = 3 ];
// A shaft (R = 10) in the groove of a V-block, its axis at y = 10 sqrt 2.
//   gmsh -3 -format msh41 vee.geo -o vee.msh
Point(1)={-20,-12,-15}; Point(2)={20,-12,-15}; Point(3)={20,16,-15}; Point(4)={16,16,-15};Point(5)={0,0,-15};Point(6)={-16,16,-15};Point(7)={-20,16,-15};
For i In {1:6}
 Line(i)={i,i+1};
EndFor
Line(7)={7,1};
Curve Loop(1)={1:7}; Plane Surface(1)={1};
out[]=Extrude{0,0,30}{Surface{1};};
Cylinder(2)={0,14.1421356,-20,0,0,40,10};
Physical Volume("block")={1};
Physical Volume("shaft")={2};
e=1e-3;
f[]=Surface In BoundingBox{-20-e,-12-e,-15-e,20+e,-12+e,15+e}; Physical Surface("bottom")={f[]};
f[]=Surface In BoundingBox{-16-e,0-e,-15-e,16+e,16+e,15+e}; Physical Surface("groove")={f[]};
f[]=Surface In BoundingBox{-10-e,4-e,-20-e,10+e,24.2,20+e};
b[]=Surface In BoundingBox{-10-e,4-e,-20-e,10+e,24.2,-20+e};
t[]=Surface In BoundingBox{-10-e,4-e,20-e,10+e,24.2,20+e};
f[]-=b[]; f[]-=t[];
Physical Surface("ends")={b[],t[]};
Physical Surface("shank")={f[]};
Mesh.CharacteristicLengthMin=h;Mesh.CharacteristicLengthMax=h;
