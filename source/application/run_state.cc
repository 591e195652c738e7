// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/byte_archive.h>
#include <signorini/algebra/input_error.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/application/run_state.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    const std::array<std::string, CurveOrder::n_kinds> kinds = {{" hexahedra", " tetrahedra"}};
  }

  template <typename Archive>
  void transfer(Archive &a, SafetyNetReport &r)
  {
    a(r.after, r.rate, r.n_steps, r.n_failed, r.linear_solver);
  }

  template <typename Archive>
  void transfer(Archive &a, ConvergenceReport &r)
  {
    a(r.converged, r.stagnated, r.iterations, r.start_iterations, r.linear_cycles, r.history, r.scale);
    a(r.active_nodes, r.energy, r.rate, r.hierarchy_updates, r.subspace_minimizations);
    a(r.needed_interface_sweeps, r.needed_patches, r.before_patches, r.checked_substeps,
      r.largest_energy_rise, r.largest_violation, r.safety_net, r.note);
  }

  template <typename Archive>
  void transfer(Archive &a, MovementReport &r)
  {
    a(r.quality_before, r.quality_after, r.n_moved, r.n_damped, r.late);
  }

  template <typename Archive>
  void transfer(Archive &a, SweepMeasurement &r)
  {
    a(r.time, r.bytes_per_second, r.read_bytes_per_second);
  }

  template <typename Archive>
  void transfer(Archive &a, ExactError &r)
  {
    a(r.l2, r.l2_norm, r.energy, r.energy_norm);
  }

  template <typename Archive>
  void transfer(Archive &a, PhaseTimes &times)
  {
    for (std::size_t i = 0; i < PhaseTimes::n_phases; ++i)
      {
        const double before  = times[static_cast<Phase>(i)];
        double       seconds = before;
        a(seconds);
        times.add(static_cast<Phase>(i), seconds - before);
      }
  }

  template <typename Archive>
  void transfer(Archive &a, CycleResult &r)
  {
    a(r.cycle, r.cells, r.dofs, r.contact_nodes, r.active_nodes, r.levels, r.nonlinear, r.linear,
      r.linear_cg);
    a(r.has_linear, r.difference, r.movement, r.indicator, r.stress_error, r.error_to_last,
      r.potential_energy, r.sweeps);
    a(r.exact_errors, r.times);
  }

  template <typename Archive>
  void transfer(Archive &a, PairResult &r)
  {
    a(r.name, r.nonmortar, r.mortar, r.force, r.force_on_mortar, r.moment, r.centre, r.min_pressure);
    a(r.max_pressure, r.contact_area, r.coverage, r.min_gap, r.max_penetration, r.initial_penetration);
    a(r.loaded_gap, r.lost_area, r.load, r.approach, r.gap_doubt, r.moment_balance, r.dropped_nodes,
      r.max_pressure_at, r.min_gap_at, r.gap_doubt_at);
    a(r.slip, r.slip_in_faces, r.mean_pressure, r.max_recovered_pressure, r.max_recovered_pressure_at,
      r.pressure_scatter, r.narrow_share, r.share_on_edges, r.missed_penetration);
    a(r.missed_at, r.spot_penetration, r.spot_approach, r.spot_at);
  }

  template <typename Archive>
  void transfer(Archive &a, BoundaryResult &r)
  {
    a(r.body, r.name, r.reaction);
  }

  template <typename Archive>
  void transfer(Archive &a, ProbeResult &r)
  {
    a(r.name, r.point, r.displacement);
  }

  template <typename Archive>
  void transfer(Archive &a, PretensionResult &r)
  {
    a(r.body, r.name, r.wanted, r.force, r.strain, r.length, r.shortening, r.iterations, r.locked_after);
  }

  template <typename Archive>
  void transfer(Archive &a, StepResult &r)
  {
    a(r.time, r.report, r.active_nodes, r.pairs, r.boundaries, r.probes, r.pretensions);
  }

  template <typename Archive>
  void transfer(Archive &a, PartingPair &p)
  {
    a(p.other, p.shift);
  }

  template <typename Archive>
  void transfer(Archive &a, PairChoice &s)
  {
    a(s.is_second, s.is_turned, s.partings);
  }

  template <typename Archive>
  void transfer(Archive &a, SavedBolt &r)
  {
    a(r.strain, r.reached, r.slopes);
  }

  template <typename Archive>
  void transfer(Archive &a, PartMotion &m)
  {
    a(m.part, m.at_origin, m.rotation);
  }

  template <typename Archive>
  void transfer(Archive &a, PointHold &h)
  {
    a(h.body, h.start_vertex, h.component, h.position, h.value, h.moves, h.motion, h.is_translation, h.arm,
      h.largest_share);
  }

  namespace
  {
    /// What the nested iteration leaves that is the same on all ranks.
    template <typename Archive>
    void transfer_common(Archive &a, NestedState &s)
    {
      auto n_marked  = static_cast<std::uint64_t>(s.marked.size());
      auto n_earlier = static_cast<std::uint64_t>(s.earlier.size());
      a(s.cycle, n_marked, s.trace, s.choices, s.bolts, s.holds, s.cycles, s.converged, n_earlier,
        s.has_indicator);
      a(s.solution.report, s.solution.pretensions, s.solution.n_active, s.solution.n_levels);
      s.marked.resize(n_marked);
      s.earlier.resize(n_earlier);
    }

    template <typename Archive>
    void transfer_common(Archive &a, SeriesState &s)
    {
      a(s.steps, s.time_previous, s.time_before, s.bolts, s.converged, s.needed_patches);
    }

    template <typename Archive>
    void transfer_common(Archive &a, RunState &s)
    {
      a(s.notes, s.wall_time, s.files, s.folder_of_files);
      transfer_common(a, s.nested);
      bool has_series = s.series.has_value();
      a(has_series);
      if (has_series && !s.series)
        s.series.emplace();
      if (has_series)
        transfer_common(a, *s.series);
    }

    /// All fields with three values for each node, by the names of their sections.
    template <typename F>
    void for_each_field(RunState &state, const F &action)
    {
      action("displacement", state.nested.displacement);
      for (std::size_t i = 0; i < state.nested.earlier.size(); ++i)
        action("earlier displacement " + std::to_string(i), state.nested.earlier[i]);
      if (!state.series)
        return;
      action("displacement of the step before", state.series->previous);
      action("displacement of the second step before", state.series->before);
    }

    std::string marks_name(const unsigned int k)
    {
      return "marks " + std::to_string(k);
    }
  } // namespace



  void write_state(CheckpointWriter &writer, const RunState &constant_state)
  {
    // The archive runs over the members in both directions.
    auto      &state = const_cast<RunState &>(constant_state);
    ByteWriter common;
    transfer_common(common, state);
    writer.add("common", common.bytes());
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      {
        for (unsigned int k = 0; k < state.nested.marked.size(); ++k)
          writer.add(marks_name(k) + kinds[kind], state.nested.marked[k][kind]);
        for_each_field(state, [&](const std::string &name, const SavedField &field) {
          writer.add(name + kinds[kind], field[kind]);
        });
        writer.add("indicator" + kinds[kind], state.nested.indicator[kind]);
        writer.add("contact" + kinds[kind], state.nested.contact[kind]);
      }
  }



  RunState read_state(const CheckpointReader &reader)
  {
    RunState   state;
    ByteReader common(reader.text("common"));
    transfer_common(common, state);
    return state;
  }



  void read_marks(NestedState &state, const CheckpointReader &reader, const unsigned int k,
                  const CurveOrder &order)
  {
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      state.marked[k][kind] =
          reader.read_piece<unsigned char>(marks_name(k) + kinds[kind], order.cells(kind).size());
  }



  namespace
  {
    /// The first row at a node or behind it.
    std::uint64_t lower_bound(const CheckpointReader &reader, const std::string &section,
                              const std::uint64_t node)
    {
      std::uint64_t low = 0, high = reader.size(section);
      while (low < high)
        {
          const std::uint64_t middle = low + (high - low) / 2;
          if (reader.read<SavedContact>(section, middle, 1)[0].node < node)
            low = middle + 1;
          else
            high = middle;
        }
      return low;
    }
  } // namespace



  void read_fields(RunState &state, const CheckpointReader &reader, const CurveOrder &order)
  {
    // Sums in another order differ by rounding; one node in another place shows.
    constexpr double rounding = 1e-11;
    if (!(std::abs(order.trace() - state.nested.trace) <= rounding))
      throw InputError("belongs to other meshes than this program makes of the same input.");
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      {
        const std::size_t n_nodes = order.nodes(kind).size();
        for_each_field(state, [&](const std::string &name, SavedField &field) {
          field[kind] = reader.read_piece<double>(name + kinds[kind], dim * n_nodes);
        });
        if (state.nested.has_indicator)
          state.nested.indicator[kind] =
              reader.read_piece<double>("indicator" + kinds[kind], order.cells(kind).size());
        const std::string   name  = "contact" + kinds[kind];
        const std::uint64_t begin = lower_bound(reader, name, order.first_node(kind)),
                            end   = lower_bound(reader, name, order.first_node(kind) + n_nodes);
        state.nested.contact[kind] =
            reader.read<SavedContact>(name, begin, static_cast<std::size_t>(end - begin));
      }
  }



  SavedField save_field(const Vector &field, const NodePartition &partition, const CurveOrder &order)
  {
    SavedField values;
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      for (const NodeIndex node : order.nodes(kind))
        for (unsigned int c = 0; c < dim; ++c)
          values[kind].push_back(field.local_element(dim * partition.to_local(node) + c));
    return values;
  }



  void restore_field(Vector &field, const SavedField &values, const NodePartition &partition,
                     const CurveOrder &order)
  {
    partition.reinit(field);
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      for (std::size_t i = 0; i < order.nodes(kind).size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          field.local_element(dim * partition.to_local(order.nodes(kind)[i]) + c) = values[kind][dim * i + c];
    field.update_ghost_values();
  }



  CurvePieces<SavedContact> save_stress(const ContactStress &stress, const Discretization &d,
                                        const CurveOrder &order)
  {
    CurvePieces<SavedContact> contact;
    const auto               &rows = d.coupling.rows;
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      for (std::size_t i = 0; i < order.nodes(kind).size(); ++i)
        {
          const auto it = std::lower_bound(rows.begin(), rows.end(), order.nodes(kind)[i]);
          if (it == rows.end() || *it != order.nodes(kind)[i])
            continue;
          const std::size_t p = it - rows.begin();
          const Vector3    &t = stress.traction[p];
          contact[kind].push_back({order.first_node(kind) + i,
                                   {t[0], t[1], t[2]},
                                   stress.pressure[p],
                                   stress.opening[p],
                                   static_cast<double>(stress.active[p])});
        }
    return contact;
  }



  ContactStress restore_stress(const CurvePieces<SavedContact> &contact, const Discretization &d,
                               const CurveOrder &order)
  {
    Vector traction, others;
    d.partition().reinit(traction);
    d.partition().reinit(others);
    for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
      for (const SavedContact &row : contact[kind])
        {
          const NodeIndex    node = order.nodes(kind)[row.node - order.first_node(kind)];
          const unsigned int i    = d.partition().to_local(node);
          for (unsigned int c = 0; c < dim; ++c)
            traction.local_element(dim * i + c) = row.traction[c];
          others.local_element(dim * i)     = row.pressure;
          others.local_element(dim * i + 1) = row.opening;
          others.local_element(dim * i + 2) = row.active;
        }
    ContactStress stress = no_stress(d);
    stress.traction      = import_values(d.partition(), traction, d.coupling.rows);
    const auto values    = import_values(d.partition(), others, d.coupling.rows);
    for (std::size_t p = 0; p < values.size(); ++p)
      {
        stress.pressure[p] = values[p][0];
        stress.opening[p]  = values[p][1];
        stress.active[p]   = values[p][2] != 0.;
      }
    return stress;
  }



  std::vector<SavedBolt> save_bolts(const std::vector<Pretension> &bolts)
  {
    std::vector<SavedBolt> saved;
    for (const Pretension &bolt : bolts)
      saved.push_back({bolt.strain, bolt.reached, bolt.slopes});
    return saved;
  }



  void restore_bolts(std::vector<Pretension> &bolts, const std::vector<SavedBolt> &saved)
  {
    for (std::size_t i = 0; i < std::min(bolts.size(), saved.size()); ++i)
      {
        bolts[i].strain  = saved[i].strain;
        bolts[i].reached = saved[i].reached;
        bolts[i].slopes  = saved[i].slopes;
      }
  }
} // namespace Signorini
