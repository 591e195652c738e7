// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The images of the nonmortar vertices.

#include "plane_graph_walk.h"

#include <signorini/surface/box_tree.h>
#include <signorini/surface/normal_projection.h>

#include <queue>

namespace Signorini
{
  using namespace dealii;
  using On = SurfacePoint::On;

  namespace
  {
    std::array<Tensor<1, 3>, 3> normals_of(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      const auto &t = mesh.triangles[triangle];
      return {{mesh.vertex_normals[t[0]], mesh.vertex_normals[t[1]], mesh.vertex_normals[t[2]]}};
    }
  } // namespace



  unsigned int PlaneGraph::triangle_beside(const unsigned int vertex, const MappingNode &node) const
  {
    const SurfacePoint &place = node.mortar;
    if (place.on == On::triangle)
      return place.index;
    if (place.on == On::edge)
      {
        const auto index = static_cast<std::size_t>(&node - nodes.data());
        if (node.nonmortar.on == On::edge && low_side[index] != 0)
          {
            const bool is_low = nonmortar.edges[node.nonmortar.index][0] == vertex;
            return mortar.edge_triangles[place.index][(low_side[index] > 0) == is_low ? 1 : 0];
          }
        // Left for the nonmortar viewer is right for the mortar viewer.
        const bool left = incidence.of_nonmortar_vertex(vertex, place.index).distance > 0.;
        return mortar.edge_triangles[place.index][left ? 1 : 0];
      }
    return triangle_around(place.index, vertex);
  }



  unsigned int PlaneGraph::triangle_around(const unsigned int mortar_vertex, const unsigned int vertex) const
  {
    for (unsigned int k = mortar.fan_start[mortar_vertex]; k < mortar.fan_start[mortar_vertex + 1]; ++k)
      {
        const unsigned int t = mortar.fan[k], corner = mortar.local_corner(t, mortar_vertex);
        bool               between = true;
        for (const unsigned int i : {corner, (corner + 2) % 3})
          {
            const unsigned int edge  = mortar.triangle_edges[t][i];
            const bool         along = mortar.triangles[t][i] == mortar.edges[edge][0];
            const double       d     = incidence.of_nonmortar_vertex(vertex, edge).distance;
            between                  = between && (along ? -d : d) > 0.;
          }
        if (between)
          return t;
      }
    return none;
  }



  // The image is spread as far as no node separates vertices. What of the surface turns away from the mortar
  // side is not separated by nodes from what faces it.
  struct PlaneGraph::Image
  {
    /// A mortar triangle, or none.
    unsigned int triangle = none;
    /// The mortar triangle that this was decided at.
    unsigned int decided_at = none;
    /// Over which edges it spreads: those beside which triangles face that one, or those beside which none
    /// does. `hidden`: nearer triangles hide it; that is no image, and none that spreads.
    enum class Spreading
    {
      where_faced,
      where_turned_away,
      hidden
    } spreading = Spreading::where_faced;
  };



  PlaneGraph::Image PlaneGraph::search_triangle(const unsigned int vertex)
  {
    std::vector<unsigned int> candidates;
    tree_of_mortar_triangles().find_nearest(candidates, incidence.nonmortar.vertices[vertex], 16);
    unsigned int best      = none;
    bool         faces_any = false;
    double       nearest   = std::numeric_limits<double>::max();
    Point<3>     foot;
    Tensor<1, 3> normal;
    for (const unsigned int t : candidates)
      {
        std::array<double, 3> w;
        double                eta;
        bool                  faces = false;
        for (unsigned int k = nonmortar.fan_start[vertex]; k < nonmortar.fan_start[vertex + 1]; ++k)
          faces = faces || incidence.triangles_face(nonmortar.fan[k], t);
        faces_any = faces_any || faces;
        if (faces &&
            NormalProjection::inverse_project(w, eta, incidence.nonmortar.vertices[vertex],
                                              corners_of(incidence.mortar, t),
                                              normals_of(incidence.mortar, t)) &&
            *std::min_element(w.begin(), w.end()) >= 0. && std::abs(eta) < nearest)
          {
            nearest = std::abs(eta);
            best    = t;
            foot    = Point<3>();
            normal  = Tensor<1, 3>();
            for (unsigned int i = 0; i < 3; ++i)
              {
                foot += w[i] * incidence.mortar.vertices[mortar.triangles[t][i]];
                normal += w[i] * incidence.mortar.vertex_normals[mortar.triangles[t][i]];
              }
          }
      }
    const auto  &any  = nonmortar.triangles[nonmortar.fan[nonmortar.fan_start[vertex]]];
    const double size = incidence.nonmortar.vertices[any[0]].distance(incidence.nonmortar.vertices[any[1]]);
    if (best != none && is_hidden(foot, normal, nearest, Incidence::near_end * size))
      return {none, best, Image::Spreading::hidden};
    if (best == none && !candidates.empty())
      return {none, candidates[0],
              faces_any ? Image::Spreading::where_faced : Image::Spreading::where_turned_away};
    return {best, best};
  }



  unsigned int PlaneGraph::any_triangle_at(const MappingNode &node) const
  {
    const SurfacePoint &place = node.mortar;
    if (place.on == On::triangle)
      return place.index;
    if (place.on == On::edge)
      return std::min(mortar.edge_triangles[place.index][0], mortar.edge_triangles[place.index][1]);
    return mortar.fan[mortar.fan_start[place.index]];
  }



  bool PlaneGraph::lies_below(const unsigned int vertex, const unsigned int triangle) const
  {
    std::array<double, 3> w;
    double                eta;
    return NormalProjection::inverse_project(w, eta, incidence.nonmortar.vertices[vertex],
                                             corners_of(incidence.mortar, triangle),
                                             normals_of(incidence.mortar, triangle)) &&
           *std::min_element(w.begin(), w.end()) >= -Incidence::near_end;
  }



  SurfacePoint PlaneGraph::image_in(const unsigned int vertex, const unsigned int triangle) const
  {
    std::array<double, 3> w;
    double                eta;
    if (!NormalProjection::inverse_project(w, eta, incidence.nonmortar.vertices[vertex],
                                           corners_of(incidence.mortar, triangle),
                                           normals_of(incidence.mortar, triangle)) ||
        *std::max_element(w.begin(), w.end()) <= 0.)
      w = {{1. / 3., 1. / 3., 1. / 3.}};
    return SurfacePoint::in_triangle(triangle, w);
  }



  /// Image triangles of the vertices without a node, each spread as far as no node separates them.
  class PlaneGraph::VertexImages
  {
  public:
    explicit VertexImages(const PlaneGraph &graph)
      : graph(graph)
      , nonmortar(graph.nonmortar)
      , image(graph.nonmortar_vertex_node.size())
      , is_known(image.size(), false)
    {
    }

    /// Beside the first node on an edge of the vertex, else beside a node at the other end of an edge.
    void begin_at_nodes()
    {
      for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
        if (graph.edge_start[e] < graph.edge_start[e + 1] && is_complete(e))
          {
            const auto [low, high] = nonmortar.edges[e];
            set_beside(low, graph.edge_nodes[graph.edge_start[e]]);
            set_beside(high, graph.edge_nodes[graph.edge_start[e + 1] - 1]);
          }
      for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
        if (is_empty(e))
          for (unsigned int i = 0; i < 2; ++i)
            set_beside(nonmortar.edges[e][i], graph.nonmortar_vertex_node[nonmortar.edges[e][1 - i]]);
      for (unsigned int v = 0; v < image.size(); ++v)
        if (graph.nonmortar_vertex_node[v] == none && is_known[v])
          front.push(v);
      spread([](const unsigned int, const unsigned int) { return true; });
    }

    /// Whether the image of a vertex is still to be searched.
    bool is_open(const unsigned int v) const
    {
      return graph.nonmortar_vertex_node[v] == none && !is_known[v] && graph.region.contains(v);
    }

    /// What was found. It is the image of the others that lie below it. What is hidden by nearer triangles
    /// stays open: on the rim of what faces the mortar side these may be its own, and give it theirs.
    void set(const unsigned int v, const Image &found)
    {
      if (found.spreading == Image::Spreading::hidden)
        return;
      image[v]    = found;
      is_known[v] = true;
      front.push(v);
      spread([&](const unsigned int other, const unsigned int below) {
        return below == none || graph.lies_below(other, below);
      });
    }

    /// The image triangle, or none.
    unsigned int operator[](const unsigned int v) const
    {
      return image[v].triangle;
    }

  private:
    /// All nodes are known only on edges in the region.
    bool is_complete(const unsigned int e) const
    {
      return graph.region.contains(nonmortar.edges[e][0], nonmortar.edges[e][1]);
    }

    bool is_empty(const unsigned int e) const
    {
      return graph.edge_start[e] == graph.edge_start[e + 1] && is_complete(e);
    }

    void set_beside(const unsigned int v, const unsigned int node)
    {
      if (node == none || !is_open(v))
        return;
      image[v]    = {graph.triangle_beside(v, graph.nodes[node]), graph.any_triangle_at(graph.nodes[node])};
      is_known[v] = true;
    }

    /// Whether an image spreads over a nonmortar edge.
    bool spreads_over(const Image &what, const unsigned int e) const
    {
      const auto &beside = nonmortar.edge_triangles[e];
      const bool  faces  = std::any_of(beside.begin(), beside.end(), [&](const unsigned int t) {
        return t != none && graph.incidence.triangles_face(t, what.decided_at);
      });
      return faces == (what.spreading == Image::Spreading::where_faced);
    }

    /// Whether an image may be that of a vertex: a vertex on the rim of what turns away has one of its own.
    bool may_have(const unsigned int v, const Image &what) const
    {
      return what.spreading != Image::Spreading::where_turned_away ||
             std::none_of(nonmortar.fan.begin() + nonmortar.fan_start[v],
                          nonmortar.fan.begin() + nonmortar.fan_start[v + 1], [&](const unsigned int t) {
                            return graph.incidence.triangles_face(t, what.decided_at);
                          });
    }

    /// What no node separates has the same image triangle.
    /// @param takes whether a vertex takes a triangle
    template <typename Takes>
    void spread(const Takes &takes)
    {
      for (; !front.empty(); front.pop())
        {
          const unsigned int v = front.front();
          for (unsigned int k = nonmortar.fan_start[v]; k < nonmortar.fan_start[v + 1]; ++k)
            {
              const unsigned int t = nonmortar.fan[k], i = nonmortar.local_corner(t, v);
              for (const unsigned int j : {i, (i + 2) % 3})
                {
                  const unsigned int e     = nonmortar.triangle_edges[t][j];
                  const unsigned int other = nonmortar.edges[e][nonmortar.edges[e][0] == v ? 1 : 0];
                  if (is_empty(e) && is_open(other) && spreads_over(image[v], e) &&
                      may_have(other, image[v]) && takes(other, image[v].triangle))
                    {
                      image[other]    = image[v];
                      is_known[other] = true;
                      front.push(other);
                    }
                }
            }
        }
    }

    const PlaneGraph        &graph;
    const SurfaceTopology   &nonmortar;
    std::vector<Image>       image;
    std::vector<bool>        is_known;
    std::queue<unsigned int> front;
  };



  void PlaneGraph::map_nonmortar_vertices()
  {
    const std::size_t n = nonmortar_vertex_node.size();
    VertexImages      images(*this);
    images.begin_at_nodes();
    for (unsigned int v = 0; v < n; ++v)
      if (images.is_open(v) && nonmortar.fan_start[v] < nonmortar.fan_start[v + 1])
        images.set(v, search_triangle(v));
    for (unsigned int v = 0; v < n; ++v)
      if (nonmortar_vertex_node[v] == none && images[v] != none)
        {
          nonmortar_vertex_node[v] = static_cast<unsigned int>(nodes.size());
          nodes.push_back({SurfacePoint::at_vertex(v), image_in(v, images[v])});
        }
  }
} // namespace Signorini
