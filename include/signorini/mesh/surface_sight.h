// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_sight_h
#define signorini_mesh_surface_sight_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/surface/box_tree.h>

#include <array>
#include <functional>
#include <vector>

namespace Signorini
{
  /// What is seen of a whole contact surface along lines. The surface must outlive the object.
  class SurfaceSight
  {
  public:
    /// Builds a search tree of the triangles.
    explicit SurfaceSight(const ContactSurface &surface);

    /// A point of the surface on a line.
    struct Place
    {
      /// Along the line, negative behind the point that one looks from (length).
      double       distance = 0.;
      unsigned int triangle = 0;
      /// Barycentric coordinates.
      std::array<double, 3> weights = {{0., 0., 0.}};
    };

    /// The nearest triangle before or behind a point, if it faces the line: if its normal and that of the
    /// line, a unit vector, differ by 120 degrees and more, as where a mapping ends.
    /// @param same_place lengths that do not differ
    /// @param is_open tells of a distance whether one can see as far
    bool find(Place &place, const dealii::Point<3> &p, const Vector3 &n, const double same_place,
              const std::function<bool(double distance)> &is_open) const;

  private:
    bool meets(Place &place, const dealii::Point<3> &p, const Vector3 &n) const;

    const ContactSurface             &surface;
    const BoxTree                     tree;
    mutable std::vector<unsigned int> found;
  };
} // namespace Signorini

#endif
