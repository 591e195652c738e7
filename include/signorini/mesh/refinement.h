// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_refinement_h
#define signorini_mesh_refinement_h

#include <signorini/mesh/bodies.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// Prescribed refinement, worked through one level per cycle of the nested iteration.
  struct RefinementParameters
  {
    unsigned int initial_global = 0, global_cycles = 0, final_global_cycles = 0;
    std::string  regions;

    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// A ball or box and how many times cells in it are refined beyond the coarse mesh and the global levels.
  struct RefinementRegion
  {
    bool             is_ball;
    dealii::Point<3> centre_or_lower, upper;
    double           radius;
    unsigned int     levels;

    /// Whether a cell may intersect the region: by the bounding box of its vertices.
    bool touches(const dealii::Point<3> &lower_corner, const dealii::Point<3> &upper_corner) const;
  };

  class Refinement
  {
  public:
    /// Errors: InputError for regions that cannot be understood.
    explicit Refinement(const RefinementParameters &parameters);

    /// Number of cycles after the first.
    unsigned int n_cycles() const
    {
      return cycles;
    }

    /// Marks the cells that cycle `cycle` (1, 2, ...) refines. Returns whether any cell of any rank is
    /// marked. The caller prepares, executes, and transfers what it needs.
    bool mark(dealii::parallel::distributed::Triangulation<3> &triangulation, const unsigned int cycle) const;

  private:
    RefinementParameters          parameters;
    std::vector<RefinementRegion> regions;
    unsigned int                  cycles, first_final_cycle;
  };
} // namespace Signorini

#endif
