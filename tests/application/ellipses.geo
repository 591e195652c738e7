// A shaft of elliptic section in a bore that is smaller by .02 all around: a slice of length 1, one layer of cells.
SetFactory("OpenCASCADE");
Ellipse(1) = {0, 0, 0, 10.02, 6.02};
Circle(2) = {0, 0, 0, 2.5};
Circle(3) = {0, 0, 0, 16};
Ellipse(4) = {0, 0, 0, 10, 6};
Rotate {{0, 0, 1}, {0, 0, 0}, .3} { Curve{1, 4}; }
Curve Loop(1) = {1};
Curve Loop(2) = {2};
Curve Loop(3) = {3};
Curve Loop(4) = {4};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {3, 4};
shaft[] = Extrude {0, 0, 1} { Surface{1}; Layers{1}; };
ring[] = Extrude {0, 0, 1} { Surface{2}; Layers{1}; };
Physical Volume("shaft") = {shaft[1]};
Physical Volume("ring") = {ring[1]};
Physical Surface("shaft ends") = {1, shaft[0]};
Physical Surface("skin") = {shaft[2]};
Physical Surface("ring ends") = {2, ring[0]};
Physical Surface("outside") = {ring[2]};
Physical Surface("bore") = {ring[3]};
MeshSize{ PointsOf{ Curve{2}; } } = 1.5;
MeshSize{ PointsOf{ Curve{3}; } } = 3;
MeshSize{ PointsOf{ Curve{1}; } } = .5;
MeshSize{ PointsOf{ Curve{4}; } } = .6;
