// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_run_state_h
#define signorini_application_run_state_h

#include <signorini/application/contact_solve.h>
#include <signorini/mesh/curve_order.h>
#include <signorini/output/checkpoint_file.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// Values on a mesh in the lists of CurveOrder: this rank's pieces, hexahedra and tetrahedra.
  template <typename T>
  using CurvePieces = std::array<std::vector<T>, CurveOrder::n_kinds>;

  /// Three values for each node.
  using SavedField = CurvePieces<double>;

  /// What is known of a bolt (Pretension).
  struct SavedBolt
  {
    /// As there.
    double              strain = 0., reached = 0.;
    std::vector<double> slopes;
  };

  /// The contact stress of a row of the joined coupling.
  struct SavedContact
  {
    /// Place of the node in its list (CurveOrder).
    std::uint64_t node;
    /// As in ContactStress.
    double traction[3], pressure, opening, active;
  };

  /// The nested iteration after a cycle. The meshes are rebuilt by refining the first one again as it was
  /// refined before: that gives the same numbers to tetrahedra and puts vertices on curved boundaries where
  /// they were.
  struct NestedState
  {
    /// The last cycle that was solved.
    unsigned int cycle = 0;
    /// What was marked on one mesh after the other, 1 or 0 by cell.
    std::vector<CurvePieces<unsigned char>> marked;
    /// CurveOrder::trace() of the mesh.
    double trace = 0.;
    /// As in Discretization.
    std::vector<PairChoice> choices;
    /// By bolt of the model.
    std::vector<SavedBolt> bolts;
    /// Of the model.
    std::vector<PointHold> holds;
    /// Of the cycles so far; whether all of them converged.
    std::vector<CycleResult> cycles;
    bool                     converged = true;
    /// Of the solution, without fields.
    ContactSolution solution;
    SavedField      displacement;
    /// Where cycles are compared, the solutions of those before, on the mesh of this one.
    std::vector<SavedField> earlier;
    /// Error indicators by cell; empty where they were not computed.
    CurvePieces<double> indicator;
    bool                has_indicator = false;
    /// Sorted by node.
    CurvePieces<SavedContact> contact;
  };

  /// A series of load steps on the last mesh.
  struct SeriesState
  {
    /// Those that are done, from the first on.
    std::vector<StepResult> steps;
    /// Times of the last two of them (0 before the first), and their displacements.
    double                 time_previous = 0., time_before = 0.;
    SavedField             previous, before;
    std::vector<SavedBolt> bolts;
    bool                   converged = true, needed_patches = false;
  };

  /// All that determines the rest of a run, beside its input.
  struct RunState
  {
    /// Of the meshes, and of the load steps, if those have begun.
    NestedState                nested;
    std::optional<SeriesState> series;
    /// Of the journal.
    std::vector<std::string> notes;
    /// Seconds up to here, of all runs that came one after the other.
    double wall_time = 0.;
    /// The files that load steps have left, with their sizes.
    std::vector<std::pair<std::string, std::uint64_t>> files;
    /// Where they are: a folder beside the state.
    std::string folder_of_files;
  };

  /// Adds the sections of a state.
  void write_state(CheckpointWriter &writer, const RunState &state);

  /// What is the same on all ranks. Fields are empty. Errors: InputError for sections that are missing.
  RunState read_state(const CheckpointReader &reader);

  /// Collective. What was marked on the k-th mesh, which `order` belongs to.
  void read_marks(NestedState &state, const CheckpointReader &reader, const unsigned int k,
                  const CurveOrder &order);

  /// Collective. The fields, on the mesh that all marks led to. Errors: InputError for another mesh than the
  /// one that the state was written for.
  void read_fields(RunState &state, const CheckpointReader &reader, const CurveOrder &order);

  /// Values at the owned nodes, in the order of a state.
  SavedField save_field(const Vector &field, const NodePartition &partition, const CurveOrder &order);

  /// Collective. The other way round; ghosts are up to date.
  void restore_field(Vector &field, const SavedField &values, const NodePartition &partition,
                     const CurveOrder &order);

  /// Collective. The contact stress of a solution in the order of a state.
  CurvePieces<SavedContact> save_stress(const ContactStress &stress, const Discretization &discretization,
                                        const CurveOrder &order);

  /// Collective. The other way round.
  ContactStress restore_stress(const CurvePieces<SavedContact> &contact, const Discretization &discretization,
                               const CurveOrder &order);

  /// What is known of the bolts of a model.
  std::vector<SavedBolt> save_bolts(const std::vector<Pretension> &bolts);

  /// The other way round.
  void restore_bolts(std::vector<Pretension> &bolts, const std::vector<SavedBolt> &saved);
} // namespace Signorini

#endif
