// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_problem_h
#define signorini_application_contact_problem_h

#include <signorini/application/parameters.h>
#include <signorini/discretization/basis_transformation.h>
#include <signorini/discretization/level_hierarchy.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/mesh/refinement.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/rigid_obstacle.h>
#include <signorini/output/progress.h>
#include <signorini/output/results.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <memory>

namespace Signorini
{
  /// One contact pair on the current mesh.
  struct ContactPair
  {
    std::string    name;
    unsigned int   nonmortar_body, mortar_body;
    std::string    nonmortar_name, mortar_name;
    ContactSurface nonmortar, mortar;
    /// Boundary ids of the two sides.
    std::set<dealii::types::boundary_id> nonmortar_ids, mortar_ids;
    /// With a rigid obstacle the mortar surface is empty and there is no mapping.
    std::unique_ptr<ContactMapping> mapping;
    std::unique_ptr<RigidObstacle>  obstacle;
    /// Seconds it took.
    double                   mapping_time = 0.;
    std::vector<FaceMoments> moments;
    GapFunction              prescribed_gap;
  };

  /// All that belongs to one mesh of the nested iteration.
  struct Discretization
  {
    std::shared_ptr<const NodalSpace> space;
    std::unique_ptr<NodePartition>    partition;
    DirichletData                     dirichlet;
    std::vector<FreeMotion>           free_motions;
    std::vector<ContactPair>          pairs;
    std::vector<PairCoupling>         couplings;
    InterfaceCoupling                 coupling;
    /// Per row of the coupling: pair and row in the pair, A_p with the normal, gap.
    std::vector<std::pair<unsigned int, std::size_t>> origin;
    std::vector<RowProjection>                        projections;
    std::vector<double>                               gaps;
    std::unique_ptr<BasisTransformation>              transformation;
    /// Physical displacement on `partition`, ghosts up to date.
    Vector displacement;
    /// Per row: whether the pair is tied (û_p = 0) instead of in contact.
    std::vector<unsigned char> tied;
    /// Per row: contact stress, its normal part (the pressure), opening g - n·û, whether active.
    std::vector<Vector3>       traction;
    std::vector<double>        pressure, opening;
    std::vector<unsigned char> active;
    /// A body that only a tie holds: its decoupled linear problem has no unique solution.
    bool is_held_by_ties = false;

    bool has_ties() const
    {
      return std::find(tied.begin(), tied.end(), 1) != tied.end();
    }
  };

  /// Reads a problem, runs the nested iteration, collects results. Owns the objects; the algorithms are
  /// elsewhere.
  class ContactProblem
  {
  public:
    /// Collective. `out` prints on rank 0 only.
    ContactProblem(ProblemParameters &parameters, const MPI_Comm communicator,
                   dealii::ConditionalOStream &out);

    /// Solves all cycles.
    void run();

    /// Builds the meshes of all cycles and the contact mapping of the last, solves nothing.
    void build_meshes();

    /// Prints bodies, boundaries, and the range of the gap of each pair.
    void describe();

    Results results;

    Discretization discretization;

    const Bodies &body_data() const
    {
      return bodies;
    }

  private:
    struct PairDefinition
    {
      PairParameters parameters;
      unsigned int   body[2];
      std::string    boundary[2];
      Expression     region[2];
      bool           has_region[2];
      SurfaceShapes  shapes[2];
      Expression     gap;
      bool           has_gap;
      RigidObstacle  obstacle;
      bool           has_obstacle;
      /// Whether an automatic choice of the nonmortar side was turned round, because the other side left
      /// contact without multipliers.
      bool is_swapped = false;

      unsigned int n_sides() const
      {
        return has_obstacle ? 1 : 2;
      }
    };

    void define_pairs();
    void setup_space();
    /// Pairs that are tied (ties.cc).
    void hold_by_ties();
    void tie_lift();
    void tie_unknowns(LinearSystem &system) const;
    void evaluate_ties();
    void setup_contact(CycleResult &cycle);
    void couple_pairs();
    /// Pairs that lose contact because of conditions or other pairs, or begin with an overlap that makes no
    /// sense (contact_checks.cc). Turns automatic choices of sides round where that helps; whether it did.
    bool   swap_sides(CycleResult &cycle);
    void   refuse_lost_contact() const;
    void   refuse_dense_coupling() const;
    void   refuse_held_overlap(const unsigned int pair) const;
    double initial_overlap(const ContactPair &pair) const;
    void   refuse_large_overlap(const unsigned int pair, const double overlap) const;
    /// The other pairs that need nodes of a pair's nonmortar side.
    std::string            rivals_of(const unsigned int pair) const;
    double                 width_of(const unsigned int body) const;
    std::set<unsigned int> parts_of(const PairDefinition &definition, const unsigned int side) const;
    ContactPair            make_pair(const PairDefinition &definition, CycleResult &cycle);
    void                   map_pair(ContactPair &pair, CycleResult &cycle);
    void                   use_nodal_gaps(PairCoupling &coupling, const ContactPair &pair) const;
    unsigned int choose_nonmortar(const PairDefinition &definition, const ContactSurface (&surfaces)[2]);
    void         solve_cycle(CycleResult &cycle);
    /// Half-spaces of the contact nodes that a rank owns; bounds as BasisTransformation::reduce_gaps() gives
    /// them.
    HalfSpaces make_half_spaces(const NodePartition &partition, const std::vector<double> &bounds) const;
    /// @param start null, or what the active set is guessed from
    std::unique_ptr<MultigridHierarchy> make_hierarchy(LinearSystem &&system, const LevelSpaces &levels,
                                                       const ObstacleProblem &problem,
                                                       const Vector *const    start) const;
    /// Bodies that are not held by Dirichlet conditions (free_bodies.cc): whether they can be in contact at
    /// all; whether contact can hold them against their loads; what remains undetermined.
    void check_free_bodies();
    void hold_free_bodies(Vector &v, ObstacleProblem &problem, MultigridHierarchy &hierarchy,
                          const bool settle);
    void remove_free_motions(Vector &v, const ObstacleProblem &problem, MultigridHierarchy &hierarchy,
                             const std::vector<unsigned char> &active);
    std::vector<Vector> motions_of_unknowns(const NodePartition       &partition,
                                            const BasisTransformation &transformation) const;
    void evaluate_contact(const Vector &v, const ObstacleProblem &problem, const NodeBlockMatrix &matrix,
                          const std::vector<double> &bounds, const std::vector<unsigned char> &active);
    void solve_linear(CycleResult &cycle, const LevelSpaces &levels, const Vector &start);
    bool refine(const std::vector<bool> &marked);
    /// A displacement of the old space, on the current one.
    Vector interpolate(const Vector &old, const NodeRows &rows, const NodalSpace &old_space) const;
    void   compare_cycles();
    /// Squared error indicators of the cells of the space; the cells that a cycle refines (adaptivity.cc).
    std::vector<double> estimate();
    std::vector<bool>   mark(const unsigned int cycle, const std::vector<double> &indicator);
    void                finish();
    void                certify();
    void                object();
    /// In words; empty if there are none.
    std::string errors_in_contact(const unsigned int pair) const;
    /// E times largest displacement times width of the contact surfaces (force).
    double force_scale() const;
    void   measure_contact(PairResult &result, const unsigned int p, const std::vector<bool> &is_active,
                           const ContactForces &forces) const;
    /// Of the owned nodes.
    std::vector<unsigned int> bodies_of_nodes() const;
    void                      collect_pairs();
    void                      collect_reactions();
    void                      collect_probes();
    void                      compare_with_exact(CycleResult &cycle);
    void                      note(const std::string &text);
    void                      note_movement();
    /// A line on the terminal of rank 0.
    void print(const std::string &line);

    ProblemParameters          &parameters;
    const MPI_Comm              comm;
    dealii::ConditionalOStream &out;
    Bodies                      bodies;
    CoarserSpaces               coarser_spaces;
    Loads                       loads;
    Refinement                  refinement;
    std::vector<PairDefinition> pair_definitions;
    Progress                    progress;
    /// Those of the cycles before, interpolated to the current mesh, if they are to be compared.
    std::vector<Vector> earlier_displacements;
    dealii::Timer       total_time;
  };
} // namespace Signorini

#endif
