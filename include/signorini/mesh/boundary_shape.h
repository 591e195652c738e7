// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_boundary_shape_h
#define signorini_mesh_boundary_shape_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/manifold.h>

#include <memory>
#include <string>
#include <vector>

namespace Signorini
{
  /// The true shape of a boundary, to which new boundary nodes move: an analytic one or a triangulated
  /// surface. Immutable.
  class BoundaryShape
  {
  public:
    virtual ~BoundaryShape() = default;

    /// The point of the shape that belongs to a point near it.
    virtual dealii::Point<3> project(const dealii::Point<3> &p) const = 0;

    /// The unit normal of the shape at the point that belongs to p, on the side that `facing` points to. At
    /// creases that of the side that faces there most.
    virtual dealii::Tensor<1, 3> normal(const dealii::Point<3>     &p,
                                        const dealii::Tensor<1, 3> &facing) const = 0;

    /// The pieces that creases divide the shape into; empty if it is one. What lies at a crease has to be
    /// projected onto those that it belongs to: the nearest point of the whole may lie in another one.
    virtual const std::vector<std::shared_ptr<const BoundaryShape>> &pieces() const
    {
      static const std::vector<std::shared_ptr<const BoundaryShape>> none;
      return none;
    }

    /// The number of the piece near p whose outward side faces `facing` (any length), of a shape with pieces.
    virtual unsigned int piece_at(const dealii::Point<3> &, const dealii::Tensor<1, 3> &) const
    {
      return 0;
    }

    /// By how much the shape itself may be wrong near p (length): nothing where a user gave it.
    virtual double doubt(const dealii::Point<3> &) const
    {
      return 0.;
    }

    /// Whether it is the shape itself, which does not end. Patches over facets end where these do, with
    /// normals of one side: where they meet a plane they lie off it a little.
    virtual bool is_exact() const
    {
      return true;
    }

    /// Remarks for the user; empty if there are none.
    virtual std::string note() const
    {
      return "";
    }
  };

  using BoundaryShapePointer = std::shared_ptr<const BoundaryShape>;

  /// How a body was put into its place: rotation, then translation.
  struct Placement
  {
    /// Turns first, then moves (length).
    dealii::Tensor<2, 3> rotation = dealii::unit_symmetric_tensor<3>();
    dealii::Tensor<1, 3> translation;

    /// The image of a point.
    dealii::Point<3> operator()(const dealii::Point<3> &p) const
    {
      return dealii::Point<3>(rotation * p + translation);
    }
  };

  /// "sphere: centre, radius", "cylinder: point, axis, radius", "cone: point, axis, radius there, half angle"
  /// (in degrees; it opens along the axis, and a radius of 0 makes the point its apex), "torus: centre, axis,
  /// radius of the circle, radius of the tube", "plane: point, normal" with points as (x, y, z), or "file:
  /// NAME" (see read_surface()), all in the frame of the mesh before it is placed. Files are relative to
  /// base_folder. Errors: InputError that begins with `where`: texts and files that cannot be understood,
  /// surfaces with edges of more than two triangles.
  BoundaryShapePointer make_boundary_shape(const std::string &text, const Placement &placement,
                                           const std::string &base_folder, const std::string &where);

  BoundaryShapePointer make_sphere_shape(const dealii::Point<3> &centre, const double radius);

  /// The axis and the normal are unit vectors.
  BoundaryShapePointer make_cylinder_shape(const dealii::Point<3> &point, const dealii::Tensor<1, 3> &axis,
                                           const double radius);

  BoundaryShapePointer make_plane_shape(const dealii::Point<3> &point, const dealii::Tensor<1, 3> &normal);

  /// Projects onto one shape, or onto the edge where several meet (by turns).
  dealii::Point<3> project_onto(const std::vector<BoundaryShapePointer> &shapes, const dealii::Point<3> &p);

  /// New points of deal.II's hexahedra on boundaries with shapes.
  class ShapeManifold : public dealii::Manifold<3>
  {
  public:
    /// Points lie on all of the shapes.
    explicit ShapeManifold(const std::vector<BoundaryShapePointer> &shapes)
      : shapes(shapes)
    {
    }

    /// deal.II's copy.
    std::unique_ptr<dealii::Manifold<3>> clone() const override
    {
      return std::make_unique<ShapeManifold>(shapes);
    }

    /// The weighted mean of the points around, moved to the shapes.
    dealii::Point<3> get_new_point(const dealii::ArrayView<const dealii::Point<3>> &surrounding,
                                   const dealii::ArrayView<const double>           &weights) const override;

  private:
    const std::vector<BoundaryShapePointer> shapes;
  };
} // namespace Signorini

#endif
