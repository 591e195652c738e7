// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_problem_definition_h
#define signorini_application_problem_definition_h

#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/body_definition.h>
#include <signorini/mesh/field.h>
#include <signorini/mortar/rigid_obstacle.h>

#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// What two surfaces do to each other.
  enum class ContactKind
  {
    /// Frictionless contact.
    unilateral,
    /// Glued together where they are; gaps do not count.
    tied
  };

  /// What the gap of a contact node is.
  enum class GapKind
  {
    /// Integrals of the gap with the dual functions.
    weighted,
    /// The gap at the nodes along their normals, with an obstacle or a prescribed gap.
    nodal
  };

  /// Which surface carries the contact pressure.
  enum class NonmortarChoice
  {
    /// The softer body, then the finer mesh; the other one where this one could carry no contact stress.
    automatic,
    /// As they stand in the definition.
    first,
    second
  };

  /// What the gap and the normals are measured on.
  enum class SurfaceKind
  {
    /// The shapes of boundaries where there are any, else what the start mesh shows of itself.
    automatic,
    /// Curved patches wherever there is no shape.
    smooth,
    /// The facets of the mesh.
    faceted
  };

  /// What to do where surfaces overlap at the start.
  enum class InitialPenetration
  {
    /// An interference fit where it is small against the bodies, else InputError.
    automatic,
    /// An interference fit.
    resolve,
    /// InputError.
    refuse
  };

  /// One surface of a pair: a boundary of a body.
  struct PairSide
  {
    /// Their names.
    std::string body, boundary;
    /// Positive where the surface may touch (a face belongs to it if a corner or its centre does); empty for
    /// everywhere.
    ScalarField region;
  };

  /// Two surfaces, or a surface and an obstacle, that may touch.
  struct PairDefinition
  {
    /// What results and messages call it.
    std::string name;
    /// A surface.
    PairSide first;
    /// Without meaning if there is an obstacle.
    PairSide                     second;
    std::optional<RigidObstacle> obstacle;
    /// The initial gap (length) at points of the nonmortar surface; empty for the geometric one.
    ScalarField prescribed_gap;
    /// What the surfaces do to each other, and how that is discretized.
    ContactKind        contact     = ContactKind::unilateral;
    GapKind            gap         = GapKind::weighted;
    NonmortarChoice    nonmortar   = NonmortarChoice::automatic;
    SurfaceKind        surface     = SurfaceKind::automatic;
    InitialPenetration penetration = InitialPenetration::automatic;
  };

  /// A body and what acts on it.
  struct BodyProblem
  {
    /// Mesh, material, boundary shapes.
    BodyDefinition body;
    /// Conditions and forces.
    LoadDefinition loads;
  };

  /// A contact problem: bodies, what acts on them, and where they may touch. From a parameter file
  /// (ParameterFile::problem()), or filled in by a program.
  struct ProblemDefinition
  {
    /// In any order; names of bodies differ, and names of pairs.
    std::vector<BodyProblem>    bodies;
    std::vector<PairDefinition> pairs;
  };
} // namespace Signorini

#endif
