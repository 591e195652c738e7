// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_late_vertices_h
#define signorini_mesh_late_vertices_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <vector>

namespace Signorini
{
  /// Second attempts for vertices that had to go back. Pure numbers; measured on refined spheres and the
  /// knee.
  struct MovementRule
  {
    /// The share of its quality that a cell keeps at least.
    double tolerated = 1. / 3.;
    /// How many times vertices go back half of the way before they stay where they were.
    unsigned int n_halvings = 10;
    /// Rounds over the vertices that are not there yet, and sweeps over the free vertices around one.
    unsigned int n_rounds = 3, n_sweeps = 3;
    /// A bound for the cost on meshes that are bad all over (some milliseconds each).
    std::size_t n_attempts = 500;
    /// A free vertex moves while the worst of its cells has a smaller share of its quality than this.
    double good = .7;
    /// First and last step of its search, as shares of its shortest edge.
    double       first_step = .4, last_step = .05;
    unsigned int n_steps = 12;
  };

  /// Mean ratio of a tetrahedron, scaled Jacobian of a hexahedron.
  double cell_quality(const std::vector<dealii::Point<3>>         &positions,
                      const dealii::ArrayView<const unsigned int> &cell);

  /// Several attempts for vertices that are not where they should be; those that are not there in the end
  /// stay in the list.
  /// @param targets of the vertices `late`
  /// @param is_free vertices that may give way
  /// @param reference quality of each cell that counts as whole, zero where it is that of now
  void try_again(std::vector<unsigned int> &late, const std::vector<dealii::Point<3>> &targets,
                 std::vector<dealii::Point<3>>                            &positions,
                 const std::vector<dealii::ArrayView<const unsigned int>> &cells,
                 const std::vector<bool> &is_free, std::vector<double> &reference);
} // namespace Signorini

#endif
