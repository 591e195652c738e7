// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/problem_description.h>
#include <signorini/application/problem_identity.h>
#include <signorini/application/run_problem.h>
#include <signorini/application/turning_faces.h>
#include <signorini/application/write_results.h>
#include <signorini/output/termination.h>
#include <signorini/verification/verify_command.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <optional>
#include <sstream>

#if defined(__GLIBC__)
#  include <malloc.h>
#endif

namespace
{
  using namespace Signorini;

  const char *const usage =
      "usage: signorini FILE.prm [--set \"Section/Name=value\"]... [--output DIR]\n"
      "       signorini --resume FILE.prm ... go on from the checkpoint of an interrupted run, on any number "
      "of ranks\n"
      "       signorini FILE.inp [--strict] [--ignore KEYWORD,KEYWORD]...   a deck of Abaqus or CalculiX\n"
      "       signorini --check FILE.prm      parse, read the meshes, list bodies, boundaries and gaps; "
      "solve nothing\n"
      "       signorini --mesh-only FILE.prm  write meshes and the contact mapping, then stop\n"
      "       signorini --print-parameters [FILE.prm]   a complete, commented parameter file\n"
      "       signorini verify [--quick] [--help] ...   solve problems with known solutions: does this "
      "installation compute what it should?\n"
      "       signorini --help | --version\n"
      "Under MPI: mpirun -np N signorini FILE.prm\n";

  struct CommandLine
  {
    std::string              file, output, ignored;
    std::vector<std::string> overrides;
    bool                     check = false, mesh_only = false, print = false, help = false, version = false;
    bool                     resume = false;
  };

  CommandLine parse(const int argc, char **argv)
  {
    CommandLine line;
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        const auto        value    = [&]() -> std::string {
          if (i + 1 >= argc)
            throw InputError(argument + " needs a value.\n" + usage);
          return argv[++i];
        };
        if (argument == "--set")
          line.overrides.push_back(value());
        else if (argument == "--output")
          line.output = value();
        else if (argument == "--strict")
          line.overrides.push_back("Deck/Strict=true");
        else if (argument == "--ignore")
          line.ignored += (line.ignored.empty() ? "" : ", ") + value();
        else if (argument == "--resume")
          line.resume = true;
        else if (argument == "--check")
          line.check = true;
        else if (argument == "--mesh-only")
          line.mesh_only = true;
        else if (argument == "--print-parameters")
          line.print = true;
        else if (argument == "--help" || argument == "-h")
          line.help = true;
        else if (argument == "--version")
          line.version = true;
        else if (!argument.empty() && argument[0] == '-')
          throw InputError("unknown option \"" + argument + "\".\n" + usage);
        else if (line.file.empty())
          line.file = argument;
        else
          throw InputError("more than one parameter file given.\n" + std::string(usage));
      }
    if (line.resume && (line.check || line.mesh_only || line.print))
      throw InputError(
          "--resume goes on with a computation; with --check, --mesh-only and --print-parameters "
          "there is none.");
    return line;
  }

  /// What was asked for on standard output. A reader who has seen enough may go. Errors: InputError where it
  /// cannot be written.
  void print(const std::string &text)
  {
    // What lines on the way have met, this one meets again.
    std::cout.clear();
    errno = 0;
    std::cout << text << std::flush;
    const int reason = errno;
    if (!std::cout && reason != EPIPE)
      throw InputError("standard output cannot be written" +
                       (reason != 0 ? std::string(": ") + std::strerror(reason) : "") + ".");
  }

  std::string parameters_with_documentation(const ParameterFile &file)
  {
    std::ostringstream text;
    file.print(text, true);
    return text.str();
  }

  /// A parameter file with one body and one pair, for people who start from nothing.
  std::string default_parameters()
  {
    const std::vector<std::string> bodies = {"first", "second"}, pairs = {"contact"};
    return parameters_with_documentation(ParameterFile(bodies, pairs));
  }

  /// Returns the exit code.
  int run(const CommandLine &line)
  {
    const MPI_Comm           comm      = MPI_COMM_WORLD;
    const bool               is_root   = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    std::vector<std::string> overrides = line.overrides;
    if (!line.output.empty())
      overrides.push_back("Output/Folder=" + line.output);
    if (!line.ignored.empty())
      overrides.push_back("Deck/Ignore=" + line.ignored);
    const ParameterFile file(line.file, overrides);
    if (line.print)
      {
        if (is_root)
          print(parameters_with_documentation(file));
        return 0;
      }
    const dealii::Timer         time;
    std::optional<OutputFolder> folder;
    if (!line.check)
      folder.emplace(file.output().folder, comm);
    const NestedParameters     parameters = file.nested();
    Journal                    journal(is_root, file.output().verbosity);
    std::optional<Checkpoints> checkpoints;
    if (!line.check && !line.mesh_only)
      checkpoints.emplace(*folder, problem_identity(file, comm), version_text(), file.output().checkpoints);
    if (line.resume)
      checkpoints->resume();
    else if (checkpoints && !checkpoints->hint().empty())
      journal.print(checkpoints->hint());
    ContactModel model = make_model(file, comm, journal);
    if (line.check)
      {
        const auto space = std::make_shared<const ConstrainedSpace>(model);
        note_turning_faces(model, *space, journal);
        check_probes(model, space->nodal(), parameters.probes);
        std::ostringstream description;
        describe(description, model, *discretize(model, space, {}, 0, journal));
        if (is_root)
          print(description.str());
        // What the run says first, here with all of the above to look at.
        Journal silent;
        check_free_parts(model, space->free_parts, parameters.solve.solver.method, silent);
        return 0;
      }
    const std::vector<double> times  = file.load_steps();
    const OutputParameters    output = file.output();
    NestedSolution            nested =
        line.mesh_only
                       ? build_meshes(model, parameters, journal)
                       : solve_problem(model, file, StepWriter(model, output, *folder, times), journal, &*checkpoints);
    nested.results.notes = journal.notes();
    if (!line.mesh_only)
      nested.results.wall_time = checkpoints->earlier_wall_time() + time.wall_time();
    write_results(nested, model, file, *folder, line.mesh_only);
    const bool        converged = nested.results.converged;
    const std::string place     = folder->commit(converged ? Outcome::complete : Outcome::not_converged);
    if (checkpoints)
      checkpoints->remove();
    if (is_root && file.output().verbosity > 0)
      std::cout << "results in " << place << std::endl;
    if (!converged)
      throw InputError("the iteration did not converge; see the notes and convergence.csv in " + place + ".");
    return nested.results.certificate.objections.empty() ? 0 : 3;
  }
} // namespace



namespace
{
  /// MPI libraries may keep malloc from giving memory back to the system, because networks know where it is:
  /// large arrays that come and go then pile up (5.3 million unknowns: 1.6 instead of 1.4 kB each). A single
  /// rank has no network. Arrays from 16 MiB on: matrices, but not the vectors that solvers make and forget.
  void give_memory_back()
  {
#if defined(__GLIBC__)
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      return;
    mallopt(M_MMAP_MAX, 1 << 16);
    mallopt(M_MMAP_THRESHOLD, 1 << 24);
#endif
  }
} // namespace



int
main(int argc, char **argv)
{
  TerminationWatch::start();
  // Our options are none of PETSc's, which is a part of deal.II and would warn of them.
  int                                      n_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_arguments, argv, 1);
  give_memory_back();
  const bool is_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  MPI_Comm   for_errors;
  MPI_Comm_dup(MPI_COMM_WORLD, &for_errors);
  try
    {
      if (argc > 1 && std::string(argv[1]) == "verify")
        return verify_command({argv + 2, argv + argc}, MPI_COMM_WORLD);
      const CommandLine line = parse(argc, argv);
      if (line.help || line.version || (line.print && line.file.empty()))
        {
          if (is_root)
            print(line.help ? usage : line.version ? version_text() + "\n" : default_parameters());
          return 0;
        }
      if (line.file.empty())
        throw InputError("no parameter file given.\n" + std::string(usage));
      return run(line);
    }
  catch (const RunStopped &e)
    {
      if (is_root)
        std::cerr << "signorini: " << e.what() << " Go on with --resume and the same arguments." << std::endl;
      return 4;
    }
  catch (const InputError &e)
    {
      const bool together = all_ranks_come(for_errors);
      if (is_root || !together)
        std::cerr << "signorini: error: " << e.what() << std::endl;
      if (!together)
        MPI_Abort(MPI_COMM_WORLD, 1);
      return 1;
    }
  catch (const std::exception &e)
    {
      std::cerr << "signorini: internal error: " << e.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 2);
    }
  return 2;
}
