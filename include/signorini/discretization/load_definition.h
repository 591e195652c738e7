// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_load_definition_h
#define signorini_discretization_load_definition_h

#include <signorini/discretization/condition_frame.h>
#include <signorini/mesh/field.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <limits>
#include <optional>
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
      /// In the directions of the frame; free components are empty.
      std::array<ScalarField, 3> components;
      ConditionFrame             frame = ConditionFrame();
      /// Whether it is there for nodes of finer meshes alone, between sets that others hold.
      bool is_between_sets = false;
    };

    /// Acts on a boundary.
    struct SurfaceForce
    {
      /// A boundary that the mesh names.
      std::string boundary;
      /// Force per area, pressure against the outward normal, and a total force that is spread evenly over
      /// the area (its value at the origin counts); any may be empty.
      VectorField traction;
      ScalarField pressure    = ScalarField();
      VectorField total_force = VectorField();
    };

    /// Acts at a node of the start mesh.
    struct NodalForce
    {
      /// Of BodyDefinition::mesh.
      unsigned int vertex;
      /// Several at a node add up.
      VectorField force;
    };

    /// A boundary that moves as a rigid body, as one that is glued to a stamp does. What other conditions
    /// prescribe at its nodes (symmetry planes, say) holds it too.
    struct RigidBoundary
    {
      /// A boundary that the mesh names.
      std::string boundary;
      /// On the whole of it (their values at the centre count); the moment is about the centre. Empty: none.
      VectorField force, moment;
      /// The centre: that of the area of the boundary, if it is not given.
      std::optional<dealii::Point<3>> about = std::nullopt;
      /// Prescribed displacement of the centre and prescribed rotation (radian); free components are empty.
      std::array<ScalarField, 3> displacement = {}, rotation = {};
      /// If it is not zero: the boundary moves along this direction only, and does not turn.
      Vector3 direction = Vector3();
    };

    /// What a body, or one of its volumes, would strain if it were free: thermal expansion and more. What is
    /// not given for a volume is that of the body.
    struct InitialStrain
    {
      /// A volume that the mesh names; empty for the whole body.
      std::string volume;
      /// Difference to the temperature without stress; coefficient of linear expansion (per degree).
      ScalarField           temperature = ScalarField();
      std::optional<double> expansion   = std::nullopt;
      /// Strains beside those of the temperature.
      StrainField strain = StrainField();
    };

    /// A part of the body, a bolt's shank, whose strain along an axis is found such that its section carries
    /// a force.
    struct Pretension
    {
      /// The volume of the mesh that it is, if there is no region.
      std::string name;
      /// Along the shank; of any length.
      Vector3 axis;
      /// Of the section, positive for tension (its value at the origin counts).
      ScalarField force;
      /// Positive at the centres of its cells; empty for the volume.
      ScalarField region = ScalarField();
      /// The pseudo-time after which the strain that was found at it stays as it is, whatever the section
      /// carries then.
      double locked_after = std::numeric_limits<double>::max();
    };

    /// Where conditions overlap, the later one counts.
    std::vector<Displacement>  displacements;
    std::vector<RigidBoundary> rigid_boundaries;
    std::vector<SurfaceForce>  surface_forces;
    std::vector<NodalForce>    nodal_forces;
    /// Force per volume; empty for none.
    VectorField volume_force;
    /// Where volumes overlap, the later one counts.
    std::vector<InitialStrain> initial_strains;
    std::vector<Pretension>    pretensions;
  };

  /// The same as a user writes it, in the subsection of the body.
  struct LoadParameters
  {
    /// Lists as the parameter file has them, one condition after the other.
    std::string dirichlet, tractions, pressures, forces, rigid, volume_force;
    std::string temperature, expansion, initial_strain, volume_temperatures, volume_expansions,
        volume_initial_strains, pretension;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Errors: InputError for texts that cannot be understood; `section` is what the names of the parameters
    /// get in front.
    LoadDefinition definition(const std::string &section) const;

  private:
    void parse_initial_strains(LoadDefinition &result, const std::string &section) const;
    void parse_pretensions(LoadDefinition &result, const std::string &section) const;
  };
} // namespace Signorini

#endif
