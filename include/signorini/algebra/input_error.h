// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_input_error_h
#define signorini_algebra_input_error_h

#include <stdexcept>
#include <string>

namespace Signorini
{
  /// An error that the user can cause and mend: what is wrong, where (parameter or file), what to do.
  /// Raised on all ranks alike.
  class InputError : public std::runtime_error
  {
  public:
    /// @param message what is wrong, where, and what to do, in full sentences
    explicit InputError(const std::string &message)
      : std::runtime_error(message)
    {
    }
  };
} // namespace Signorini

#endif
