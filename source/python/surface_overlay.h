// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_python_surface_overlay_h
#define signorini_python_surface_overlay_h

#include <signorini/surface/contact_mapping.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Signorini
{
  /// Two surfaces and the mapping between them.
  class SurfaceOverlay
  {
  public:
    /// Errors: InputError for surfaces that are none.
    SurfaceOverlay(SurfaceMesh nonmortar, SurfaceMesh mortar);

    /// The mapping.
    const ContactMapping &mapping() const
    {
      return *the_mapping;
    }

    /// Overlay triangles, and the area of each on the nonmortar side.
    std::vector<OverlayTriangle> cells;
    std::vector<double>          areas;
    /// The figures of signorini-map as JSON, and its errors in words (empty if there are none).
    std::string report, errors;

    /// The corners of the polygons in barycentric coordinates on either side, three numbers a corner.
    std::vector<double> polygon_coordinates(const bool on_mortar) const;

    /// A sparse matrix by its entries.
    struct Matrix
    {
      /// One number each an entry.
      std::vector<std::int64_t> rows, columns;
      std::vector<double>       values;
    };

    /// D and M with hat functions as multipliers, or with dual ones (doc/algorithm.md, (12) to (15)): entries
    /// of the same place are to be summed up.
    std::pair<Matrix, Matrix> coupling(const bool is_dual) const;

    /// Images (or preimages) of points: a triangle each, or -1; and three coordinates.
    /// @param triangles, weights of the points; three numbers a point
    std::pair<std::vector<std::int64_t>, std::vector<double>>
    images(const std::vector<std::int64_t> &triangles, const std::vector<double> &weights,
           const bool from_mortar) const;

  private:
    SurfaceMesh                           nonmortar, mortar;
    std::unique_ptr<const ContactMapping> the_mapping;
  };
} // namespace Signorini

#endif
