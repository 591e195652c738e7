// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_plane_graph_h
#define signorini_surface_plane_graph_h

#include <signorini/surface/box_tree.h>
#include <signorini/surface/incidence.h>
#include <signorini/surface/part_region.h>
#include <signorini/surface/surface_mesh.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <set>
#include <vector>

namespace Signorini
{
  /// Why a mortar vertex has no image on the nonmortar surface.
  enum class Unmapped : unsigned char
  {
    /// It has one.
    not_at_all,
    /// The line along its normal misses the nonmortar surface.
    no_hit,
    /// The same, with a neighbour that has an image: the vertex lies just outside of the common part.
    outside_rim,
    /// It hits, but only triangles that do not face it.
    wrong_side,
    /// Another layer of the mortar surface lies nearer to what it hits.
    behind
  };

  /// A node of the plane graph with its places on both surfaces: Phi takes the first to the second.
  struct MappingNode
  {
    /// Places on either surface.
    SurfacePoint nonmortar, mortar;
  };

  /// The image of the edge graph of the mortar surface on the nonmortar surface under Phi^-1 (Krause &
  /// Sander, section 3), by its nodes: images of mortar vertices, crossings of edges (system (10)), and the
  /// nonmortar vertices with their images (system (9)).
  ///
  /// Where a vertex lies is decided once. From there the image of a mortar edge is followed through the
  /// triangles by topology: which edge it leaves through is a matter of the side on which it passes a vertex.
  /// Numbers only place the nodes. So the pieces always fit together, whatever the rounding.
  class PlaneGraph
  {
  public:
    /// Moves vertices as it finds them incident. Complete in the region of a part, where it is the same as
    /// the graph of the whole; elsewhere nodes are left out. Collective over the parts.
    PlaneGraph(Incidence &incidence, const PartRegion &region, const MPI_Comm communicator);
    ~PlaneGraph();

    /// No node.
    static constexpr unsigned int none = SurfaceTopology::none;

    /// In the order in which they were found.
    std::vector<MappingNode> nodes;
    /// The node at each vertex, or none.
    std::vector<unsigned int> nonmortar_vertex_node, mortar_vertex_node;
    /// Nodes in the interior of nonmortar edges, from the lower to the higher vertex, and of nonmortar
    /// triangles: edge_nodes[edge_start[e]] ... edge_nodes[edge_start[e + 1] - 1].
    std::vector<unsigned int> edge_start, edge_nodes, triangle_start, triangle_nodes;

    /// Mortar vertices without an image, of this part's share: each vertex belongs to the share of one part.
    std::vector<std::pair<unsigned int, Unmapped>> unmapped;
    /// Mortar edges whose image could not be followed from end to end although both ends have one, lost in
    /// the region.
    std::vector<unsigned int> lost_edges;

  private:
    enum class State
    {
      on_the_way,
      reached,
      left,
      lost
    };

    /// The image of a mortar edge on its way.
    struct Walk;

    /// Where the line along the normal of a mortar vertex meets the nonmortar surface.
    struct Hit
    {
      SurfacePoint place;
      /// Way to it along the normal.
      double eta = 0.;
      /// Whether there are triangles on the line that do not face the vertex.
      bool turned_away = false;
    };

    void     select_mortar_edges(const MPI_Comm communicator);
    void     map_mortar_vertices();
    Unmapped map_mortar_vertex(const unsigned int vertex, const Hit &hit);
    Hit      nearest_hit(const unsigned int vertex, const std::vector<unsigned int> &candidates) const;
    bool     is_hit(SurfacePoint &place, double &eta, const unsigned int vertex,
                    const unsigned int triangle) const;

    void  trace_mortar_edges();
    State trace_from_node(const unsigned int edge, const int direction, const unsigned int start,
                          const unsigned int target);
    State leave_node(Walk &walk, const SurfacePoint &start);
    State pass_triangle(Walk &walk);
    State pass_vertex(Walk &walk);
    State leave_through(Walk &walk, const unsigned int local_edge, const Incidence::Side &begin,
                        const Incidence::Side &end);
    State walk_to_end(Walk &walk, State state);
    /// Whether a crossing near an end of one of the edges is none right beside it: a matter of the side on
    /// which that end lies, as for all other decisions.
    bool is_between_ends(const Incidence::Crossing &crossing, const unsigned int edge,
                         const unsigned int mortar_edge) const;
    /// Where a walk by roots is: the triangles that it may go on through, and the edges that it has passed.
    struct Front;

    State trace_by_roots(Walk &walk, const SurfacePoint &start);
    Front front_at(const SurfacePoint &start) const;
    bool  find_next_crossing(unsigned int &edge, Incidence::Crossing &next, const Walk &walk,
                             const Front &front) const;
    void  take_back(const Walk &walk, const std::size_t n_nodes);
    void  note_lost(const Walk &walk, const SurfacePoint &start);
    bool  is_reached(const Walk &walk, const unsigned int triangle) const;

    void                      enter_at_borders();
    std::vector<unsigned int> edges_to_enter_at() const;
    std::vector<signed char>  find_facing() const;
    void find_below_curtain(std::vector<unsigned int> &found, const BoxTree &tree, const BoxTree::Box &all,
                            const unsigned int mortar_edge) const;
    void enter_at(const unsigned int edge, const unsigned int mortar_edge);
    void enter_at(const unsigned int edge, const unsigned int mortar_edge, const unsigned int inner_side);
    bool is_hidden_at(const unsigned int mortar_edge, const double s, const unsigned int edge,
                      const double t);
    bool runs_along(const unsigned int mortar_edge, const unsigned int edge) const;

    /// What a walk is whose edge ends before the next vertex.
    static State end_before(const Walk &walk);
    State        go_to_vertex(Walk &walk, const unsigned int vertex, const double position);
    State        place_crossing(Walk &walk, const unsigned int edge, const double t, const double position,
                                const int low);
    State        add_crossing(Walk &walk, const unsigned int edge, const Incidence::Side &low,
                              const Incidence::Side &high);

    /// As Incidence, but a nonmortar vertex with a node lies on the mortar edge of that node and no other.
    Incidence::Side side(const unsigned int vertex, const unsigned int mortar_edge) const;

    /// The images of the nonmortar vertices without a node.
    class VertexImages;

    void map_nonmortar_vertices();
    /// What a nonmortar vertex without a node is mapped to.
    struct Image;

    unsigned int triangle_beside(const unsigned int vertex, const MappingNode &node) const;
    unsigned int any_triangle_at(const MappingNode &node) const;
    /// The triangle around a mortar vertex whose two edges there have the vertex between them, or none.
    unsigned int triangle_around(const unsigned int mortar_vertex, const unsigned int vertex) const;
    SurfacePoint image_in(const unsigned int vertex, const unsigned int triangle) const;
    Image        search_triangle(const unsigned int vertex);
    bool         lies_below(const unsigned int vertex, const unsigned int triangle) const;

    /// Whether another layer of the nonmortar surface lies nearer to a point of the mortar surface than
    /// `distance` along its normal: then what is there belongs to that one.
    bool is_hidden(const dealii::Point<3> &foot, const dealii::Tensor<1, 3> &normal, const double distance,
                   const double margin) const;

    /// Whether the mortar surface can lie over itself: it has several parts, or its normals do not lie in one
    /// half-space.
    bool may_lie_over_itself() const;

    /// Whether another layer of the mortar surface lies nearer to foot + eta normal, along that line, than
    /// the foot itself: then what is there belongs to that one.
    bool is_behind(const dealii::Point<3> &foot, const dealii::Tensor<1, 3> &normal, const double eta,
                   const double margin);

    const BoxTree &tree_of_mortar_triangles();

    Incidence             &incidence;
    const PartRegion      &region;
    const SurfaceTopology &nonmortar, &mortar;
    /// Mortar edges that may cross the region, mortar vertices whose image is needed, and those whose state
    /// this part tells.
    std::vector<bool> edge_is_needed, vertex_is_needed, vertex_is_in_share;
    bool              has_layers = false;
    /// The order in which mortar vertices, and edges from them, are visited.
    std::vector<unsigned int> mortar_order;
    /// For nodes where edges cross: the side of the mortar edge on which the lower end of the nonmortar edge
    /// lies.
    std::vector<signed char> low_side;
    /// Mortar edges that were not followed from end to end, and where they are known to come in or to leave
    /// over edges.
    std::vector<unsigned int>                       unfinished;
    std::set<std::pair<unsigned int, unsigned int>> border_crossings;
    std::unique_ptr<BoxTree>                        nonmortar_tree, mortar_tree;
  };
} // namespace Signorini

#endif
