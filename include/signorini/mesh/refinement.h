// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_refinement_h
#define signorini_mesh_refinement_h

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// A ball or box and how many times cells in it are refined beyond the coarse mesh and the global levels.
  struct RefinementRegion
  {
    /// A ball (centre and radius) or a box (two corners), in lengths, and how often cells in it are refined.
    bool             is_ball;
    dealii::Point<3> centre_or_lower, upper;
    double           radius;
    unsigned int     levels;
    /// Only the cells of this body; empty for all.
    std::string body;

    /// Whether a cell may intersect the region: by the bounding box of its vertices.
    bool touches(const dealii::Point<3> &lower_corner, const dealii::Point<3> &upper_corner) const;
  };

  /// "ball: (x, y, z), radius, levels; box: (x, y, z), (x, y, z), levels; BODY: ball: ...". Errors:
  /// InputError for regions that cannot be understood.
  std::vector<RefinementRegion> parse_regions(const std::string &text);

  /// Prescribed refinement, worked through one level per cycle of the nested iteration.
  struct RefinementParameters
  {
    /// What an adaptive cycle refines: the largest indicators that have a share of the error together, or
    /// that share of the cells.
    enum class Marking
    {
      error,
      cells
    };

    /// As the parameters of the same names say (add_parameters()).
    unsigned int initial_global = 0, global_cycles = 0, adaptive_cycles = 0, final_global_cycles = 0;
    /// Levels before the first cycle by body; empty for initial_global everywhere.
    std::vector<unsigned int>     initial_of_body;
    std::vector<RefinementRegion> regions;
    Marking                       marking          = Marking::error;
    double                        marking_fraction = .5;
    /// No adaptive cycle is begun that would have more unknowns; 0 for no limit.
    double max_dofs = 0.;
    /// No adaptive cycle is begun where the estimated error of stresses (a part of them) is as small; 0 for
    /// never.
    double wanted_stress_error = 0.;
    bool   compare_cycles      = false;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Which cells are refined from one mesh of the nested iteration to the next.
  class Refinement
  {
  public:
    /// The cycles that the parameters ask for.
    explicit Refinement(const RefinementParameters &parameters);

    /// Number of cycles after the first.
    unsigned int n_cycles() const
    {
      return cycles;
    }

    /// Whether a cycle is refined where the error indicator is large.
    bool is_adaptive(const unsigned int cycle) const
    {
      return cycle >= first_adaptive_cycle && cycle < first_final_cycle;
    }

    /// Whether a cycle refines all cells.
    bool is_global(const unsigned int cycle) const
    {
      return cycle <= parameters.global_cycles || (cycle >= first_final_cycle && cycle <= cycles);
    }

    /// Which cells of a space of the bodies cycle `cycle` (1, 2, ...), if it is not adaptive, refines
    /// (Bodies::refine()).
    std::vector<bool> mark(const Bodies &bodies, const NodalSpace &space, const unsigned int cycle) const;

  private:
    RefinementParameters parameters;
    unsigned int         cycles, first_adaptive_cycle, first_final_cycle;
  };
} // namespace Signorini

#endif
