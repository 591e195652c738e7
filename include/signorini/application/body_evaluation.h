// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_body_evaluation_h
#define signorini_application_body_evaluation_h

#include <signorini/application/contact_solve.h>
#include <signorini/output/results.h>

#include <vector>

namespace Signorini
{
  /// A force and its moment about the origin of the coordinates.
  struct Resultant
  {
    /// Force; force times length.
    Vector3 force, moment;
  };

  /// Collective. What loads on volumes, boundaries and nodes (not prescribed displacements, not rigid faces)
  /// do to each body, from the nodal forces that the solver sees.
  std::vector<Resultant> load_resultants(const ContactModel &model, const Discretization &discretization,
                                         const Loads &loads);

  /// Collective. Those of the model, with those of its rigid faces.
  std::vector<Resultant> all_loads(const ContactModel &model, const Discretization &discretization);

  /// How far the displacements of a body are from infinitesimal ones.
  struct Distortion
  {
    /// Angle of the rotation of a small one (radians), and absolute value of the principal strain.
    double rotation = 0., strain = 0.;
  };

  /// Collective. The largest of each body, at the centres of cells.
  std::vector<Distortion> largest_distortions(const ContactModel &model, const Discretization &discretization,
                                              const Vector &displacement);

  /// Collective. Extrema of displacement, stress, strain and rotation of each body, and what acts on it.
  /// @param results with boundaries and pairs
  std::vector<BodyResult> evaluate_bodies(const ContactModel &model, const Discretization &discretization,
                                          const Vector &displacement, const Results &results);

  /// How far bodies slide on each other where they touch: along the surface (length), and in multiples of the
  /// width of the faces there. Of surfaces that end up apart without having been lifted off each other, where
  /// they are nearer than they have slid: whether they touch there is for the gap to say, which is that of
  /// the points that face each other at the beginning.
  struct Slip
  {
    /// Along the surface; in multiples of the width of faces (1).
    double length = 0., in_faces = 0.;
    /// The part of the contact force on nodes that slide toward the other side only because their normals
    /// are not those of the other side: with the bodies where they end up, others would touch.
    double pressed = 0.;
  };

  /// Collective. The largest of a pair.
  Slip largest_slip(const Discretization &discretization, const ContactSolution &solution,
                    const unsigned int pair);
} // namespace Signorini

#endif
