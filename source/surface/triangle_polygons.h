// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_triangle_polygons_h
#define signorini_source_surface_triangle_polygons_h

#include <signorini/surface/common_polygon.h>
#include <signorini/surface/contact_mapping.h>

namespace Signorini
{
  /// The polygons in one nonmortar triangle, from the nodes of the plane graph.
  class TrianglePolygons
  {
  public:
    struct Polygon
    {
      unsigned int mortar_triangle;
      /// Parts of the nonmortar and of the mortar triangle; negative where the mapping is turned.
      double         share, mortar_share;
      std::ptrdiff_t first, last;
    };

    TrianglePolygons(const Incidence &incidence, const PlaneGraph &graph,
                     const std::vector<bool> &mortar_border)
      : incidence(incidence)
      , nonmortar(incidence.nonmortar_topology)
      , mortar(incidence.mortar_topology)
      , graph(graph)
      , mortar_border(mortar_border)
    {
    }

    void compute(const unsigned int t);

    /// How far the pieces are from covering a triangle that no border of the mortar surface runs through.
    double defect() const
    {
      return is_covered_all && !list.empty() ? std::abs(covered - 1.) : 0.;
    }

    /// Whether it is known to be covered as a whole, up to a share of it.
    bool is_tiled(const double share) const
    {
      return is_covered_all && !list.empty() && defect() <= share;
    }

    /// Whether it has images everywhere, but no polygon.
    bool is_lost() const
    {
      return is_covered_all && faces_any && list.empty();
    }

    /// Whether it meets a triangle that it can touch, or would if it were not lost.
    bool can_touch() const
    {
      return is_lost() ? touches_any : std::any_of(list.begin(), list.end(), [&](const Polygon &polygon) {
        return !incidence.triangles_turn_away(triangle, polygon.mortar_triangle);
      });
    }

    /// A part of an edge of the triangle that is a side of a polygon.
    struct EdgeSide
    {
      unsigned int edge;
      double       length;
    };

    /// A node in a nonmortar triangle, with a mortar triangle that it lies in as well.
    struct Incident
    {
      unsigned int mortar_triangle, node;

      bool operator<(const Incident &other) const
      {
        return mortar_triangle != other.mortar_triangle ? mortar_triangle < other.mortar_triangle
                                                        : node < other.node;
      }
    };

    std::vector<Polygon>      list;
    std::vector<EdgeSide>     sides;
    std::vector<unsigned int> corners;
    double                    covered;
    unsigned int              n_broken;

  private:
    void   add(const unsigned int node);
    bool   meet(const unsigned int t, const unsigned int m, const std::size_t first,
                const std::size_t last) const;
    void   add_polygon(const unsigned int t, const unsigned int m, const std::size_t first,
                       const std::size_t last);
    void   add_sides(const unsigned int t, const unsigned int m);
    double parameter_on(const SurfacePoint &p, const unsigned int edge) const;

    const Incidence                   &incidence;
    const SurfaceTopology             &nonmortar, &mortar;
    const PlaneGraph                  &graph;
    const std::vector<bool>           &mortar_border;
    std::vector<Incident>              incident;
    std::vector<CommonPolygon::Corner> unsorted;
    std::vector<std::array<double, 2>> flat;
    CommonPolygon                      sorter;
    unsigned int                       triangle;
    bool                               is_covered_all, faces_any, touches_any;
  };
} // namespace Signorini

#endif
