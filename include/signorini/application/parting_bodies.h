// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_parting_bodies_h
#define signorini_application_parting_bodies_h

#include <signorini/application/contact_solve.h>
#include <signorini/application/journal.h>

#include <vector>

namespace Signorini
{
  /// When two bodies that meet under a node do not carry it together (doc/algorithm.md, several pairs).
  struct PartingRule
  {
    /// How deep the node lies in one of them, relative to what contact does (PairResult::approach). Two
    /// blocks under one whose moduli differ by up to ten do not come near it, one that is pulled back exceeds
    /// it.
    double depth = .2;
    /// Pairs where contact does less than this part of what the largest does carry nothing but rounding.
    double idle = 1e-6;
  };

  /// Collective. Looks at the rows that pairs with different mortar bodies share: they hold the node at the
  /// mean of these bodies, which is in neither of them as long as both stay where they meet, but not where
  /// they slide past each other. Adds to PairChoice::apart_from of the pairs for which it does not hold, with
  /// a note. Returns whether there are any: the problem has to be coupled and solved again then. Not of a
  /// solution that has not converged.
  bool part_bodies(std::vector<PairChoice> &choices, const Discretization &discretization,
                   const ContactSolution &solution, Journal &journal, const PartingRule &rule = {});
} // namespace Signorini

#endif
