// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_parting_bodies_h
#define signorini_application_parting_bodies_h

#include <signorini/application/contact_solve.h>
#include <signorini/application/journal.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// When two bodies that meet under a node do not carry it together (doc/algorithm.md, several pairs).
  struct PartingRule
  {
    /// How deep the node lies in one of them, relative to what contact does (PairResult::approach). What a
    /// thinly covering pair says of that is an extrapolation and counts for less. Two blocks on which one is
    /// pressed, moduli from 1:100 to 50:1, do not part on three meshes; one that is pulled back does.
    double depth = .2;
    /// Pairs where contact does less than this part of what the largest does carry nothing but rounding.
    double idle = 1e-6;
  };

  /// Two pairs whose mortar bodies do not stay beside each other.
  struct PartedPairs
  {
    /// The number of the first one; the second one, with the shift between them.
    unsigned int pair;
    PartingPair  from;
  };

  /// Collective. Looks at the rows that pairs with different mortar bodies share: they hold the node at the
  /// mean of these bodies, which is in neither of them as long as both stay where they meet, but not where
  /// they slide past each other. Nothing of a solution that has not converged.
  std::vector<PartedPairs> find_parted_bodies(const Discretization  &discretization,
                                              const ContactSolution &solution, const PartingRule &rule = {});

  /// For notes.
  std::string describe_parted(const PartedPairs &parted, const Discretization &discretization);

  /// Collective. Adds them to PairChoice::partings, with a note. Returns whether there are any: the problem
  /// has to be coupled and solved again then.
  bool part_bodies(std::vector<PairChoice> &choices, const Discretization &discretization,
                   const ContactSolution &solution, Journal &journal, const PartingRule &rule = {});
} // namespace Signorini

#endif
