// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_true_shape_h
#define signorini_mesh_true_shape_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/boundary_shape.h>
#include <signorini/surface/surface_mesh.h>

#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// Shapes of the boundaries of a contact surface, by boundary id, and whether its gap is measured between
  /// them or between facets.
  struct SurfaceShapes
  {
    /// The shapes, and whether gaps and normals are taken from them.
    std::map<dealii::types::boundary_id, BoundaryShapePointer> by_boundary;
    bool                                                       are_used = true;
  };

  /// Where the true surface lies over the facets of a contact surface: the offset from a point to its shape.
  /// Of exact shapes (BoundaryShape::is_exact()) at each place itself. Of patches over facets, whose nearest
  /// point takes a search, on each triangle the polynomial of fifth degree that has the right values at 21
  /// points (error of sixth order), worked out for the triangles that are asked for. Where two shapes of the
  /// surface meet (not at hanging vertices), their places over the chords move along them to the edge: a
  /// chamfer would else go on beyond it, into the shaft.
  class TrueShape
  {
  public:
    /// A facet without a shape.
    static constexpr unsigned int no_shape = std::numeric_limits<unsigned int>::max();

    /// The facets are the true surface.
    TrueShape() = default;

    /// @param mesh the facets
    /// @param shape_of_triangle index into shapes, or no_shape
    /// @param is_used whether offset() hands the offsets out, or only doubt() knows them
    TrueShape(const SurfaceMesh &mesh, std::vector<BoundaryShapePointer> shapes,
              std::vector<unsigned int> shape_of_triangle, const bool is_used);

    /// That of the triangles of a part of the surface.
    TrueShape(const TrueShape &whole, const Renumbering &triangles);

    /// Whether offsets are not all zero for want of a shape.
    bool has_offsets() const
    {
      return is_used && !shapes.empty();
    }

    /// From the point of a triangle with given barycentric coordinates to the true surface (length), as far
    /// as it is used.
    Vector3 offset(const SurfaceMesh &mesh, const unsigned int triangle,
                   const std::array<double, 3> &weights) const
    {
      return is_used ? known_offset(mesh, triangle, weights) : Vector3();
    }

    /// The part of it that is known but not used: facets stand for the surface because a user wants it.
    Vector3 unused_offset(const SurfaceMesh &mesh, const unsigned int triangle,
                          const std::array<double, 3> &weights) const
    {
      return is_used ? Vector3() : known_offset(mesh, triangle, weights);
    }

    /// By how much the shape itself may be wrong over a triangle (length).
    double doubt(const SurfaceMesh &mesh, const unsigned int triangle) const;

    /// Bytes of this surface, without the shapes.
    std::size_t memory_consumption() const;

    /// Of the polynomials, and how many terms they have.
    static constexpr unsigned int degree = 5, n_terms = (degree + 1) * (degree + 2) / 2;

  private:
    using Polynomial = std::array<Vector3, n_terms>;

    Vector3           known_offset(const SurfaceMesh &mesh, const unsigned int triangle,
                                   const std::array<double, 3> &weights) const;
    const Polynomial &polynomial(const SurfaceMesh &mesh, const unsigned int triangle) const;

    std::vector<BoundaryShapePointer> shapes;
    std::vector<unsigned int>         shape_of_triangle;
    bool                              is_used = false;
    /// A point of the lattice by the vertices, in ascending order, whose mean it is: neighbours share it.
    using LatticePoint = std::array<unsigned int, degree>;

    struct LatticeHash
    {
      std::size_t operator()(const LatticePoint &p) const
      {
        std::size_t hash = 0;
        for (const unsigned int v : p)
          hash = (hash ^ v) * 0x9e3779b97f4a7c15ULL;
        return hash ^ hash >> 32;
      }
    };

    Vector3 lattice_value(const SurfaceMesh &mesh, const unsigned int triangle, LatticePoint point) const;

    /// By local edge of a triangle, from corner i to the next one: the shape beyond it, if that is another
    /// one, or no_shape.
    using ShapesBeyond = std::array<unsigned int, 3>;

    void    find_edges_of_shapes(const SurfaceMesh &mesh);
    Vector3 moved_offset(const SurfaceMesh &mesh, const unsigned int triangle, const ShapesBeyond &others,
                         const std::array<double, 3> &weights) const;

    /// Of triangles at edges of their shapes.
    std::unordered_map<unsigned int, ShapesBeyond> beyond;

    /// By shape: offsets at points of the lattice that lie on edges.
    mutable std::vector<std::unordered_map<LatticePoint, Vector3, LatticeHash>> known;
    /// Those made so far; of a triangle index_of_polynomial, or no_shape.
    mutable std::vector<Polynomial>   polynomials;
    mutable std::vector<unsigned int> index_of_polynomial;
  };
} // namespace Signorini

#endif
