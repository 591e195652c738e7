// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/surface/box_tree.h>
#include <signorini/surface/normal_projection.h>

#include <deal.II/base/utilities.h>

#include <filesystem>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Sphere, cylinder, torus or plane.
    class RoundShape : public BoundaryShape
    {
    public:
      enum Kind
      {
        sphere,
        cylinder,
        torus,
        plane
      };

      RoundShape(const Kind kind, const Point<3> &centre, const Tensor<1, 3> &axis, const double radius,
                 const double tube)
        : kind(kind)
        , centre(centre)
        , axis(axis)
        , radius(radius)
        , tube(tube)
      {
      }

      Point<3> project(const Point<3> &p) const override
      {
        const Tensor<1, 3> d     = p - centre;
        const double       along = d * axis;
        const Tensor<1, 3> out   = d - along * axis;
        switch (kind)
          {
            case plane:
              return p - along * axis;
            case sphere:
              return d.norm() > 0. ? centre + (radius / d.norm()) * d : p;
            case cylinder:
              return out.norm() > 0. ? centre + along * axis + (radius / out.norm()) * out : p;
            case torus:
              break;
          }
        if (!(out.norm() > 0.))
          return p;
        const Point<3>     circle = centre + (radius / out.norm()) * out;
        const Tensor<1, 3> way    = p - circle;
        return way.norm() > 0. ? circle + (tube / way.norm()) * way : p;
      }

    private:
      const Kind         kind;
      const Point<3>     centre;
      const Tensor<1, 3> axis;
      const double       radius, tube;
    };



    /// The point of a triangle nearest to p (Ericson: Real-Time Collision Detection, 5.1.5).
    Point<3> nearest_in_triangle(const std::array<Point<3>, 3> &x, const Point<3> &p)
    {
      const Tensor<1, 3> ab = x[1] - x[0], ac = x[2] - x[0], ap = p - x[0], bp = p - x[1], cp = p - x[2];
      const double       d1 = ab * ap, d2 = ac * ap, d3 = ab * bp, d4 = ac * bp, d5 = ab * cp, d6 = ac * cp;
      if (d1 <= 0. && d2 <= 0.)
        return x[0];
      if (d3 >= 0. && d4 <= d3)
        return x[1];
      if (d6 >= 0. && d5 <= d6)
        return x[2];
      const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
      if (vc <= 0. && d1 >= 0. && d3 <= 0.)
        return x[0] + (d1 / (d1 - d3)) * ab;
      if (vb <= 0. && d2 >= 0. && d6 <= 0.)
        return x[0] + (d2 / (d2 - d6)) * ac;
      if (va <= 0. && d4 - d3 >= 0. && d5 - d6 >= 0.)
        return x[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (x[2] - x[1]);
      const double sum = va + vb + vc;
      return x[0] + (vb / sum) * ab + (vc / sum) * ac;
    }



    std::vector<BoxTree::Box> boxes_of(const SurfaceMesh &mesh)
    {
      std::vector<BoxTree::Box> boxes;
      for (const auto &t : mesh.triangles)
        {
          boxes.push_back({mesh.vertices[t[0]], mesh.vertices[t[0]]});
          boxes.back().include(mesh.vertices[t[1]]);
          boxes.back().include(mesh.vertices[t[2]]);
        }
      return boxes;
    }



    /// A triangulated surface. Points come from it along its continuous normals, as in the contact mapping
    /// (system (9) of the paper), so that neighbours stay neighbours; where no normal meets the point, the
    /// nearest point counts.
    class TriangulatedShape : public BoundaryShape
    {
    public:
      TriangulatedShape(SurfaceMesh surface, std::string remark)
        : mesh(std::move(surface))
        , tree(boxes_of(mesh))
        , remark(std::move(remark))
      {
      }

      Point<3> project(const Point<3> &p) const override
      {
        std::vector<unsigned int> found;
        Point<3>                  best;
        double                    distance = std::numeric_limits<double>::max();
        // Boxes come nearest first or not: ask for more until the nearest point cannot improve.
        for (unsigned int n = 16;; n *= 4)
          {
            tree.find_nearest(found, p, n);
            double farthest = 0.;
            for (const unsigned int t : found)
              {
                const auto     x    = corners(t);
                const Point<3> near = nearest_in_triangle(x, p);
                farthest            = std::max(farthest, box_distance(x, p));
                if (p.distance(near) < distance)
                  {
                    distance = p.distance(near);
                    best     = near;
                  }
              }
            if (distance <= farthest || found.size() < n)
              break;
          }
        double least = 2. * distance + 1e-300;
        for (const unsigned int t : found)
          {
            const auto                 &v = mesh.triangles[t];
            std::array<double, 3>       weights;
            double                      eta;
            std::array<Tensor<1, 3>, 3> normals = {
                {mesh.vertex_normals[v[0]], mesh.vertex_normals[v[1]], mesh.vertex_normals[v[2]]}};
            const auto x = corners(t);
            if (!NormalProjection::inverse_project(weights, eta, p, x, normals) ||
                *std::min_element(weights.begin(), weights.end()) < -1e-10)
              continue;
            Point<3> foot;
            for (unsigned int i = 0; i < 3; ++i)
              foot += weights[i] * x[i];
            if (p.distance(foot) < least)
              {
                least = p.distance(foot);
                best  = foot;
              }
          }
        return best;
      }

      std::string note() const override
      {
        return remark;
      }

    private:
      std::array<Point<3>, 3> corners(const unsigned int t) const
      {
        const auto &v = mesh.triangles[t];
        return {{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
      }

      static double box_distance(const std::array<Point<3>, 3> &x, const Point<3> &p)
      {
        Tensor<1, 3> way;
        for (unsigned int c = 0; c < 3; ++c)
          way[c] = std::max({std::min({x[0][c], x[1][c], x[2][c]}) - p[c],
                             p[c] - std::max({x[0][c], x[1][c], x[2][c]}), 0.});
        return way.norm();
      }

      const SurfaceMesh mesh;
      const BoxTree     tree;
      const std::string remark;
    };



    double number_in(const std::string &text, const std::string &where)
    {
      return Expression(text, where)(Point<3>());
    }

    Point<3> point_in(const std::string &text, const std::string &where)
    {
      const auto entries = split_vector(text, where);
      return Point<3>(number_in(entries[0], where), number_in(entries[1], where),
                      number_in(entries[2], where));
    }

    BoundaryShapePointer read_shape(const std::string &name, const Placement &placement,
                                    const std::string &base_folder, const std::string &where)
    {
      const std::filesystem::path path(name);
      const std::string           file =
          path.is_absolute() ? name : (std::filesystem::path(base_folder) / path).string();
      SurfaceMesh mesh;
      try
        {
          mesh = read_surface(file);
        }
      catch (const InputError &e)
        {
          throw InputError(where + ": " + e.what());
        }
      const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
      if (topology.n_conflicts > 0)
        throw InputError(where + ": surface " + file +
                         " is not a manifold: " + std::to_string(topology.n_conflicts) +
                         " triangles are the third on an edge or turned against their neighbours. Mend it.");
      unsigned int n_border = 0;
      for (unsigned int e = 0; e < topology.edges.size(); ++e)
        n_border += topology.is_border(e);
      for (Point<3> &v : mesh.vertices)
        v = placement(v);
      for (Tensor<1, 3> &n : mesh.vertex_normals)
        n = placement.rotation * n;
      return std::make_shared<TriangulatedShape>(
          std::move(mesh), n_border == 0
                               ? ""
                               : where + ": surface " + file + " is open (" + std::to_string(n_border) +
                                     " border edges); nodes beyond its border move onto the border.");
    }
  } // namespace



  BoundaryShapePointer make_boundary_shape(const std::string &text, const Placement &placement,
                                           const std::string &base_folder, const std::string &where)
  {
    const std::string usage =
        where + ": \"" + text +
        "\" should read \"sphere: centre, radius\", \"cylinder: point, axis, radius\", \"torus: centre, "
        "axis, "
        "radius, radius of the tube\", \"plane: point, normal\" with points as (x, y, z), or \"file: NAME\".";
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
      throw InputError(usage);
    const std::string name = Utilities::trim(text.substr(0, colon)),
                      rest = Utilities::trim(text.substr(colon + 1));
    if (name == "file")
      return read_shape(rest, placement, base_folder, where);
    const auto pieces = split_list(rest, ',', where);
    const std::map<std::string, std::pair<RoundShape::Kind, std::size_t>> kinds = {
        {"sphere", {RoundShape::sphere, 2}},
        {"cylinder", {RoundShape::cylinder, 3}},
        {"torus", {RoundShape::torus, 4}},
        {"plane", {RoundShape::plane, 2}}};
    const auto kind = kinds.find(name);
    if (kind == kinds.end() || pieces.size() != kind->second.second)
      throw InputError(usage);
    const bool   is_sphere = kind->second.first == RoundShape::sphere;
    Tensor<1, 3> axis({0., 0., 1.});
    double       radii[2] = {1., 1.};
    if (!is_sphere)
      {
        axis = placement.rotation * Tensor<1, 3>(point_in(pieces[1], where));
        if (!(axis.norm() > 0.))
          throw InputError(where + ": the direction \"" + pieces[1] + "\" has no length.");
        axis /= axis.norm();
      }
    for (std::size_t i = is_sphere ? 1 : 2, k = 0; i < pieces.size(); ++i, ++k)
      if (!((radii[k] = number_in(pieces[i], where)) > 0.))
        throw InputError(where + ": the radius \"" + pieces[i] + "\" must be positive.");
    return std::make_shared<RoundShape>(kind->second.first, placement(point_in(pieces[0], where)), axis,
                                        radii[0], radii[1]);
  }



  BoundaryShapePointer make_round_shape(const bool is_sphere, const double radius, const Placement &placement)
  {
    return std::make_shared<RoundShape>(is_sphere ? RoundShape::sphere : RoundShape::cylinder,
                                        placement(Point<3>()),
                                        placement.rotation * Tensor<1, 3>({0., 0., 1.}), radius, 1.);
  }



  Point<3> project_onto(const std::vector<BoundaryShapePointer> &shapes, const Point<3> &p)
  {
    if (shapes.size() == 1)
      return shapes[0]->project(p);
    // Alternating projections converge linearly to the edge, quickly where the shapes meet at a large angle.
    Point<3> x = p;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Point<3> old = x;
        for (const BoundaryShapePointer &shape : shapes)
          x = shape->project(x);
        if (x.distance(old) <= 1e-14 * x.distance(p))
          break;
      }
    return x;
  }



  Point<3> ShapeManifold::get_new_point(const ArrayView<const Point<3>> &surrounding,
                                        const ArrayView<const double>   &weights) const
  {
    Point<3> mean;
    for (unsigned int i = 0; i < surrounding.size(); ++i)
      mean += weights[i] * surrounding[i];
    return project_onto(shapes, mean);
  }
} // namespace Signorini
