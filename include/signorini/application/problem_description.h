// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_problem_description_h
#define signorini_application_problem_description_h

#include <signorini/application/discretization.h>

#include <ostream>

namespace Signorini
{
  /// Collective. Prints bodies, boundaries, and the range of the gap of each pair. `out` should swallow what
  /// ranks other than the first say.
  void describe(std::ostream &out, const ContactModel &model, const Discretization &discretization);
} // namespace Signorini

#endif
