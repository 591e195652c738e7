// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/load_curve.h>

#include "csv_text.h"

#include <iomanip>
#include <limits>
#include <ostream>

namespace Signorini
{
  namespace
  {
    /// Calls f(name, value) for all columns of a step.
    template <typename F>
    void for_columns(const StepResult &step, const F &f)
    {
      const auto vector = [&](const std::string &name, const Vector3 &value) {
        for (unsigned int c = 0; c < dim; ++c)
          f(name + " " + "xyz"[c], value[c]);
      };
      f("t", step.time);
      f("iterations", step.report.iterations);
      f("active nodes", static_cast<double>(step.active_nodes));
      for (const PairResult &pair : step.pairs)
        {
          vector(pair.name + ": force", pair.force);
          f(pair.name + ": load", pair.load);
          f(pair.name + ": approach", pair.approach);
          f(pair.name + ": contact area", pair.contact_area);
          f(pair.name + ": largest pressure", pair.max_pressure);
          f(pair.name + ": mean pressure", pair.mean_pressure);
          f(pair.name + ": largest recovered pressure", pair.max_recovered_pressure);
          f(pair.name + ": smallest gap", pair.min_gap);
        }
      for (const BoundaryResult &boundary : step.boundaries)
        vector(boundary.body + ": " + boundary.name + ": reaction", boundary.reaction);
      for (const PretensionResult &bolt : step.pretensions)
        {
          f(bolt.body + ": " + bolt.name + ": section force", bolt.force);
          f(bolt.body + ": " + bolt.name + ": shortening", bolt.shortening);
        }
      for (const ProbeResult &probe : step.probes)
        vector(probe.name + ": displacement", probe.displacement);
    }
  } // namespace



  void write_load_curve(std::ostream &out, const Results &results)
  {
    out << std::setprecision(std::numeric_limits<double>::max_digits10);
    bool is_first = true;
    if (!results.steps.empty())
      for_columns(results.steps[0], [&](const std::string &name, const double) {
        out << (is_first ? "" : ",") << csv_text(name);
        is_first = false;
      });
    for (const StepResult &step : results.steps)
      {
        out << '\n';
        is_first = true;
        for_columns(step, [&](const std::string &, const double value) {
          out << (is_first ? "" : ",") << value;
          is_first = false;
        });
      }
    out << '\n';
  }
} // namespace Signorini
