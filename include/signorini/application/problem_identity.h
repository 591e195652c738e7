// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_problem_identity_h
#define signorini_application_problem_identity_h

#include <signorini/application/parameters.h>

#include <string>

namespace Signorini
{
  /// Collective. All that decides the results of a run, a line each: parameters but for those that say where
  /// results go and how long it may take, and checksums of the files that they name (meshes, surfaces, the
  /// deck and what it includes). The same on all ranks.
  std::string problem_identity(const ParameterFile &file, const MPI_Comm communicator);

  /// In what two identities differ, in words; empty if they do not.
  std::string identity_difference(const std::string &earlier, const std::string &present);
} // namespace Signorini

#endif
