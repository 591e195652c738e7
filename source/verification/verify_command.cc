// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/write_results.h>
#include <signorini/output/progress.h>
#include <signorini/output/report_page.h>
#include <signorini/verification/verification_report.h>
#include <signorini/verification/verify_command.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <cstdio>
#include <iomanip>
#include <iostream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    const char *const usage = "usage: signorini verify [--quick] [--details] [--json FILE] [--report FILE] "
                              "[NAME]...\n"
                              "       signorini verify --list   the problems\n"
                              "Solves problems with known solutions. NAME: of a problem, or how names begin "
                              "(hertz); all without it.\n"
                              "--quick: the coarser meshes only; --details: errors on all meshes; --json: "
                              "everything in numbers;\n"
                              "--report: a page for browsers (FILE.html), with errors over refinement. Exit "
                              "code 0: all pass, 3: not all.\n";

    struct VerifyOptions
    {
      bool                     quick = false, details = false, list = false, help = false;
      std::string              json, report;
      std::vector<std::string> names;
    };

    VerifyOptions parse(const std::vector<std::string> &arguments)
    {
      VerifyOptions options;
      for (std::size_t i = 0; i < arguments.size(); ++i)
        {
          const std::string &argument = arguments[i];
          if (argument == "--quick")
            options.quick = true;
          else if (argument == "--details")
            options.details = true;
          else if (argument == "--list")
            options.list = true;
          else if (argument == "--help" || argument == "-h")
            options.help = true;
          else if (argument == "--json" || argument == "--report")
            {
              if (i + 1 == arguments.size() || arguments[i + 1].empty())
                throw InputError("verify " + argument + " needs the name of a file.\n" + usage);
              (argument == "--json" ? options.json : options.report) = arguments[++i];
            }
          else if (!argument.empty() && argument[0] == '-')
            throw InputError("verify: unknown option \"" + argument + "\".\n" + usage);
          else
            options.names.push_back(argument);
        }
      return options;
    }

    /// Those whose names begin with one of the given ones, in their own order.
    std::vector<VerificationProblem> select(const std::vector<std::string> &names)
    {
      std::vector<VerificationProblem> all = verification_problems(), selected;
      const auto is_meant                  = [](const VerificationProblem &problem, const std::string &name) {
        return !name.empty() && problem.name.compare(0, name.size(), name) == 0;
      };
      for (const std::string &name : names)
        if (std::none_of(all.begin(), all.end(),
                         [&](const auto &problem) { return is_meant(problem, name); }))
          throw InputError("verify: there is no problem \"" + name + "\"; signorini verify --list has them.");
      for (const VerificationProblem &problem : all)
        if (names.empty() || std::any_of(names.begin(), names.end(),
                                         [&](const auto &name) { return is_meant(problem, name); }))
          selected.push_back(problem);
      return selected;
    }

    /// A file of results, written beside it first: it is complete, or as it was.
    class ResultFile
    {
    public:
      /// Errors: InputError for a place where nothing can be written, before anything is computed.
      ResultFile(const std::string &name)
        : name(name)
        , part(name + ".part")
        , out(part)
      {
        if (!out)
          throw InputError("verify: the file \"" + part + "\" cannot be written.");
      }

      ~ResultFile()
      {
        if (!is_complete)
          std::remove(part.c_str());
      }

      void write(const std::function<void(std::ostream &)> &write_content)
      {
        write_content(out);
        out.close();
        if (!out || std::rename(part.c_str(), name.c_str()) != 0)
          throw InputError("verify: the file \"" + name + "\" could not be written; is the disk full?");
        is_complete = true;
      }

    private:
      const std::string name, part;
      std::ofstream     out;
      bool              is_complete = false;
    };

    /// Those of the options, of the first rank only; null where nobody asked for one.
    struct ResultFiles
    {
      std::unique_ptr<ResultFile> json, report;

      void write(const std::vector<VerifiedProblem> &results, const VerificationSettings &settings) const
      {
        if (json)
          json->write([&](std::ostream &out) { write_json(out, results, settings); });
        if (report)
          report->write([&](std::ostream &out) {
            std::ostringstream text;
            write_json(text, results, settings);
            write_verification_report(out, text.str());
          });
      }
    };

    /// Collective: what goes wrong on the first rank ends all.
    ResultFiles open(const VerifyOptions &options, const MPI_Comm communicator)
    {
      ResultFiles files;
      std::string error;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        try
          {
            if (!options.json.empty())
              files.json = std::make_unique<ResultFile>(options.json);
            if (!options.report.empty())
              files.report = std::make_unique<ResultFile>(options.report);
          }
        catch (const InputError &e)
          {
            error = e.what();
          }
      error = broadcast_value(error, communicator);
      if (!error.empty())
        throw InputError(error);
      return files;
    }

    void print_list(std::ostream &out, const std::vector<VerificationProblem> &problems)
    {
      for (const VerificationProblem &problem : problems)
        out << std::left << std::setw(24) << problem.name << problem.what << '\n';
    }

    std::vector<VerifiedProblem> verify_all(const std::vector<VerificationProblem> &problems,
                                            const VerifyOptions &options, const MPI_Comm communicator,
                                            std::ostream &out)
    {
      const bool                   is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
      Progress                     progress(std::cout, Progress::wanted(is_root, 1));
      std::vector<VerifiedProblem> results;
      for (const VerificationProblem &problem : problems)
        {
          const unsigned int n_meshes =
              options.quick ? problem.n_quick : static_cast<unsigned int>(problem.meshes.size());
          results.push_back(verify(problem, n_meshes, communicator, [&](const unsigned int mesh) {
            progress.show(problem.name + ", mesh " + std::to_string(mesh + 1) + " of " +
                          std::to_string(n_meshes));
          }));
          progress.clear();
          out << verdict_line(results.back()) << std::endl;
          if (options.details || !results.back().passes())
            print_details(out, results.back());
        }
      return results;
    }
  } // namespace



  int verify_command(const std::vector<std::string> &arguments, const MPI_Comm communicator)
  {
    const VerifyOptions options = parse(arguments);
    std::ostream        nowhere(nullptr);
    std::ostream       &out = Utilities::MPI::this_mpi_process(communicator) == 0 ? std::cout : nowhere;
    if (options.help)
      {
        out << usage;
        return 0;
      }
    const std::vector<VerificationProblem> problems = select(options.names);
    if (options.list)
      {
        print_list(out, problems);
        return 0;
      }
    const ResultFiles          files = open(options, communicator);
    const Timer                time;
    const VerificationSettings settings = {version_text(), Utilities::MPI::n_mpi_processes(communicator),
                                           options.quick};
    const std::vector<VerifiedProblem> results  = verify_all(problems, options, communicator, out);
    const auto                         n_passed = std::count_if(results.begin(), results.end(),
                                                                [](const VerifiedProblem &result) { return result.passes(); });
    out << n_passed << " of " << results.size()
        << (results.size() == 1 ? " problem passes" : " problems pass") << " (" << settings.version << ", "
        << settings.ranks << (settings.ranks == 1 ? " rank, " : " ranks, ") << std::fixed
        << std::setprecision(0) << time.wall_time() << " s)" << std::endl;
    files.write(results, settings);
    return n_passed == static_cast<std::ptrdiff_t>(results.size()) ? 0 : 3;
  }
} // namespace Signorini
