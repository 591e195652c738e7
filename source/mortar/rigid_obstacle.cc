// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/expression.h>
#include <signorini/mortar/rigid_obstacle.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The root of a t^2 + 2 b t + c where it falls, of smaller rounding error.
    bool falling_root(double &t, const double a, const double b, const double c)
    {
      const double discriminant = b * b - a * c;
      if (!(discriminant >= 0.))
        return false;
      // At the root a t + b = -sqrt(discriminant) < 0.
      const double root = std::sqrt(discriminant);
      if (b > 0.)
        {
          // t = -(b + root) / a
          if (a == 0.)
            return false;
          t = -(b + root) / a;
        }
      else
        {
          if (root - b == 0.)
            return false;
          t = c / (root - b);
        }
      return std::isfinite(t);
    }
  } // namespace



  RigidObstacle::RigidObstacle(const Kind kind, const std::string &name, const Point<3> &point,
                               const Vector3 &axis, const double radius, const bool is_hollow)
    : kind(kind)
    , text(name)
    , point(point)
    , radius(radius)
    , sign(is_hollow ? -1. : 1.)
  {
    if ((kind == Kind::plane || kind == Kind::cylinder || kind == Kind::paraboloid) && !(axis.norm() > 0.))
      throw InputError(name + ": the direction has no length.");
    if (kind == Kind::paraboloid ? radius == 0. : !(radius > 0.))
      throw InputError(name + ": the radius should be " +
                       (kind == Kind::paraboloid ? "different from 0." : "positive."));
    this->axis = axis.norm() > 0. ? Vector3(axis / axis.norm()) : axis;
  }



  RigidObstacle RigidObstacle::plane(const Point<3> &point, const Vector3 &normal)
  {
    return RigidObstacle(Kind::plane, "plane", point, normal, 1., false);
  }



  RigidObstacle RigidObstacle::sphere(const Point<3> &centre, const double radius, const bool is_hollow)
  {
    return RigidObstacle(Kind::sphere, "sphere", centre, Vector3(), radius, is_hollow);
  }



  RigidObstacle RigidObstacle::cylinder(const Point<3> &point, const Vector3 &axis, const double radius,
                                        const bool is_hollow)
  {
    return RigidObstacle(Kind::cylinder, "cylinder", point, axis, radius, is_hollow);
  }



  RigidObstacle RigidObstacle::paraboloid(const Point<3> &apex, const Vector3 &axis, const double radius)
  {
    return RigidObstacle(Kind::paraboloid, "paraboloid", apex, axis, radius, false);
  }



  RigidObstacle RigidObstacle::level_set(const ScalarField &function)
  {
    RigidObstacle result(Kind::function, "function", Point<3>(), Vector3(), 1., false);
    result.function = function;
    return result;
  }



  RigidObstacle RigidObstacle::parse(const std::string &description, const std::string &where)
  {
    const std::size_t colon     = description.find(':');
    std::string       name      = Utilities::trim(description.substr(0, colon));
    const std::string rest      = colon == std::string::npos ? "" : description.substr(colon + 1);
    const std::string hollow    = "hollow ";
    const bool        is_hollow = name.compare(0, hollow.size(), hollow) == 0;
    if (is_hollow)
      name = Utilities::trim(name.substr(hollow.size()));
    // Number of entries; whether it can be hollow.
    const std::map<std::string, std::pair<std::size_t, bool>> kinds = {
        {"plane", {2, false}}, {"sphere", {2, true}}, {"cylinder", {3, true}}, {"paraboloid", {3, false}}};
    const auto kind   = kinds.find(name);
    const bool is_set = name == "function" && !is_hollow && colon != std::string::npos;
    const auto pieces = is_set ? std::vector<std::string>() : split_list(rest, ',', where);
    if (!is_set &&
        (kind == kinds.end() || pieces.size() != kind->second.first || (is_hollow && !kind->second.second)))
      throw InputError(
          where + ": \"" + description +
          "\" should read \"plane: point, normal\", \"sphere: centre, radius\", \"cylinder: point, axis, "
          "radius\", \"paraboloid: apex, axis, radius\" or \"function: f(x,y,z)\", with points as (x, y, "
          "z).");
    const auto make = [&]() {
      if (is_set)
        return level_set(Expression(rest, where));
      const Point<3> at = parse_point(pieces[0], where);
      if (name == "plane")
        return plane(at, parse_point(pieces[1], where));
      const double radius = parse_number(pieces.back(), where);
      if (name == "sphere")
        return sphere(at, radius, is_hollow);
      const Vector3 axis = parse_point(pieces[1], where);
      return name == "cylinder" ? cylinder(at, axis, radius, is_hollow) : paraboloid(at, axis, radius);
    };
    try
      {
        RigidObstacle result = make();
        result.text          = description;
        return result;
      }
    catch (const InputError &e)
      {
        const std::string text = e.what();
        throw InputError(text.compare(0, where.size(), where) == 0 ? text : where + ": " + text);
      }
  }



  bool RigidObstacle::gap(double &distance, const Point<3> &x, const Vector3 &n, const double size) const
  {
    const Vector3 d      = x - point;
    const auto    across = [&](const Vector3 &v) -> Vector3 { return v - (v * axis) * axis; };
    switch (kind)
      {
        case Kind::plane:
          distance = -(d * axis) / (n * axis);
          return n * axis < 0. && std::isfinite(distance);
        case Kind::sphere:
          return falling_root(distance, sign, sign * (d * n), sign * (d * d - radius * radius));
        case Kind::cylinder:
          {
            const Vector3 e = across(d), m = across(n);
            return falling_root(distance, sign * (m * m), sign * (e * m), sign * (e * e - radius * radius));
          }
        case Kind::paraboloid:
          {
            const Vector3 e = across(d), m = across(n);
            const double  s = .5 / radius;
            return falling_root(distance, s * (m * m), s * (e * m) + .5 * (n * axis), s * (e * e) + d * axis);
          }
        default:
          return function_gap(distance, x, n, size);
      }
  }



  Vector3 RigidObstacle::gradient(const Point<3> &y, const double size) const
  {
    const Vector3 d      = y - point;
    const Vector3 across = d - (d * axis) * axis;
    switch (kind)
      {
        case Kind::plane:
          return axis;
        case Kind::sphere:
          return sign * d;
        case Kind::cylinder:
          return sign * across;
        case Kind::paraboloid:
          return axis + across / radius;
        default:
          {
            const double h = 1e-6 * size;
            Vector3      result;
            for (unsigned int c = 0; c < dim; ++c)
              {
                Vector3 step;
                step[c]   = h;
                result[c] = function(y + step) - function(y - step);
              }
            return result;
          }
      }
  }



  bool RigidObstacle::is_faced(const Point<3> &y, const Vector3 &n, const double size) const
  {
    // The gap along a normal grows like 1 / cosine; the weighted gaps of nodes beside faces across which it
    // grows many times over are negative by multiples of the size of the body. Vertices of a cube that stands
    // on a plane have .58.
    const Vector3 outward = gradient(y, size);
    return n * outward < touching_cosine * outward.norm();
  }



  bool RigidObstacle::contact_normal(Vector3 &normal, double &distance, const Point<3> &x, const Vector3 &n,
                                     const double size) const
  {
    if (!gap(distance, x, n, size) || !is_faced(x + distance * n, n, size))
      return false;
    const Vector3 outward = gradient(x + distance * n, size);
    normal                = -outward / outward.norm();
    double along;
    return gap(along, x, normal, size);
  }



  // Newton's method along the line, with a difference quotient.
  bool RigidObstacle::function_gap(double &distance, const Point<3> &x, const Vector3 &n,
                                   const double size) const
  {
    const double h = 1e-6 * size;
    distance       = 0.;
    for (unsigned int i = 0; i < 50; ++i)
      {
        const Point<3> y     = x + distance * n;
        const double   value = function(y), slope = (function(y + h * n) - function(y - h * n)) / (2. * h);
        if (value == 0.)
          return true;
        if (!(slope < 0.))
          return false;
        const double step = std::max(-size, std::min(size, -value / slope));
        distance += step;
        if (std::abs(distance) > 100. * size)
          return false;
        if (std::abs(step) <= 1e-13 * size)
          return true;
      }
    return false;
  }



  ImageFunction rigid_images(const ContactSurface &surface, const RigidObstacle &obstacle)
  {
    const double size = surface.extent();
    return [size, &obstacle](Vector3 &gap, const Point<3> &x, const Vector3 &normal) {
      double     distance;
      const bool hit =
          obstacle.gap(distance, x, normal, size) && obstacle.is_faced(x + distance * normal, normal, size);
      if (hit)
        gap = distance * normal;
      return hit;
    };
  }



  std::vector<FaceMoments> compute_rigid_moments(const ContactSurface &surface, const RigidObstacle &obstacle,
                                                 const MPI_Comm communicator)
  {
    return compute_face_moments(surface, rigid_images(surface, obstacle), communicator);
  }



  GeometricPenetration sample_rigid_penetration(const ContactSurface &surface, const RigidObstacle &obstacle,
                                                const std::vector<Vector3> &displacement,
                                                const ContactAtVertices    &contact,
                                                const std::vector<bool> &faces, const MPI_Comm communicator)
  {
    // Corners, middles of edges and centres of triangles, displaced; normals as they were.
    const std::array<std::array<double, 3>, 7> samples = {{{{1., 0., 0.}},
                                                           {{0., 1., 0.}},
                                                           {{0., 0., 1.}},
                                                           {{.5, .5, 0.}},
                                                           {{0., .5, .5}},
                                                           {{.5, 0., .5}},
                                                           {{1. / 3., 1. / 3., 1. / 3.}}}};
    const double                               size    = surface.extent();
    const ChordEdges                           chords(surface);
    GapUnderLoad                               under_load(surface, contact.pressure);
    LeastGap                                   initially, deformed;
    DoubtOfGaps                                doubts(surface);
    for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
      if (faces[surface.triangle_face[t]])
        {
          LeastGap              least;
          std::optional<double> at_centre;
          for (const auto &w : samples)
            {
              at_centre.reset();
              if (chords.has_point(t, w))
                continue;
              Vector3 x, u, n;
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const unsigned int v = surface.mesh.triangles[t][i];
                  x += w[i] * Vector3(surface.mesh.vertices[v]);
                  u += w[i] * displacement[v];
                  n += w[i] * surface.mesh.vertex_normals[v];
                }
              x += surface.offset(t, w);
              if (!(n.norm() > 0.))
                continue;
              n /= n.norm();
              double gap;
              if (obstacle.gap(gap, Point<3>(x), n, size))
                {
                  initially.add(gap, Point<3>(x));
                  if (obstacle.gap(gap, Point<3>(x + u), n, size))
                    {
                      deformed.add(gap, Point<3>(x));
                      least.add(gap, Point<3>(x));
                      at_centre = gap;
                    }
                }
            }
          if (has_corner(surface, t, contact.doubted))
            doubts.add(t, 1., gap_doubt(surface, t), at_centre.value_or(least.value()));
          under_load.add(t, triangle_area(surface.mesh, t), least);
        }
    initially.reduce(communicator);
    deformed.reduce(communicator);
    const auto [doubt, doubt_at] = doubts.largest(communicator);
    return {initially.value(), deformed.value(),     deformed.place(), under_load.mean(communicator), doubt,
            doubt_at,          under_load.of_faces()};
  }
} // namespace Signorini
