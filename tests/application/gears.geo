// Three teeth each of two spur gears with involute flanks (module 4, 20 teeth, pressure angle 20 degrees) that touch at the pitch point.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.8, backlash = 0 ];
m = 4; z = 20;
rp = m * z / 2; rb = rp * Cos(Pi / 9); ra = rp + m; rf = rp - 1.25 * m; ri = rf - 6;
r0 = rb + 0.01; n = 12;
Function Segment
  // Around cx, the middle tooth at the angle `start`; returns the surface `segment`.
  centre = newp; Point(centre) = {cx, 0, 0};
  a0 = start - 3 * Pi / z; a1 = start + 3 * Pi / z;
  inner = newp; Point(inner) = {cx + ri * Cos(a0), ri * Sin(a0), 0};
  first = newp; Point(first) = {cx + rf * Cos(a0), rf * Sin(a0), 0};
  lines() = {}; l = newl; Line(l) = {inner, first}; lines() += {l};
  last = first;
  For k In {-1 : 1}
    t = start + k * 2 * Pi / z;
    For side In {0 : 1}
      flank() = {};
      For i In {0 : n - 1}
        j = side == 0 ? i : n - 1 - i;
        r = r0 + (ra - r0) * j / (n - 1);
        al = Acos(rb / r);
        half = Pi / (2 * z) + Tan(Pi / 9) - Pi / 9 - (Tan(al) - al);
        // The other flanks touch at the pitch point.
        half = side == 0 ? half - backlash / r : half;
        s = side == 0 ? t - half : t + half;
        p = newp; Point(p) = {cx + r * Cos(s), r * Sin(s), 0};
        flank() += {p};
        If (i == 0 && side == 0)
          p = newp; Point(p) = {cx + rf * Cos(s), rf * Sin(s), 0};
          l = newl; Circle(l) = {last, centre, p}; lines() += {l};
          l = newl; Line(l) = {p, flank(0)}; lines() += {l};
        EndIf
        If (i == 0 && side == 1)
          l = newl; Circle(l) = {last, centre, flank(0)}; lines() += {l};
        EndIf
      EndFor
      l = newl; Spline(l) = flank(); lines() += {l};
      last = flank(n - 1);
    EndFor
    p = newp; Point(p) = {cx + rf * Cos(s), rf * Sin(s), 0};
    l = newl; Line(l) = {last, p}; lines() += {l};
    last = p;
  EndFor
  p = newp; Point(p) = {cx + rf * Cos(a1), rf * Sin(a1), 0};
  l = newl; Circle(l) = {last, centre, p}; lines() += {l};
  outer = newp; Point(outer) = {cx + ri * Cos(a1), ri * Sin(a1), 0};
  l = newl; Line(l) = {p, outer}; lines() += {l};
  l = newl; Circle(l) = {outer, centre, inner}; lines() += {l};
  loop = newll; Curve Loop(loop) = lines();
  segment = news; Plane Surface(segment) = {loop};
Return
cx = 0; start = -Pi / (2 * z);
Call Segment;
one() = Extrude {0, 0, 6} { Surface{segment}; };
cx = 2 * rp; start = Pi - Pi / (2 * z);
Call Segment;
two() = Extrude {0, 0, 6} { Surface{segment}; };
// After the end and the volume come the sides in the order of the lines: hub side, then arc, radius, flank, tip, flank, radius of each tooth.
Physical Volume("pinion") = {one(1)};
Physical Volume("gear") = {two(1)};
Physical Surface("pinion flanks") = {one(5), one(7), one(11), one(13), one(17), one(19)};
Physical Surface("gear flanks") = {two(5), two(7), two(11), two(13), two(17), two(19)};
Physical Surface("pinion hub") = {one(2), one(22), one(23)};
Physical Surface("gear hub") = {two(2), two(22), two(23)};
Field[1] = Ball; Field[1].VIn = h; Field[1].VOut = 2; Field[1].XCenter = rp; Field[1].YCenter = 0; Field[1].ZCenter = 3; Field[1].Radius = 5; Field[1].Thickness = 4;
Background Field = 1;
