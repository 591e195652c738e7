// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_report_mesh_h
#define signorini_output_report_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// Triangles for the eye, with what the page has to know of them.
  struct ReportMesh
  {
    /// What is known of a triangle; may be combined.
    enum Kind : unsigned char
    {
      /// Half of a quadrilateral, whose diagonal goes from the last corner to the first.
      half = 1,
      /// On a surface of a contact pair.
      in_contact = 2
    };

    /// Points (length), vertex numbers of the triangles, counterclockwise from outside, and kinds.
    std::vector<dealii::Point<3>>            vertices;
    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<unsigned char>               kinds;

    /// Adds a face with three or four corners as one or two triangles.
    void add_face(const std::array<unsigned int, 4> &corners, const unsigned int n_corners,
                  const bool is_in_contact);

    /// Puts triangles of one kind one after the other, the order of which they keep: by rising number.
    void sort_by_kind();
  };

  /// How large the drawing of a run may become. Both numbers bound the file, not what is computed.
  struct ReportRule
  {
    /// Bytes of the surfaces and their fields, of all load steps together: 20 MB as text with the contact
    /// surfaces, which may have a quarter as many triangles again. From 1e6 (coarse) to what a browser bears.
    double bytes = 9e6;
    /// Load steps that are drawn; others have their row in the curve only.
    unsigned int most_steps = 50;

    /// Triangles of all bodies that so many states leave room for: 22 bytes each, and 4 for the fields of
    /// each state.
    std::size_t n_triangles(const unsigned int n_states) const
    {
      return static_cast<std::size_t>(bytes / (22. + 4. * n_states));
    }
  };

  /// Merges vertices until there are at most so many triangles: those in a cube of a regular grid become the
  /// one nearest to its middle, where the faces of the box around all of them lie; from the finest grid on
  /// that is coarse enough. Fine parts lose the most; a vertex that stays is one of the mesh, with its
  /// values. The same on any number of ranks.
  /// @param pinned by vertex: those that stay, as long as this leaves enough others to merge; may be empty
  /// @return the numbers that the vertices of the new mesh had; empty if nothing was to be done
  std::vector<unsigned int> thin(ReportMesh &mesh, const std::size_t n_triangles,
                                 const std::vector<bool> &pinned = {});
} // namespace Signorini

#endif
