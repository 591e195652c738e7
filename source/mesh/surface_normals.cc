// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_normals.h>

#include <map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The normals of shapes at the vertices of a surface. Neighbouring faces ask for the same ones: only at
    /// creases does the answer depend on the face.
    class ShapeNormals
    {
    public:
      ShapeNormals(const ContactSurface &surface, const SurfaceShapes &shapes)
        : surface(surface)
        , shapes(shapes)
        , known(surface.mesh.vertices.size())
      {
      }

      const BoundaryShape *shape_of(const ContactSurface::Face &face) const
      {
        const auto it = shapes.by_boundary.find(face.boundary);
        return shapes.are_used && it != shapes.by_boundary.end() ? it->second.get() : nullptr;
      }

      /// @param facing unit normal of the face at the vertex
      Vector3 operator()(const BoundaryShape &shape, const unsigned int vertex, const Vector3 &facing)
      {
        Known &last = known[vertex];
        if (last.shape != &shape || !(last.facing * facing > .9))
          last = {&shape, facing, shape.normal(surface.mesh.vertices[vertex], facing)};
        return last.normal;
      }

    private:
      struct Known
      {
        const BoundaryShape *shape = nullptr;
        Vector3              facing, normal;
      };

      const ContactSurface &surface;
      const SurfaceShapes  &shapes;
      std::vector<Known>    known;
    };

    Vector3 unit(const Vector3 &v)
    {
      const double length = v.norm();
      return length > 0. ? v / length : v;
    }

    /// Pure numbers.
    struct CreaseRule
    {
      /// Faces around a vertex whose normals differ by less than 40 degrees, or are linked by such ones, are
      /// one side of it. A chamfer (45 degrees) is a side of its own; on round surfaces it does not matter.
      double same_side = .766;
      /// Sides whose unit normals add up to less than this are opposite, and have no mean.
      double smallest_mean = .1;
    };

    /// The mean of the unit normals of the sides of a vertex, each of which has the mean of its faces: where
    /// the sides were weighted by their areas the normals along a crease would turn from vertex to vertex.
    /// @param faces normals around the vertex, weighted
    Vector3 mean_of_sides(const std::vector<Vector3> &faces)
    {
      DisjointSets                   sets = linked_normals(faces, CreaseRule().same_side);
      std::map<std::size_t, Vector3> sides;
      for (unsigned int i = 0; i < faces.size(); ++i)
        sides[sets.find(i)] += faces[i];
      Vector3 mean, sum;
      for (const auto &[set, side] : sides)
        {
          mean += unit(side);
          sum += side;
        }
      return mean.norm() > CreaseRule().smallest_mean ? mean : sum;
    }

    /// What faces give to the normals of their vertices.
    class VertexNormals
    {
    public:
      explicit VertexNormals(const std::size_t n_vertices)
        : sums(n_vertices)
        , first(n_vertices)
      {
      }

      void add(const unsigned int vertex, const Vector3 &weighted)
      {
        if (first[vertex].norm() == 0.)
          first[vertex] = unit(weighted);
        else if (weighted * first[vertex] < CreaseRule().same_side * weighted.norm())
          creased[vertex];
        sums[vertex] += weighted;
      }

      /// Those on creases want to see each face again.
      void add_again(const unsigned int vertex, const Vector3 &weighted)
      {
        if (const auto it = creased.find(vertex); it != creased.end() && weighted.norm() > 0.)
          it->second.push_back(weighted);
      }

      bool has_creases() const
      {
        return !creased.empty();
      }

      /// Unit normals; zero at vertices without faces.
      std::vector<Vector3> finish() const
      {
        std::vector<Vector3> normals = sums;
        for (const auto &[vertex, faces] : creased)
          normals[vertex] = mean_of_sides(faces);
        for (Vector3 &normal : normals)
          normal = unit(normal);
        return normals;
      }

    private:
      std::vector<Vector3>                         sums, first;
      std::map<unsigned int, std::vector<Vector3>> creased;
    };

    /// Hanging vertices get the mean of their parents; vertices without faces take after the hanging ones
    /// that depend on them.
    void complete_normals(const ContactSurface &surface, std::vector<Vector3> &normals,
                          const std::vector<bool> &has_shape)
    {
      std::vector<bool> is_without_faces;
      for (const Vector3 &normal : normals)
        is_without_faces.push_back(normal.norm() == 0.);
      for (std::size_t v = 0; v < normals.size(); ++v)
        if (!surface.hanging[v].empty() && !has_shape[v])
          {
            Vector3 mean;
            for (const auto &[parent, weight] : surface.hanging[v])
              mean += weight * normals[parent];
            if (mean.norm() > 0.)
              normals[v] = mean / mean.norm();
          }
      std::vector<Vector3> inherited(normals.size());
      for (std::size_t v = 0; v < normals.size(); ++v)
        for (const auto &[parent, weight] : surface.hanging[v])
          if (is_without_faces[parent])
            inherited[parent] += weight * normals[v];
      for (std::size_t v = 0; v < normals.size(); ++v)
        if (inherited[v].norm() > 0.)
          normals[v] = inherited[v] / inherited[v].norm();
    }
  } // namespace



  Vector3 area_vector(const ContactSurface &surface, const ContactSurface::Face &face)
  {
    // The fourth corner of a triangle is its first one.
    const auto &x = surface.mesh.vertices;
    const auto &c = face.corners;
    return .5 * cross_product_3d(x[c[2]] - x[c[0]], x[c[3]] - x[c[1]]);
  }



  Vector3 facet_normal(const ContactSurface &surface, const unsigned int triangle)
  {
    const auto   &t    = surface.mesh.triangles[triangle];
    const auto   &x    = surface.mesh.vertices;
    const Vector3 area = cross_product_3d(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    return area.norm() > 0. ? area / area.norm() : area;
  }



  Vector3 true_normal(const ContactSurface &surface, const unsigned int triangle, const unsigned int corner)
  {
    if (!surface.true_shape.has_offsets())
      return facet_normal(surface, triangle);
    const auto true_point = [&](const unsigned int toward) {
      // Part of the way to another corner: the offset is a cubic, the error of the direction that part of it.
      constexpr double      step    = 1e-3;
      std::array<double, 3> weights = {{0., 0., 0.}};
      weights[corner] += 1. - step;
      weights[toward] += step;
      Point<3> p;
      for (unsigned int i = 0; i < 3; ++i)
        p += Vector3(weights[i] * surface.mesh.vertices[surface.mesh.triangles[triangle][i]]);
      return p + surface.offset(triangle, weights);
    };
    const Point<3> x   = true_point(corner);
    const Vector3 area = cross_product_3d(true_point((corner + 1) % 3) - x, true_point((corner + 2) % 3) - x);
    return area.norm() > 0. ? area / area.norm() : area;
  }



  DisjointSets linked_normals(const std::vector<Vector3> &normals, const double cosine)
  {
    DisjointSets sets(normals.size());
    for (unsigned int i = 0; i < normals.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (normals[i] * normals[j] >= cosine * normals[i].norm() * normals[j].norm())
          sets.unite(i, j);
    return sets;
  }



  void set_normals(ContactSurface &surface, const SurfaceShapes &shapes,
                   const std::function<bool(unsigned int face, unsigned int vertex)> &counts)
  {
    ShapeNormals      shape_normals(surface, shapes);
    std::vector<bool> has_shape(surface.mesh.vertices.size(), false);
    const auto        for_corners = [&](const auto &add) {
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        {
          const ContactSurface::Face &face   = surface.faces[f];
          const Vector3               area   = area_vector(surface, face);
          const double                weight = area.norm();
          const BoundaryShape *const  shape  = shape_normals.shape_of(face);
          for (unsigned int i = 0; i < face.n_corners; ++i)
            {
              const unsigned int v = face.corners[i];
              if (counts && !counts(f, v))
                continue;
              has_shape[v] = has_shape[v] || (shape != nullptr && weight > 0.);
              add(v,
                  shape != nullptr && weight > 0. ? weight * shape_normals(*shape, v, area / weight) : area);
            }
        }
    };
    VertexNormals normals(surface.mesh.vertices.size());
    for_corners([&](const unsigned int vertex, const Vector3 &weighted) { normals.add(vertex, weighted); });
    if (normals.has_creases())
      for_corners(
          [&](const unsigned int vertex, const Vector3 &weighted) { normals.add_again(vertex, weighted); });
    surface.mesh.vertex_normals = normals.finish();
    complete_normals(surface, surface.mesh.vertex_normals, has_shape);
  }
} // namespace Signorini
