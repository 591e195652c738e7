// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_moments_h
#define signorini_mortar_face_moments_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/surface/overlay.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace Signorini
{
  /// Integrals over the covered part of one nonmortar face, with the bilinear functions of its four corners
  /// (also fixed and hanging ones). Everything that the dual basis needs is a combination of them.
  struct FaceMoments
  {
    /// Index into ContactSurface::faces of the nonmortar side.
    unsigned int face = 0;
    /// Integrals over the whole face (area).
    std::array<double, 4> full = {{0., 0., 0., 0.}};
    /// Covered area, and area of the face.
    double covered = 0., area = 0.;
    /// 4x4 row by row: products of corner functions.
    std::array<double, 16> mass = {};
    /// Corner function times Phi(x) - x (area * length); or, with a prescribed gap, that gap in component 0.
    std::array<Vector3, 4> gap;
    /// For each mortar vertex (index of its surface): products with the corner functions.
    std::vector<std::pair<unsigned int, std::array<double, 4>>> coupling;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &face &covered &area;
      for (unsigned int v = 0; v < 4; ++v)
        archive &full[v] &gap[v];
      for (double &m : mass)
        archive &m;
      std::size_t n = coupling.size();
      archive    &n;
      coupling.resize(n);
      for (auto &[vertex, values] : coupling)
        {
          archive &vertex;
          for (double &value : values)
            archive &value;
        }
    }
  };

  using GapFunction = std::function<double(const dealii::Point<3> &)>;

  /// Collective. Moments of all faces that the overlay touches or that have area, sorted by face, on all ranks.
  /// `overlay` holds the overlay of this rank's own faces, ordered by nonmortar triangle.
  std::vector<FaceMoments>
  compute_face_moments(const ContactSurface               &nonmortar,
                       const ContactSurface               &mortar,
                       const std::vector<OverlayTriangle> &overlay,
                       const GapFunction                  &prescribed_gap,
                       const MPI_Comm                      communicator);
} // namespace Signorini

#endif
