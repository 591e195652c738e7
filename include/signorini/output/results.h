// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_results_h
#define signorini_output_results_h

#include <signorini/algebra/types.h>
#include <signorini/discretization/exact_error.h>
#include <signorini/mesh/node_movement.h>
#include <signorini/output/phase_times.h>
#include <signorini/output/told_rules.h>
#include <signorini/solvers/convergence_report.h>
#include <signorini/solvers/sweep_measurement.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/point.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// What one cycle of the nested iteration produced.
  struct CycleResult
  {
    /// Number of the mesh in the nested iteration, what it has (cells, unknowns, contact nodes,
    /// those of them with an active condition), and levels of the hierarchy.
    unsigned int cycle = 0;
    std::size_t  cells = 0, dofs = 0, contact_nodes = 0, active_nodes = 0;
    unsigned int levels = 0;
    /// Of the contact problem.
    ConvergenceReport nonlinear;
    /// The linear problem by multigrid and by conjugate gradients with it, from the same start.
    ConvergenceReport linear, linear_cg;
    bool              has_linear = false;
    /// Relative difference of the linear (conjugate gradients) and the nonlinear solution (energy norm).
    double difference = 0.;
    /// What boundary shapes did to the mesh of this cycle.
    MovementReport movement;
    /// Estimates of the energy norm of the error, and of the error of stresses as a part of them; 0 if they
    /// were not computed.
    double indicator = 0., stress_error = 0.;
    /// Energy norm of the difference to the solution of the last cycle, if cycles are compared.
    double error_to_last = 0.;
    /// ½uᵀAu - fᵀu, lifts included; where the indicator was computed and on the last mesh.
    double potential_energy = 0.;
    /// What the parts of a cycle took.
    SweepMeasurement sweeps;
    /// By body, where a known displacement was given.
    std::map<std::string, ExactError> exact_errors;
    PhaseTimes                        times;
  };

  /// What a contact pair does, after the last solve.
  struct PairResult
  {
    /// Of the pair, and of its two boundaries.
    std::string name, nonmortar, mortar;
    /// Force on either side; moment of the first about the origin; its centre of pressure.
    Vector3          force, force_on_mortar, moment;
    dealii::Point<3> centre;
    double           min_pressure = 0., max_pressure = 0., contact_area = 0., coverage = 0., min_gap = 0.,
           max_penetration = 0.;
    /// Over what gap between the true surfaces the contact forces act, in the mean (length).
    double loaded_gap          = 0.;
    double initial_penetration = 0., lost_area = 0.;
    /// Integral of the pressure where nodes are active (force).
    double load = 0.;
    /// Whether pressures largely cancel in the force, as in a press fit, so that the load is told beside it
    /// (CancellingPressureRule).
    bool pressures_cancel() const
    {
      return force.norm() < CancellingPressureRule().told * load;
    }
    /// What contact does (length): by how much bodies approach each other that touch on the contact area A
    /// with this force, 4/3 ∫p / (√A E*), 1/E* = sum of (1 - ν²)/E, as in Hertz' contact; what symmetry
    /// planes cut off belongs to both (count_symmetry_planes()). Zero without contact.
    double approach = 0.;
    /// By how much the gap may be wrong where bodies touch (length).
    double gap_doubt = 0.;
    /// |moment on nonmortar + moment on mortar| / (load √A).
    double moment_balance = 0.;
    /// Nodes without a multiplier although covered.
    std::size_t dropped_nodes = 0;
    /// Where the pressure is largest, the gap after the deformation least, and the doubt of the gap largest.
    dealii::Point<3> max_pressure_at, min_gap_at, gap_doubt_at;
    /// load / contact_area; the largest recovered pressure, which scatters less from node to node
    /// (recover_pressure()), and where it is.
    double           mean_pressure = 0., max_recovered_pressure = 0.;
    dealii::Point<3> max_recovered_pressure_at;
    /// How far nodal pressures are from the recovered ones: half of the load is on nodes whose pressure
    /// differs by this share of the recovered one or more. Noise of the mesh, or a contact too narrow for it.
    /// Zero for ties.
    double pressure_scatter = 0.;
    /// Whether that is so much that it is told, and pictures show the recovered pressure (ScatterRule).
    bool scatter_is_told() const
    {
      return pressure_scatter > ScatterRule().told;
    }
    /// Share of the load on nodes around which no face is in contact as a whole: pressures there are those of
    /// the mesh. Zero for ties.
    double narrow_share = 0.;
    /// Share of the load on nodes of sharp edges: they press along the mean of the normals of the faces that
    /// meet there, where those have no other node. Zero for ties.
    double share_on_edges = 0.;
    /// Whether that is so much that it is told (NarrowContactRule).
    bool is_narrow() const
    {
      return narrow_share > NarrowContactRule().told;
    }
    /// By how much the true surfaces penetrate each other where no force of the pair is near (length), beyond
    /// what is not known of them (MissedContactRule): a contact narrower than the faces. Where it is.
    double           missed_penetration = 0.;
    dealii::Point<3> missed_at;
    /// Largest penetration and approach of the part of the contact where their ratio is worst (lengths), or
    /// of all of it (ContactSpotRule); where it is.
    double           spot_penetration = 0., spot_approach = 0.;
    dealii::Point<3> spot_at;
    /// How far the surfaces slide on each other where they touch, or end up apart by less than that (length),
    /// and in multiples of the width of the faces there.
    double slip = 0., slip_in_faces = 0.;
    /// The part of the force on nodes that only their slip presses: along their normals they come nearer,
    /// along those of the other side they do not.
    double pressed_by_slip = 0.;
  };

  /// What happens to a body, after the last solve.
  struct BodyResult
  {
    /// As the parameter file names it.
    std::string name;
    /// Length of the displacement and von Mises stress, the largest at nodes; where.
    double           largest_displacement = 0., largest_von_mises = 0.;
    dealii::Point<3> displacement_at, von_mises_at;
    /// Sums of what acts on it: loads (and their moment about the origin), reactions of prescribed
    /// displacements, contact.
    Vector3 load, load_moment, reaction, contact;
    /// Largest angle (radians) and absolute value of the principal strains, at the centres of cells.
    double largest_rotation = 0., largest_strain = 0.;
    /// Estimated error of the stresses as a part of their energy norm (NodalStress::errors()).
    double stress_error = 0.;

    /// By about which part displacements under given forces are too small: energies of the error and of the
    /// solution add up, and cells that cannot bend make a body stiffer.
    double missing_compliance() const
    {
      return stress_error * stress_error;
    }
  };

  /// The forces that hold a boundary with prescribed displacements.
  struct BoundaryResult
  {
    /// Of the body and the boundary; sum of the nodal forces.
    std::string body, name;
    Vector3     reaction;
  };

  /// The displacement at a point of a body (lengths).
  struct ProbeResult
  {
    /// As the parameter file names it; where; displacement.
    std::string      name;
    dealii::Point<3> point;
    Vector3          displacement;
  };

  /// Each number relative to the scale that is stated beside it.
  struct Certificate
  {
    /// Largest n·û - g over the contact nodes / largest displacement.
    double penetration = 0.;
    /// Largest penetration of the true surfaces, sampled at points of all overlay cells / approach of the
    /// pair (consistency error of the discretization, not of the solver).
    double geometric_penetration = 0.;
    /// Largest PairResult::loaded_gap / approach of the pair: forces where nothing touches.
    double loaded_gap = 0.;
    /// Largest PairResult::gap_doubt / approach of the pair.
    double gap_doubt = 0.;
    /// Largest tension / largest pressure.
    double tension = 0.;
    /// Largest pressure times opening / (largest pressure times largest displacement).
    double complementarity = 0.;
    /// Residual of the equilibrium including contact forces, physical basis / norm of the nodal forces.
    double equilibrium = 0.;
    /// |force on nonmortar + force on mortar| / load.
    double force_balance = 0.;
    /// Largest PairResult::moment_balance.
    double moment_balance = 0.;
    /// Largest |sum of loads, reactions and contact forces| of a body / sum of their norms, and the same of
    /// their moments about its centre / (that sum times its size).
    double body_force_balance = 0., body_moment_balance = 0.;
    /// Why the contact conditions do not hold, with what to try; empty if they do.
    std::vector<std::string> objections;
    /// Numbers of the pairs whose mapping has errors where the bodies touch, or within two faces of it.
    std::vector<unsigned int> wrongly_mapped_pairs;
    /// ½vᵀÂv - b̂ᵀv.
    double energy = 0.;
    /// ½uᵀAu - fᵀu, lifts included.
    double potential_energy = 0.;
  };

  /// One row of pressure.csv.
  struct PressureRow
  {
    /// Of the node (lengths).
    dealii::Point<3> position;
    /// area: integral of the node's dual function; area times pressure sums up to the force.
    double area, pressure, recovered_pressure, gap;
    bool   active;
    /// Number of the pair, and of the node in the mesh of this run and in the mesh file
    /// (VolumeMesh::no_number where there is none).
    unsigned int pair      = 0;
    NodeIndex    node      = 0;
    long         mesh_node = -1;
    /// Outward unit normal of the surface that the node lies on.
    Vector3 normal = Vector3();
  };

  /// The contact mapping of a pair, over all ranks.
  struct MappingResult
  {
    /// Name of the pair and what its mapping covers.
    std::string    pair;
    MappingReport  report;
    MappingQuality quality;
    /// Seconds, of the slowest rank, on the last mesh.
    double time = 0.;
    /// Whether errors of the mapping, if there are any, can matter: not if none is near where the bodies
    /// touch.
    bool errors_matter = true;
  };

  /// A bolt's shank whose section carries a given force.
  struct PretensionResult
  {
    /// Of the body, and what the parameter file calls it.
    std::string body, name;
    /// The force that was asked for, and that of the section.
    double wanted = 0., force = 0.;
    /// Shortening per length without stress; length of the shank; strain times length (length).
    double strain = 0., length = 0., shortening = 0.;
    /// Of each of the solutions by which the strain was found on the last mesh.
    std::vector<unsigned int> iterations;
    /// The pseudo-time at which the strain was found that is kept; none where it is sought.
    std::optional<double> locked_after;
  };

  /// One load step.
  struct StepResult
  {
    /// The pseudo-time t.
    double time = 0.;
    /// Of the solver; contact nodes that are active.
    ConvergenceReport report;
    std::size_t       active_nodes = 0;
    /// As in Results.
    std::vector<PairResult>       pairs;
    std::vector<BoundaryResult>   boundaries;
    std::vector<ProbeResult>      probes;
    std::vector<PretensionResult> pretensions;
  };

  /// All that is reported about a run.
  struct Results
  {
    /// What was run, and on how many ranks.
    std::string  version, parameter_file, title;
    unsigned int ranks = 1;
    /// Whether the iteration converged on all meshes; time (s), peak memory of all ranks together (bytes).
    bool   converged = true;
    double wall_time = 0., peak_memory = 0.;
    /// A line for each mesh, and the results on the last one.
    std::vector<CycleResult>      cycles;
    std::vector<PairResult>       pairs;
    std::vector<MappingResult>    mappings;
    std::vector<BoundaryResult>   boundaries;
    std::vector<BodyResult>       bodies;
    std::vector<ProbeResult>      probes;
    Certificate                   certificate;
    std::vector<PretensionResult> pretensions;
    /// Load steps, if there were any; the last is what is in the rest of the results.
    std::vector<StepResult> steps;
    /// Norm of the nodal forces before reactions and contact forces are taken off (force).
    double largest_nodal_force = 0.;
    /// At the nodes with a multiplier, which lie on the nonmortar surfaces; what arrives at the nodes of the
    /// mortar surfaces. On rank 0.
    std::vector<PressureRow> pressure, mortar_pressure;
    /// Remarks and warnings for the user.
    std::vector<std::string> notes;
  };
} // namespace Signorini

#endif
