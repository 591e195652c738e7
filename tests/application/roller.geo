SetFactory("OpenCASCADE");
DefineConstant[ h = 1.5 ];
// A roller (R = 5) between two plates, 0.01 away from each.
//   gmsh -3 -format msh41 roller.geo -o roller.msh
Cylinder(1)={0,0,0,0,0,10,5};
Box(2)={-8,-10.01,-1,16,5,12};
Box(3)={-8,5.01,-1,16,5,12};
Physical Volume("roller")={1};
Physical Volume("lower")={2};
Physical Volume("upper")={3};
e=1e-3;
f[]=Surface In BoundingBox{-5-e,-5-e,-e,5+e,5+e,10+e};
b[]=Surface In BoundingBox{-5-e,-5-e,-e,5+e,5+e,e};
t[]=Surface In BoundingBox{-5-e,-5-e,10-e,5+e,5+e,10+e};
f[]-=b[]; f[]-=t[];
Physical Surface("barrel")={f[]};
f[]=Surface In BoundingBox{-8-e,-5.01-e,-1-e,8+e,-5.01+e,11+e}; Physical Surface("lower top")={f[]};
f[]=Surface In BoundingBox{-8-e,-10.01-e,-1-e,8+e,-10.01+e,11+e}; Physical Surface("lower bottom")={f[]};
f[]=Surface In BoundingBox{-8-e,5.01-e,-1-e,8+e,5.01+e,11+e}; Physical Surface("upper bottom")={f[]};
f[]=Surface In BoundingBox{-8-e,10.01-e,-1-e,8+e,10.01+e,11+e}; Physical Surface("upper top")={f[]};
Mesh.CharacteristicLengthMin=h;Mesh.CharacteristicLengthMax=h;
