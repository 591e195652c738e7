// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_free_motion_correction_h
#define signorini_solvers_free_motion_correction_h

#include <signorini/solvers/contact_state.h>

#include <optional>

namespace Signorini
{
  /// Minimizes over the rigid motions of bodies that only contact holds, tangential at active nodes. Most of
  /// them cost far less than any deformation, and where nodes lie on curved surfaces coarse functions have
  /// their rotations only approximately: an error along a rotation would not go away. Each motion m has A m =
  /// 0, so products are those of its normal parts at active nodes alone.
  ///
  /// Motions that nothing opposes and on which the loads do no work are idle: what a correction has of them
  /// is rounding over rounding. It can be many times longer than the deformation, and then its own rounding
  /// hides that. They are taken out.
  class FreeMotionCorrection
  {
  public:
    /// When a motion is idle.
    struct Rule
    {
      /// Its energy relative to what it would be if the active nodes opposed it in all directions: rounding.
      double costs_nothing = 1e-14;
      /// The work of the loads on it, relative to what it is made up of, and to the work on all motions.
      double rounding = 1e-10, no_work = 1e-7;
      /// What taking it out may cost of the way to the next plane: rounding, where it slides along all
      /// planes.
      double shorter = 1e-8;
    };

    /// @param free_motions orthonormal; may be empty. Both must outlive the object.
    /// @param rhs the loads
    FreeMotionCorrection(const NodeBlockMatrix &matrix, const std::vector<Vector> &free_motions,
                         const Vector &rhs);

    /// Collective. Makes the work of a residual b - A v on each motion what it is, that of the loads b, as A
    /// m = 0. The rounding of sweeps in single precision is more, and a motion that nothing opposes is what
    /// that does work on, over next to nothing.
    void restore_work(Vector &residual) const;

    /// Collective. The active half-spaces have changed, perhaps.
    void update(const ContactState &contact);

    /// Whether loads do work on a motion that nothing opposes: there is no minimum on these planes.
    bool is_driven() const
    {
      return driven;
    }

    /// Collective. Adds to a correction c the motion that is_driven(), up to the next half-space. It has no
    /// energy, so a V-cycle need not find it. Returns the work of the loads on it; zero, and no motion, where
    /// nothing is in its way or loads do none.
    double drive(Vector &c, const ContactState &contact) const;

    /// Collective. Subtracts A s from a residual, which is tangential at active nodes; s minimizes over the
    /// motions. Returns the coefficients of s.
    std::vector<double> minimize(Vector &residual) const;

    /// Collective. Adds to a correction c, for which minimize() left `residual` behind, s and what minimizes
    /// again after it, and removes idle motions, unless that runs into half-spaces.
    /// @param z what c corrects, with `contact` as its half-spaces
    void complete(Vector &c, const std::vector<double> &s, const Vector &residual, const Vector &z,
                  const ContactState &contact) const;

    /// Collective. Removes idle motions from a correction c of z, unless that runs into a half-space that is
    /// not active.
    void remove_idle(Vector &c, const Vector &z, const ContactState &contact) const;

  private:
    void add(Vector &c, const std::vector<double> &coefficients) const;
    /// Collective. The largest energy of a motion if the active nodes opposed it in all directions.
    double largest_opposition(const HalfSpaces &spaces) const;

    const NodeBlockMatrix     &matrix;
    const std::vector<Vector> &motions;
    /// Tangential at active nodes, and their products with A.
    std::vector<Vector> tangential, products;
    /// Work of the loads on each motion.
    std::vector<double> loads;
    /// For which the tangential ones are.
    std::optional<std::vector<unsigned char>> active;
    /// Inverse of their energies without idle ones, and the projector onto the coefficients of those; row by
    /// row.
    std::vector<double> inverse, projector;
    /// Coefficients of the driven motion, on which the loads do positive work.
    std::vector<double> flight;
    bool                driven = false;
  };
} // namespace Signorini

#endif
