// A block with rounded edges (radius 2) in a pocket with the same rounding, 0.05 away from its walls: with h = 2 fillets have two faces.
SetFactory("OpenCASCADE");
DefineConstant[ h = 2 ];
c = .05;
Box(1) = {0, 0, 0, 20, 14, 10};
Box(2) = {-6, -6, -6, 32, 26, 12};
Box(3) = {-c, -c, 0, 20 + 2 * c, 14 + 2 * c, 12};
// All edges of a box but the four on top, which are 2, 6, 10 and 12.
block() = Fillet{1}{1, 3, 4, 5, 7, 8, 9, 11}{2};
hole() = Fillet{3}{25, 27, 28, 29, 31, 32, 33, 35}{2};
pocket() = BooleanDifference{ Volume{2}; Delete; }{ Volume{hole(0)}; Delete; };
top() = Surface In BoundingBox {-1, -1, 9.9, 21, 15, 10.1};
skin() = Abs(Boundary{ Volume{block(0)}; });
skin() -= {top()};
base() = Surface In BoundingBox {-7, -7, -6.1, 27, 21, -5.9};
inner() = Surface In BoundingBox {-1, -1, -1, 21, 15, 6.1};
inner() -= {skin()};
Physical Volume("block") = {block(0)}; Physical Surface("top") = {top()}; Physical Surface("skin") = {skin()};
Physical Volume("pocket") = {pocket(0)}; Physical Surface("base") = {base()}; Physical Surface("inner") = {inner()};
Mesh.CharacteristicLengthMax = h;
