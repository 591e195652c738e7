// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_element_h
#define signorini_discretization_element_h

#include <signorini/discretization/hexahedron.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

namespace Signorini
{
  /// A cell of either shape with its kernels: trilinear hexahedra (Hexahedron) and linear tetrahedra.
  /// Arrays are filled up to the number of vertices.
  class Element
  {
  public:
    /// Values of the functions of the vertices at a point; zero beyond n_vertices().
    using Shape = std::array<double, CellShape::max_vertices>;

    Element() = default;
    /// A copy of the corners of a cell of the space.
    Element(const NodalSpace &space, const NodalSpace::Cell &cell);
    /// The same of a cell of a mesh.
    Element(const VolumeMesh &mesh, const VolumeMesh::Cell &cell);

    /// 4 or 8.
    unsigned int n_vertices() const
    {
      return n;
    }

    /// Position of a vertex (length).
    const dealii::Point<3> &corner(const unsigned int v) const
    {
      return corners[v];
    }

    /// Mean of the corners.
    dealii::Point<3> centre() const;

    /// Stiffness of isotropic linear elasticity: blocks[n_vertices * a + b], nine numbers each, row by row
    /// (E times length). False if the Jacobian is not positive.
    bool stiffness(std::array<double, 576> &blocks, const Material &material) const;

    /// Points of a quadrature that is exact for products of the shape functions and linear data on
    /// parallelepipeds and tetrahedra.
    unsigned int n_points() const
    {
      return n == CellShape::tetrahedron ? 4 : 8;
    }

    /// Jacobian determinant times weight, and the point in space.
    std::pair<double, dealii::Point<3>> volume_element(const unsigned int point) const;

    /// Values of the shape functions at a point of the rule.
    Shape shape_at_point(const unsigned int point) const;

    /// Values of the shape functions at reference coordinates.
    Shape shape_values(const dealii::Point<3> &reference) const;

    /// Gradients of the shape functions in space. False if the Jacobian is not positive there.
    bool shape_gradients(std::array<Vector3, CellShape::max_vertices> &gradients,
                         const dealii::Point<3>                       &reference) const;

    /// Reference coordinates of a point in space; false if there are none.
    bool invert_map(dealii::Point<3> &reference, const dealii::Point<3> &point) const;

    /// Gradients of the shape functions in reference coordinates, and the inverse of the derivative of the
    /// map (1 / length). false where its determinant is not positive.
    bool reference_gradients(std::array<Vector3, CellShape::max_vertices> &gradients, Block &inverse,
                             const dealii::Point<3> &reference) const;

    /// Reference coordinates of a vertex.
    dealii::Point<3> reference_vertex(const unsigned int vertex) const
    {
      if (n_vertices() == CellShape::hexahedron)
        return dealii::Point<3>(vertex & 1, vertex >> 1 & 1, vertex >> 2);
      return dealii::Point<3>(vertex == 1, vertex == 2, vertex == 3);
    }

    /// How far reference coordinates lie outside of the cell; 0 inside.
    double outside(const dealii::Point<3> &reference) const;

    /// Of the cell (length^3).
    double volume() const;

    /// Length of the longest edge or diagonal.
    double diameter() const;

    /// Reference coordinates of a point of the rule.
    dealii::Point<3> reference_point(const unsigned int point) const;

  private:
    unsigned int        n = 0;
    Hexahedron::Corners corners;
  };

  /// The strain without stress in a cell: symmetric values at the vertices, in between by the shape
  /// functions.
  struct CellEigenstrain
  {
    /// Whether there is none.
    bool is_zero = true;
    /// Symmetric (1).
    std::array<Block, CellShape::max_vertices> at_vertices;

    /// Where the shape functions have these values.
    Block value(const Element::Shape &shape) const
    {
      Block result;
      for (unsigned int v = 0; v < CellShape::max_vertices; ++v)
        result += shape[v] * at_vertices[v];
      return result;
    }
  };

  /// Stress lambda tr(eps) I + 2 mu eps of a displacement gradient.
  Block stress(const Block &gradient, const Material &material);

  /// A displacement in one cell, with the strain that the stiffness of the cell is made of.
  class CellDisplacement
  {
  public:
    /// u: at the vertices of the cell.
    CellDisplacement(const Element &element, const Material &material,
                     const std::array<Vector3, CellShape::max_vertices> &u,
                     const CellEigenstrain                              &eigenstrain = CellEigenstrain());

    /// The gradient in space; with mean dilatation its trace is the mean over the cell. Zero where the
    /// Jacobian is not positive.
    Block gradient(const dealii::Point<3> &reference) const;

    /// The same without the eigenstrain; with mean dilatation the trace of that, too, is its mean.
    Block elastic_gradient(const dealii::Point<3> &reference) const;

    /// Stress (force per area) at reference coordinates.
    Block stress(const dealii::Point<3> &reference) const
    {
      return Signorini::stress(elastic_gradient(reference), material);
    }

    /// Stress at a point of the rule of the element, and Jacobian determinant times weight there; zero where
    /// the Jacobian is not positive.
    std::pair<Block, double> stress_at_point(const unsigned int point) const;

    /// div C : eps0 (force per volume) on tetrahedra, where the eigenstrain eps0 is linear.
    Vector3 eigenstress_divergence() const;

    /// What it was made from.
    const Element                                      element;
    const Material                                    &material;
    const std::array<Vector3, CellShape::max_vertices> u;
    const CellEigenstrain                              eigenstrain;

  private:
    /// @return determinant of the Jacobian; 0 where it is not positive
    double plain_gradient(Block &gradient, const dealii::Point<3> &reference) const;
    Block  with_mean_dilatation(const Block &plain) const;
    Block  without_eigenstrain(const Block &gradient, const dealii::Point<3> &reference) const;

    bool   has_mean_dilatation = false;
    double mean_dilatation = 0., mean_of_eigenstrain = 0.;
  };

  /// A face of a cell: its corners (in the order of CellShape::face), and Gauss points (2x2 on
  /// quadrilaterals, three on triangles: exact for polynomials of degree two).
  class ElementFace
  {
  public:
    /// @param face as in CellShape::face
    ElementFace(const Element &cell, const unsigned int face);

    /// What an integrand needs at a point.
    struct PointData
    {
      /// In space (length).
      dealii::Point<3> position;
      /// Outward normal times area times weight.
      Vector3 area;
      /// Of the corners of the face.
      std::array<double, 4> shape;
    };

    /// 3 or 4.
    unsigned int n_corners() const
    {
      return static_cast<unsigned int>(vertices.size());
    }

    /// Which vertex of the cell a corner is.
    unsigned int vertex(const unsigned int corner) const
    {
      return vertices[corner];
    }

    /// Number of points of the rule.
    unsigned int n_points() const
    {
      return n_corners();
    }

    /// A point of the rule, 0 ... n_points() - 1.
    PointData point(const unsigned int q) const;

    /// Length of the longest edge.
    double diameter() const;

  private:
    const dealii::ArrayView<const unsigned int> vertices;
    std::array<dealii::Point<3>, 4>             x;
  };
} // namespace Signorini

#endif
