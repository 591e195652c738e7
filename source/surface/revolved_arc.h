// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_revolved_arc_h
#define signorini_source_surface_revolved_arc_h

#include "vertex_quadric.h"

namespace Signorini
{
  /// A surface of revolution whose profile is an arc or a line, through a vertex: torus, cone, sphere or
  /// cylinder. In the frame of the vertex the profile is a curve in the plane of v and the normal, and u
  /// leads around the axis. Places are vectors from the vertex (length).
  struct RevolvedArc
  {
    dealii::Tensor<1, 3> u, v, normal;
    /// Curvatures across the profile and along it: those of c and e of a Quadric. 1/length.
    double across = 0., along = 0.;
    /// The distance from the axis is 1/|q|, in the direction of q = -across normal + tilt v. 1/length.
    double tilt = 0.;
    /// As of a Quadric.
    double       residual = 0., left_over = 0.;
    unsigned int n_checks = 0;

    /// About how far a place is from the surface, along its normal (length); a zero is exact.
    double distance(const dealii::Tensor<1, 3> &x) const;

    /// Whether a place is not much nearer to the axis than the vertex is: at the apex of a cone curvature has
    /// no bound.
    bool reaches(const dealii::Tensor<1, 3> &x) const;

    /// The quadratic surface that touches it near a place.
    Quadric at(const dealii::Tensor<1, 3> &x) const;
  };

  /// Fits one to the vectors from a vertex to its neighbours, with weights 1/distance², from the quadratic
  /// surface that has been fitted to them. Returns false if there are too few or none is found.
  bool fit(RevolvedArc &arc, const Quadric &start, const std::vector<dealii::Tensor<1, 3>> &neighbours);
} // namespace Signorini

#endif
