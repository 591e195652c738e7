// The paper's first example: half-sphere of radius 1 on a cube with edges of length 2, unstructured tetrahedra.
//   gmsh -3 -format msh41 -bin half_sphere_on_cube.geo -o ../../prm/hertz/half_sphere_on_cube.msh
SetFactory("OpenCASCADE");
h = DefineNumber[0.19, Name "size"];
Sphere(1) = {0, 0, 1, 1, -Pi/2, 0, 2*Pi};
Box(2)    = {-1, -1, -2, 2, 2, 2};
e = 1e-6;
top() = Surface In BoundingBox{-1-e, -1-e, 1-e, 1+e, 1+e, 1+e};
Physical Volume("ball") = {1};
Physical Volume("cube") = {2};
all() = Boundary{ Volume{1}; };
sphere() = all();
sphere() -= top();
Physical Surface("ball top") = {top()};
Physical Surface("sphere")   = {sphere()};
Physical Surface("cube top") = {Surface In BoundingBox{-1-e, -1-e, -e, 1+e, 1+e, e}};
Physical Surface("bottom")   = {Surface In BoundingBox{-1-e, -1-e, -2-e, 1+e, 1+e, -2+e}};
Physical Surface("left")     = {Surface In BoundingBox{-1-e, -1-e, -2-e, -1+e, 1+e, e}};
Physical Surface("right")    = {Surface In BoundingBox{1-e, -1-e, -2-e, 1+e, 1+e, e}};
Physical Surface("front")    = {Surface In BoundingBox{-1-e, -1-e, -2-e, 1+e, -1+e, e}};
Physical Surface("back")     = {Surface In BoundingBox{-1-e, 1-e, -2-e, 1+e, 1+e, e}};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.OptimizeThreshold = 0.6;
Mesh.Optimize          = 1;
