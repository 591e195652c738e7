// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/write_results.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/output/field_output.h>
#include <signorini/output/summary.h>

#include <deal.II/base/config.h>
#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  std::string version_text()
  {
    return std::string("signorini ") + SIGNORINI_VERSION + " (deal.II " + DEAL_II_PACKAGE_VERSION + ")";
  }



  namespace
  {
    /// Nodal values in the order of NodalSpace::relevant().
    std::vector<double> relevant_values(const Discretization &d)
    {
      std::vector<double> values;
      values.reserve(3 * d.space->relevant().n_elements());
      for (const NodeIndex node : d.space->relevant())
        {
          const unsigned int i = d.partition->to_local(node);
          for (unsigned int c = 0; c < dim; ++c)
            values.push_back(d.displacement.local_element(dim * i + c));
        }
      return values;
    }

    void write_bodies_of(const ContactProblem &problem, const ProblemParameters &parameters,
                         const std::string &folder)
    {
      const Discretization    &d = problem.discretization;
      std::vector<OutputField> fields;
      fields.push_back({"displacement", 3, relevant_values(d)});
      if (parameters.write_stress)
        for (OutputField &field :
             nodal_stress(*d.space, fields[0].values, [&](const types::material_id id) -> const Material & {
               return problem.body_data().material(id);
             }))
          fields.push_back(std::move(field));
      write_bodies(folder, "bodies", *d.space, fields, [&](const types::material_id id) {
        return static_cast<double>(problem.body_data().body_of_material(id));
      });
    }

    /// Fields by vertex of the nonmortar surface of a pair.
    std::vector<OutputField> surface_fields(const Discretization &d, const unsigned int p)
    {
      const ContactPair &pair = d.pairs[p];
      const std::size_t  n    = pair.nonmortar.mesh.vertices.size();
      OutputField        pressure{"pressure", 1, std::vector<double>(n, 0.)},
          gap{"gap", 1, std::vector<double>(n, 0.)}, active{"active", 1, std::vector<double>(n, 0.)},
          normal{"normal", 3, {}}, displacement{"displacement", 3, {}},
          image{"mortar_image", 3, std::vector<double>(3 * n, 0.)};
      for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
        if (d.origin[row].first == p)
          {
            const unsigned int v = d.couplings[p].vertices[d.origin[row].second];
            pressure.values[v]   = d.pressure[row];
            gap.values[v]        = d.opening[row];
            active.values[v]     = d.active[row];
          }
      for (std::size_t v = 0; v < n; ++v)
        for (const auto &[parent, weight] : pair.nonmortar.hanging[v])
          {
            pressure.values[v] += weight * pressure.values[parent];
            gap.values[v] += weight * gap.values[parent];
          }
      // The vector from a vertex to its image, where the mapping reaches it.
      if (pair.obstacle)
        for (std::size_t v = 0; v < n; ++v)
          {
            const Vector3 &direction = pair.nonmortar.mesh.vertex_normals[v];
            if (double distance; pair.obstacle->gap(distance, pair.nonmortar.mesh.vertices[v], direction,
                                                    surface_size(pair.nonmortar)))
              for (unsigned int k = 0; k < 3; ++k)
                image.values[3 * v + k] = distance * direction[k];
          }
      for (const OverlayTriangle &cell :
           pair.mapping ? pair.mapping->overlay() : std::vector<OverlayTriangle>())
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < 3; ++i)
            if (cell.nonmortar[c][i] == 1.)
              {
                const unsigned int v = pair.nonmortar.mesh.triangles[cell.nonmortar_triangle][i];
                const auto         y = evaluate(pair.mortar.mesh, cell.mortar_triangle, cell.mortar[c]);
                for (unsigned int k = 0; k < 3; ++k)
                  image.values[3 * v + k] = y[k] - pair.nonmortar.mesh.vertices[v][k];
              }
      const auto u = vertex_values(pair.nonmortar, *d.partition, d.displacement);
      for (std::size_t v = 0; v < n; ++v)
        {
          for (unsigned int c = 0; c < 3; ++c)
            {
              normal.values.push_back(pair.nonmortar.mesh.vertex_normals[v][c]);
              displacement.values.push_back(u[v][c]);
            }
        }
      return {displacement, pressure, gap, active, normal, image};
    }

    template <typename F>
    void write_file(const std::string &path, const F &writer)
    {
      std::ofstream out(path);
      writer(out);
      out.close();
      if (!out)
        throw InputError("the file \"" + path + "\" cannot be written: is the disk full?");
    }
  } // namespace



  void write_results(ContactProblem &problem, ProblemParameters &parameters, const OutputFolder &folder,
                     const bool mesh_only, ConditionalOStream &out)
  {
    Discretization &d       = problem.discretization;
    Results        &results = problem.results;
    const MPI_Comm  comm    = d.partition->communicator();
    Timer           time;
    if (parameters.write_bodies)
      write_bodies_of(problem, parameters, folder.path());
    if (parameters.write_surfaces || mesh_only)
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        write_surface(folder.path(), "contact-" + Utilities::replace_in_string(d.pairs[p].name, " ", "-"),
                      d.pairs[p].nonmortar, surface_fields(d, p), comm);

    if (parameters.write_mapping || mesh_only)
      for (const ContactPair &pair : d.pairs)
        if (pair.mapping)
          write_file(folder.path() + "mapping-" + Utilities::replace_in_string(pair.name, " ", "-") + "." +
                         Utilities::int_to_string(Utilities::MPI::this_mpi_process(comm)) + ".vtu",
                     [&](std::ostream &o) {
                       write_overlay(o, pair.nonmortar.mesh, pair.mortar.mesh, pair.mapping->overlay());
                     });
    results.mappings.clear();
    for (const ContactPair &pair : d.pairs)
      if (pair.mapping)
        results.mappings.push_back(
            {pair.name, sum_reports(pair.mapping->report(), comm),
             assess_mapping(*pair.mapping, pair.nonmortar.mesh, pair.mortar.mesh, comm),
             Utilities::MPI::max(pair.mapping_time, comm)});

    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    results.peak_memory    = 1024. * Utilities::MPI::sum(static_cast<double>(memory.VmHWM), comm);
    results.version        = version_text();
    results.title          = parameters.title;
    results.parameter_file = parameters.file;
    results.ranks          = Utilities::MPI::n_mpi_processes(comm);
    if (!results.cycles.empty())
      results.cycles.back().times["output"] = time.wall_time();
    results.wall_time += time.wall_time();
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const std::string &path = folder.path();
        write_file(path + "summary.json", [&](std::ostream &o) { write_summary(o, results); });
        write_file(path + "table.txt", [&](std::ostream &o) { write_table(o, results); });
        write_file(path + "convergence.csv", [&](std::ostream &o) { write_convergence(o, results); });
        write_file(path + "pressure.csv", [&](std::ostream &o) { write_pressure(o, results); });
        write_file(path + "parameters.prm", [&](std::ostream &o) {
          o << "# " << version_text() << ", complete parameters of " << parameters.file << "\n\n";
          parameters.print(o, false);
        });
        write_file(path + "signorini.log", [&](std::ostream &o) {
          o << version_text() << "\n";
          for (const std::string &note : results.notes)
            o << "note: " << note << "\n";
          write_table(o, results);
          print_certificate(o, results);
          for (const MappingResult &mapping : results.mappings)
            {
              o << "mapping of pair " << mapping.pair << '\n';
              print_mapping(o, mapping.report, mapping.quality);
            }
        });
        if (mesh_only && parameters.verbosity > 0)
          for (const MappingResult &mapping : results.mappings)
            {
              std::cout << "mapping of pair " << mapping.pair << '\n';
              print_mapping(std::cout, mapping.report, mapping.quality);
            }
        if (parameters.verbosity > 0 && !mesh_only)
          {
            write_table(std::cout, results);
            print_certificate(std::cout, results);
          }
      }
    (void)out;
  }
} // namespace Signorini
