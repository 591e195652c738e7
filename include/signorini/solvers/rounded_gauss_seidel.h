// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_rounded_gauss_seidel_h
#define signorini_solvers_rounded_gauss_seidel_h

#include <signorini/algebra/rounded_sweep.h>
#include <signorini/solvers/projected_gauss_seidel.h>

namespace Signorini
{
  /// The sweeps of a multigrid cycle: those of ProjectedGaussSeidel in single precision (RoundedSweep) but
  /// for what must not be rounded: rows that are not ordered, and the right hand side of rows with a
  /// half-space, which at an active node is the contact force. For corrections, and right hand sides that go
  /// to zero with them. Calls come in this order: start(), sweeps and changes by others, then the residual,
  /// if the last sweep has kept it.
  class RoundedGaussSeidel
  {
  public:
    /// Collective. Matrix and sweeps must outlive the object.
    RoundedGaussSeidel(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &exact);

    /// Rows of the matrix, and the sweeps in double precision, have changed.
    void update(const std::vector<unsigned int> &rows);

    /// Takes v and a right hand side. If v is not zero the first sweep must go backward and pass all on.
    void start(const Vector &v, const Vector &rhs, const ContactState &contact);

    /// Collective. One sweep over all rows.
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const RoundedSweep::Options &options);

    /// A row that others have changed by `change` (three numbers); passed on unless a first sweep follows
    /// that passes all on.
    void follow(const Vector &v, const unsigned int row, const double *change, const bool passes_on);

    /// The residual in ordered rows after a sweep that has kept it.
    void get_residual(Vector &residual, const ContactState &contact) const;

  private:
    void relax_apart(Vector &v, const Vector &rhs, const unsigned int row, ContactState &contact,
                     const RoundedSweep::Options &options);
    void relax_half_space(double *y, const double *rhs, const unsigned int row, ContactState &contact,
                          const bool keeps_residual);

    const NodeBlockMatrix      &matrix;
    const ProjectedGaussSeidel &exact;
    RoundedSweep                rounded;
    /// Of relax_half_space(), by half-space.
    std::vector<Vector3> contact_residual;
  };
} // namespace Signorini

#endif
