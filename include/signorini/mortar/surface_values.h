// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_surface_values_h
#define signorini_mortar_surface_values_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/face_map.h>
#include <signorini/surface/overlay.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// Barycentric coordinates in a surface triangle of a point given in an overlay triangle, whose corners lie
  /// there (OverlayTriangle::nonmortar or mortar).
  std::array<double, 3> compose(const std::array<std::array<double, 3>, 3> &corners,
                                const std::array<double, 3>                &weights);

  /// From a point of the true nonmortar surface to its image on the true mortar surface (length):
  /// Phi(x) - x + offset_mor - offset_non, where x and Phi(x) lie on the facets (doc/algorithm.md, (18)); of
  /// the way between these what is along the normal of the nonmortar side, in the direction of that of the
  /// mortar side, along which Phi goes; all of it beside edges.
  /// @param weights of the point in the overlay triangle
  Vector3 initial_gap(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const OverlayTriangle &cell, const std::array<double, 3> &weights,
                      const dealii::Point<3> &x, const dealii::Point<3> &image);

  /// Whether surfaces with these unit normals may touch: less than 60 degrees from being opposite, as for
  /// obstacles. Gaps at grazing angles are no distances.
  bool may_touch(const Vector3 &normal, const Vector3 &other);

  /// The two surfaces of a pair, with overlay triangles of the mapping between them (those of this rank's own
  /// faces, say). Refers to all of them.
  struct FacingSurfaces
  {
    /// The surfaces, and the overlay ordered by nonmortar triangle.
    const ContactSurface               &nonmortar, &mortar;
    const std::vector<OverlayTriangle> &overlay;
    /// By vertex of the nonmortar surface, vertices_on_sharp_edges(); none if empty.
    std::vector<bool> sharp_vertices = {};
  };

  /// A field on a contact surface that may jump from face to face: by face, at its corners.
  using CornerValues = std::vector<std::array<Vector3, 4>>;

  /// Fields on a contact surface at points of its triangles. Nodal fields are evaluated at the true reference
  /// point of the face. The surface must outlive the object.
  class SurfaceValues
  {
  public:
    /// The surface must outlive the object.
    /// @param sharp_vertices those whose normal is that of none of the faces around them; none if empty
    explicit SurfaceValues(const ContactSurface &surface, std::vector<bool> sharp_vertices = {});

    /// What it is about.
    const ContactSurface &contact_surface() const
    {
      return surface;
    }

    /// The point with given barycentric coordinates, on the facet.
    dealii::Point<3> point(const unsigned int triangle, const std::array<double, 3> &weights) const;

    /// The unit normal at a point, linear on triangles; zero where there is none. Sharp vertices have that of
    /// the true surface over the triangle.
    Vector3 normal(const unsigned int triangle, const std::array<double, 3> &weights) const;

    /// The corner functions of the face of a triangle at a point of it.
    std::array<double, 4> shape(const unsigned int triangle, const dealii::Point<3> &p) const;

    /// A field given by vertex, with the corner functions at the point.
    Vector3 value(const std::vector<Vector3> &field, const unsigned int triangle,
                  const std::array<double, 4> &shape) const;

    /// A field given by the corners of faces, with the corner functions at the point.
    Vector3 value(const CornerValues &field, const unsigned int triangle,
                  const std::array<double, 4> &shape) const;

    /// A field given by vertices at a point of a triangle.
    Vector3 value(const std::vector<Vector3> &field, const unsigned int triangle,
                  const dealii::Point<3> &p) const
    {
      return value(field, triangle, shape(triangle, p));
    }

  private:
    const ContactSurface &surface;
    std::vector<bool>     sharp_vertices;
    std::vector<FaceMap>  maps;
  };
} // namespace Signorini

#endif
