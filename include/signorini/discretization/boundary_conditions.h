// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_boundary_conditions_h
#define signorini_discretization_boundary_conditions_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/load_definition.h>
#include <signorini/discretization/rigid_faces.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  /// Prescribed displacement on a boundary; empty components are free.
  struct DirichletCondition
  {
    /// Which boundary of which body; values by component (length).
    unsigned int                         body;
    std::string                          boundary;
    std::set<dealii::types::boundary_id> ids;
    /// In the directions of the frame.
    std::array<ScalarField, 3> components;
    ConditionFrame             frame;
    /// What its normals are taken from, where there is one.
    std::map<dealii::types::boundary_id, BoundaryShapePointer> shapes;
    /// Number of the set of nodes (NodalSpace::node_sets()) that it holds instead of a boundary.
    unsigned int node_set = StartNodes::none;
    /// The single node (NodalSpace::start_vertices()) that it holds instead.
    unsigned int start_vertex = StartNodes::none;
    /// LoadDefinition::Displacement::is_between_sets.
    bool is_between_sets = false;
  };

  /// Forces on a boundary, as LoadDefinition::SurfaceForce has them.
  struct Traction
  {
    /// Where, and what.
    std::set<dealii::types::boundary_id> ids;
    VectorField                          traction;
    ScalarField                          pressure;
    VectorField                          total_force;
  };

  /// A boundary that moves as a rigid body, as LoadDefinition::RigidBoundary has it.
  struct RigidFaceCondition
  {
    /// What messages begin with; of which body; where.
    std::string                          where;
    unsigned int                         body;
    std::string                          boundary;
    std::set<dealii::types::boundary_id> ids;
    VectorField                          force, moment;
    std::optional<dealii::Point<3>>      about;
    std::array<ScalarField, 3>           displacement, rotation;
    Vector3                              direction;
  };

  /// The strain without stress of the cells with a material.
  struct Eigenstrain
  {
    /// As LoadDefinition::InitialStrain has them.
    ScalarField temperature;
    double      expansion = 0.;
    StrainField strain;
  };

  /// Cells whose strain along an axis makes a section force, as LoadDefinition::Pretension has them, and how
  /// far it has been found.
  struct Pretension
  {
    /// What messages begin with; of which body, and what results call it.
    std::string                          where;
    unsigned int                         body;
    std::string                          name;
    std::set<dealii::types::material_id> materials;
    /// Empty for all cells of the materials.
    ScalarField region;
    /// A unit vector.
    Vector3     axis;
    ScalarField force;
    /// As in LoadDefinition::Pretension.
    double locked_after = std::numeric_limits<double>::max();
    /// The shortening per length without stress; the section force with it, and by how much that grows with
    /// the strains of all of them (force; empty before the first solution).
    double              strain = 0., reached = 0.;
    std::vector<double> slopes = {};

    /// Whether its strain is no longer sought at a pseudo-time.
    bool is_locked(const double time) const
    {
      return time > locked_after;
    }

    /// The section force that its strain is sought for (force).
    double wanted(const double time) const
    {
      return force(dealii::Point<3>(), std::min(time, locked_after));
    }
  };

  /// All conditions and loads of all bodies.
  struct Loads
  {
    /// The conditions, in the order of the parameter file.
    std::vector<DirichletCondition> dirichlet;
    std::vector<RigidFaceCondition> rigid_faces;
    std::vector<Traction>           tractions;
    /// Forces at vertices of the start meshes (NodalSpace::start_vertices()).
    std::map<unsigned int, std::vector<VectorField>> nodal_forces;
    /// Force per volume of each body; an entry for all of them is needed, so add() every body.
    std::vector<VectorField> volume_forces;
    /// By material id; those beyond the end have none.
    std::vector<Eigenstrain> eigenstrains;
    std::vector<Pretension>  pretensions;
    /// The pseudo-time at which conditions and forces are evaluated.
    double time = ScalarField::end;

    /// Takes in what acts on one body. Errors: InputError for unknown boundaries.
    void add(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition);

    /// Whether any cell strains without stress.
    bool has_eigenstrains() const
    {
      return !eigenstrains.empty() || !pretensions.empty();
    }

    /// The strain without stress of a cell. Errors: InputError where it is no small one (not collective).
    CellEigenstrain eigenstrain(const NodalSpace &space, const NodalSpace::Cell &cell) const;

  private:
    void add_initial_strains(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition);
    void add_pretensions(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition);
  };

  /// Whether a cell belongs to the part of a body that a pretension shortens.
  bool is_in(const Pretension &pretension, const NodalSpace &space, const NodalSpace::Cell &cell);

  /// The surface forces of a problem on one mesh, which total forces are spread over.
  class SurfaceForces
  {
  public:
    /// Collective. The loads must outlive the object.
    SurfaceForces(const Loads &loads, const NodalSpace &space);

    /// The forces that act on the boundary, as numbers in Loads::tractions.
    const std::vector<std::size_t> &on(const dealii::types::boundary_id id) const;

    /// One of them on a piece of the boundary, given its outward area vector.
    Vector3 force(const std::size_t traction, const dealii::Point<3> &position, const Vector3 &area) const;

  private:
    const Loads                                                   &loads;
    std::map<dealii::types::boundary_id, std::vector<std::size_t>> by_boundary;
    /// Per traction; 0 where there is no total force.
    std::vector<double> areas;
  };

  /// What holds a node in directions that need not be orthogonal, nor axes of coordinates.
  struct HeldNode
  {
    /// One component of a condition.
    struct Hold
    {
      /// Index into Loads::dirichlet, and which of its components.
      int          condition;
      unsigned int component;
      /// A unit vector, and its dual among the directions of the node: both span the same space, and their
      /// products are one for the pair and zero for others.
      Vector3 direction, dual;
    };

    /// Three at most, linearly independent.
    std::vector<Hold> holds;
  };

  /// Prescribed displacements of the relevant nodes of a space.
  struct DirichletData
  {
    /// Indexed like NodalSpace::relevant().
    std::vector<FixedDirections> fixed;
    /// The displacement (length), zero in free directions.
    std::vector<Vector3> value;
    /// The condition that prescribes each component (index into Loads::dirichlet), or -1.
    std::vector<std::array<int, 3>> condition;
    /// Owned nodes, by relevant index, with conditions in other frames; they have no components above.
    std::map<std::size_t, HeldNode> held;
    /// Boundaries that move as rigid bodies: their nodes depend on carriers. Null without.
    std::shared_ptr<const RigidFaces> rigid;

    /// Calls f(condition, its part) for the parts of a force at a relevant node that its conditions take;
    /// returns what they leave.
    template <typename F>
    Vector3 split_reaction(const std::size_t i, const Vector3 &force, const F &f) const
    {
      Vector3 rest = force;
      if (const auto node = held.find(i); node != held.end())
        for (const HeldNode::Hold &hold : node->second.holds)
          {
            const Vector3 part = (force * hold.dual) * hold.direction;
            f(static_cast<std::size_t>(hold.condition), part);
            rest -= part;
          }
      else
        for (unsigned int c = 0; c < dim; ++c)
          if (condition[i][c] >= 0)
            {
              Vector3 part;
              part[c] = force[c];
              rest[c] = 0.;
              f(static_cast<std::size_t>(condition[i][c]), part);
            }
      return rest;
    }
  };

  /// Collective. Evaluates the conditions at the nodes. Where two conditions prescribe the same direction
  /// of a node, the later one counts. Hanging nodes get no entry: their parents do.
  /// @param rigid how rigid faces may move, for a coarser mesh (of the finest); empty to find out
  DirichletData evaluate_dirichlet(const NodalSpace &space, const Loads &loads, const bool with_values,
                                   const std::vector<RigidFace> &rigid = {});

  /// Of the owned nodes, in their order; hanging ones are fixed.
  std::vector<FixedDirections> fixed_of_owned(const NodalSpace &space, const DirichletData &dirichlet);
} // namespace Signorini

#endif
