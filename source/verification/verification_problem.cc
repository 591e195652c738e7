// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "measurement.h"

namespace Signorini
{
  std::vector<VerificationProblem> verification_problems()
  {
    std::vector<VerificationProblem> all;
    for (const auto &family :
         {patch_problems, corner_problems, shell_problems, press_fit_problems, manufactured_problems,
          indenter_problems, hertz_problems, obstacle_problems, mapping_problems})
      for (VerificationProblem &problem : family())
        all.push_back(std::move(problem));
    return all;
  }
} // namespace Signorini
