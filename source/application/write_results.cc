// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/write_results.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/surface_values.h>
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
          recovered{"recovered pressure", 1, {}}, traction{"traction", 3, std::vector<double>(3 * n, 0.)},
          normal{"normal", 3, {}}, displacement{"displacement", 3, {}},
          image{"mortar_image", 3, std::vector<double>(3 * n, 0.)};
      std::vector<double> row_pressure(d.couplings[p].coupling.n_rows(), 0.);
      for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
        if (d.origin[row].first == p)
          {
            const unsigned int v = d.couplings[p].vertices[d.origin[row].second];
            pressure.values[v]   = d.pressure[row];
            for (unsigned int c = 0; c < dim; ++c)
              traction.values[3 * v + c] = -d.traction[row][c];
            row_pressure[d.origin[row].second] = d.pressure[row];
            gap.values[v]    = d.couplings[p].mean_gap(d.origin[row].second, d.opening[row]);
            active.values[v] = d.active[row];
          }
      for (std::size_t v = 0; v < n; ++v)
        for (const auto &[parent, weight] : pair.nonmortar.hanging[v])
          {
            pressure.values[v] += weight * pressure.values[parent];
            gap.values[v] += weight * gap.values[parent];
            for (unsigned int c = 0; c < dim; ++c)
              traction.values[3 * v + c] += weight * traction.values[3 * parent + c];
          }
      recovered.values = recover_pressure(pair.nonmortar, pair.moments, d.couplings[p], row_pressure);
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
                const unsigned int    v      = pair.nonmortar.mesh.triangles[cell.nonmortar_triangle][i];
                std::array<double, 3> corner = {{0., 0., 0.}};
                corner[c]                    = 1.;
                const Vector3 way =
                    initial_gap(pair.nonmortar, pair.mortar, cell, corner, pair.nonmortar.mesh.vertices[v],
                                evaluate(pair.mortar.mesh, cell.mortar_triangle, cell.mortar[c]));
                for (unsigned int k = 0; k < 3; ++k)
                  image.values[3 * v + k] = way[k];
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
      return {displacement, pressure, recovered, traction, gap, active, normal, image};
    }

    /// Fields by vertex of the mortar surface of a pair.
    std::vector<OutputField> mortar_fields(const Discretization &d, const unsigned int p)
    {
      const ContactPair   &pair = d.pairs[p];
      std::vector<Vector3> row_traction(d.couplings[p].coupling.n_rows());
      for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
        if (d.origin[row].first == p)
          row_traction[d.origin[row].second] = d.traction[row];
      const auto  stress = mortar_stress(pair.mortar, d.couplings[p], row_traction);
      const auto  u      = vertex_values(pair.mortar, *d.partition, d.displacement);
      OutputField displacement{"displacement", 3, {}}, pressure{"pressure", 1, {}},
          traction{"traction", 3, {}}, normal{"normal", 3, {}};
      for (std::size_t v = 0; v < stress.size(); ++v)
        {
          const Vector3 &n = pair.mortar.mesh.vertex_normals[v];
          pressure.values.push_back(-(stress[v] * n));
          for (unsigned int c = 0; c < dim; ++c)
            {
              displacement.values.push_back(u[v][c]);
              traction.values.push_back(stress[v][c]);
              normal.values.push_back(n[c]);
            }
        }
      return {displacement, pressure, traction, normal};
    }

    std::string file_name(const std::string &pair)
    {
      return Utilities::replace_in_string(pair, " ", "-");
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
        {
          const std::string name = "contact-" + file_name(d.pairs[p].name);
          write_surface(folder.path(), name, d.pairs[p].nonmortar, surface_fields(d, p), comm);
          if (!d.pairs[p].obstacle)
            write_surface(folder.path(), name + "-mortar", d.pairs[p].mortar, mortar_fields(d, p), comm);
        }

    if (parameters.write_mapping || mesh_only)
      for (const ContactPair &pair : d.pairs)
        if (pair.mapping)
          write_file(folder.path() + "mapping-" + file_name(pair.name) + "." +
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
