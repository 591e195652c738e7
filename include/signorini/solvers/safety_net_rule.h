// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_safety_net_rule_h
#define signorini_solvers_safety_net_rule_h

#include <cstddef>

namespace Signorini
{
  /// When an iteration is slow, and what takes over (doc/measurements.md, random pairs).
  struct SafetyNetRule
  {
    /// So many iterations that leave more than this part of the first correction, the last one without a
    /// step of conjugate gradients, have lost the active set. Leaf springs: .78 and .88 are left, and they
    /// come to rest after hundreds; pin in lug: .11. With .1 after three of them random pairs take 6 % more
    /// time and no iteration less.
    unsigned int n_to_settle = 2;
    double       most_left   = .3;
    /// The rate is the geometric mean over so many iterations.
    std::size_t n_watched = 8;
    /// So many iterations to go at this rate, and one more for this many unknowns, are slow. A
    /// factorization of 5,000 unknowns takes as long as 50 iterations (0.1 s), of 13,000 as 125 (0.5 s):
    /// they are taken earlier than time alone would suggest, for a bound on the iterations (random pairs:
    /// at most 32).
    double few_left = 12., unknowns_for_one_more = 2000.;
    /// Not more than these, which are slow in any case. Patches cost some ten times a sweep by node.
    double many_left = 40.;
    /// Unknowns up to which sparse factors are taken whatever they cost, and up to which their cost is
    /// looked at: the matrix is gathered on rank 0 for that.
    double small = 30000., largest_for_factors = 500000.;
    /// Multiplications of a factorization that is cheap: it takes some 5 s, and 0.4 to 0.6 GB. Pairs of
    /// blocks with 164,000 unknowns, slabs of one layer with 108,000, a sheet with 242,000 have 2e10 to
    /// 5e10 of them.
    double cheap_factors = 5e10;
    /// Unknowns of a rank up to which the smoothers take patches: 4 kB each.
    double largest_for_patches = 500000.;
    /// Of the iterations watched, those that conjugate gradients did not take: with fewer it is the linear
    /// problem that is slow, and active-set steps with the same V-cycles would gain nothing.
    unsigned int fewest_searched = 3;
  };
} // namespace Signorini

#endif
