// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_boundary_conditions_h
#define signorini_discretization_boundary_conditions_h

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/field.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  /// What acts on a body. Boundaries are those that its mesh names.
  struct LoadDefinition
  {
    /// Prescribed on a boundary or at a set of nodes (length).
    struct Displacement
    {
      /// A boundary, or else a set of nodes, that the mesh names.
      std::string boundary;
      /// Free components are empty.
      std::array<ScalarField, 3> components;
    };

    /// Acts on a boundary.
    struct SurfaceForce
    {
      /// A boundary that the mesh names.
      std::string boundary;
      /// Force per area, and pressure against the outward normal; either may be empty.
      VectorField traction;
      ScalarField pressure;
    };

    /// Acts at a node of the start mesh.
    struct NodalForce
    {
      /// Of BodyDefinition::mesh.
      unsigned int vertex;
      /// Several at a node add up.
      Vector3 force;
    };

    /// Where conditions overlap, the later one counts.
    std::vector<Displacement> displacements;
    std::vector<SurfaceForce> surface_forces;
    std::vector<NodalForce>   nodal_forces;
    /// Force per volume; empty for none.
    VectorField volume_force;
  };

  /// The same as a user writes it, in the subsection of the body.
  struct LoadParameters
  {
    /// Lists as the parameter file has them, one condition after the other.
    std::string dirichlet, tractions, pressures, volume_force;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Errors: InputError for texts that cannot be understood; `section` is what the names of the parameters
    /// get in front.
    LoadDefinition definition(const std::string &section) const;
  };

  /// Prescribed displacement on a boundary; empty components are free.
  struct DirichletCondition
  {
    /// Which boundary of which body; values by component (length).
    unsigned int                         body;
    std::string                          boundary;
    std::set<dealii::types::boundary_id> ids;
    std::array<ScalarField, 3>           components;
    /// Number of the set of nodes (NodalSpace::node_sets()) that it holds instead of a boundary.
    unsigned int node_set = StartNodes::none;
  };

  /// Force per area on a boundary: a vector, a pressure against the outward normal, or both.
  struct Traction
  {
    /// Where; force per area, and pressure against the outward normal; either may be empty.
    std::set<dealii::types::boundary_id> ids;
    VectorField                          traction;
    ScalarField                          pressure;

    /// Force on a piece of the boundary, given its outward area vector.
    Vector3 force(const dealii::Point<3> &position, const Vector3 &area) const;
  };

  /// All conditions and loads of all bodies.
  struct Loads
  {
    /// The conditions, in the order of the parameter file.
    std::vector<DirichletCondition> dirichlet;
    std::vector<Traction>           tractions;
    /// Forces at vertices of the start meshes (NodalSpace::start_vertices()).
    std::map<unsigned int, Vector3> nodal_forces;
    /// Force per volume of each body; an entry for all of them is needed, so add() every body.
    std::vector<VectorField> volume_forces;

    /// Takes in what acts on one body. Errors: InputError for unknown boundaries.
    void add(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition);
  };

  /// Prescribed components of the relevant nodes of a space.
  struct DirichletData
  {
    /// Indexed like NodalSpace::relevant().
    std::vector<FixedMask> mask;
    std::vector<Vector3>   value;
    /// The condition that prescribes each component (index into Loads::dirichlet), or -1.
    std::vector<std::array<int, 3>> condition;
  };

  /// Collective. Evaluates the conditions at the nodes. Where two conditions prescribe the same component
  /// of a node, the later one counts. Hanging nodes get no entry: their parents do.
  DirichletData evaluate_dirichlet(const NodalSpace &space, const Loads &loads, const bool with_values);
} // namespace Signorini

#endif
