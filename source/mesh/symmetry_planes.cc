// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/symmetry_planes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    class SymmetryPlanes
    {
    public:
      SymmetryPlanes(const ContactSurface &surface, const std::vector<FixedDirections> &fixed,
                     const SymmetryPlaneRule &rule)
        : mesh(surface.mesh)
        , fixed(fixed)
        , rule(rule)
        , topology(mesh.triangles, mesh.vertices.size())
      {
      }

      /// The directions that symmetry planes take from the normal of a vertex.
      FixedDirections directions(const unsigned int vertex)
      {
        std::vector<Vector3> result;
        for (const Vector3 &n : candidates(vertex))
          if (ends_at_plane(vertex, n) && is_curved_across(vertex, n))
            result.push_back(n);
        return FixedDirections::span(result);
      }

      /// Whether border edges along which the direction n is prescribed meet at a vertex, all in the plane
      /// across n.
      bool ends_at_plane(const unsigned int vertex, const Vector3 &n) const
      {
        bool any = false, all = true;
        for_border_edges(vertex, [&](const unsigned int a, const unsigned int b) {
          if (!fixed[a].contains(n) || !fixed[b].contains(n))
            return;
          const Vector3 way = mesh.vertices[b] - mesh.vertices[a];
          all               = all && std::abs(way * n) <= rule.planarity * way.norm();
          any               = true;
        });
        return any && all;
      }

    private:
      /// Calls f with both ends of all border edges at a vertex.
      template <typename F>
      void for_border_edges(const unsigned int vertex, const F &f) const
      {
        for (unsigned int t = topology.fan_start[vertex]; t < topology.fan_start[vertex + 1]; ++t)
          for (const unsigned int edge : topology.triangle_edges[topology.fan[t]])
            if (const auto &[a, b] = topology.edges[edge];
                topology.is_border(edge) && (a == vertex || b == vertex))
              f(a, b);
      }

      /// Normals of planes that a vertex may lie in: what is fixed there, and where that is more than one
      /// direction that is no axis, those of its neighbours on the border.
      std::vector<Vector3> candidates(const unsigned int vertex) const
      {
        std::vector<Vector3> result = fixed[vertex].basis();
        if (fixed[vertex].n_oblique_directions() < 2)
          return result;
        result.clear();
        for_border_edges(vertex, [&](const unsigned int a, const unsigned int b) {
          const std::vector<Vector3> other = fixed[a == vertex ? b : a].basis();
          if (other.size() == 1 && fixed[vertex].contains(other[0]))
            result.push_back(other[0]);
        });
        return result;
      }

      /// Whether the facets around a vertex and those around their corners differ along n by as much as the
      /// normal of the vertex has of it. Where all of them touch the plane there is nothing to compare with:
      /// then whether they differ at all.
      bool is_curved_across(const unsigned int vertex, const Vector3 &n)
      {
        near.clear();
        for (unsigned int f = topology.fan_start[vertex]; f < topology.fan_start[vertex + 1]; ++f)
          for (const unsigned int corner : topology.triangles[topology.fan[f]])
            near.insert(near.end(), topology.fan.begin() + topology.fan_start[corner],
                        topology.fan.begin() + topology.fan_start[corner + 1]);
        const Tensor<1, 3> &normal = mesh.vertex_normals[vertex];
        double              least = 1., largest = -1.;
        bool                all_touch = true;
        for (const unsigned int t : near)
          {
            const auto        &x      = mesh.triangles[t];
            const Tensor<1, 3> area   = cross_product_3d(mesh.vertices[x[1]] - mesh.vertices[x[0]],
                                                         mesh.vertices[x[2]] - mesh.vertices[x[0]]);
            const double       length = area.norm();
            if (length == 0. || area * normal < rule.crease * length)
              continue;
            least     = std::min(least, area * n / length);
            largest   = std::max(largest, area * n / length);
            all_touch = all_touch && std::any_of(x.begin(), x.end(), [&](const unsigned int corner) {
                          const double distance = (mesh.vertices[corner] - mesh.vertices[vertex]) * n;
                          return distance * distance <= rule.planarity * rule.planarity * length;
                        });
          }
        return largest - least >= (all_touch ? rule.flatness : std::abs(normal * n));
      }

      const SurfaceMesh                  &mesh;
      const std::vector<FixedDirections> &fixed;
      const SymmetryPlaneRule            &rule;
      const SurfaceTopology               topology;
      std::vector<unsigned int>           near;
    };
  } // namespace



  namespace
  {
    /// What is prescribed at the vertices; at hanging ones what is at all of their parents.
    std::vector<FixedDirections> fixed_of_vertices(const ContactSurface &surface)
    {
      std::vector<FixedDirections> fixed = surface.vertex_fixed;
      for (std::size_t v = 0; v < fixed.size(); ++v)
        if (!surface.hanging[v].empty())
          {
            fixed[v] = all_fixed;
            for (const auto &parent : surface.hanging[v])
              fixed[v] = fixed[v].common(surface.vertex_fixed[parent.first]);
          }
      return fixed;
    }
  } // namespace



  void project_onto_symmetry_planes(ContactSurface &surface, const SymmetryPlaneRule &rule)
  {
    const std::vector<FixedDirections> fixed = fixed_of_vertices(surface);
    // Vertices without any free component carry no multiplier.
    const auto is_partly_fixed = [](const FixedDirections &f) { return f.any() && !f.all(); };
    if (std::none_of(fixed.begin(), fixed.end(), is_partly_fixed))
      return;

    SymmetryPlanes                                       planes(surface, fixed, rule);
    std::vector<std::pair<std::size_t, FixedDirections>> projected;
    std::vector<bool>                                    is_projected(fixed.size(), false);
    for (unsigned int v = 0; v < fixed.size(); ++v)
      if (surface.hanging[v].empty() && is_partly_fixed(fixed[v]))
        if (const FixedDirections directions = planes.directions(v); directions.any())
          projected.emplace_back(v, directions);
    for (const auto &[v, directions] : projected)
      {
        Tensor<1, 3>      &normal = surface.mesh.vertex_normals[v];
        const Tensor<1, 3> inside = project_free(directions, normal);
        if (const double length = inside.norm(); length > 0.)
          {
            normal          = inside / length;
            is_projected[v] = true;
          }
      }
    for (std::size_t v = 0; v < fixed.size(); ++v)
      if (std::any_of(surface.hanging[v].begin(), surface.hanging[v].end(),
                      [&](const auto &parent) { return is_projected[parent.first]; }))
        {
          Tensor<1, 3> mean;
          for (const auto &[parent, weight] : surface.hanging[v])
            mean += weight * surface.mesh.vertex_normals[parent];
          surface.mesh.vertex_normals[v] = mean / mean.norm();
        }
  }



  namespace
  {
    /// Calls f(vertex, what is prescribed there) for the vertices of a part that are free in some directions
    /// and prescribed in others.
    template <typename F>
    void for_guided_vertices(const ContactSurface &surface, const std::vector<bool> &is_part, const F &f)
    {
      for (std::size_t v = 0; v < is_part.size(); ++v)
        if (const FixedDirections &fixed = surface.vertex_fixed[v];
            is_part[v] && surface.hanging[v].empty() && fixed.any() && !fixed.all())
          f(v, fixed);
    }

    /// Collective. Directions across the normals that are prescribed at some of the vertices, at the ends of
    /// border edges in a plane across them (single nodes may be held anywhere). Where that is two directions,
    /// one of them is that of a plane which meets others alone, or both are axes.
    std::vector<Vector3> guided_directions(const ContactSurface &surface, const std::vector<bool> &is_part,
                                           const MPI_Comm communicator, const SymmetryPlaneRule &rule)
    {
      const std::vector<FixedDirections> all_fixed_directions = fixed_of_vertices(surface);
      const SymmetryPlanes               planes(surface, all_fixed_directions, rule);
      std::vector<Vector3>               result;
      const auto                         add = [&](const Vector3 &direction) {
        if (std::all_of(result.begin(), result.end(),
                                                [&](const Vector3 &other) { return std::abs(direction * other) < rule.same; }))
          result.push_back(direction);
      };
      const auto add_of_all_ranks = [&](const std::size_t n_directions, const auto &directions) {
        for_guided_vertices(surface, is_part, [&](const std::size_t v, const FixedDirections &fixed) {
          if (const std::vector<Vector3> basis = fixed.basis(); basis.size() == n_directions)
            for (const Vector3 &direction : directions(fixed, basis))
              if (std::abs(direction * surface.mesh.vertex_normals[v]) <= rule.across &&
                  planes.ends_at_plane(static_cast<unsigned int>(v), direction))
                add(direction);
        });
        const auto of_ranks = Utilities::MPI::all_gather(communicator, result);
        result.clear();
        for (const auto &mine : of_ranks)
          for (const Vector3 &direction : mine)
            add(direction);
      };
      add_of_all_ranks(1, [](const FixedDirections &, const std::vector<Vector3> &basis) { return basis; });
      const std::vector<Vector3> alone = result;
      add_of_all_ranks(2, [&](const FixedDirections &fixed, const std::vector<Vector3> &basis) {
        for (const Vector3 &one : alone)
          if (fixed.contains(one))
            return std::vector<Vector3>{cross_product_3d(cross_product_3d(basis[0], basis[1]), one)};
        return basis;
      });
      return result;
    }
  } // namespace



  unsigned int count_symmetry_planes(const ContactSurface &surface, const std::vector<bool> &is_part,
                                     const MPI_Comm communicator, const SymmetryPlaneRule &rule)
  {
    std::vector<Vector3> directions = guided_directions(surface, is_part, communicator, rule);
    // Guided along a curved boundary.
    if (directions.size() > dim)
      return 0;
    // Largest coordinates along them and against them: of the vertices that are held, and of all.
    const double        nowhere = std::numeric_limits<double>::lowest();
    std::vector<double> held(2 * dim, nowhere), all(2 * dim, nowhere);
    const auto          extend = [&](std::vector<double> &largest, const std::size_t k, const std::size_t v) {
      const double along = directions[k] * Vector3(surface.mesh.vertices[v]);
      largest[2 * k]     = std::max(largest[2 * k], along);
      largest[2 * k + 1] = std::max(largest[2 * k + 1], -along);
    };
    for_guided_vertices(surface, is_part, [&](const std::size_t v, const FixedDirections &fixed) {
      for (std::size_t k = 0; k < directions.size(); ++k)
        if (fixed.contains(directions[k]))
          extend(held, k, v);
    });
    for (std::size_t k = 0; k < directions.size(); ++k)
      for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
        extend(all, k, v);
    Utilities::MPI::max(held, communicator, held);
    Utilities::MPI::max(all, communicator, all);
    std::vector<Vector3> planes;
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (held[2 * k] + held[2 * k + 1] <= rule.planarity * (all[2 * k] + all[2 * k + 1]) &&
          std::all_of(planes.begin(), planes.end(), [&](const Vector3 &other) {
            return std::abs(directions[k] * other) <= rule.right_angle;
          }))
        planes.push_back(directions[k]);
    return static_cast<unsigned int>(planes.size());
  }
} // namespace Signorini
