// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/parameter_choice.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/refinement.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  void RefinementParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
        "Initial global levels", initial_global,
        "Global refinements before the first cycle, of bodies without Initial levels of their own.",
        Patterns::Integer(0, 20));
    prm.add_parameter("Global cycles", global_cycles,
                      "Cycles, each with one global refinement, after the first one.",
                      Patterns::Integer(0, 20));
    prm.declare_entry(
        "Regions", "", Patterns::Anything(),
        "Balls and boxes with the number of levels their cells are refined beyond the global levels, one "
        "level per cycle: \"ball: (x, y, z), radius, levels; box: (x, y, z), (x, y, z), levels; ...\"; with "
        "the "
        "name of a body in front, \"punch: ball: (x, y, z), radius, levels\", only cells of this body.");
    prm.add_action("Regions", [this](const std::string &text) { regions = parse_regions(text); });
    prm.add_parameter("Adaptive cycles", adaptive_cycles,
                      "Cycles, after the regions have been worked through, that refine where the residual "
                      "error indicator is large.",
                      Patterns::Integer(0, 100));
    add_choice(
        prm, "Marking", marking, {{Marking::error, "error"}, {Marking::cells, "cells"}},
        "What an adaptive cycle refines. error: the cells with the largest indicators that have the marking "
        "fraction of the (squared) error together. cells: that fraction of all cells.");
    prm.add_parameter("Marking fraction", marking_fraction, "Share of the error or of the cells.",
                      Patterns::Double(0., 1.));
    prm.add_parameter(
        "Compare cycles", compare_cycles,
        "Reports how far the solution of every cycle is from that of the last (energy norm), to judge "
        "the error indicator.");
    prm.add_parameter("Max dofs", max_dofs,
                      "No adaptive cycle is begun that would have more unknowns; 0 for no limit.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Wanted stress error", wanted_stress_error,
        "Adaptive cycles end where the estimated error of the stresses of all bodies together "
        "is as small, as a part of them in the energy norm: 0.05 for five percent. 0 for never: "
        "all of \"Adaptive cycles\" are done.",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Final global cycles", final_global_cycles,
        "Cycles, each with one global refinement, after the regions have been worked through. "
        "They keep the nested iteration cheap: each mesh has about eight times the cells of the "
        "one before.",
        Patterns::Integer(0, 20));
  }



  namespace
  {
    RefinementRegion parse_region(const std::string &kind, const std::string &text)
    {
      const std::string where = "Refinement/Regions, \"" + kind + ": " + text + "\"";
      const auto        parts = split_list(text, ',', where);
      if ((kind != "ball" && kind != "box") || parts.size() != 3)
        throw InputError(
            where +
            ": expected \"ball: (x, y, z), radius, levels\" or \"box: (x, y, z), (x, y, z), levels\".");
      RefinementRegion region;
      region.is_ball         = kind == "ball";
      region.centre_or_lower = parse_point(parts[0], where);
      region.radius          = 0.;
      if (region.is_ball)
        region.radius = parse_number(parts[1], where);
      else
        region.upper = parse_point(parts[1], where);
      for (unsigned int c = 0; c < 3 && !region.is_ball; ++c)
        if (!(region.centre_or_lower[c] <= region.upper[c]))
          throw InputError(where + ": the first corner must be the lower one in x, y and z.");
      const double levels = parse_number(parts[2], where);
      if (!(levels >= 0. && levels <= 20. && levels == std::floor(levels)) ||
          (region.is_ball && !(region.radius > 0.)))
        throw InputError(where + ": the number of levels must be between 0 and 20, and a radius positive.");
      region.levels = static_cast<unsigned int>(levels);
      return region;
    }
  } // namespace



  std::vector<RefinementRegion> parse_regions(const std::string &text)
  {
    std::vector<RefinementRegion> regions;
    for (const auto &[first, entry] : split_named_entries(text, "Refinement/Regions"))
      if (const std::size_t colon = entry.find(':'); colon != std::string::npos)
        {
          regions.push_back(parse_region(Utilities::trim(entry.substr(0, colon)),
                                         Utilities::trim(entry.substr(colon + 1))));
          regions.back().body = first;
        }
      else
        regions.push_back(parse_region(first, entry));
    return regions;
  }



  bool RefinementRegion::touches(const Point<3> &low, const Point<3> &high) const
  {
    double distance_square = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      if (is_ball)
        {
          const double d = std::max({low[c] - centre_or_lower[c], centre_or_lower[c] - high[c], 0.});
          distance_square += d * d;
        }
      else if (high[c] < centre_or_lower[c] || low[c] > upper[c])
        return false;
    return distance_square <= radius * radius;
  }



  Refinement::Refinement(const RefinementParameters &parameters)
    : parameters(parameters)
    , cycles(parameters.global_cycles)
  {
    for (const RefinementRegion &region : parameters.regions)
      cycles = std::max(cycles, parameters.global_cycles + region.levels);
    first_adaptive_cycle = cycles + 1;
    cycles += parameters.adaptive_cycles;
    first_final_cycle = cycles + 1;
    cycles += parameters.final_global_cycles;
  }



  std::vector<bool> Refinement::mark(const Bodies &bodies, const NodalSpace &space,
                                     const unsigned int cycle) const
  {
    std::vector<bool> marked(space.cells().size(), false);
    if (cycle > cycles)
      return marked;
    if (cycle <= parameters.global_cycles || cycle >= first_final_cycle)
      {
        marked.assign(marked.size(), true);
        return marked;
      }
    // Local refinement follows the global cycles. Regions may be nested: each cycle brings every region one
    // level further until it has its levels.
    for (std::size_t c = 0; c < marked.size(); ++c)
      {
        const auto nodes = space.nodes(space.cells()[c]);
        Point<3>   low = space.position(nodes[0]), high = low;
        for (const NodeIndex node : nodes)
          for (unsigned int d = 0; d < 3; ++d)
            {
              low[d]  = std::min(low[d], space.position(node)[d]);
              high[d] = std::max(high[d], space.position(node)[d]);
            }
        const NodalSpace::Cell &cell = space.cells()[c];
        const unsigned int      b    = bodies.body_of_material(cell.material);
        const unsigned int      initial =
            b < parameters.initial_of_body.size() ? parameters.initial_of_body[b] : parameters.initial_global;
        for (const RefinementRegion &region : parameters.regions)
          if ((region.body.empty() || region.body == bodies.body_name(b)) &&
              cell.level < initial + std::min(cycle, parameters.global_cycles + region.levels) &&
              region.touches(low, high))
            marked[c] = true;
      }
    return marked;
  }
} // namespace Signorini
