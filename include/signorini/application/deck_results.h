// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_deck_results_h
#define signorini_application_deck_results_h

#include <signorini/application/deck_problem.h>
#include <signorini/application/nested_iteration.h>

#include <string>

namespace Signorini
{
  class Journal;

  /// When displacements are too large for linear kinematics.
  struct KinematicsRule
  {
    /// Beyond them the answer to a deck that asks for NLGEOM is refused: terms of second order are then some
    /// percent of the strains that are computed (½ θ² of a rotation θ against them).
    static constexpr double largest_rotation = 10., largest_strain = .1;
  };

  /// Collective. Displacements, stresses and contact pressures as a result file of CalculiX
  /// (FOLDER/results.frd), on the deck's own elements where they are not refined, else on the cells.
  void write_deck_results(const DeckProblem &deck, const ContactModel &model, const Discretization &d,
                          const ContactSolution &solution, const std::string &folder);

  /// Collective. Notes how large rotations and strains became where a deck asks for NLGEOM, and adds an
  /// objection to the certificate where that is too much.
  void judge_linear_kinematics(const DeckProblem &deck, const ContactModel &model, NestedSolution &nested,
                               Journal &journal);
} // namespace Signorini

#endif
