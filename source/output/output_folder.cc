// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/output/output_folder.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

#include <unistd.h>

namespace Signorini
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const char *const marker = ".signorini";

    /// Runs on rank 0; an error there is raised everywhere.
    template <typename F>
    void on_root(const MPI_Comm comm, const F &action)
    {
      std::string error;
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        try
          {
            action();
          }
        catch (const std::exception &e)
          {
            error = e.what();
          }
      error = Utilities::MPI::broadcast(comm, error, 0);
      if (!error.empty())
        throw InputError("Output folder: " + error);
    }
  } // namespace



  OutputFolder::OutputFolder(const std::string &folder, const MPI_Comm communicator)
    : target(folder)
    , comm(communicator)
  {
    while (target.size() > 1 && target.back() == '/')
      target.pop_back();
    temporary = target + ".part-" +
                std::to_string(Utilities::MPI::broadcast(comm, static_cast<long>(getpid()), 0)) + "/";
    on_root(comm, [&] {
      if (fs::exists(target) && !fs::is_directory(target))
        throw InputError("\"" + target + "\" is a file. Choose another name.");
      if (fs::exists(target) && !fs::is_empty(target) && !fs::exists(target + "/" + marker))
        throw InputError("\"" + target +
                         "\" exists and was not written by signorini. Choose another name or remove it.");
      fs::create_directories(temporary);
      std::ofstream(temporary + marker) << "results of signorini\n";
    });
  }



  OutputFolder::~OutputFolder()
  {
    // On every rank: after an error that one rank alone has met, the others never come here.
    std::error_code ignored;
    if (!committed)
      fs::remove_all(temporary, ignored);
  }



  void OutputFolder::commit()
  {
    // All ranks must have closed their files.
    MPI_Barrier(comm);
    on_root(comm, [&] {
      if (fs::exists(target))
        fs::remove_all(target);
      fs::rename(temporary.substr(0, temporary.size() - 1), target);
    });
    committed = true;
  }
} // namespace Signorini
