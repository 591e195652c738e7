// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_load_curve_h
#define signorini_output_load_curve_h

#include <signorini/output/results.h>

#include <iosfwd>

namespace Signorini
{
  /// A table of the load steps, with commas: t, iterations and active nodes; of each pair ("contact: ...")
  /// force on the nonmortar side, load, approach, contact area, largest and mean pressure, smallest gap; the
  /// reaction of each held boundary ("block: bottom: ...") and the displacement of each probe.
  void write_load_curve(std::ostream &out, const Results &results);
} // namespace Signorini

#endif
