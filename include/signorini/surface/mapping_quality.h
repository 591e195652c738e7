// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_mapping_quality_h
#define signorini_surface_mapping_quality_h

#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>

#include <iosfwd>
#include <map>
#include <string>

namespace Signorini
{
  /// How the two surfaces of a mapping lie to each other, over the selected nonmortar triangles.
  struct MappingQuality
  {
    /// Largest angle between the normal of a nonmortar triangle and the turned one of a mortar triangle that
    /// it meets, in degrees, and the mean over the area.
    double largest_angle = 0., mean_angle = 0.;
    /// (Phi(x) - x) . n at the corners of the overlay, n the normal of the nonmortar triangle.
    double min_gap, max_gap;
    /// Area where the gap lies in each tenth of [min_gap, max_gap].
    std::array<double, 10> histogram = {};
  };

  /// Collective over the ranks that hold parts of a mapping. The surfaces are those of the mapping. Gaps are
  /// +-infinity if the surfaces do not meet.
  MappingQuality assess_mapping(const ContactMapping &mapping, const SurfaceMesh &nonmortar,
                                const SurfaceMesh &mortar, const MPI_Comm communicator = MPI_COMM_SELF);

  /// Collective. The report of the whole mapping from those of its parts.
  MappingReport sum_reports(MappingReport report, const MPI_Comm communicator);

  /// Words for the reasons of Unmapped: "no hit", ...
  const char *reason_name(const Unmapped reason);

  /// Number of unmapped vertices for each reason that occurs.
  std::map<std::string, std::size_t> count_unmapped(const MappingReport &report);

  /// Whether a surface is covered to more than 100 %. Of the whole mapping (sum_reports()).
  bool covers_twice(const MappingReport &report);

  /// What is wrong with a mapping, in words: lost or turned pieces, a tiling that is not exact, a surface
  /// that is covered more than once. Empty where all is well. Of the whole mapping.
  std::string describe_errors(const MappingReport &report);

  /// A text of some lines for a person.
  void print_mapping(std::ostream &out, const MappingReport &report, const MappingQuality &quality);
} // namespace Signorini

#endif
