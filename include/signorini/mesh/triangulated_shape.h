// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_triangulated_shape_h
#define signorini_mesh_triangulated_shape_h

#include <signorini/mesh/boundary_shape.h>
#include <signorini/surface/smooth_surface.h>
#include <signorini/surface/surface_feet.h>

namespace Signorini
{
  /// The plane that some triangles of a surface lie in, its normal on their side; null if they do not lie in
  /// one, or have no area.
  BoundaryShapePointer plane_through(const SurfaceMesh &mesh, const std::vector<unsigned int> &triangles);

  /// A triangulated surface, finer than the mesh: its facets are the shape.
  class TriangulatedShape : public BoundaryShape
  {
  public:
    /// @param remark how messages call it
    TriangulatedShape(SurfaceMesh surface, std::string remark);

    dealii::Point<3>     project(const dealii::Point<3> &p) const override;
    dealii::Tensor<1, 3> normal(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &facing) const override;

    bool is_exact() const override
    {
      return false;
    }

    std::string note() const override
    {
      return remark;
    }

  private:
    const SurfaceMesh mesh;
    const SurfaceFeet feet;
    const std::string remark;
  };

  /// What the start mesh of a body alone says about the shape of a part of its boundary: curved patches over
  /// its triangles, by themselves where they are believed (SmoothSurface::Patch::is_smooth) or everywhere.
  /// Pieces between creases that are flat are planes that do not end.
  class SmoothShape : public BoundaryShape
  {
  public:
    /// @param wanted the triangles of the part
    /// @param everywhere patches also where the mesh does not show that it stands for a smooth surface
    SmoothShape(SurfaceMesh boundary, const std::vector<bool> &wanted, const bool everywhere);
    /// Some triangles of a smooth surface, without pieces.
    SmoothShape(std::shared_ptr<const SmoothSurface> surface, std::vector<unsigned int> part,
                const bool everywhere);

    dealii::Point<3>     project(const dealii::Point<3> &p) const override;
    dealii::Tensor<1, 3> normal(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &facing) const override;
    double               doubt(const dealii::Point<3> &p) const override;
    unsigned int piece_at(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &facing) const override;

    const std::vector<BoundaryShapePointer> &pieces() const override
    {
      return between_creases;
    }

    bool is_exact() const override
    {
      return false;
    }

    /// Whether the part consists of plane pieces.
    bool is_flat() const;

  private:
    bool is_curved(const unsigned int triangle) const
    {
      const SmoothSurface::Patch &patch = surface->patch(triangle);
      return !patch.is_flat && (everywhere || patch.is_smooth);
    }

    void divide();

    const std::shared_ptr<const SmoothSurface> surface;
    const std::vector<unsigned int>            part;
    const SurfaceFeet                          feet;
    const bool                                 everywhere;
    std::vector<BoundaryShapePointer>          between_creases;
    /// By triangle of the whole surface.
    std::vector<unsigned int> piece_of_triangle;
  };
} // namespace Signorini

#endif
