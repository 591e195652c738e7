// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "problem_run.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/run_problem.h>
#include <signorini/output/load_curve.h>
#include <signorini/output/summary.h>

#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A run has no checkpoints here: it goes on where the script wants it to.
    void refuse_time_limit(const OutputParameters &output)
    {
      if (output.checkpoints.wall_time_limit > 0.)
        throw InputError("Output/Wall time limit: runs from Python have no checkpoints and cannot go on "
                         "later; use the program signorini.");
    }

    template <typename F>
    std::string text_of(const F &write)
    {
      std::ostringstream text;
      write(text);
      return text.str();
    }

    StepArrays step_arrays(const MeshArrays &mesh, const double time, const ContactModel &model,
                           const Discretization &d, const ContactSolution &solution)
    {
      StepArrays step{time, mesh.body_values(model, d, solution), {}, {}};
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        {
          step.nonmortar.push_back(pair_values(d, solution, p, false));
          step.mortar.push_back(pair_values(d, solution, p, true));
        }
      return step;
    }

    /// Texts and last fields.
    void fill(RunOutcome &outcome, const NestedSolution &nested, const ContactModel &model,
              const ParameterFile &file)
    {
      const Results &results = nested.results;
      outcome.converged      = results.converged;
      outcome.objections     = results.certificate.objections;
      outcome.summary        = text_of([&](std::ostream &out) { write_summary(out, results); });
      outcome.pressure   = broadcast_value(text_of([&](std::ostream &out) { write_pressure(out, results); }),
                                           model.communicator());
      outcome.parameters = text_of([&](std::ostream &out) { file.print(out, false); });
      if (!results.steps.empty())
        outcome.curve = text_of([&](std::ostream &out) { write_load_curve(out, results); });
      const Discretization &d = *nested.discretization;
      outcome.bodies          = MeshArrays(model, d).bodies(model, d, nested.solution);
      outcome.pairs           = pair_arrays(d, nested.solution);
    }

    std::unique_ptr<const ParameterFile> read(const RunRequest &request)
    {
      std::vector<std::string> overrides = request.overrides;
      if (!request.output.empty())
        overrides.push_back("Output/Folder=" + request.output);
      auto file = request.text.text.empty() ? std::make_unique<const ParameterFile>(request.file, overrides)
                                            : std::make_unique<const ParameterFile>(request.text, overrides);
      refuse_time_limit(file->output());
      return file;
    }

    /// Does with the load steps what is wanted of them.
    class StepKeeper
    {
    public:
      /// @param folder null for no files; the arguments must outlive the object
      StepKeeper(const ContactModel &model, const ParameterFile &file, const OutputFolder *const folder,
                 std::vector<StepArrays> *const steps)
        : model(model)
        , output(file.output())
        , times(file.load_steps())
        , steps(steps)
      {
        if (folder != nullptr)
          writer.emplace(model, output, *folder, times);
      }

      StepKeeper(const StepKeeper &) = delete;

      void operator()(const unsigned int step, const Discretization &d, const ContactSolution &solution)
      {
        if (writer)
          (*writer)(step, d, solution);
        if (steps == nullptr)
          return;
        // All steps have the same mesh.
        if (!mesh)
          mesh.emplace(model, d);
        steps->push_back(step_arrays(*mesh, times[step], model, d, solution));
      }

    private:
      const ContactModel            &model;
      const OutputParameters         output;
      const std::vector<double>      times;
      std::vector<StepArrays> *const steps;
      std::optional<StepWriter>      writer;
      std::optional<MeshArrays>      mesh;
    };

    RunOutcome run(const RunRequest &request, const MPI_Comm comm, const std::function<void()> &interrupt)
    {
      const Timer                 time;
      const auto                  file = read(request);
      std::optional<OutputFolder> folder;
      if (!request.output.empty())
        folder.emplace(file->output().folder, comm);
      Journal journal(Utilities::MPI::this_mpi_process(comm) == 0, file->output().verbosity);
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        journal.interrupt_by(interrupt);

      ContactModel   model = make_model(*file, comm, journal);
      RunOutcome     outcome;
      StepKeeper     keeper(model, *file, folder ? &*folder : nullptr,
                        request.keeps_steps ? &outcome.steps : nullptr);
      NestedSolution nested    = solve_problem(model, *file, std::ref(keeper), journal);
      nested.results.notes     = journal.notes();
      nested.results.wall_time = time.wall_time();
      if (folder)
        write_results(nested, model, *file, *folder, false);
      else
        complete_results(nested, model, *file, false);
      fill(outcome, nested, model, *file);
      if (folder)
        outcome.folder = folder->commit(outcome.converged ? Outcome::complete : Outcome::not_converged);
      return outcome;
    }

    /// For errors that the other ranks may know nothing of, and would wait for ever.
    void end_all(const std::string &message, const int code)
    {
      std::cerr << "signorini: " << message << std::endl;
      MPI_Abort(MPI_COMM_WORLD, code);
    }
  } // namespace



  RunOutcome run_problem(const RunRequest &request, const MPI_Comm communicator,
                         const std::function<void()> &interrupt)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return run(request, communicator, interrupt);
    MPI_Comm for_errors;
    MPI_Comm_dup(communicator, &for_errors);
    try
      {
        RunOutcome outcome = run(request, communicator, interrupt);
        MPI_Comm_free(&for_errors);
        return outcome;
      }
    catch (const InputError &error)
      {
        if (!all_ranks_come(for_errors))
          end_all(std::string("error: ") + error.what(), 1);
        MPI_Comm_free(&for_errors);
        throw;
      }
    catch (const std::exception &error)
      {
        end_all(std::string("internal error: ") + error.what(), 2);
        throw;
      }
  }
} // namespace Signorini
