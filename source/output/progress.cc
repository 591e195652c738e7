// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/progress.h>

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace Signorini
{
  Progress::Progress(std::ostream &out, const bool enabled)
    : out(out)
    , enabled(enabled)
  {
  }



  Progress::~Progress()
  {
    clear();
  }



  bool Progress::wanted(const bool is_root, const unsigned int verbosity)
  {
    return is_root && verbosity > 0 && isatty(STDOUT_FILENO) == 1;
  }



  void Progress::write(const std::string &text)
  {
    if (!enabled)
      return;
    out << '\r' << text << std::string(width > text.size() ? width - text.size() : 0, ' ') << std::flush;
    width = text.size();
  }



  void Progress::show(const std::string &phase)
  {
    write("  " + phase + " ...");
  }



  void Progress::show(const std::string &phase, const double fraction)
  {
    constexpr unsigned int length = 30;
    const double           part   = std::isfinite(fraction) ? std::clamp(fraction, 0., 1.) : 0.;
    const auto             filled = static_cast<unsigned int>(part * length);
    write("  " + phase + " [" + std::string(filled, '#') + std::string(length - filled, '.') + "] " +
          std::to_string(static_cast<int>(100. * part)) + " %");
  }



  void Progress::clear()
  {
    if (width == 0)
      return;
    write("");
    out << '\r' << std::flush;
  }
} // namespace Signorini
