// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_moments_h
#define signorini_mortar_face_moments_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/field.h>
#include <signorini/surface/overlay.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace Signorini
{
  /// How the other side lies over a nonmortar face (SeatedOverlay): nearly all of it along the face up to an
  /// angle, most of it away by at least an angle (degrees, between the true surfaces).
  struct FaceLie
  {
    /// As above.
    double along = 0., away = 0.;
  };

  /// Integrals over the covered part F_c of one nonmortar face, with the bilinear functions phi_a of its four
  /// corners (also fixed and hanging ones). Everything that the dual basis needs is a combination of them.
  struct FaceMoments
  {
    /// Index into ContactSurface::faces of the nonmortar side.
    unsigned int face = 0;
    /// Integrals of the corner functions over the whole face (area), with the face's triangles as domain.
    std::array<double, 4> full = {{0., 0., 0., 0.}};
    /// Area of F_c and of the face.
    double covered = 0., area = 0.;
    /// 4x4 row by row: products of corner functions (area).
    std::array<double, 16> mass = {};
    /// Corner function times initial_gap() without its bubbles (area * length; doc/algorithm.md, (17a)); or,
    /// with a prescribed gap, that gap in component 0.
    std::array<Vector3, 4> gap;
    /// Corner function times the outward unit normal of the other side at the images (area), interpolated
    /// from its vertices. Nothing with obstacles, which are seen along the own normals.
    std::array<Vector3, 4> facing;
    /// For each mortar vertex (index of its surface): products of its bilinear function with the corner
    /// functions.
    std::vector<std::pair<unsigned int, std::array<double, 4>>> coupling;
    /// As above; zero unless the flanks of seats were looked for.
    FaceLie lie;
  };

  /// A gap (length) prescribed at points of the nonmortar surface; empty for the geometric one.
  using GapFunction = ScalarField;

  /// Moments of the faces of the nonmortar surface that this rank works on (ContactSurface::Face::worker),
  /// sorted by face; those of uncovered faces hold the area only.
  ///
  /// Pairs of parallelograms are integrated exactly (degree 4 on every overlay triangle), other faces and
  /// prescribed gaps by a collapsed 8x8 Gauss rule (doc/algorithm.md, chapter 3, moments).
  /// @param overlay the overlay of this rank's own faces, ordered by nonmortar triangle (ContactMapping)
  std::vector<FaceMoments> compute_face_moments(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                                const std::vector<OverlayTriangle> &overlay,
                                                const GapFunction                  &prescribed_gap,
                                                const MPI_Comm                      communicator);

  /// The vector (length) from a point to its image in the direction of a unit normal; false if there is none.
  using ImageFunction = std::function<bool(Vector3 &, const dealii::Point<3> &, const Vector3 &)>;

  /// The same where the images (of points of the true surface) are given by a function and nothing moves on
  /// the other side: no coupling. Normals are linear on triangles. A triangle with a quadrature point without
  /// image counts as uncovered.
  std::vector<FaceMoments> compute_face_moments(const ContactSurface &nonmortar, const ImageFunction &image,
                                                const MPI_Comm communicator);
} // namespace Signorini

#endif
