// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "paraview_files.h"
#include "result_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/body_evaluation.h>
#include <signorini/application/deck_results.h>
#include <signorini/application/journal.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/application/write_report.h>
#include <signorini/application/write_results.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/output/field_output.h>
#include <signorini/output/final_words.h>
#include <signorini/output/load_curve.h>
#include <signorini/output/process_memory.h>
#include <signorini/output/summary.h>

#include <deal.II/base/config.h>
#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <fstream>
#include <functional>
#include <map>

namespace Signorini
{
  using namespace dealii;

  std::string version_text()
  {
    return std::string("signorini ") + SIGNORINI_VERSION + " (deal.II " + DEAL_II_PACKAGE_VERSION + ")";
  }



  namespace
  {
    OutputField field_of(const std::string &name, const std::vector<Vector3> &values)
    {
      OutputField field{name, 3, {}};
      for (const Vector3 &value : values)
        for (unsigned int c = 0; c < dim; ++c)
          field.values.push_back(value[c]);
      return field;
    }

    /// The vectors from the vertices of the nonmortar surface to their images, where the mapping reaches
    /// them.
    std::vector<Vector3> vertex_images(const ContactPair &pair)
    {
      const ContactSurface &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      std::vector<Vector3>  images(non.mesh.vertices.size());
      const double          size = non.extent();
      if (pair.obstacle)
        for (std::size_t v = 0; v < images.size(); ++v)
          {
            const Vector3 &direction = non.mesh.vertex_normals[v];
            if (double distance; pair.obstacle->gap(distance, non.mesh.vertices[v], direction, size))
              images[v] = distance * direction;
          }
      if (pair.mapping)
        for (const OverlayTriangle &cell : pair.mapping->overlay())
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int i = 0; i < 3; ++i)
              if (cell.nonmortar[c][i] == 1.)
                {
                  const unsigned int    v      = non.mesh.triangles[cell.nonmortar_triangle][i];
                  std::array<double, 3> corner = {{0., 0., 0.}};
                  corner[c]                    = 1.;
                  images[v]                    = initial_gap(non, mor, cell, corner, non.mesh.vertices[v],
                                                             evaluate(mor.mesh, cell.mortar_triangle, cell.mortar[c]));
                }
      return images;
    }
  } // namespace



  std::vector<OutputField> body_fields(const ContactModel &model, const Discretization &d,
                                       const ContactSolution &solution, const bool with_stress)
  {
    std::vector<OutputField> fields;
    fields.push_back({"displacement", 3, relevant_values(d, solution.displacement)});
    if (with_stress)
      for (OutputField &field : stress_fields(
               NodalStress({model.bodies(), model.loads(), d.nodal(), d.dirichlet().fixed, fields[0].values})
                   .values()))
        fields.push_back(std::move(field));
    return fields;
  }



  std::vector<OutputField> nonmortar_fields(const Discretization &d, const ContactSolution &solution,
                                            const unsigned int p)
  {
    const ContactPair    &pair    = d.pairs[p];
    const ContactSurface &surface = pair.nonmortar.surface;
    const ContactStress   stress  = stress_of_pair(d, solution.stress, p);
    std::vector<Vector3>  traction;
    std::vector<double>   gap;
    for (std::size_t i = 0; i < stress.pressure.size(); ++i)
      {
        traction.push_back(-stress.traction[i]);
        gap.push_back(d.couplings[p].mean_gap(i, stress.opening[i]));
      }
    OutputField active{"active", 1,
                       spread_rows(d.couplings[p], *pair.halo,
                                   std::vector<double>(stress.active.begin(), stress.active.end()))};
    return {field_of("displacement", vertex_values(surface, d.partition(), solution.displacement)),
            {"pressure", 1, at_vertices(d, p, stress.pressure)},
            {"recovered pressure", 1,
             recover_pressure(surface, *pair.halo, pair.moments, d.couplings[p], stress.pressure)},
            field_of("traction", at_vertices(d, p, traction)),
            {"gap", 1, at_vertices(d, p, gap)},
            active,
            field_of("normal", surface.mesh.vertex_normals),
            field_of("mortar_image", vertex_images(pair))};
  }



  std::vector<OutputField> mortar_fields(const Discretization &d, const ContactSolution &solution,
                                         const unsigned int p)
  {
    const ContactPair        &pair    = d.pairs[p];
    const ContactSurface     &surface = pair.mortar.surface;
    const ContactStress       stress  = stress_of_pair(d, solution.stress, p);
    const std::vector<double> recovered =
        recover_pressure(pair.nonmortar.surface, *pair.halo, pair.moments, d.couplings[p], stress.pressure);
    std::vector<double> of_rows;
    for (const unsigned int vertex : d.couplings[p].vertices)
      of_rows.push_back(recovered[vertex]);
    return {field_of("displacement", vertex_values(surface, d.partition(), solution.displacement)),
            {"pressure", 1, mortar_means(surface, d.couplings[p], stress.pressure, d.partition())},
            {"recovered pressure", 1, mortar_means(surface, d.couplings[p], of_rows, d.partition())},
            field_of("traction", mortar_means(surface, d.couplings[p], stress.traction, d.partition())),
            field_of("normal", surface.mesh.vertex_normals)};
  }



  namespace
  {
    void write_mappings(const Discretization &d, const OutputFolder &folder)
    {
      const unsigned int rank  = Utilities::MPI::this_mpi_process(d.nodal().communicator());
      const auto         files = pair_files(d.pairs);
      for (unsigned int p = 0; p < files.size(); ++p)
        if (const ContactPair &pair = d.pairs[p]; pair.mapping)
          write_file(folder.path() + files[p].mapping + "." + Utilities::int_to_string(rank) + ".vtu",
                     [&](std::ostream &o) {
                       const ContactSurface &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
                       write_overlay(
                           o, non.mesh, mor.mesh, pair.mapping->overlay(),
                           [&](const unsigned int t) { return non.number_of_triangle(t); },
                           [&](const unsigned int t) { return mor.number_of_triangle(t); });
                     });
    }

    void print_mappings(std::ostream &out, const Results &results)
    {
      for (const MappingResult &mapping : results.mappings)
        {
          out << "mapping of pair " << mapping.pair << '\n';
          print_mapping(out, mapping.report, mapping.quality);
        }
    }

    /// @param wrong_pairs see Certificate
    std::vector<MappingResult> mapping_results(const Discretization            &d,
                                               const std::vector<unsigned int> &wrong_pairs)
    {
      const MPI_Comm             comm = d.nodal().communicator();
      std::vector<MappingResult> results;
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        if (const ContactPair &pair = d.pairs[p]; pair.mapping)
          {
            MappingReport report = sum_reports(pair.mapping->report(), comm);
            // Where something is covered twice is not known.
            const bool errors_matter =
                covers_twice(report) ||
                std::find(wrong_pairs.begin(), wrong_pairs.end(), p) != wrong_pairs.end();
            results.push_back(
                {pair.name, std::move(report),
                 assess_mapping(*pair.mapping, pair.nonmortar.surface.mesh, pair.mortar.surface.mesh, comm),
                 Utilities::MPI::max(pair.mapping_time, comm), errors_matter});
          }
      return results;
    }

    std::vector<unsigned int> all_pairs(const Discretization &d)
    {
      std::vector<unsigned int> pairs(d.pairs.size());
      std::iota(pairs.begin(), pairs.end(), 0u);
      return pairs;
    }

    /// What the results say of bodies and slip, which wants the displacement.
    void evaluate(NestedSolution &nested, const ContactModel &model)
    {
      const Discretization &d       = *nested.discretization;
      Results              &results = nested.results;
      results.bodies                = evaluate_bodies(model, d, nested.solution.displacement, results);
      for (unsigned int p = 0; p < results.pairs.size(); ++p)
        {
          const Slip slip                  = largest_slip(d, nested.solution, p);
          results.pairs[p].slip            = slip.length;
          results.pairs[p].slip_in_faces   = slip.in_faces;
          results.pairs[p].pressed_by_slip = slip.pressed;
        }
      for (const auto &lines : {large_displacements(results), coarse_meshes(results)})
        for (const std::string &line : lines)
          results.notes.push_back("warning: " + line);
    }

    /// On rank 0.
    void write_texts(const Results &results, const ParameterFile &file, const std::string &path)
    {
      write_file(path + "summary.json", [&](std::ostream &o) { write_summary(o, results); });
      if (!results.steps.empty())
        write_file(path + "curve.csv", [&](std::ostream &o) { write_load_curve(o, results); });
      write_file(path + "table.txt", [&](std::ostream &o) { write_table(o, results); });
      write_file(path + "convergence.csv", [&](std::ostream &o) { write_convergence(o, results); });
      write_file(path + "pressure.csv", [&](std::ostream &o) { write_pressure(o, results); });
      write_file(path + "parameters.prm", [&](std::ostream &o) {
        o << "# " << version_text() << ", complete parameters of " << file.path() << "\n\n";
        file.print(o, false);
      });
      write_file(path + "signorini.log", [&](std::ostream &o) {
        o << version_text() << "\n";
        for (const std::string &note : results.notes)
          o << note_line(note) << "\n";
        write_table(o, results);
        print_certificate(o, results);
        print_final_words(o, results);
        print_mappings(o, results);
      });
    }
  } // namespace



  namespace
  {
    /// What is written. Indicators are empty where there are none.
    struct WrittenState
    {
      const ContactModel        &model;
      const Discretization      &d;
      const ContactSolution     &solution;
      const std::vector<double> &indicator;
    };

    void write_body_fields(const WrittenState &state, const OutputParameters &output,
                           const std::string &folder, const std::string &suffix)
    {
      const Bodies            &bodies = state.model.bodies();
      const NodalSpace        &space  = state.d.nodal();
      std::vector<OutputField> fields = body_fields(state.model, state.d, state.solution, output.stress);
      for (OutputField &field : node_numbers(bodies, space))
        fields.push_back(std::move(field));
      BodyFiles files{body_files(bodies),
                      [&](const types::material_id id) { return bodies.body_of_material(id); }};
      for (std::string &name : files.names)
        name += suffix;
      const auto cells = cell_fields(bodies, space, state.indicator);
      write_bodies(folder, "bodies" + suffix, space, {fields, cells}, files, output.format());
    }

    void write_surfaces_of_pair(const WrittenState &state, const OutputParameters &output,
                                const std::string &folder, const std::string &suffix, const unsigned int p)
    {
      const ContactPair &pair  = state.d.pairs[p];
      const PairFiles    files = pair_files(state.d.pairs)[p];
      const auto         write = [&](const std::string &file, const ContactSurface &surface,
                             std::vector<OutputField> fields) {
        for (OutputField &field : node_numbers(state.model.bodies(), state.d, surface))
          fields.push_back(std::move(field));
        write_surface(folder, file + suffix, surface, fields, state.model.communicator(), output.format());
      };
      write(files.nonmortar, pair.nonmortar.surface, nonmortar_fields(state.d, state.solution, p));
      if (!pair.obstacle)
        write(files.mortar, pair.mortar.surface, mortar_fields(state.d, state.solution, p));
    }

    void write_state(const WrittenState &state, const OutputParameters &output, const OutputFolder &folder,
                     const std::string &suffix)
    {
      if (output.bodies)
        write_body_fields(state, output, folder.path(), suffix);
      if (output.surfaces)
        for (unsigned int p = 0; p < state.d.pairs.size(); ++p)
          write_surfaces_of_pair(state, output, folder.path(), suffix, p);
      if (output.mapping)
        write_mappings(state.d, folder);
      if (suffix.empty() && Utilities::MPI::this_mpi_process(state.model.communicator()) == 0)
        {
          std::vector<CollectionEntry> entries;
          for (const ParaviewBlock &block : paraview_blocks(state.model.bodies(), state.d, output))
            entries.push_back({0., block.name, block.file + ".pvtu"});
          write_file(folder.path() + "results.pvd", [&](std::ostream &o) { write_collection(o, entries); });
        }
    }
  } // namespace



  void write_fields(const ContactModel &model, const Discretization &d, const ContactSolution &solution,
                    const OutputParameters &output, const OutputFolder &folder, const std::string &suffix)
  {
    const std::vector<double> none;
    write_state({model, d, solution, none}, output, folder, suffix);
  }



  namespace
  {
    /// Lists of the files of the first steps: of each block, of the bodies together, and of all.
    /// @param state time and suffix of a step
    void write_series(const std::string &folder, const std::vector<ParaviewBlock> &blocks,
                      const std::size_t                                                       n_steps,
                      const std::function<std::pair<double, std::string>(const std::size_t)> &state)
    {
      std::map<std::string, std::vector<CollectionEntry>> lists;
      for (std::size_t k = 0; k < n_steps; ++k)
        {
          const auto [time, suffix] = state(k);
          for (const ParaviewBlock &block : blocks)
            {
              const bool is_body = block.file.rfind("body-", 0) == 0;
              lists["results"].push_back({time, block.name, block.file + suffix + ".pvtu"});
              if (!is_body)
                lists[block.file].push_back({time, "", block.file + suffix + ".pvtu"});
              else if (lists["bodies"].size() == k)
                lists["bodies"].push_back({time, "", "bodies" + suffix + ".pvtu"});
            }
        }
      for (const auto &[name, entries] : lists)
        write_file(folder + name + "-steps.pvd",
                   [&, &list = entries](std::ostream &o) { write_collection(o, list); });
    }
  } // namespace



  StepWriter::StepWriter(const ContactModel &model, const OutputParameters &output,
                         const OutputFolder &folder, const std::vector<double> &times)
    : model(model)
    , output(output)
    , folder(folder)
    , times(times)
    , report(output.report ? std::make_shared<ReportSteps>(model, folder, times.size()) : nullptr)
  {
  }



  void StepWriter::operator()(const unsigned int step, const Discretization &d,
                              const ContactSolution &solution)
  {
    OutputParameters fields = output;
    fields.mapping          = false;
    const auto suffix       = [this](const std::size_t k) {
      return "-step-" +
             Utilities::int_to_string(static_cast<unsigned int>(k) + 1,
                                            static_cast<unsigned int>(std::to_string(times.size()).size()));
    };
    write_fields(model, d, solution, fields, folder, suffix(step));
    if (report)
      report->add(step, times[step], d, solution);

    if (Utilities::MPI::this_mpi_process(model.communicator()) == 0)
      write_series(folder.path(), paraview_blocks(model.bodies(), d, output), step + 1,
                   [&](const std::size_t k) { return std::make_pair(times[k], suffix(k)); });
  }



  void complete_results(NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                        const bool mesh_only)
  {
    Results       &results = nested.results;
    const MPI_Comm comm    = model.communicator();
    if (!mesh_only)
      evaluate(nested, model);
    results.mappings =
        mapping_results(*nested.discretization, mesh_only ? all_pairs(*nested.discretization)
                                                          : results.certificate.wrongly_mapped_pairs);

    results.peak_memory    = Utilities::MPI::sum(process_memory().peak, comm);
    results.version        = version_text();
    results.title          = file.title();
    results.parameter_file = file.path();
    results.ranks          = Utilities::MPI::n_mpi_processes(comm);
  }



  void write_results(NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                     const OutputFolder &folder, const bool mesh_only)
  {
    const Discretization &d       = *nested.discretization;
    Results              &results = nested.results;
    const MPI_Comm        comm    = model.communicator();
    PhaseTimes            times;
    PhaseTimes::Scope     time   = times.measure(Phase::output);
    OutputParameters      output = file.output();
    output.surfaces              = output.surfaces || mesh_only;
    output.mapping               = output.mapping || mesh_only;
    write_state({model, d, nested.solution, nested.indicator}, output, folder, "");
    if (file.deck() != nullptr && !mesh_only)
      write_deck_results(*file.deck(), model, d, nested.solution, folder.path());
    complete_results(nested, model, file, mesh_only);
    results.wall_time += time.stop();
    if (!results.cycles.empty())
      results.cycles.back().times.add(Phase::output, times[Phase::output]);
    if (output.report && !mesh_only)
      write_report(nested, model, file, folder);
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    write_texts(results, file, folder.path());
    if (output.verbosity == 0)
      return;
    if (mesh_only)
      print_mappings(std::cout, results);
    else
      {
        if (output.verbosity > 1)
          {
            write_table(std::cout, results);
            print_certificate(std::cout, results);
          }
        print_final_words(std::cout, results);
      }
  }
} // namespace Signorini
