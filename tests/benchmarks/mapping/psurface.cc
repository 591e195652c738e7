// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// libpsurface's ContactMapping on two OFF files: prints seconds and the covered part of the first surface.

#include "off_file.h"

#include <psurface/ContactMapping.h>
#include <psurface/IntersectionPrimitive.h>

#include <chrono>

int
main(int, char **argv)
{
  const OffFile                           non(argv[1]), mor(argv[2]);
  std::vector<std::tr1::array<double, 3>> x1, x2;
  std::vector<std::tr1::array<int, 3>>    t1, t2;
  const auto                              convert = [](const OffFile &file, auto &x, auto &t) {
    for (const auto &p : file.points)
      x.push_back({{p[0], p[1], p[2]}});
    for (const auto &triangle : file.triangles)
      t.push_back({{triangle[0], triangle[1], triangle[2]}});
  };
  convert(non, x1, t1);
  convert(mor, x2, t2);
  psurface::ContactMapping<3, double> mapping;
  const auto                          start = std::chrono::steady_clock::now();
  mapping.build(x1, t1, x2, t2);
  std::vector<psurface::IntersectionPrimitive<2, double>> overlaps;
  mapping.getOverlaps(overlaps);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  double covered = 0.;
  for (const auto &o : overlaps)
    {
      const auto &a = o.localCoords[0][0], &b = o.localCoords[0][1], &c = o.localCoords[0][2];
      covered +=
          std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * non.area(o.tris[0]);
    }
  std::cout.precision(15);
  std::cout << seconds << ' ' << covered / non.area() << ' ' << overlaps.size() << std::endl;
  return 0;
}
