// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_way_out_h
#define signorini_mesh_way_out_h

#include <signorini/surface/box_tree.h>
#include <signorini/surface/surface_mesh.h>

#include <vector>

namespace Signorini
{
  /// Whether segments that begin on the boundary of a body leave it behind that boundary.
  class WayOut
  {
  public:
    /// @param boundary as much of it as is known, with what is not mapped; must outlive this
    explicit WayOut(const SurfaceMesh &boundary);

    /// Whether the segment from x on the boundary to y goes out through it, farther from x than half of a
    /// width (length): that of the face around x.
    bool leads_from(const dealii::Point<3> &x, const dealii::Point<3> &y, const double width) const;

  private:
    const SurfaceMesh                &boundary;
    const BoxTree                     tree;
    mutable std::vector<unsigned int> found;
  };
} // namespace Signorini

#endif
