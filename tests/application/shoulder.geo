// A quarter of a hollow bolt whose head is pulled onto a plate, with clearance around the shank: the head has one or two faces between the shank and its rim.
SetFactory("Built-in");
DefineConstant[ h = 2 ];
Point(1) = {1, 0, -8, h}; Point(2) = {5, 0, -8, h}; Point(3) = {5, 0, 0, h}; Point(4) = {8.5, 0, 0, h}; Point(5) = {8.5, 0, 6, h}; Point(6) = {1, 0, 6, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
Point(11) = {5.5, 0, -8, h}; Point(12) = {15, 0, -8, h}; Point(13) = {15, 0, 0, h}; Point(14) = {5.5, 0, 0, h};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};
b[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{1}; };
p[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{2}; };
Physical Volume("bolt") = {b[1]};
Physical Surface("bolt y0") = {1}; Physical Surface("bolt x0") = {b[0]};
Physical Surface("pull") = {b[2]}; Physical Surface("shank") = {b[3]}; Physical Surface("underside") = {b[4]};
Physical Volume("plate") = {p[1]};
Physical Surface("plate y0") = {2}; Physical Surface("plate x0") = {p[0]};
Physical Surface("base") = {p[2]}; Physical Surface("top") = {p[4]}; Physical Surface("bore") = {p[5]};
