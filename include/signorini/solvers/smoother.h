// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_smoother_h
#define signorini_solvers_smoother_h

#include <signorini/solvers/contact_state.h>
#include <signorini/solvers/sweep_schedule.h>

namespace Signorini
{
  /// How often a smoother goes over a level.
  struct SmoothingParameters
  {
    /// Before and after the coarse correction.
    unsigned int n_pre = 3, n_post = 3;
    /// Extra sweeps over the contact nodes and their neighbours, nearest to the coarse correction.
    unsigned int n_interface_sweeps = 2;
  };



  /// What multigrid asks of the smoother of a level. Whoever implements this (smooth() is enough) hands it to
  /// the hierarchy (HierarchyParts::make_smoother). Every function lowers the energy ½ vᵀAv - rhsᵀv, keeps v
  /// in the half-spaces of `contact`, and says there which are active. All are collective.
  class Smoother
  {
  public:
    /// The matrix must outlive the object.
    explicit Smoother(const NodeBlockMatrix &matrix)
      : matrix(matrix)
    {
    }

    virtual ~Smoother() = default;

    /// Sweeps before (forward) or after (backward) a coarse correction, one the adjoint of the other.
    virtual void smooth(Vector &v, const Vector &rhs, ContactState &contact,
                        const SmoothingParameters &parameters, const Direction direction) = 0;

    /// The sweeps forward from v = 0 and residual = rhs - A v. v may be rounded to single precision: it is a
    /// correction. Residuals of active nodes are not rounded relative to the contact force. Here: by a
    /// product with the matrix, which smoothers that have the residual at hand save.
    virtual void smooth_from_zero(Vector &v, const Vector &rhs, ContactState &contact,
                                  const SmoothingParameters &parameters, Vector &residual);

    /// The sweeps backward in the same way, and residual = rhs - A v in double precision unless it is null.
    virtual void smooth_to_residual(Vector &v, const Vector &rhs, ContactState &contact,
                                    const SmoothingParameters &parameters, Vector *const residual);

    /// Collective. Rows of the matrix have changed, of which a smoother may keep something.
    virtual void update(const std::vector<unsigned int> &)
    {
    }

    /// Collective. From now on smooths patches of nodes at once, because the cycle is slow.
    virtual void strengthen()
    {
    }

    /// Whether sweeps over the contact nodes alone would be slow, so that they must not be spared.
    virtual bool is_slow_at_interface() const
    {
      return false;
    }

  protected:
    /// Of the level.
    const NodeBlockMatrix &matrix;
  };



  /// One stage of a smoother beside its sweeps by node: lines and planes of stretched cells, the interface.
  /// It changes only some rows, and whoever keeps a residual follows those.
  class SmoothingStage
  {
  public:
    /// The matrix must outlive the object.
    explicit SmoothingStage(const NodeBlockMatrix &matrix)
      : matrix(matrix)
    {
    }

    virtual ~SmoothingStage() = default;

    /// Collective. One run. The energy never rises, half-spaces are kept. Ghost values of v are up to date
    /// before and after it.
    virtual void run(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) = 0;

    /// The owned rows that a run may change.
    virtual const std::vector<unsigned int> &rows() const = 0;

    /// Collective. A run forward that subtracts A times the change of v from a residual.
    virtual void run_with_residual(Vector &v, const Vector &rhs, ContactState &contact, Vector &residual);

    /// Collective. Rows of the matrix have changed.
    virtual void update(const std::vector<unsigned int> &)
    {
    }

    /// Collective. A run, then follow(node, change) for each row and each ghost that has changed, with its
    /// local number and the three numbers by which it has changed.
    template <typename Follow>
    void run_and_follow(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction,
                        const Follow &follow);

  protected:
    /// Of the level.
    const NodeBlockMatrix &matrix;
  };

  /// residual -= A (change of a local node), at owned nodes; what it leaves at ghosts has no meaning.
  void subtract_change(double *residual, const NodeBlockMatrix &matrix, const unsigned int node,
                       const double *change);



  template <typename Follow>
  void SmoothingStage::run_and_follow(Vector &v, const Vector &rhs, ContactState &contact,
                                      const Direction direction, const Follow &follow)
  {
    std::vector<unsigned int> changed = rows();
    for (unsigned int node = matrix.n_rows(); node < matrix.partition().n_local(); ++node)
      changed.push_back(node);
    std::vector<double> old(dim * changed.size());
    for (std::size_t r = 0; r < changed.size(); ++r)
      for (unsigned int c = 0; c < dim; ++c)
        old[dim * r + c] = v.local_element(dim * changed[r] + c);
    run(v, rhs, contact, direction);
    for (std::size_t r = 0; r < changed.size(); ++r)
      {
        double change[dim];
        for (unsigned int c = 0; c < dim; ++c)
          change[c] = v.local_element(dim * changed[r] + c) - old[dim * r + c];
        if (change[0] != 0. || change[1] != 0. || change[2] != 0.)
          follow(changed[r], change);
      }
  }
} // namespace Signorini

#endif
