// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_psurface_overlaps_h
#define signorini_tests_psurface_overlaps_h

#include <array>
#include <map>
#include <utility>
#include <vector>

/// Plain arrays on both sides: libpsurface needs an older C++ than we do.
struct PlainSurface
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>>    triangles;
};

/// The overlay of libpsurface: for each pair of triangles the common part of the first one (0 to 1).
std::map<std::pair<unsigned int, unsigned int>, double>
psurface_overlaps(const PlainSurface &nonmortar, const PlainSurface &mortar);

#endif
