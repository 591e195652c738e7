// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "psurface_overlaps.h"

#include <psurface/ContactMapping.h>
#include <psurface/IntersectionPrimitive.h>

#include <cmath>

std::map<std::pair<unsigned int, unsigned int>, double>
psurface_overlaps(const PlainSurface &nonmortar, const PlainSurface &mortar)
{
  std::vector<std::tr1::array<double, 3>> x1, x2;
  std::vector<std::tr1::array<int, 3>>    t1, t2;
  const auto                              convert = [](const PlainSurface &surface, auto &x, auto &t) {
    for (const auto &p : surface.points)
      x.push_back({{p[0], p[1], p[2]}});
    for (const auto &triangle : surface.triangles)
      t.push_back({{triangle[0], triangle[1], triangle[2]}});
  };
  // It projects along the normals of its first surface, we along those of the mortar surface.
  convert(mortar, x1, t1);
  convert(nonmortar, x2, t2);
  psurface::ContactMapping<3, double> mapping;
  mapping.build(x1, t1, x2, t2);
  std::vector<psurface::IntersectionPrimitive<2, double>> overlaps;
  mapping.getOverlaps(overlaps);

  std::map<std::pair<unsigned int, unsigned int>, double> result;
  for (const auto &o : overlaps)
    {
      const auto &a = o.localCoords[1][0], &b = o.localCoords[1][1], &c = o.localCoords[1][2];
      result[{o.tris[1], o.tris[0]}] +=
          std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
  return result;
}
