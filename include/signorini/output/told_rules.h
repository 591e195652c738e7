// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_told_rules_h
#define signorini_output_told_rules_h

namespace Signorini
{
  // From where on something is told about the result of a contact pair.

  /// From where on it is told that pressures of nodes are far from the recovered ones. Pure number.
  struct ScatterRule
  {
    /// Measured (doc/guide/accuracy.md): structured hexahedra .003, unstructured ones .03, tetrahedra .05 to
    /// .14. It chooses what is drawn first and nothing else.
    double told = .05;
  };

  /// From what share of the load on it is told that a contact is narrower than a face. Pure number.
  struct NarrowContactRule
  {
    /// On a C-ring with a strip of contact a quarter as wide as a face, where the largest pressure was a
    /// third of Hertz', it is all; on strips of two faces and more nothing.
    double told = .5;
  };

  /// When a pair has missed a contact. Pure numbers.
  struct MissedContactRule
  {
    /// Of the penetration, the approach up to which all of the pair carries no force.
    double idle = 1e-3;
    /// Of the width of the faces, the penetration that is rounding: meshes have five digits and more. Faces 6
    /// wide under a roller of radius 10 miss penetrations of up to 0.05 of it.
    double rounding = 1e-3;
  };

  /// Which parts of the contact of a pair are looked at on their own. Pure number.
  struct ContactSpotRule
  {
    /// Of the load of the strongest one, what they carry at least. A block on a wide and a narrow roller in
    /// one pair, where the narrow one carried .059 of the wide one, half of what is right.
    double least_load = .03;
  };

  /// Below which part of the integral of the pressure its resultant is not what a contact carries. Pure
  /// number.
  struct CancellingPressureRule
  {
    /// A press fit has 0, a pin in a bore π/4, a plane contact 1.
    double told = .5;
  };
} // namespace Signorini

#endif
