// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_evaluation_h
#define signorini_application_contact_evaluation_h

#include <signorini/application/contact_solve.h>
#include <signorini/output/results.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// A point whose displacement is reported.
  struct Probe
  {
    /// What the results call it.
    std::string name;
    /// Number of the body in the problem.
    unsigned int body;
    /// In the body or on it, before it is deformed (length).
    dealii::Point<3> point;
  };

  /// The whole equilibrium of a solution.
  struct Equilibrium
  {
    /// Per Loads::dirichlet, then per rigid face.
    std::vector<BoundaryResult> reactions;
    /// Whether they are told: not those of conditions between sets that hold no node on this mesh.
    std::vector<bool> is_told;
    /// Those.
    std::vector<BoundaryResult> told_reactions() const;
    /// Norm of the nodal forces before reactions and contact forces are taken off (force).
    double largest_nodal_force = 0.;
    /// Certificate::equilibrium, Certificate::body_force_balance, Certificate::body_moment_balance.
    double residual = 0., force_balance = 0., moment_balance = 0.;
    /// What is left of the forces on a body.
    struct Rest
    {
      /// Norm of their sum; sum of the norms of its nodal forces (forces).
      double force = 0., scale = 0.;
      /// Of the body: largest Young's modulus (pressure), largest displacement, size (lengths).
      double young = 0., displacement = 0., size = 0.;
    };
    /// By body.
    std::vector<Rest> of_bodies;
  };

  /// Collective. PairResult::approach of one pair but for the images of its contact by planes of symmetry
  /// (length); 0 where nothing touches.
  double approach_without_images(const Discretization &discretization, const ContactSolution &solution,
                                 const unsigned int pair);

  /// Collective. Forces, areas, gaps and extrema of one pair.
  PairResult evaluate_pair(const Discretization &discretization, const ContactSolution &solution,
                           const unsigned int pair);

  /// Collective. Pressures at the contact nodes of one pair, in the order of the nodes; on rank 0.
  /// Numbers of the mesh file are those of `bodies`.
  std::vector<PressureRow> pressure_rows(const Bodies &bodies, const Discretization &discretization,
                                         const ContactStress &stress, const unsigned int pair);

  /// Collective. What arrives at the nodes of the mortar surface of one pair, in the same way: sums over the
  /// rows p of the pair, the area sum_p M_pq, and means with the weights M_pq of traction, recovered pressure
  /// and gap. None with an obstacle.
  std::vector<PressureRow> mortar_pressure_rows(const Bodies &bodies, const Discretization &discretization,
                                                const ContactStress &stress, const unsigned int pair);

  /// Collective. Reactions, and what is left of the forces on every body.
  Equilibrium evaluate_equilibrium(const ContactModel &model, const Discretization &discretization,
                                   const ContactSolution &solution);

  /// What a solution says, for a person and for its certificate.
  struct ContactEvaluation
  {
    /// By pair; the same on all ranks.
    std::vector<PairResult> pairs;
    /// By contact node, pair after pair; on rank 0.
    std::vector<PressureRow> pressure, mortar_pressure;
    /// Reactions, and what is left of the forces.
    Equilibrium equilibrium;
  };

  /// Collective. All of the above.
  ContactEvaluation evaluate_contact(const ContactModel &model, const Discretization &discretization,
                                     const ContactSolution &solution);

  /// Collective. On the first mesh. Errors: InputError for points far outside of their bodies.
  void check_probes(const ContactModel &model, const NodalSpace &space, const std::vector<Probe> &probes);

  /// Collective. Errors: InputError for points outside of their bodies.
  std::vector<ProbeResult> evaluate_probes(const ContactModel &model, const Discretization &discretization,
                                           const ContactSolution &solution, const std::vector<Probe> &probes);
} // namespace Signorini

#endif
