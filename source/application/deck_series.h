// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_deck_series_h
#define signorini_source_application_deck_series_h

#include <signorini/application/deck_model.h>
#include <signorini/mesh/field.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// A number at the ends of the steps: step k of n (from 0) ends at t = (k + 1) / n, in between it is
  /// linear, from zero at t = 0.
  struct DeckSeries
  {
    std::vector<double> values;

    bool       is_zero() const;
    DeckSeries scaled(const double factor) const;
    double     at(const double t) const;

    /// The same everywhere; along a direction.
    ScalarField field() const;
    VectorField field(const Vector3 &direction) const;
  };

  /// What acts in the steps of a deck, one after the other: all of them, where conditions hold the same
  /// directions of the same nodes in all of them, else the last one.
  class DeckHistory
  {
  public:
    /// The model must outlive the object.
    explicit DeckHistory(const DeckModel &model);

    unsigned int n_steps() const
    {
      return static_cast<unsigned int>(steps.size());
    }

    const DeckState &step(const unsigned int k) const
    {
      return *steps[k];
    }

    /// Values of a condition of the last step.
    std::array<std::optional<DeckSeries>, 3> values(const DeckBoundary &condition) const;

    /// Values of a direction of a single node, where a condition of the last step holds it.
    std::optional<DeckSeries> value_at(const unsigned int node, const unsigned int direction) const;

    /// Values of a rotation of a reference node, where a condition of the last step holds it.
    std::optional<DeckSeries> rotation_at(const unsigned int node, const unsigned int axis) const;

    /// By node and direction; by element and side.
    std::map<std::pair<unsigned int, unsigned int>, DeckSeries> forces() const;
    std::map<std::pair<unsigned int, unsigned int>, DeckSeries> pressures() const;

    /// On a surface.
    struct SurfaceLoad
    {
      const DeckSurface        *surface = nullptr;
      DeckPlace                 place;
      DeckSeries                pressure;
      std::array<DeckSeries, 3> traction;
    };

    /// By name of the surface.
    std::map<std::string, SurfaceLoad> surface_loads() const;

  private:
    /// The value of a condition in a step, if that has one for all of its nodes.
    std::optional<double> find(const DeckBoundary &condition, const unsigned int direction,
                               const DeckState &state) const;
    DeckSeries            zero() const
    {
      return {std::vector<double>(steps.size(), 0.)};
    }

    std::vector<const DeckState *> steps;
  };
} // namespace Signorini

#endif
