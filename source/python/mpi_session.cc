// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "mpi_session.h"

#include <signorini/algebra/input_error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <memory>

#include <p4est.h>

namespace Signorini
{
  namespace
  {
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> &own_session()
    {
      static std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> session;
      return session;
    }

    /// What deal.II does beside MPI_Init(): one thread a process, and a p4est that does not print.
    void join_session_of_others()
    {
      static bool has_joined = false;
      if (has_joined)
        return;
      has_joined = true;
      dealii::MultithreadInfo::set_thread_limit(1);
      sc_init(MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_SILENT);
      p4est_init(nullptr, SC_LP_SILENT);
    }
  } // namespace



  void MpiSession::start()
  {
    if (own_session())
      return;
    int is_started = 0, is_over = 0;
    MPI_Initialized(&is_started);
    MPI_Finalized(&is_over);
    if (is_over)
      throw InputError("MPI has ended; nothing can be computed any more in this process.");
    if (is_started)
      {
        join_session_of_others();
        return;
      }
    int    n_arguments = 0;
    char **arguments   = nullptr;
    own_session() = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n_arguments, arguments, 1);
  }



  void MpiSession::finish()
  {
    own_session().reset();
  }



  MPI_Comm MpiSession::communicator(const bool all_ranks)
  {
    start();
    return all_ranks ? MPI_COMM_WORLD : MPI_COMM_SELF;
  }
} // namespace Signorini
