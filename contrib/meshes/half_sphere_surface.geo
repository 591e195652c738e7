// The half-sphere z <= 1 of radius 1 around (0, 0, 1) as a fine surface, finest at the pole: the shape that the
// boundary of half_sphere_on_cube.msh follows.
//   gmsh -2 -format stl -bin half_sphere_surface.geo -o ../../prm/hertz/half_sphere_surface.stl
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 1, 1, -Pi/2, 0, 2*Pi};
e = 1e-6;
top() = Surface In BoundingBox{-1-e, -1-e, 1-e, 1+e, 1+e, 1+e};
all() = Boundary{ Volume{1}; };
sphere() = all();
sphere() -= top();
Physical Surface("sphere") = {sphere()};
Field[1]         = MathEval;
Field[1].F       = "0.003 + 0.055*(x*x + y*y + z*z)^0.8";
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints         = 0;
