// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_problem_description_h
#define signorini_application_problem_description_h

#include <signorini/application/discretization.h>

#include <ostream>
#include <utility>
#include <vector>

namespace Signorini
{
  /// Collective. By body: the materials of its cells, each once, and how many cells have it.
  std::vector<std::vector<std::pair<IsotropicMaterial, std::size_t>>> used_materials(const Bodies     &bodies,
                                                                                     const NodalSpace &space);

  /// Collective. Prints bodies, boundaries, and the range of the gap of each pair. `out` should swallow what
  /// ranks other than the first say.
  void describe(std::ostream &out, const ContactModel &model, const Discretization &discretization);
} // namespace Signorini

#endif
