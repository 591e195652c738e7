// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_final_words_h
#define signorini_output_final_words_h

#include <signorini/output/results.h>

#include <ostream>
#include <string>
#include <vector>

namespace Signorini
{
  /// From where on displacements are large for a theory of small ones. Pure numbers.
  struct SmallnessRule
  {
    /// A rotation by an angle changes lengths by half its square: 0.5 %.
    double rotation = .1;
    /// The gap is that of the points that face each other before the bodies move: a shift by a face is an
    /// error of the order of the mesh.
    double slip_in_faces = 1.;
    /// Part of the force on nodes that only their slip presses.
    double pressed_by_slip = .25;
    /// Strains whose squares count: 0.25 % in strain.
    double strain = .05;
  };

  /// From where on a mesh is coarse for what its body does. Pure number.
  struct FinenessRule
  {
    /// Estimated error of the stresses: the body is too stiff by a tenth.
    double stress_error = .3;
  };

  /// "(x, y, z)"; what is rounding against the rest is 0.
  std::string place_text(const dealii::Point<3> &place);

  /// "5.2 %" for .052.
  std::string percent_text(const double part, const int digits = 2);

  /// Where displacements are too large for a theory of small ones, in words; empty if they are small.
  std::vector<std::string> large_displacements(const Results &results);

  /// A line for each body whose mesh is too coarse for it (FinenessRule).
  std::vector<std::string> coarse_meshes(const Results &results);

  /// What a person looks for at the end of a run: largest displacement and stress of each body, what acts on
  /// it, force, area and largest pressure of each pair, whether displacements are small, and whether the
  /// contact conditions hold.
  void print_final_words(std::ostream &out, const Results &results);
} // namespace Signorini

#endif
