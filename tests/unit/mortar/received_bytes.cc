// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "received_bytes.h"

#include <mpi.h>

// PETSc, which comes with deal.II, counts messages by macros of these names.
#undef MPI_Recv
#undef MPI_Irecv
#undef MPI_Allgather
#undef MPI_Allgatherv
#undef MPI_Allreduce

namespace
{
  std::size_t received = 0;

  std::size_t size_of(const MPI_Datatype type)
  {
    int size;
    PMPI_Type_size(type, &size);
    return static_cast<std::size_t>(size);
  }

  int n_others(const MPI_Comm communicator)
  {
    int n;
    PMPI_Comm_size(communicator, &n);
    return n - 1;
  }
} // namespace

std::size_t
received_bytes()
{
  return received;
}

extern "C"
{
  int MPI_Recv(void *buffer, int count, MPI_Datatype type, int source, int tag, MPI_Comm communicator,
               MPI_Status *status)
  {
    MPI_Status own;
    const int  error = PMPI_Recv(buffer, count, type, source, tag, communicator, &own);
    int        n     = 0;
    PMPI_Get_count(&own, MPI_BYTE, &n);
    received += static_cast<std::size_t>(n);
    if (status != MPI_STATUS_IGNORE)
      *status = own;
    return error;
  }

  int MPI_Irecv(void *buffer, int count, MPI_Datatype type, int source, int tag, MPI_Comm communicator,
                MPI_Request *request)
  {
    received += static_cast<std::size_t>(count) * size_of(type);
    return PMPI_Irecv(buffer, count, type, source, tag, communicator, request);
  }

  int MPI_Allgather(const void *sent, int n_sent, MPI_Datatype sent_type, void *buffer, int count,
                    MPI_Datatype type, MPI_Comm communicator)
  {
    received +=
        static_cast<std::size_t>(count) * size_of(type) * static_cast<std::size_t>(n_others(communicator));
    return PMPI_Allgather(sent, n_sent, sent_type, buffer, count, type, communicator);
  }

  int MPI_Allgatherv(const void *sent, int n_sent, MPI_Datatype sent_type, void *buffer, const int *counts,
                     const int *starts, MPI_Datatype type, MPI_Comm communicator)
  {
    for (int r = 0; r <= n_others(communicator); ++r)
      received += static_cast<std::size_t>(counts[r]) * size_of(type);
    received -= static_cast<std::size_t>(n_sent) * size_of(sent_type);
    return PMPI_Allgatherv(sent, n_sent, sent_type, buffer, counts, starts, type, communicator);
  }

  int MPI_Allreduce(const void *sent, void *buffer, int count, MPI_Datatype type, MPI_Op operation,
                    MPI_Comm communicator)
  {
    if (n_others(communicator) > 0)
      received += static_cast<std::size_t>(count) * size_of(type);
    return PMPI_Allreduce(sent, buffer, count, type, operation, communicator);
  }
}
