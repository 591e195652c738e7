// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_surface_values_h
#define signorini_mortar_surface_values_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/face_map.h>

#include <vector>

namespace Signorini
{
  /// Barycentric coordinates in a surface triangle of a point given in an overlay triangle, whose corners lie
  /// there (OverlayTriangle::nonmortar or mortar).
  std::array<double, 3> compose(const std::array<std::array<double, 3>, 3> &corners,
                                const std::array<double, 3>                &weights);

  /// Fields on a contact surface at points of its triangles. Nodal fields are evaluated at the true reference
  /// point of the face. The surface must outlive the object.
  class SurfaceValues
  {
  public:
    explicit SurfaceValues(const ContactSurface &surface);

    /// The point with given barycentric coordinates.
    dealii::Point<3> point(const unsigned int triangle, const std::array<double, 3> &weights) const;

    /// The unit normal there, linear on triangles; zero where there is none.
    Vector3 normal(const unsigned int triangle, const std::array<double, 3> &weights) const;

    /// The corner functions of the face of a triangle at a point of it.
    std::array<double, 4> shape(const unsigned int triangle, const dealii::Point<3> &p) const;

    /// A field given by vertex, with the corner functions at the point.
    Vector3 value(const std::vector<Vector3> &field, const unsigned int triangle,
                  const std::array<double, 4> &shape) const;

    Vector3 value(const std::vector<Vector3> &field, const unsigned int triangle,
                  const dealii::Point<3> &p) const
    {
      return value(field, triangle, shape(triangle, p));
    }

  private:
    const ContactSurface &surface;
    std::vector<FaceMap>  maps;
  };
} // namespace Signorini

#endif
