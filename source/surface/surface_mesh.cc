// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/surface_mesh.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  void SurfaceMesh::compute_vertex_normals()
  {
    vertex_normals.assign(vertices.size(), Tensor<1, 3>());
    for (const auto &t : triangles)
      {
        // Twice the area times the unit normal: the weighting by area comes for free.
        const Tensor<1, 3> normal =
            cross_product_3d(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
        for (const unsigned int v : t)
          vertex_normals[v] += normal;
      }
    for (Tensor<1, 3> &normal : vertex_normals)
      if (const double length = normal.norm(); length > 0.)
        normal /= length;
  }



  SurfaceTopology::SurfaceTopology(std::vector<std::array<unsigned int, 3>> triangle_list,
                                   const std::size_t                        n_vertices)
    : triangles(std::move(triangle_list))
    , triangle_edges(triangles.size())
    , fan_start(n_vertices + 1, 0)
    , fan(3 * triangles.size())
  {
    make_fans();
    make_edges();
  }



  SurfaceTopology::SurfaceTopology(const SurfaceTopology &whole, const SurfacePart &part,
                                   const Renumbering &kept_edges)
    : triangles(part.triangles.select(whole.triangles))
    , triangle_edges(part.triangles.select(whole.triangle_edges))
    , edges(kept_edges.select(whole.edges))
    , edge_triangles(kept_edges.select(whole.edge_triangles))
    , fan_start(part.vertices.kept().size() + 1, 0)
    , fan(3 * triangles.size())
    , n_conflicts(whole.n_conflicts)
  {
    const auto renumber = [](auto &list, const Renumbering &numbers) {
      for (auto &entry : list)
        for (unsigned int &i : entry)
          i = i == none ? none : numbers[i];
    };
    renumber(triangles, part.vertices);
    renumber(edges, part.vertices);
    renumber(triangle_edges, kept_edges);
    renumber(edge_triangles, part.triangles);
    make_fans();
  }



  Renumbering SurfaceTopology::edges_of(const Renumbering &some_triangles) const
  {
    std::vector<bool> is_kept(edges.size(), false);
    for (const unsigned int t : some_triangles.kept())
      for (const unsigned int edge : triangle_edges[t])
        is_kept[edge] = true;
    return Renumbering(is_kept);
  }



  void SurfaceTopology::make_fans()
  {
    for (const auto &triangle : triangles)
      for (const unsigned int v : triangle)
        ++fan_start[v + 1];
    std::partial_sum(fan_start.begin(), fan_start.end(), fan_start.begin());
    std::vector<unsigned int> next(fan_start.begin(), fan_start.end() - 1);
    for (unsigned int t = 0; t < triangles.size(); ++t)
      for (const unsigned int v : triangles[t])
        fan[next[v]++] = t;
  }



  unsigned int SurfaceTopology::find_edge(const unsigned int low, const unsigned int high,
                                          const unsigned int side, const std::size_t first)
  {
    bool used = false;
    for (std::size_t e = first; e < edges.size(); ++e)
      if (edges[e][1] == high)
        {
          if (edge_triangles[e][side] == none)
            return static_cast<unsigned int>(e);
          used = true;
        }
    n_conflicts += used;
    edges.push_back({{low, high}});
    edge_triangles.push_back({{none, none}});
    return static_cast<unsigned int>(edges.size() - 1);
  }



  void SurfaceTopology::make_edges()
  {
    const std::size_t n_vertices = fan_start.size() - 1;
    // Each edge is made at its lower vertex; the few edges there are searched one after the other.
    edges.reserve(3 * triangles.size() / 2 + n_vertices / 2);
    edge_triangles.reserve(edges.capacity());
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        const std::size_t first = edges.size();
        for (unsigned int k = fan_start[v]; k < fan_start[v + 1]; ++k)
          {
            const unsigned int t = fan[k];
            for (unsigned int i = 0; i < 3; ++i)
              {
                const unsigned int a = triangles[t][i], b = triangles[t][(i + 1) % 3];
                if (std::min(a, b) != v)
                  continue;
                const unsigned int side = a < b ? 0 : 1;
                const unsigned int e    = find_edge(v, std::max(a, b), side, first);
                edge_triangles[e][side] = t;
                triangle_edges[t][i]    = e;
              }
          }
      }
  }



  namespace
  {
    /// Two bits of zero behind each bit.
    std::uint64_t spread_bits(std::uint64_t x)
    {
      x = (x | x << 32) & 0x1f00000000ffffULL;
      x = (x | x << 16) & 0x1f0000ff0000ffULL;
      x = (x | x << 8) & 0x100f00f00f00f00fULL;
      x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
      return (x | x << 2) & 0x1249249249249249ULL;
    }
  } // namespace



  std::vector<unsigned int> spatial_order(const std::vector<Point<3>> &points)
  {
    if (points.empty())
      return {};
    Point<3> low = points[0], high = low;
    for (const Point<3> &p : points)
      for (unsigned int c = 0; c < 3; ++c)
        {
          low[c]  = std::min(low[c], p[c]);
          high[c] = std::max(high[c], p[c]);
        }
    const double                                        size = std::max(low.distance(high), 1e-300);
    std::vector<std::pair<std::uint64_t, unsigned int>> codes;
    codes.reserve(points.size());
    for (unsigned int v = 0; v < points.size(); ++v)
      {
        // The bits of the three coordinates in turn.
        std::uint64_t code = 0;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const double place = (points[v][c] - low[c]) / size;
            code |= spread_bits(place > 0. ? static_cast<std::uint64_t>(place * 0x1fffff) : 0) << c;
          }
        codes.emplace_back(code, v);
      }
    std::sort(codes.begin(), codes.end());
    std::vector<unsigned int> order;
    order.reserve(codes.size());
    for (const auto &code : codes)
      order.push_back(code.second);
    return order;
  }



  std::vector<unsigned int> spatial_order(const SurfaceMesh &mesh)
  {
    return spatial_order(mesh.vertices);
  }



  SurfacePoint SurfacePoint::at_vertex(const unsigned int vertex)
  {
    SurfacePoint p;
    p.on    = On::vertex;
    p.index = vertex;
    return p;
  }



  SurfacePoint SurfacePoint::on_edge(const unsigned int edge, const double parameter)
  {
    SurfacePoint p;
    p.on    = On::edge;
    p.index = edge;
    p.x[0]  = std::min(1., std::max(0., parameter));
    return p;
  }



  SurfacePoint SurfacePoint::in_triangle(const unsigned int triangle, const std::array<double, 3> &weights)
  {
    double sum = 0.;
    for (const double w : weights)
      sum += std::max(0., w);
    SurfacePoint p;
    p.on    = On::triangle;
    p.index = triangle;
    p.x     = {{std::max(0., weights[1]) / sum, std::max(0., weights[2]) / sum}};
    return p;
  }



  bool SurfacePoint::lies_in(const SurfaceTopology &topology, const unsigned int triangle) const
  {
    const auto contains = [&](const std::array<unsigned int, 3> &list) {
      return list[0] == index || list[1] == index || list[2] == index;
    };
    switch (on)
      {
        case On::triangle:
          return index == triangle;
        case On::edge:
          return contains(topology.triangle_edges[triangle]);
        case On::vertex:
          return contains(topology.triangles[triangle]);
        default:
          return false;
      }
  }



  std::array<double, 3> SurfacePoint::weights_in(const SurfaceTopology &topology,
                                                 const unsigned int     triangle) const
  {
    std::array<double, 3> w = {{0., 0., 0.}};
    if (on == On::triangle)
      w = {{std::max(0., 1. - x[0] - x[1]), x[0], x[1]}};
    else if (on == On::vertex)
      w[topology.local_corner(triangle, index)] = 1.;
    else
      {
        const unsigned int i = topology.local_edge(triangle, index), j = (i + 1) % 3;
        const bool         along = topology.triangles[triangle][i] == topology.edges[index][0];
        w[i]                     = along ? 1. - x[0] : x[0];
        w[j]                     = along ? x[0] : 1. - x[0];
      }
    return w;
  }
} // namespace Signorini
