// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_common_error_h
#define signorini_algebra_common_error_h

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>

#include <string>

namespace Signorini
{
  /// Collective. Raises an input error of any rank on all of them, with the message of the first.
  /// @param message empty where nothing is wrong
  inline void throw_everywhere(const std::string &message, const MPI_Comm communicator)
  {
    for (const std::string &text : gather_values(message, communicator))
      if (!text.empty())
        throw InputError(text);
  }
} // namespace Signorini

#endif
