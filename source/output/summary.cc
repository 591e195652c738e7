// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/final_words.h>
#include <signorini/output/json_writer.h>
#include <signorini/output/summary.h>

#include "csv_text.h"

#include <iomanip>

namespace Signorini
{
  namespace
  {
    void write_solver(JsonWriter &json, const ConvergenceReport &report)
    {
      json.number("iterations", report.iterations);
      if (report.linear_cycles > 0)
        json.number("amg_cycles", report.linear_cycles);
      json.number("rate", report.rate);
      json.begin('[', "history");
      for (const double correction : report.history)
        json.number("", correction);
      json.end(']');
      if (report.stagnated)
        json.text("stagnated", report.note);
      if (report.needed_patches)
        json.number("patches_after_iterations", report.before_patches);
      if (report.safety_net.after > 0)
        {
          json.begin('{', "safety_net");
          json.number("after_iterations", report.safety_net.after);
          json.number("rate", report.safety_net.rate);
          json.number("active_set_steps", report.safety_net.n_steps);
          json.number("failed_attempts", report.safety_net.n_failed);
          json.text("linear_solver", report.safety_net.linear_solver);
          json.end('}');
        }
      if (report.checked_substeps > 0)
        {
          json.begin('{', "monotonicity");
          json.number("substeps", report.checked_substeps);
          json.number("largest_energy_rise", report.largest_energy_rise);
          json.number("largest_violation", report.largest_violation);
          json.end('}');
        }
    }

    void write_exact_errors(JsonWriter &json, const std::map<std::string, ExactError> &errors)
    {
      json.begin('{', "exact");
      for (const auto &[body, error] : errors)
        {
          json.begin('{', body);
          json.number("l2_error", error.l2);
          json.number("l2_norm", error.l2_norm);
          json.number("energy_error", error.energy);
          json.number("energy_norm", error.energy_norm);
          json.end('}');
        }
      json.end('}');
    }

    void write_movement(JsonWriter &json, const MovementReport &movement)
    {
      json.begin('{', "boundary_shapes");
      json.number("moved_nodes", movement.n_moved);
      json.number("nodes_not_yet_there", movement.n_damped);
      json.number("worst_quality_before", movement.quality_before);
      json.number("worst_quality_after", movement.quality_after);
      json.end('}');
    }

    void write_nonlinear(JsonWriter &json, const ConvergenceReport &report)
    {
      json.begin('{', "nonlinear");
      write_solver(json, report);
      json.number("hierarchy_updates", report.hierarchy_updates);
      json.number("subspace_minimizations", report.subspace_minimizations);
      json.boolean("needed_interface_sweeps", report.needed_interface_sweeps);
      json.boolean("needed_patches", report.needed_patches);
      if (!report.start_iterations.empty())
        {
          json.begin('[', "start_iterations");
          for (const unsigned int n : report.start_iterations)
            json.number("", n);
          json.end(']');
        }
      json.end('}');
    }

    void write_linear(JsonWriter &json, const CycleResult &cycle)
    {
      json.begin('{', "linear");
      write_solver(json, cycle.linear);
      json.end('}');
      json.begin('{', "linear_cg");
      write_solver(json, cycle.linear_cg);
      json.number("difference", cycle.difference);
      json.end('}');
    }

    void write_times(JsonWriter &json, const CycleResult &cycle)
    {
      json.number("sweep_time_s", cycle.sweeps.time);
      json.number("sweep_bytes_per_s", cycle.sweeps.bytes_per_second);
      json.number("read_bytes_per_s", cycle.sweeps.read_bytes_per_second);
      json.begin('{', "times_s");
      for (std::size_t i = 0; i < PhaseTimes::n_phases; ++i)
        json.number(PhaseTimes::names[i], cycle.times[static_cast<Phase>(i)]);
      json.end('}');
    }

    void write_cycle(JsonWriter &json, const CycleResult &cycle)
    {
      json.begin('{');
      json.number("cycle", cycle.cycle);
      json.number("levels", cycle.levels);
      json.number("cells", cycle.cells);
      json.number("dofs", cycle.dofs);
      json.number("contact_nodes", cycle.contact_nodes);
      json.number("active_nodes", cycle.active_nodes);
      json.number("energy", cycle.nonlinear.energy);
      if (!cycle.exact_errors.empty())
        write_exact_errors(json, cycle.exact_errors);
      if (cycle.movement.n_moved > 0 || cycle.movement.quality_after < 1.)
        write_movement(json, cycle.movement);
      if (cycle.potential_energy != 0.)
        json.number("potential_energy", cycle.potential_energy);
      if (cycle.error_to_last > 0.)
        json.number("error_to_last_cycle", cycle.error_to_last);
      if (cycle.indicator > 0.)
        {
          json.number("indicator", cycle.indicator);
          json.number("stress_error", cycle.stress_error);
        }
      write_nonlinear(json, cycle.nonlinear);
      if (cycle.has_linear)
        write_linear(json, cycle);
      write_times(json, cycle);
      json.end('}');
    }

    void write_pair(JsonWriter &json, const PairResult &pair)
    {
      json.begin('{');
      json.text("name", pair.name);
      json.text("nonmortar", pair.nonmortar);
      json.text("mortar", pair.mortar);
      json.vector("force", pair.force);
      json.vector("force_on_mortar", pair.force_on_mortar);
      json.vector("moment", pair.moment);
      json.vector("centre_of_pressure", Vector3(pair.centre));
      json.number("load", pair.load);
      json.boolean("pressures_cancel", pair.pressures_cancel());
      json.number("approach", pair.approach);
      json.number("gap_doubt", pair.gap_doubt);
      json.number("moment_balance", pair.moment_balance);
      json.number("min_pressure", pair.min_pressure);
      json.number("max_pressure", pair.max_pressure);
      json.number("mean_pressure", pair.mean_pressure);
      json.number("max_recovered_pressure", pair.max_recovered_pressure);
      json.vector("max_recovered_pressure_at", Vector3(pair.max_recovered_pressure_at));
      json.number("pressure_scatter", pair.pressure_scatter);
      json.boolean("scatter_is_told", pair.scatter_is_told());
      json.number("narrow_share", pair.narrow_share);
      json.number("share_on_edges", pair.share_on_edges);
      json.number("missed_penetration", pair.missed_penetration);
      json.vector("missed_at", Vector3(pair.missed_at));
      json.number("spot_penetration", pair.spot_penetration);
      json.number("spot_approach", pair.spot_approach);
      json.vector("spot_at", Vector3(pair.spot_at));
      json.boolean("is_narrow", pair.is_narrow());
      json.number("contact_area", pair.contact_area);
      json.number("coverage", pair.coverage);
      json.number("min_gap", pair.min_gap);
      json.vector("min_gap_at", Vector3(pair.min_gap_at));
      json.vector("gap_doubt_at", Vector3(pair.gap_doubt_at));
      json.number("max_penetration", pair.max_penetration);
      json.number("loaded_gap", pair.loaded_gap);
      json.number("initial_penetration", pair.initial_penetration);
      json.number("area_without_multiplier", pair.lost_area);
      json.number("dropped_nodes", pair.dropped_nodes);
      json.vector("max_pressure_at", Vector3(pair.max_pressure_at));
      json.number("slip", pair.slip);
      json.number("slip_in_faces", pair.slip_in_faces);
      json.number("pressed_by_slip", pair.pressed_by_slip);
      json.end('}');
    }

    void write_body(JsonWriter &json, const BodyResult &body)
    {
      json.begin('{');
      json.text("name", body.name);
      json.number("largest_displacement", body.largest_displacement);
      json.vector("largest_displacement_at", Vector3(body.displacement_at));
      json.number("largest_von_mises", body.largest_von_mises);
      json.vector("largest_von_mises_at", Vector3(body.von_mises_at));
      json.vector("load", body.load);
      json.vector("load_moment", body.load_moment);
      json.vector("reaction", body.reaction);
      json.vector("contact_force", body.contact);
      json.number("largest_rotation", body.largest_rotation);
      json.number("largest_strain", body.largest_strain);
      json.number("stress_error", body.stress_error);
      json.number("missing_compliance", body.missing_compliance());
      json.end('}');
    }

    void write_mapping(JsonWriter &json, const MappingResult &mapping)
    {
      const MappingQuality &quality = mapping.quality;
      json.begin('{');
      json.text("pair", mapping.pair);
      write_mapping_report(json, mapping.report);
      json.number("largest_angle_degrees", quality.largest_angle);
      json.number("mean_angle_degrees", quality.mean_angle);
      json.number("min_gap", quality.min_gap);
      json.number("max_gap", quality.max_gap);
      json.begin('[', "gap_histogram");
      for (const double area : quality.histogram)
        json.number("", area);
      json.end(']');
      json.number("time_s", mapping.time);
      json.end('}');
    }

    void write_boundary(JsonWriter &json, const BoundaryResult &boundary)
    {
      json.begin('{');
      json.text("body", boundary.body);
      json.text("name", boundary.name);
      json.vector("reaction", boundary.reaction);
      json.end('}');
    }

    void write_probe(JsonWriter &json, const ProbeResult &probe)
    {
      json.begin('{');
      json.text("name", probe.name);
      json.vector("point", probe.point);
      json.vector("displacement", probe.displacement);
      json.end('}');
    }

    void write_pretension(JsonWriter &json, const PretensionResult &bolt)
    {
      json.begin('{');
      json.text("body", bolt.body);
      json.text("name", bolt.name);
      json.number("wanted", bolt.wanted);
      if (bolt.locked_after)
        json.number("locked_after", *bolt.locked_after);
      json.number("force", bolt.force);
      json.number("strain", bolt.strain);
      json.number("length", bolt.length);
      json.number("shortening", bolt.shortening);
      json.begin('[', "iterations");
      for (const unsigned int n : bolt.iterations)
        json.number("", n);
      json.end(']');
      json.end('}');
    }

    template <typename Entry>
    void write_list(JsonWriter &json, const std::string &name, const std::vector<Entry> &list,
                    void (*const write)(JsonWriter &, const Entry &))
    {
      json.begin('[', name);
      for (const Entry &entry : list)
        write(json, entry);
      json.end(']');
    }

    void write_certificate(JsonWriter &json, const Certificate &c)
    {
      json.begin('{', "certificate");
      json.boolean("contact_conditions_hold", c.objections.empty());
      json.begin('[', "objections");
      for (const std::string &text : c.objections)
        json.text("", text);
      json.end(']');
      json.number("penetration", c.penetration);
      json.number("geometric_penetration", c.geometric_penetration);
      json.number("loaded_gap", c.loaded_gap);
      json.number("gap_doubt", c.gap_doubt);
      json.number("tension", c.tension);
      json.number("complementarity", c.complementarity);
      json.number("equilibrium", c.equilibrium);
      json.number("force_balance", c.force_balance);
      json.number("moment_balance", c.moment_balance);
      json.number("body_force_balance", c.body_force_balance);
      json.number("body_moment_balance", c.body_moment_balance);
      json.number("energy", c.energy);
      json.number("potential_energy", c.potential_energy);
      json.end('}');
    }
  } // namespace



  void write_mapping_report(JsonWriter &json, const MappingReport &report)
  {
    json.number("coverage_nonmortar", report.area_covered / report.area_nonmortar);
    json.number("coverage_mortar", report.area_mortar_covered / report.area_mortar);
    json.number("cells", report.n_cells);
    json.number("pairs", report.n_pairs);
    json.number("area", report.area_covered);
    json.number("worst_tiling_defect", report.worst_tiling_defect);
    json.text("errors", describe_errors(report));
    json.begin('{', "unmapped");
    for (const auto &[reason, number] : count_unmapped(report))
      json.number(reason, number);
    json.end('}');
    json.number("turned", report.n_flips);
    json.number("conflicting_edges", report.n_conflicts);
    json.number("lost_edges", report.lost_edges.size());
    json.number("lost_triangles", report.n_lost_triangles);
    json.number("torn_edges", report.n_torn_edges);
    json.number("turned_away", report.n_turned_away);
    json.number("slight", report.n_slight);
  }



  void write_summary(std::ostream &out, const Results &results)
  {
    JsonWriter json(out);
    json.begin('{');
    json.text("program", "signorini");
    json.text("version", results.version);
    json.text("title", results.title);
    json.text("parameter_file", results.parameter_file);
    json.number("ranks", results.ranks);
    json.boolean("converged", results.converged);
    json.number("wall_time_s", results.wall_time);
    json.number("peak_memory_bytes", results.peak_memory);
    write_list(json, "cycles", results.cycles, write_cycle);
    write_list(json, "pairs", results.pairs, write_pair);
    write_list(json, "mappings", results.mappings, write_mapping);
    write_list(json, "bodies", results.bodies, write_body);
    json.boolean("displacements_are_small", large_displacements(results).empty());
    json.boolean("meshes_are_fine", coarse_meshes(results).empty());
    write_list(json, "boundaries", results.boundaries, write_boundary);
    write_list(json, "probes", results.probes, write_probe);
    if (!results.pretensions.empty())
      write_list(json, "pretension", results.pretensions, write_pretension);
    write_certificate(json, results.certificate);
    json.begin('[', "notes");
    for (const std::string &note : results.notes)
      json.text("", note);
    json.end(']');
    json.end('}');
    out << '\n';
  }



  namespace
  {
    /// A single iteration has no rate.
    std::string rate_text(const double rate)
    {
      std::ostringstream text;
      text << std::setprecision(3) << rate;
      return std::isfinite(rate) ? text.str() : "-";
    }
  } // namespace



  void write_table(std::ostream &out, const Results &results)
  {
    out << "level  elements      dofs  nonlinear  linear  with CG  contact  active      rate  linear rate  "
           "solve [s]  "
           "total [s]\n";
    for (const CycleResult &c : results.cycles)
      {
        out << std::setw(5) << c.cycle << std::setw(10) << c.cells << std::setw(10) << c.dofs << std::setw(11)
            << c.nonlinear.iterations << std::setw(8)
            << (c.has_linear ? std::to_string(c.linear.iterations) : "-") << std::setw(9)
            << (c.has_linear ? std::to_string(c.linear_cg.iterations) : "-") << std::setw(9)
            << c.contact_nodes << std::setw(8) << c.active_nodes << std::setprecision(3) << std::setw(10)
            << rate_text(c.nonlinear.rate) << std::setw(13) << (c.has_linear ? rate_text(c.linear.rate) : "-")
            << std::setw(11) << c.times[Phase::solve] << std::setw(11) << c.times.total() << '\n';
      }
  }



  void write_convergence(std::ostream &out, const Results &results)
  {
    out << "cycle,iteration,correction,relative,active_nodes\n" << std::setprecision(17);
    for (const CycleResult &c : results.cycles)
      for (std::size_t i = 0; i < c.nonlinear.history.size(); ++i)
        out << c.cycle << ',' << i + 1 << ',' << c.nonlinear.history[i] << ','
            << (c.nonlinear.scale > 0. ? c.nonlinear.history[i] / c.nonlinear.scale : 0.) << ','
            << c.nonlinear.active_nodes[i] << '\n';
  }



  void write_pressure(std::ostream &out, const Results &results)
  {
    out << "x,y,z,area,pressure,recovered_pressure,gap,active,nx,ny,nz,node,mesh_node,side,pair\n"
        << std::setprecision(17);
    const std::pair<const std::vector<PressureRow> *, const char *> sides[] = {
        {&results.pressure, "nonmortar"}, {&results.mortar_pressure, "mortar"}};
    for (const auto &[rows, side] : sides)
      for (const PressureRow &row : *rows)
        out << row.position[0] << ',' << row.position[1] << ',' << row.position[2] << ',' << row.area << ','
            << row.pressure << ',' << row.recovered_pressure << ',' << row.gap << ',' << row.active << ','
            << row.normal[0] << ',' << row.normal[1] << ',' << row.normal[2] << ',' << row.node << ','
            << row.mesh_node << ',' << side << ',' << csv_text(results.pairs[row.pair].name) << '\n';
  }



  void print_certificate(std::ostream &out, const Results &results)
  {
    const Certificate &c = results.certificate;
    out << std::setprecision(3) << "certificate\n"
        << "  penetration      " << c.penetration << "   (algebraic, largest / largest displacement)\n"
        << "  geometric        " << c.geometric_penetration
        << "   (of the true surfaces, sampled on all overlay cells, / approach)\n"
        << "  gap under load   " << c.loaded_gap
        << "   (of the true surfaces, mean over the contact forces, / approach)\n"
        << "  doubt of the gap " << c.gap_doubt
        << "   (what is not known of the surfaces in contact / approach)\n"
        << "  tension          " << c.tension << "   (largest / largest pressure)\n"
        << "  complementarity  " << c.complementarity
        << "   (largest |pressure * gap| / (largest pressure * displacement))\n"
        << "  equilibrium      " << c.equilibrium
        << "   (residual with contact forces / norm of the nodal forces)\n"
        << "  force balance    " << c.force_balance << "   (sum of the forces on both bodies / force)\n"
        << "  moment balance   " << c.moment_balance
        << "   (sum of the moments on both bodies / force * width)\n"
        << "  bodies           " << std::max(c.body_force_balance, c.body_moment_balance)
        << "   (what is left of forces and moments on a body)\n"
        << "  energy           " << std::setprecision(10) << c.energy << '\n';
  }
} // namespace Signorini
