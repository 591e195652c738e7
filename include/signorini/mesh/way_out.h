// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_way_out_h
#define signorini_mesh_way_out_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/surface/box_tree.h>

#include <vector>

namespace Signorini
{
  /// Whether segments that begin on a surface leave the body behind it.
  class WayOut
  {
  public:
    /// @param surface a whole one, which must outlive this
    explicit WayOut(const ContactSurface &surface);

    /// Whether the segment from x in a face to y goes out through another face, farther from x than half of a
    /// width (length).
    bool leads_from(const unsigned int face, const dealii::Point<3> &x, const dealii::Point<3> &y,
                    const double width) const;

  private:
    const ContactSurface             &surface;
    const BoxTree                     tree;
    mutable std::vector<unsigned int> found;
  };
} // namespace Signorini

#endif
