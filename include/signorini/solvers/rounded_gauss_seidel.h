// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_rounded_gauss_seidel_h
#define signorini_solvers_rounded_gauss_seidel_h

#include <signorini/algebra/rounded_sweep.h>
#include <signorini/solvers/projected_gauss_seidel.h>

namespace Signorini
{
  /// The sweeps of a multigrid cycle: those of ProjectedGaussSeidel in single precision (RoundedSweep) but
  /// for rows with a half-space, whose right hand side must not be rounded (at an active node it is the
  /// contact force), and for damped rows. For corrections, and right hand sides that go to zero with them.
  /// Calls come in this order: start(), sweeps and changes by others, then the residual, if the last sweep
  /// has kept it.
  class RoundedGaussSeidel
  {
  public:
    /// Collective. Matrix and sweeps must outlive the object.
    RoundedGaussSeidel(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &exact);

    /// Rows of the matrix, and the sweeps in double precision, have changed.
    void update(const std::vector<unsigned int> &rows);

    /// Takes v, with ghost values, and a right hand side. If v is not zero the first sweep must go backward
    /// and pass all on.
    void start(const Vector &v, const Vector &rhs, const ContactState &contact);

    /// Collective. One sweep over all rows. Ghost values of v are up to date afterwards.
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const RoundedSweep::Options &options);

    /// A local node that others have changed by `change` (three numbers); passed on unless a first sweep
    /// follows that passes all on.
    void follow(const Vector &v, const unsigned int node, const double *change, const bool passes_on);

    /// The residual after a sweep that has kept it.
    void get_residual(Vector &residual, const ContactState &contact) const;

  private:
    /// Rows that are not visited by RoundedSweep.
    bool is_apart(const unsigned int row, const ContactState &contact) const
    {
      return contact.at(row) >= 0 || exact.damping()[row] < 1.;
    }

    /// One of the ranges of the schedule.
    void relax(Vector &v, const Vector &rhs, const std::size_t begin, const std::size_t end,
               ContactState &contact, const RoundedSweep::Options &options);
    void relax_apart(Vector &v, const Vector &rhs, const unsigned int row, ContactState &contact,
                     const RoundedSweep::Options &options);
    void keep_residual(const std::array<double, 3> &residual, const unsigned int row,
                       const ContactState &contact);

    const NodeBlockMatrix      &matrix;
    const ProjectedGaussSeidel &exact;
    RoundedSweep                rounded;
    /// By half-space.
    std::vector<Vector3> contact_residual;
  };
} // namespace Signorini

#endif
