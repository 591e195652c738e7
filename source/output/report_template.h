// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_report_template_h
#define signorini_output_report_template_h

#include <string>

namespace Signorini
{
  /// The page without data, as contrib/report builds it; a part of the program.
  std::string report_template();
} // namespace Signorini

#endif
