// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "deck_series.h"

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  bool DeckSeries::is_zero() const
  {
    return std::all_of(values.begin(), values.end(), [](const double v) { return v == 0.; });
  }



  DeckSeries DeckSeries::scaled(const double factor) const
  {
    DeckSeries result = *this;
    for (double &v : result.values)
      v *= factor;
    return result;
  }



  double DeckSeries::at(const double t) const
  {
    // The ends of the steps are rounded numbers.
    const double n = static_cast<double>(values.size()), x = t * n;
    const double nearest = std::round(x);
    if (nearest >= 1. && nearest <= n && std::abs(x - nearest) < 1e-10 * n)
      return values[static_cast<std::size_t>(nearest) - 1];
    if (x >= n)
      return values.back();
    const auto   k     = static_cast<std::size_t>(std::max(0., std::floor(x)));
    const double begin = k == 0 ? 0. : values[k - 1];
    return begin + (values[k] - begin) * (x - static_cast<double>(k));
  }



  ScalarField DeckSeries::field() const
  {
    return [series = *this](const Point<3> &, const double t) { return series.at(t); };
  }



  VectorField DeckSeries::field(const Vector3 &direction) const
  {
    return [series = *this, direction](const Point<3> &, const double t) { return series.at(t) * direction; };
  }



  namespace
  {
    using Held = std::set<std::pair<unsigned int, unsigned int>>;

    /// Nodes and directions that conditions hold.
    Held held(const DeckState &state)
    {
      Held result;
      for (const DeckBoundary &condition : state.boundaries)
        for (const unsigned int node : condition.nodes)
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.values[c])
              result.insert({node, c});
      return result;
    }
  } // namespace



  DeckHistory::DeckHistory(const DeckModel &model)
  {
    const std::vector<DeckState> &all = model.steps();
    if (all.size() > 1)
      {
        const Held last   = held(all.back());
        bool       is_one = true;
        for (const DeckState &state : all)
          {
            is_one = is_one && held(state) == last;
            for (const DeckBoundary &condition : all.back().boundaries)
              for (unsigned int c = 0; c < 3; ++c)
                is_one = is_one && (!condition.values[c] || find(condition, c, state));
          }
        if (is_one)
          for (const DeckState &state : all)
            steps.push_back(&state);
      }
    if (steps.empty())
      steps.push_back(&all.back());
  }



  std::optional<double> DeckHistory::find(const DeckBoundary &condition, const unsigned int direction,
                                          const DeckState &state) const
  {
    for (auto other = state.boundaries.rbegin(); other != state.boundaries.rend(); ++other)
      if (other->values[direction] && other->nodes == condition.nodes)
        return other->values[direction];
    return std::nullopt;
  }



  std::array<std::optional<DeckSeries>, 3> DeckHistory::values(const DeckBoundary &condition) const
  {
    std::array<std::optional<DeckSeries>, 3> result;
    for (unsigned int c = 0; c < 3; ++c)
      if (condition.values[c])
        {
          result[c] = zero();
          for (unsigned int k = 0; k + 1 < n_steps(); ++k)
            result[c]->values[k] = *find(condition, c, *steps[k]);
          result[c]->values.back() = *condition.values[c];
        }
    return result;
  }



  std::optional<DeckSeries> DeckHistory::value_at(const unsigned int node, const unsigned int direction) const
  {
    const auto &last = steps.back()->boundaries;
    for (auto condition = last.rbegin(); condition != last.rend(); ++condition)
      if (condition->values[direction] &&
          std::find(condition->nodes.begin(), condition->nodes.end(), node) != condition->nodes.end())
        return values(*condition)[direction];
    return std::nullopt;
  }



  std::optional<DeckSeries> DeckHistory::rotation_at(const unsigned int node, const unsigned int axis) const
  {
    if (steps.back()->rotations.count({node, axis}) == 0)
      return std::nullopt;
    DeckSeries result = zero();
    for (unsigned int k = 0; k < n_steps(); ++k)
      if (const auto it = steps[k]->rotations.find({node, axis}); it != steps[k]->rotations.end())
        result.values[k] = it->second;
    return result;
  }



  std::map<std::pair<unsigned int, unsigned int>, DeckSeries> DeckHistory::forces() const
  {
    std::map<std::pair<unsigned int, unsigned int>, DeckSeries> result;
    for (unsigned int k = 0; k < n_steps(); ++k)
      for (const auto &[where, load] : steps[k]->forces)
        result.insert({where, zero()}).first->second.values[k] = load.value;
    return result;
  }



  std::map<std::pair<unsigned int, unsigned int>, DeckSeries> DeckHistory::pressures() const
  {
    std::map<std::pair<unsigned int, unsigned int>, DeckSeries> result;
    for (unsigned int k = 0; k < n_steps(); ++k)
      for (const auto &[where, load] : steps[k]->pressures)
        result.insert({where, zero()}).first->second.values[k] = load.value;
    return result;
  }



  std::map<std::string, DeckHistory::SurfaceLoad> DeckHistory::surface_loads() const
  {
    std::map<std::string, SurfaceLoad> result;
    for (unsigned int k = 0; k < n_steps(); ++k)
      for (const DeckSurfaceLoad &load : steps[k]->surface_loads)
        {
          const auto [it, is_new] = result.insert(
              {load.surface->name, {load.surface, load.place, zero(), {{zero(), zero(), zero()}}}});
          it->second.pressure.values[k] += load.pressure;
          for (unsigned int c = 0; c < 3; ++c)
            it->second.traction[c].values[k] += load.traction[c];
        }
    return result;
  }
} // namespace Signorini
