// A bar whose section is a regular polygon (apothem 5) in a hole with flats 0.02 away. One flat is at the bottom.
SetFactory("OpenCASCADE");
DefineConstant[ n = 6, h = 2 ];
Macro Prism
  For i In {0:n - 1}
    Point(first + i) = {a / Cos(Pi / n) * Cos(-Pi / 2 + Pi / n * (2 * i + 1)), y, a / Cos(Pi / n) * Sin(-Pi / 2 + Pi / n * (2 * i + 1))};
  EndFor
  For i In {0:n - 1}
    Line(first + i) = {first + i, first + (i + 1) % n};
  EndFor
  Curve Loop(first) = {first:first + n - 1};
  Plane Surface(first) = {first};
  prism() = Extrude {0, 12 - 2 * y, 0} { Surface{first}; };
Return
a = 5; y = 0; first = 1000; Call Prism;
bar = prism(1);
a = 5.02; y = -1; first = 2000; Call Prism;
hole = prism(1);
Box(900) = {-11, 0, -11, 22, 12, 22};
hub() = BooleanDifference{ Volume{900}; Delete; }{ Volume{hole}; Delete; };
bars() = Abs(Boundary{ Volume{bar}; });
start() = Surface In BoundingBox {-6, -.1, -6, 6, .1, 6};
end() = Surface In BoundingBox {-6, 11.9, -6, 6, 12.1, 6};
base() = Surface In BoundingBox {-12, -1, -11.1, 12, 13, -10.9};
flats() = bars(); flats() -= {start(), end()};
inner() = Surface In BoundingBox {-7, -1, -7, 7, 13, 7};
inner() -= {bars()};
Physical Volume("bar") = {bar}; Physical Surface("ends") = {start(), end()}; Physical Surface("flats") = {flats()};
Physical Volume("hub") = {hub(0)}; Physical Surface("base") = {base()}; Physical Surface("inner") = {inner()};
Mesh.CharacteristicLengthMax = h;
