// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_verification_verify_command_h
#define signorini_verification_verify_command_h

#include <mpi.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// Collective. What `signorini verify` does: solves problems with known solutions and says on the terminal
  /// (of the first rank) what came out. Errors: InputError for arguments that cannot be understood, and for a
  /// file that cannot be written.
  /// @param arguments those after the word "verify"
  /// @return the exit code: 0 if all problems pass, else 3
  int verify_command(const std::vector<std::string> &arguments, const MPI_Comm communicator);
} // namespace Signorini

#endif
