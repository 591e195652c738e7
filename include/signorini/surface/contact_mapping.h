// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_contact_mapping_h
#define signorini_surface_contact_mapping_h

#include <signorini/surface/overlay.h>
#include <signorini/surface/surface_mesh.h>

#include <functional>
#include <string>
#include <vector>

namespace Signorini
{
  /// What a contact mapping covers.
  struct MappingReport
  {
    /// Area of the selected nonmortar triangles, and of the overlay on them.
    double area_nonmortar = 0., area_covered = 0.;
    /// Largest |sum of overlay areas - area| / area over selected triangles that are covered entirely (to
    /// 1e-6).
    double worst_tiling_defect = 0.;
    /// Overlay triangles, and pairs of triangles that meet.
    std::size_t n_cells = 0, n_pairs = 0;
    /// Mortar vertices that no line along their normal takes to the nonmortar surface.
    std::vector<unsigned int> unmapped_mortar;
  };

  /// The contact mapping Phi between two triangulated surfaces (Krause & Sander, section 3): Phi^-1 is the
  /// projection of the mortar surface along its continuous normal field. Corners of the overlay are images of
  /// mortar vertices, nonmortar vertices (system (9)) and crossings of edges (system (10)).
  ///
  /// Whether a vertex lies left of, right of, or on an edge of the other surface is a function of that vertex
  /// and that edge alone, so all triangles around agree on it, and the pieces of a triangle tile it.
  class ContactMapping
  {
  public:
    /// Surfaces with vertex normals. is_selected: the nonmortar triangles whose overlay is wanted (a rank's
    /// own faces); empty for all. The overlay of a triangle does not depend on the selection.
    ContactMapping(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                   const std::function<bool(const unsigned int)> &is_selected = {});

    /// Ordered by nonmortar, then by mortar triangle.
    const std::vector<OverlayTriangle> &overlay() const
    {
      return cells;
    }

    const MappingReport &report() const
    {
      return summary;
    }

  private:
    std::vector<OverlayTriangle> cells;
    MappingReport                summary;
  };

  /// The point of a triangle with given barycentric coordinates.
  dealii::Point<3> evaluate(const SurfaceMesh &mesh, const unsigned int triangle,
                            const std::array<double, 3> &barycentric);

  /// Area of a triangle of a surface.
  double triangle_area(const SurfaceMesh &mesh, const unsigned int triangle);
} // namespace Signorini

#endif
