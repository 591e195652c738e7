// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_python_mpi_session_h
#define signorini_python_mpi_session_h

#include <mpi.h>

namespace Signorini
{
  /// MPI in a process that is not ours: started by the first function that needs it, unless another module
  /// (mpi4py) has done so, and ended by who has started it.
  namespace MpiSession
  {
    /// Starts MPI and what deal.II wants, once.
    void start();

    /// Ends what start() has started, when the interpreter ends.
    void finish();

    /// All ranks, or this one alone. Calls start().
    MPI_Comm communicator(const bool all_ranks);
  } // namespace MpiSession
} // namespace Signorini

#endif
