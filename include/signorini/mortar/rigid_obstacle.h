// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_rigid_obstacle_h
#define signorini_mortar_rigid_obstacle_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/field.h>
#include <signorini/mortar/face_moments.h>
#include <signorini/mortar/geometric_penetration.h>

#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// A rigid body that does not move, as the partner of an elastic one (the Signorini problem): the set where
  /// a function is negative, with a gap along given directions.
  class RigidObstacle
  {
  public:
    /// The normal points to the elastic body. Errors, here and below: InputError for directions without
    /// length and radii that are not positive.
    static RigidObstacle plane(const dealii::Point<3> &point, const Vector3 &normal);

    /// @param is_hollow whether the elastic body is inside
    static RigidObstacle sphere(const dealii::Point<3> &centre, const double radius,
                                const bool is_hollow = false);
    static RigidObstacle cylinder(const dealii::Point<3> &point, const Vector3 &axis, const double radius,
                                  const bool is_hollow = false);

    /// @param axis points to the elastic body
    /// @param radius of curvature at the apex; negative for a bowl
    static RigidObstacle paraboloid(const dealii::Point<3> &apex, const Vector3 &axis, const double radius);

    /// The set where a function is negative.
    static RigidObstacle level_set(const ScalarField &function);

    /// From text:
    ///   plane: point, normal              the normal points to the elastic body
    ///   sphere: centre, radius            hollow sphere: the body is inside
    ///   cylinder: point, axis, radius     hollow cylinder: the body is inside
    ///   paraboloid: apex, axis, R         r^2 = 2 R times the depth below the apex; the axis points to the
    ///                                     elastic body; negative R for a bowl
    ///   function: f                       an expression in x, y, z, positive outside of the obstacle
    /// with points and directions as (x, y, z).
    /// Errors: InputError naming `where`.
    static RigidObstacle parse(const std::string &text, const std::string &where);

    /// The distance along the unit vector n from x to where the line enters the obstacle, negative if x lies
    /// in it (length). `size` is a length of the problem. False if the line does not enter it.
    bool gap(double &distance, const dealii::Point<3> &x, const Vector3 &n, const double size) const;

    /// Whether a line along the unit vector n that enters the obstacle at y turns towards its surface there:
    /// whether n and the outward normal differ by more than 120 degrees. `size` is a length of the problem.
    bool is_faced(const dealii::Point<3> &y, const Vector3 &n, const double size) const;

    /// Where the line along the unit vector n from x enters the obstacle, and n faces it there (is_faced()):
    /// the distance (length), and the opposite of the outward unit normal, if the line along that meets the
    /// obstacle, too. False if not. `size` is a length of the problem.
    bool contact_normal(Vector3 &normal, double &distance, const dealii::Point<3> &x, const Vector3 &n,
                        const double size) const;

    /// The outward unit normal if that is the same everywhere.
    std::optional<Vector3> constant_normal() const
    {
      return kind == Kind::plane ? std::optional<Vector3>(axis / axis.norm()) : std::nullopt;
    }

    /// The text that it was made from.
    const std::string &description() const
    {
      return text;
    }

  private:
    enum class Kind
    {
      plane,
      sphere,
      cylinder,
      paraboloid,
      function
    };

    RigidObstacle(const Kind kind, const std::string &name, const dealii::Point<3> &point,
                  const Vector3 &axis, const double radius, const bool is_hollow);

    /// A multiple of the outward normal of the surface through y.
    Vector3 gradient(const dealii::Point<3> &y, const double size) const;

    bool function_gap(double &distance, const dealii::Point<3> &x, const Vector3 &n, const double size) const;

    Kind             kind = Kind::plane;
    std::string      text;
    dealii::Point<3> point;
    Vector3          axis;
    double           radius = 0.;
    /// -1 if the elastic body is inside.
    double      sign = 1.;
    ScalarField function;
  };

  /// The images of points of a surface on an obstacle, both of which must outlive the function.
  ImageFunction rigid_images(const ContactSurface &surface, const RigidObstacle &obstacle);

  /// The moments of this rank's faces against an obstacle, as compute_face_moments() has them against a
  /// surface. The gap is measured along the linear field of vertex normals. A triangle of which a part does
  /// not see the obstacle, or not face it (RigidObstacle::is_faced()), counts as uncovered.
  std::vector<FaceMoments> compute_rigid_moments(const ContactSurface &surface, const RigidObstacle &obstacle,
                                                 const MPI_Comm communicator);

  /// Collective. As sample_geometric_penetration(), against an obstacle.
  /// @param faces those of this rank to look at
  GeometricPenetration sample_rigid_penetration(const ContactSurface &surface, const RigidObstacle &obstacle,
                                                const std::vector<Vector3> &displacement,
                                                const ContactAtVertices    &contact,
                                                const std::vector<bool> &faces, const MPI_Comm communicator);
} // namespace Signorini

#endif
