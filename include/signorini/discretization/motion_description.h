// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_motion_description_h
#define signorini_discretization_motion_description_h

#include <signorini/discretization/rigid_support.h>

namespace Signorini
{
  /// What a motion moves: "body pin", "body pin (tied to body head, body ring)".
  std::string name_of_moving(const FreeMotion &motion, const Bodies &bodies);

  /// Whether a motion only turns parts about axes, without moving them along these.
  bool is_rotation(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients);

  /// Whether a motion moves parts without turning them.
  bool is_translation(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients);

  /// A motion in words: "body cube, translation (0, 0, -1)", "body lug, rotation about the axis through (0,
  /// 0, 0) along (0, 0, 1)".
  std::string describe_motion(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                              const Bodies &bodies);

  /// A motion that goes one way only, with all that moves in it: "body arm and body pin, translation (0, 0,
  /// -1) (body wire moves, too)".
  std::string describe_flight(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                              const Bodies &bodies);

  /// What loads do in a motion.
  struct FlightLoad
  {
    /// Along a translation (force), or about the axis of a rotation (force times length); the other is zero.
    double force, moment;
  };

  /// The sum over all that moves of the loads in a motion.
  /// @param work of the loads on it
  FlightLoad load_of_flight(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                            const double work, const Bodies &bodies);

  /// Several motions, which span what is free: the translations of a part together, its rotations about axes
  /// through one point together.
  std::vector<std::string> describe_motions(const std::vector<FreeMotion>          &motions,
                                            const std::vector<std::vector<double>> &basis,
                                            const Bodies                           &bodies);
} // namespace Signorini

#endif
