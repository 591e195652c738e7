// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_nodal_stress_h
#define signorini_discretization_nodal_stress_h

#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/shear_free_planes.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace Signorini
{
  /// The components of a stress (force per area): xx, yy, zz, xy, yz, zx.
  using StressComponents = std::array<double, 6>;

  /// The von Mises stress (force per area).
  double von_mises(const StressComponents &stress);

  /// A displacement and what its stress needs. Referred to, not copied.
  struct StressedBodies
  {
    /// The bodies, their loads (strains without stress), their nodes.
    const Bodies     &bodies;
    const Loads      &loads;
    const NodalSpace &space;
    /// What conditions hold at the relevant nodes (DirichletData::fixed).
    const std::vector<FixedDirections> &fixed;
    /// At the relevant nodes, three numbers each (length).
    const std::vector<double> &displacement;
  };

  /// How far the stress of a body may be from the true one.
  struct StressError
  {
    /// Energy norms, sqrt(int sigma : C^-1 : sigma): of the difference between nodal stress and stress of the
    /// cells, which estimates the error of the latter; of the stress of the cells; of stresses that are
    /// rounding where displacements are as large as they are, or less than a solver leaves beside those of
    /// all bodies.
    double error = 0., norm = 0., rounding = 0.;

    /// That of another body joins this one.
    void add(const StressError &other)
    {
      error    = std::hypot(error, other.error);
      norm     = std::hypot(norm, other.norm);
      rounding = std::hypot(rounding, other.rounding);
    }

    /// The error as a part of the norm of the true stress (whose square is that of the solution and that of
    /// the error together where forces are given); 0 without stress.
    double relative() const
    {
      return error <= rounding && norm <= rounding ? 0. : error / std::hypot(error, norm);
    }
  };

  /// The stress at the nodes: the mean over the cells around, weighted by their volumes, of the stress that
  /// they have there. That of a hexahedron is extrapolated from its Gauss points, so that one layer of them
  /// shows the stress at the surfaces of a bent plate; that of a tetrahedron is that of its middle. Cells are
  /// around a node if it is one of their vertices: the larger ones at a hanging node are not. On planes in
  /// which a body slides the mirror images of the cells are, too (ShearFreePlanes).
  class NodalStress
  {
  public:
    /// Collective. What is referred to must outlive the object.
    explicit NodalStress(const StressedBodies &stressed);

    /// At the relevant nodes, in their order; zero where there is no cell.
    std::vector<StressComponents> values() const;

    /// Collective. The estimate of Zienkiewicz and Zhu (1987), body by body. Nodes between different
    /// materials, or volumes that strain without stress, have a mean for each of them here: the stress jumps
    /// there in truth.
    std::vector<StressError> errors() const;

  private:
    /// Of the cells that belong to it.
    NodalStress(const StressedBodies &stressed, const std::function<bool(const NodalSpace::Cell &)> &belongs,
                std::shared_ptr<const ShearFreePlanes> planes);

    StressComponents at(const NodeIndex node) const;
    void             add_squares_of(const NodalSpace::Cell &cell, std::vector<StressError> &squares) const;

    const StressedBodies                         stressed;
    const std::shared_ptr<const ShearFreePlanes> planes;
    const NodePartition                          partition;
    /// Sums over the cells: xx, yy, zz and xy, yz, zx times volume; volume, in the first of three numbers.
    Vector normal, shear, weight;
  };
} // namespace Signorini

#endif
