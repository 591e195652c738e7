// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_csv_text_h
#define signorini_output_csv_text_h

#include <string>

namespace Signorini
{
  /// A text as an entry of a table with commas: in quotes where it has to be (RFC 4180).
  inline std::string csv_text(const std::string &text)
  {
    if (text.find_first_of(",\"\r\n") == std::string::npos)
      return text;
    std::string quoted = "\"";
    for (const char c : text)
      quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
  }
} // namespace Signorini

#endif
