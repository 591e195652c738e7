// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/mesh/triangulated_shape.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A cone with its apex, which opens along its axis.
    class ConeShape : public BoundaryShape
    {
    public:
      /// @param axis unit vector
      /// @param half_angle between axis and surface (radians)
      ConeShape(const Point<3> &apex, const Tensor<1, 3> &axis, const double half_angle)
        : apex(apex)
        , axis(axis)
        , cosine(std::cos(half_angle))
        , sine(std::sin(half_angle))
      {
      }

      Point<3> project(const Point<3> &p) const override
      {
        const Tensor<1, 3> d     = p - apex;
        const double       along = d * axis;
        const Tensor<1, 3> out   = d - along * axis;
        const double       r = out.norm(), way = along * cosine + r * sine;
        if (way <= 0.)
          return apex;
        return r > 0. ? apex + way * (cosine * axis + sine / r * out) : p;
      }

      Tensor<1, 3> normal(const Point<3> &p, const Tensor<1, 3> &facing) const override
      {
        const Tensor<1, 3> d   = p - apex;
        const Tensor<1, 3> out = d - (d * axis) * axis;
        if (!(out.norm() > 0.))
          return facing;
        const Tensor<1, 3> n = cosine / out.norm() * out - sine * axis;
        return n * facing < 0. ? -n : n;
      }

    private:
      const Point<3>     apex;
      const Tensor<1, 3> axis;
      const double       cosine, sine;
    };



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

      Tensor<1, 3> normal(const Point<3> &p, const Tensor<1, 3> &facing) const override
      {
        const Tensor<1, 3> d   = p - centre;
        const Tensor<1, 3> out = d - (d * axis) * axis;
        Tensor<1, 3>       n   = kind == plane ? axis : kind == sphere ? d : out;
        if (kind == torus && out.norm() > 0.)
          n = d - (radius / out.norm()) * out;
        const double length = n.norm();
        return length > 0. ? (n * facing < 0. ? -1. : 1.) / length * n : facing;
      }

    private:
      const Kind         kind;
      const Point<3>     centre;
      const Tensor<1, 3> axis;
      const double       radius, tube;
    };



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



  namespace
  {
    /// A direction of a text, of length 1, in its place.
    Tensor<1, 3> parse_direction(const std::string &text, const Placement &placement,
                                 const std::string &where)
    {
      const Tensor<1, 3> direction = placement.rotation * Tensor<1, 3>(parse_point(text, where));
      if (!(direction.norm() > 0.))
        throw InputError(where + ": the direction \"" + text + "\" has no length.");
      return direction / direction.norm();
    }

    /// @param pieces point, axis, radius at the point, half angle (degrees)
    BoundaryShapePointer parse_cone(const std::vector<std::string> &pieces, const Placement &placement,
                                    const std::string &where)
    {
      const Tensor<1, 3> axis   = parse_direction(pieces[1], placement, where);
      const double       radius = parse_number(pieces[2], where), degrees = parse_number(pieces[3], where);
      if (!(radius >= 0.))
        throw InputError(where + ": the radius \"" + pieces[2] + "\" of a cone must not be negative.");
      if (!(degrees > 0. && degrees < 90.))
        throw InputError(where + ": the half angle \"" + pieces[3] +
                         "\" of a cone must lie between 0 and 90 degrees.");
      const double half_angle = degrees * numbers::PI / 180.;
      return std::make_shared<ConeShape>(
          placement(parse_point(pieces[0], where)) - radius / std::tan(half_angle) * axis, axis, half_angle);
    }
  } // namespace



  BoundaryShapePointer make_boundary_shape(const std::string &text, const Placement &placement,
                                           const std::string &base_folder, const std::string &where)
  {
    const std::string usage =
        where + ": \"" + text +
        "\" should read \"sphere: centre, radius\", \"cylinder: point, axis, radius\", \"cone: point, axis, "
        "radius there, half angle\", \"torus: centre, axis, radius, radius of the tube\", \"plane: point, "
        "normal\" with points as (x, y, z), or \"file: NAME\".";
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
      throw InputError(usage);
    const std::string name = Utilities::trim(text.substr(0, colon)),
                      rest = Utilities::trim(text.substr(colon + 1));
    if (name == "file")
      return read_shape(rest, placement, base_folder, where);
    const auto pieces = split_list(rest, ',', where);
    if (name == "cone" && pieces.size() == 4)
      return parse_cone(pieces, placement, where);
    const std::map<std::string, std::pair<RoundShape::Kind, std::size_t>> kinds = {
        {"sphere", {RoundShape::sphere, 2}},
        {"cylinder", {RoundShape::cylinder, 3}},
        {"torus", {RoundShape::torus, 4}},
        {"plane", {RoundShape::plane, 2}}};
    const auto kind = kinds.find(name);
    if (kind == kinds.end() || pieces.size() != kind->second.second)
      throw InputError(usage);
    const bool         is_sphere = kind->second.first == RoundShape::sphere;
    const Tensor<1, 3> axis =
        is_sphere ? Tensor<1, 3>({0., 0., 1.}) : parse_direction(pieces[1], placement, where);
    double radii[2] = {1., 1.};
    for (std::size_t i = is_sphere ? 1 : 2, k = 0; i < pieces.size(); ++i, ++k)
      if (!((radii[k] = parse_number(pieces[i], where)) > 0.))
        throw InputError(where + ": the radius \"" + pieces[i] + "\" must be positive.");
    return std::make_shared<RoundShape>(kind->second.first, placement(parse_point(pieces[0], where)), axis,
                                        radii[0], radii[1]);
  }



  BoundaryShapePointer make_sphere_shape(const Point<3> &centre, const double radius)
  {
    AssertThrow(radius > 0., ExcMessage("The radius of a sphere must be positive."));
    return std::make_shared<RoundShape>(RoundShape::sphere, centre, Tensor<1, 3>({0., 0., 1.}), radius, 1.);
  }



  BoundaryShapePointer make_cylinder_shape(const Point<3> &point, const Tensor<1, 3> &axis,
                                           const double radius)
  {
    AssertThrow(radius > 0. && std::abs(axis.norm() - 1.) < 1e-10,
                ExcMessage("The radius of a cylinder must be positive, its axis a unit vector."));
    return std::make_shared<RoundShape>(RoundShape::cylinder, point, axis, radius, 1.);
  }



  BoundaryShapePointer make_plane_shape(const Point<3> &point, const Tensor<1, 3> &normal)
  {
    AssertThrow(std::abs(normal.norm() - 1.) < 1e-10,
                ExcMessage("The normal of a plane must be a unit vector."));
    return std::make_shared<RoundShape>(RoundShape::plane, point, normal, 1., 1.);
  }



  Point<3> project_onto(const std::vector<BoundaryShapePointer> &shapes, const Point<3> &p)
  {
    if (shapes.size() == 1)
      return shapes[0]->project(p);
    // Those that are exact come last: where patches over facets end beside them, a node on a plane of
    // symmetry must not leave it.
    std::vector<BoundaryShapePointer> ordered = shapes;
    std::stable_partition(ordered.begin(), ordered.end(),
                          [](const BoundaryShapePointer &shape) { return !shape->is_exact(); });
    // Alternating projections converge linearly to the edge, quickly where the shapes meet at a large angle.
    Point<3> x = p;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Point<3> old = x;
        for (const BoundaryShapePointer &shape : ordered)
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
