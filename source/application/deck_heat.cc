// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Temperatures of a deck, as strains of its bodies without stress.

#include "deck_bodies.h"
#include "deck_joined_sets.h"
#include "deck_series.h"

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Differences to the initial temperature of a node at the ends of the steps.
    DeckSeries difference_at(const unsigned int node, const DeckModel &model, const DeckHistory &history)
    {
      const auto   it      = model.initial_temperatures().find(node);
      const double initial = it == model.initial_temperatures().end() ? 0. : it->second;
      DeckSeries   result;
      for (unsigned int k = 0; k < history.n_steps(); ++k)
        {
          const auto &all = history.step(k).temperatures;
          const auto  now = all.find(node);
          result.values.push_back(now == all.end() ? 0. : now->second.value - initial);
        }
      return result;
    }

    /// By vertex; the centres of faces and cells have the mean of their nodes.
    std::vector<DeckSeries> differences(const DeckBody &body, const DeckModel &model,
                                        const DeckHistory &history)
    {
      std::vector<DeckSeries> result;
      for (unsigned int v = 0; v < body.cells->mesh.vertices.size(); ++v)
        {
          const std::vector<unsigned int> &nodes = body.cells->support(v);
          DeckSeries                       mean  = difference_at(nodes[0], model, history);
          bool                             alike = true;
          DeckSeries                       sum   = mean;
          for (std::size_t i = 1; i < nodes.size(); ++i)
            {
              const DeckSeries other = difference_at(nodes[i], model, history);
              alike                  = alike && other.values == mean.values;
              for (std::size_t k = 0; k < sum.values.size(); ++k)
                sum.values[k] += other.values[k];
            }
          // Without rounding where they are the same, which is then seen in the whole body.
          result.push_back(alike ? mean : sum.scaled(1. / static_cast<double>(nodes.size())));
        }
      return result;
    }

    ScalarField temperature_field(const DeckBody &body, const std::vector<DeckSeries> &at_vertices)
    {
      if (std::all_of(at_vertices.begin(), at_vertices.end(),
                      [&](const DeckSeries &s) { return s.values == at_vertices[0].values; }))
        return at_vertices[0].field();
      return nodal_field(body, at_vertices);
    }
  } // namespace



  void add_temperatures(std::vector<DeckBody> &bodies, const DeckModel &model, const DeckHistory &history)
  {
    for (DeckBody &body : bodies)
      {
        std::vector<LoadDefinition::InitialStrain> expansions;
        for (std::size_t i = 0; i < body.materials.size(); ++i)
          if (const auto &expansion = model.materials()[body.materials[i]].expansion;
              expansion && *expansion != 0.)
            expansions.push_back({body.cells->mesh.volume_names[i], {}, *expansion});
        if (expansions.empty())
          continue;
        const std::vector<DeckSeries> at_vertices = differences(body, model, history);
        if (std::all_of(at_vertices.begin(), at_vertices.end(),
                        [](const DeckSeries &s) { return s.is_zero(); }))
          continue;
        auto &all = body.loads.initial_strains;
        all.push_back({"", temperature_field(body, at_vertices)});
        all.insert(all.end(), expansions.begin(), expansions.end());
      }
  }
} // namespace Signorini
