// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_shank_h
#define signorini_source_application_shank_h

#include <signorini/application/discretization.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// The cells of a mesh that a pretension shortens, and what their section carries: doc/algorithm.md, (74).
  class Shank
  {
  public:
    /// Collective. The model and the discretization must outlive the object.
    /// @param bolt number among the pretensions of the loads
    /// Errors: InputError where there is no cell in the region.
    Shank(const ContactModel &model, const Discretization &d, const std::size_t bolt);

    /// Mean distance of its ends along the axis (length).
    double length() const
    {
      return volume / section;
    }

    /// E A: the force per strain between rigid plates.
    double stiffness() const
    {
      return modulus / length();
    }

    /// Collective. The section force of a displacement (force).
    double force(const Vector &displacement) const;

  private:
    struct Part
    {
      /// Index in NodalSpace::cells().
      unsigned int cell;
      /// The ramp at its vertices.
      std::array<double, CellShape::max_vertices> ramp;
    };

    const Pretension &bolt() const
    {
      return model.loads().pretensions[number];
    }

    struct Nodes;

    /// Collective. The ramp at all nodes that this rank sees, in the first component.
    Vector find_ramp() const;

    const ContactModel   &model;
    const Discretization &d;
    const std::size_t     number;
    std::vector<Part>     parts;
    /// Of all ranks: the volume, the area of the section, the integral of Young's modulus (force times
    /// length).
    double volume = 0., section = 0., modulus = 0.;
  };
} // namespace Signorini

#endif
