// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "result_file.h"
#include <signorini/application/certificate.h>
#include <signorini/application/problem_description.h>
#include <signorini/application/write_report.h>
#include <signorini/application/write_results.h>
#include <signorini/output/json_writer.h>
#include <signorini/output/load_curve.h>
#include <signorini/output/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    bool is_first_rank(const MPI_Comm communicator)
    {
      return Utilities::MPI::this_mpi_process(communicator) == 0;
    }

    std::vector<ReportSide> sides_of(const Discretization &d)
    {
      std::vector<ReportSide> sides;
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        for (const ContactSide *const side : {&d.pairs[p].nonmortar, &d.pairs[p].mortar})
          if (const bool is_mortar = side == &d.pairs[p].mortar; !is_mortar || !d.pairs[p].obstacle)
            sides.push_back({p, is_mortar, side->name, side->body, &side->surface, side->ids, {}});
      return sides;
    }

    /// Vertices without a partner have a gap of zero in the files for ParaView; a picture would show that
    /// they touch.
    void remove_void_gaps(std::vector<OutputField> &fields)
    {
      const auto values = [&](const std::string &name) {
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const OutputField &f) { return f.name == name; });
        return field == fields.end() ? nullptr : &field->values;
      };
      std::vector<double> *const gap = values("gap");
      const auto *const active = values("active"), *const image = values("mortar_image");
      if (gap == nullptr || active == nullptr || image == nullptr)
        return;
      for (std::size_t v = 0; v < gap->size(); ++v)
        if ((*gap)[v] == 0. && (*active)[v] == 0. &&
            std::all_of(image->begin() + 3 * v, image->begin() + 3 * v + 3,
                        [](const double x) { return x == 0.; }))
          (*gap)[v] = std::numeric_limits<double>::quiet_NaN();
    }

    /// Collective. The fields of a solution.
    void write_state(const ReportSurfaces &surfaces, ReportBlocks *const blocks, const ReportState &state,
                     const ContactModel &model, const Discretization &d, const ContactSolution &solution)
    {
      std::vector<OutputField> of_bodies;
      for (OutputField &field : body_fields(model, d, solution, true))
        if (field.name == "displacement" || field.name == "von_Mises")
          of_bodies.push_back(std::move(field));
      std::vector<ReportSide> sides = sides_of(d);
      for (ReportSide &side : sides)
        {
          auto fields = side.is_mortar ? mortar_fields(d, solution, side.pair)
                                       : nonmortar_fields(d, solution, side.pair);
          remove_void_gaps(fields);
          for (OutputField &field : fields)
            if (field.name == "displacement" || field.name == "pressure" ||
                field.name == "recovered pressure" || field.name == "gap")
              side.fields.push_back(std::move(field));
        }
      surfaces.write_state(blocks, state, d.nodal(), of_bodies, sides);
    }

    /// @param materials of used_materials()
    void write_bodies(JsonWriter &json, const Bodies &bodies,
                      const std::vector<std::vector<std::pair<IsotropicMaterial, std::size_t>>> &materials)
    {
      json.begin('[', "bodies");
      for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
        {
          json.begin('{');
          json.text("name", bodies.body_name(b));
          json.begin('[', "materials");
          for (const auto &[material, n_cells] : materials[b])
            {
              json.begin('{');
              json.number("young", material.young);
              json.number("poisson", material.poisson);
              json.end('}');
            }
          json.end(']');
          json.begin('[', "boundaries");
          for (const std::string &name : bodies.boundary_names(b))
            json.text("", name);
          json.end(']');
          json.end('}');
        }
      json.end(']');
    }

    /// Above which numbers of the certificate the contact conditions do not hold.
    void write_limits(JsonWriter &json, const double solver_tolerance)
    {
      const CertificateRule rule;
      const double          asked = 10. * solver_tolerance;
      json.begin('{', "limits");
      json.number("penetration", std::max(rule.penetration, asked));
      json.number("tension", std::max(rule.tension, asked));
      json.number("equilibrium", std::max(rule.equilibrium, asked));
      for (const char *const name : {"force_balance", "body_force_balance", "body_moment_balance"})
        json.number(name, std::max(rule.balance, asked));
      json.number("gap_doubt", rule.gap_doubt);
      json.number("loaded_gap", rule.loaded_gap);
      json.number("geometric_penetration", rule.geometric_penetration);
      json.number("moment_balance", rule.moment_balance);
      json.end('}');
    }

    std::string text_of(const std::function<void(std::ostream &)> &write)
    {
      std::ostringstream text;
      write(text);
      return text.str();
    }

    /// What is in no other file of the results.
    void write_run(std::ostream &out, const Results &results, const ContactModel &model,
                   const ParameterFile &file, const std::string &problem,
                   const std::vector<std::vector<std::pair<IsotropicMaterial, std::size_t>>> &materials)
    {
      const OutputParameters output = file.output();
      JsonWriter             json(out);
      json.begin('{');
      json.begin('{', "units");
      json.text("length", output.length_unit);
      json.text("force", output.force_unit);
      json.text("stress", output.stress_unit);
      json.end('}');
      json.text("time", Utilities::System::get_date() + " " + Utilities::System::get_time());
      write_bodies(json, model.bodies(), materials);
      json.begin('[', "pairs");
      for (const PairModel &pair : model.pairs())
        {
          json.begin('{');
          json.text("name", pair.definition.name);
          json.boolean("is_tied", pair.is_tied());
          json.end('}');
        }
      json.end(']');
      write_limits(json, file.nested().solve.solver.tolerance);
      json.text("problem", problem);
      json.text("parameters", text_of([&](std::ostream &o) { file.print(o, false); }));
      json.text("convergence", text_of([&](std::ostream &o) { write_convergence(o, results); }));
      if (!results.steps.empty())
        json.text("curve", text_of([&](std::ostream &o) { write_load_curve(o, results); }));
      json.end('}');
      out << '\n';
    }

    /// Takes the fields of the drawn load steps into a page and removes their files.
    void take_steps(std::ostream &out, const std::string &folder, const std::size_t n_steps)
    {
      for (std::size_t k = 0; k < n_steps; ++k)
        {
          const std::string path = folder + ReportSteps::file_name(k);
          std::ifstream     in(path);
          if (!in)
            continue;
          out << in.rdbuf();
          in.close();
          std::filesystem::remove(path);
        }
    }
  } // namespace



  ReportSteps::ReportSteps(const ContactModel &model, const OutputFolder &folder, const std::size_t n_steps)
    : model(model)
    , folder(folder)
    , n_steps(n_steps)
  {
  }



  unsigned int ReportSteps::n_drawn(const std::size_t n_steps)
  {
    return static_cast<unsigned int>(
        std::min<std::size_t>(std::max<std::size_t>(n_steps, 1), ReportRule().most_steps));
  }



  std::string ReportSteps::file_name(const std::size_t step)
  {
    return "report-step-" + std::to_string(step + 1);
  }



  void ReportSteps::add(const unsigned int step, const double time, const Discretization &d,
                        const ContactSolution &solution)
  {
    // Step k - 1 is drawn where k n / N passes a whole number, which it does at the last.
    const std::size_t n = n_drawn(n_steps);
    if ((step + 1) * n / n_steps == step * n / n_steps)
      return;
    if (surfaces == nullptr)
      surfaces = std::make_unique<const ReportSurfaces>(d.nodal(), model.bodies(), sides_of(d),
                                                        static_cast<unsigned int>(n));
    const auto write = [&](ReportBlocks *const blocks) {
      write_state(*surfaces, blocks, {step, time}, model, d, solution);
    };
    if (is_first_rank(model.communicator()))
      write_file(folder.path() + file_name(step), [&](std::ostream &out) {
        ReportBlocks blocks(out);
        write(&blocks);
      });
    else
      write(nullptr);
  }



  void write_report(const NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                    const OutputFolder &folder)
  {
    const Discretization &d         = *nested.discretization;
    const Results        &results   = nested.results;
    const bool            has_steps = !results.steps.empty();
    std::ostringstream    problem;
    describe(problem, model, d);
    const auto           materials = used_materials(model.bodies(), d.nodal());
    const ReportSurfaces surfaces(d.nodal(), model.bodies(), sides_of(d),
                                  ReportSteps::n_drawn(file.load_steps().size()));
    const auto           write = [&](ReportBlocks *const blocks) {
      write_state(surfaces, blocks, ReportState(), model, d, nested.solution);
    };
    if (!is_first_rank(model.communicator()))
      {
        if (!has_steps)
          write(nullptr);
        return;
      }
    const std::string title = results.title.empty() ? results.parameter_file : results.title;
    write_file(folder.path() + "report.html", [&](std::ostream &out) {
      write_report_page(out, "Signorini: " + title, [&](ReportBlocks &blocks) {
        blocks.json("summary", [&](std::ostream &o) { write_summary(o, results); });
        blocks.json("run",
                    [&](std::ostream &o) { write_run(o, results, model, file, problem.str(), materials); });
        surfaces.write_geometry(blocks);
        if (!has_steps)
          write(&blocks);
        else
          take_steps(out, folder.path(), file.load_steps().size());
      });
    });
  }
} // namespace Signorini
