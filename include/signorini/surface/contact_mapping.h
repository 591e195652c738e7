// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_contact_mapping_h
#define signorini_surface_contact_mapping_h

#include <signorini/surface/overlay.h>
#include <signorini/surface/plane_graph.h>
#include <signorini/surface/surface_mesh.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <vector>

namespace Signorini
{
  /// What a contact mapping covers.
  struct MappingReport
  {
    /// Area of the selected nonmortar triangles, and of the overlay on them.
    double area_nonmortar = 0., area_covered = 0.;
    /// Area of the mortar surface, and of the overlay on it (of the selected nonmortar triangles).
    double area_mortar = 0., area_mortar_covered = 0.;
    /// Largest |sum of overlay areas - area| / area over selected triangles that no border of the mortar
    /// surface runs through.
    double worst_tiling_defect = 0.;
    /// Overlay triangles (some may have no area, to rounding, and are left out of the overlay), and pairs of
    /// triangles that meet.
    std::size_t n_cells = 0, n_pairs = 0;
    /// Polygons whose orientation is turned, because a cell of the mortar surface is bent more than it is
    /// wide (their area counts negative); and pairs of triangles whose common corners make no polygon.
    std::size_t n_flips = 0, n_broken = 0;
    /// Errors of the mapping: triangles all of whose corners have images inside of the mortar surface, but
    /// without a polygon; and nonmortar edges along which the polygons of one triangle go farther than those
    /// of the other, where no border of the mortar surface runs along the edge.
    std::size_t n_lost_triangles = 0, n_torn_edges = 0;
    /// Where: nonmortar triangles with an error of their own (turned or broken polygons, too), torn edges.
    std::vector<unsigned int> wrong_triangles, torn_edges;
    /// Triangles with an error of their own and torn edges where the surfaces turn away from each other by
    /// more than 60 degrees. Nothing touches there: they are counted here only.
    std::size_t n_turned_away = 0;
    /// Such triangles and edges of which less than a small share is wrong: no result can feel that, and
    /// rounding decides whether there are any. They are counted here only.
    std::size_t n_slight = 0;
    /// That share: a shaft with a chamfer in a bore had errors of 6e-8, and in other units none.
    static constexpr double slight = 1e-5;
    /// An edge and what is known of the triangles beside it; kept where one of them is selected elsewhere.
    struct OpenEdge
    {
      /// The edge.
      unsigned int edge = 0;
      /// By how much of the edge one triangle goes farther.
      double excess = 0.;
      /// Whether it meets a triangle that it can touch.
      bool can_touch = false;
      /// Whether it is covered as a whole (up to `slight`), as far as is known: then the edge is torn over a
      /// sliver.
      bool are_tiled = false;

      /// For messages between ranks.
      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &edge &excess &can_touch &are_tiled;
      }
    };
    /// Until the parts are summed.
    std::vector<OpenEdge> open_edges;
    /// A larger part of an edge than this is torn.
    static constexpr double torn = 1e-9;

    /// Counts an edge if it is torn.
    void add_edge(const OpenEdge &sides);

    /// Edges of the two surfaces where triangles turn to different sides or more than two meet; they count as
    /// borders.
    std::size_t n_conflicts = 0;
    /// Mortar edges whose image could not be followed (over the part).
    std::vector<unsigned int> lost_edges;
    /// Mortar vertices without an image, in ascending order, with the reason. Each is told by one part.
    std::vector<std::pair<unsigned int, Unmapped>> unmapped;
  };

  /// The contact mapping Phi between two triangulated surfaces (Krause & Sander, section 3): Phi^-1 is the
  /// projection of the mortar surface along its continuous normal field. The faces of the plane graph are the
  /// polygons in which a nonmortar and a mortar triangle meet; Phi is linear on the triangles they are cut
  /// into.
  class ContactMapping
  {
  public:
    /// Surfaces with vertex normals; they need not outlive the mapping. is_selected: the nonmortar triangles
    /// whose overlay is wanted (a rank's own faces); empty for all. Only what comes near them is worked out;
    /// their overlay does not depend on the selection. Collective: the surfaces are the same on all ranks,
    /// and every triangle is selected on one of them.
    ContactMapping(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                   const std::function<bool(const unsigned int)> &is_selected  = {},
                   const MPI_Comm                                 communicator = MPI_COMM_SELF);

    /// The same mapping with the surfaces cut down to parts, which have all triangles of its polygons. What
    /// the report says of triangles, edges and vertices has the numbers of the whole surfaces.
    ContactMapping(const ContactMapping &whole, const SurfacePart &nonmortar_part,
                   const SurfacePart &mortar_part);

    /// Leaves out polygons: what they cover counts as uncovered. The report stays as it is.
    void leave_out(const std::vector<bool> &polygons);

    /// Number of polygons in which triangles meet.
    std::size_t n_polygons() const
    {
      return polygon_triangles.size();
    }

    /// Appends the triangles of one polygon.
    void triangulate(std::vector<OverlayTriangle> &triangles, const std::size_t polygon) const;

    /// The triangles of all polygons, ordered by nonmortar, then by mortar triangle.
    std::vector<OverlayTriangle> overlay() const;

    /// Phi at a point of a nonmortar triangle, Phi^-1 at a point of a mortar triangle. On::nothing where the
    /// surfaces do not meet.
    SurfacePoint image(const unsigned int nonmortar_triangle, const std::array<double, 3> &weights) const;
    SurfacePoint preimage(const unsigned int mortar_triangle, const std::array<double, 3> &weights) const;

    /// Over the selected triangles of this rank; sum_reports() has those of all.
    const MappingReport &report() const
    {
      return summary;
    }

    /// Triangles, edges and vertices of the nonmortar surface.
    const SurfaceTopology &nonmortar_topology() const
    {
      return nonmortar;
    }

    /// The same of the mortar surface.
    const SurfaceTopology &mortar_topology() const
    {
      return mortar;
    }

    /// Bytes, without the report.
    std::size_t memory_consumption() const
    {
      return nonmortar.memory_consumption() + mortar.memory_consumption() + list_bytes(graph_nodes) +
             list_bytes(polygon_triangles) + list_bytes(polygon_start) + list_bytes(polygon_corners) +
             list_bytes(by_mortar_start) + list_bytes(by_mortar);
    }

    /// Nodes of the plane graph.
    const std::vector<MappingNode> &nodes() const
    {
      return graph_nodes;
    }

    /// Polygon i meets nonmortar triangle first and mortar triangle second; its corners are the nodes
    /// corners[start[i]] ... corners[start[i+1]-1], counterclockwise for a viewer outside of the nonmortar
    /// body.
    std::vector<std::pair<unsigned int, unsigned int>> polygon_triangles;
    std::vector<unsigned int>                          polygon_start, polygon_corners;

  private:
    /// @param edges_of_parts of the nonmortar and of the mortar part
    void keep_nodes(const ContactMapping &whole, const std::array<const SurfacePart *, 2> &parts,
                    const std::array<Renumbering, 2> &edges_of_parts);

    SurfacePoint locate(const std::vector<unsigned int> &order, const std::size_t first,
                        const std::size_t last, const std::array<double, 3> &weights,
                        const bool to_mortar) const;

    SurfaceTopology          nonmortar, mortar;
    std::vector<MappingNode> graph_nodes;
    MappingReport            summary;
    /// Polygons by mortar triangle; made when Phi^-1 is asked for first.
    mutable std::vector<unsigned int> by_mortar_start, by_mortar;
  };

  /// The point of a triangle with given barycentric coordinates.
  dealii::Point<3> evaluate(const SurfaceMesh &mesh, const unsigned int triangle,
                            const std::array<double, 3> &barycentric);

  /// Area of a triangle of a surface.
  double triangle_area(const SurfaceMesh &mesh, const unsigned int triangle);
} // namespace Signorini

#endif
