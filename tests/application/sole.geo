// A steel block of 12 x 12 x 10 whose sole of 10 x 12 stands on a plate, over an edge of 45 degrees (rounding 0) or a fillet of radius 1.
SetFactory("OpenCASCADE");
DefineConstant[ rounding = 0, h = 1.5 ];
Point(1) = {-5, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {6, 0, 1}; Point(4) = {6, 0, 10}; Point(5) = {-6, 0, 10}; Point(6) = {-6, 0, 1};
Point(7) = {-5, 0, 1}; Point(8) = {5, 0, 1};
Line(1) = {1, 2}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
If (rounding)
  Circle(2) = {2, 8, 3}; Circle(6) = {6, 7, 1};
Else
  Line(2) = {2, 3}; Line(6) = {6, 1};
EndIf
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
out() = Extrude {0, 12, 0} { Surface{1}; };
Box(20) = {-15, -4, -6, 30, 20, 6};
plate() = Abs(Boundary{ Volume{20}; });
base() = Surface In BoundingBox {-16, -5, -6.1, 16, 17, -5.9};
plate() -= {base()};
top() = Surface In BoundingBox {-7, -1, 9.9, 7, 13, 10.1};
sole() = Surface In BoundingBox {-5.1, -1, -.1, 5.1, 13, .1};
skin() = Abs(Boundary{ Volume{out(1)}; });
skin() -= {top(), sole()};
Physical Volume("block") = {out(1)}; Physical Surface("top") = {top()}; Physical Surface("sole") = {sole()}; Physical Surface("block skin") = {skin()};
Physical Volume("plate") = {20}; Physical Surface("base") = {base()}; Physical Surface("plate skin") = {plate()};
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumElementsPerTwoPi = 16;
