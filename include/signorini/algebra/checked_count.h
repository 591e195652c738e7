// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_checked_count_h
#define signorini_algebra_checked_count_h

#include <limits>
#include <stdexcept>
#include <string>

namespace Signorini
{
  /// A number of items for a library that counts in int. Errors: std::length_error, with the items' name,
  /// where it does not fit.
  inline int checked_count(const std::size_t n, const std::string &items)
  {
    if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::length_error(std::to_string(n) + " " + items + " on one rank are more than " +
                              std::to_string(std::numeric_limits<int>::max()) +
                              ", as far as messages and sparse factors count: use more ranks, or a smaller "
                              "first mesh.");
    return static_cast<int>(n);
  }
} // namespace Signorini

#endif
