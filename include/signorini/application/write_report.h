// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_write_report_h
#define signorini_application_write_report_h

#include <signorini/application/parameters.h>
#include <signorini/output/output_folder.h>
#include <signorini/output/report_surfaces.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// The drawn fields of load steps, which wait in files of the output folder for the page that is written at
  /// the end: an interrupted run finds them there again.
  class ReportSteps
  {
  public:
    /// The model must outlive the object.
    /// @param n_steps of the whole series
    ReportSteps(const ContactModel &model, const OutputFolder &folder, const std::size_t n_steps);

    /// Collective. Keeps the fields of a step, by number, if it is one of those that are drawn: the last,
    /// and those before it at equal distances.
    void add(const unsigned int step, const double time, const Discretization &discretization,
             const ContactSolution &solution);

    /// How many are drawn in a series of so many.
    static unsigned int n_drawn(const std::size_t n_steps);

    /// The file of a step in the folder.
    static std::string file_name(const std::size_t step);

  private:
    const ContactModel                   &model;
    const OutputFolder                   &folder;
    const std::size_t                     n_steps;
    std::unique_ptr<const ReportSurfaces> surfaces;
  };

  /// Collective. Writes report.html: what summary.json says, the problem, the parameters, and the surfaces
  /// with their fields. Removes the files of ReportSteps.
  /// @param nested with its results complete
  void write_report(const NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                    const OutputFolder &folder);
} // namespace Signorini

#endif
