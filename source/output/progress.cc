// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/process_memory.h>
#include <signorini/output/progress.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <sstream>

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



  namespace
  {
    /// mpirun gives its processes terminals of their own, wherever its own output goes. It is their parent on
    /// this computer.
    bool launcher_has_terminal()
    {
      const bool is_launched =
          std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
      if (!is_launched)
        return true;
      char              target[64] = "";
      const std::string link       = "/proc/" + std::to_string(getppid()) + "/fd/1";
      if (readlink(link.c_str(), target, sizeof(target) - 1) <= 0)
        return false;
      const std::string name = target;
      return name.compare(0, 8, "/dev/pts") == 0 || name.compare(0, 8, "/dev/tty") == 0;
    }
  } // namespace



  bool Progress::wanted(const bool is_root, const unsigned int verbosity)
  {
    return is_root && verbosity > 0 && isatty(STDOUT_FILENO) == 1 && launcher_has_terminal();
  }



  void Progress::write(const std::string &text)
  {
    if (!enabled)
      return;
    out << '\r' << text << std::string(width > text.size() ? width - text.size() : 0, ' ') << std::flush;
    width = text.size();
  }



  void Progress::expect(const double before, const double present, const double all)
  {
    this->before  = before;
    this->present = present;
    this->all     = all;
  }



  std::string Progress::outlook(const double fraction) const
  {
    std::ostringstream text;
    const double       done = before + fraction * present;
    // The first hundredth says nothing about the rest.
    if (done > .01 * all)
      {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        const double                        left    = elapsed.count() * std::max(0., all - done) / done;
        text << "   about "
             << (left < 100. ? std::to_string(std::lround(left)) + " s"
                             : std::to_string(std::lround(left / 60.)) + " min")
             << " left";
      }
    text << "   " << std::setprecision(2) << process_memory().resident / 1e9 << " GB";
    return text.str();
  }



  void Progress::show(const std::string &phase)
  {
    if (enabled)
      write("  " + phase + " ..." + outlook(0.));
  }



  void Progress::show(const std::string &phase, const double fraction)
  {
    if (!enabled)
      return;
    constexpr unsigned int length = 20;
    const double           part   = std::isfinite(fraction) ? std::clamp(fraction, 0., 1.) : 0.;
    const auto             filled = static_cast<unsigned int>(part * length);
    write("  " + phase + " [" + std::string(filled, '#') + std::string(length - filled, '.') + "]" +
          outlook(part));
  }



  void Progress::clear()
  {
    if (width == 0)
      return;
    write("");
    out << '\r' << std::flush;
  }
} // namespace Signorini
