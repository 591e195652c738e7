// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_vertex_fits_h
#define signorini_source_surface_vertex_fits_h

#include "revolved_arc.h"
#include "smooth_pieces.h"

#include <signorini/surface/smooth_surface.h>

#include <map>
#include <optional>
#include <vector>

namespace Signorini
{
  /// A surface of revolution and its vertex.
  struct PlacedArc
  {
    RevolvedArc      arc;
    dealii::Point<3> vertex;

    /// About how far a point is from it, along its normal (length).
    double distance(const dealii::Point<3> &x) const
    {
      return arc.distance(x - vertex);
    }
  };

  /// What is known of the surface at the corners of a triangle.
  struct TriangleFit
  {
    std::array<Quadric, 3> corners;
    /// Whether there was enough around all of them to fit a surface to.
    bool is_complete = true;
  };

  /// The quadratic surfaces through the vertices, as the triangles around them see them. Where a cylinder
  /// goes on as a sphere or a torus, a fit through a vertex at the seam is neither: curvature jumps. Then a
  /// triangle takes the surface through a vertex nearby that lies on one side alone, if that is exact
  /// (sphere, cylinder, cone, torus). The normal at a vertex is the mean of what the triangles around it
  /// took, but where all of them are exact: there each has its own.
  class VertexFits
  {
  public:
    VertexFits(const SurfaceMesh &mesh, const SmoothPieces &pieces, const SmoothingRule &rule);

    TriangleFit at_corners(const unsigned int triangle);

    /// The torus or cone on which the corners of a triangle lie, if it takes one.
    std::optional<PlacedArc> arc_of(const unsigned int triangle);

    /// The fit through a piece vertex alone, with the normal that it has there.
    Quadric at_vertex(const unsigned int piece_vertex);

  private:
    /// The fit through a piece vertex, made when it is first asked for; its mean normal alone if that fails.
    const Quadric &own_fit(const unsigned int piece_vertex);
    bool           is_fitted(const unsigned int piece_vertex);
    bool           fit_vertex(Quadric &quadric, const unsigned int piece_vertex);
    /// Takes a sphere, a cone or a torus in place of a fit that leaves something over, if it leaves nothing
    /// over. Returns whether it did.
    bool fit_exactly(Quadric &quadric, const unsigned int piece_vertex);
    /// Takes a fit with terms of third degree in its place, if that leaves much less over.
    void fit_changing_curvature(Quadric &quadric, const unsigned int piece_vertex);
    /// At the end of a curve, which neighbours lie on one side of, takes a fit to more of them than those of
    /// some rings, if the curve goes on smoothly.
    void fit_end_of_curve(Quadric &quadric, const unsigned int piece_vertex,
                          const dealii::Tensor<1, 3> &straight, const unsigned int n_rings);
    /// Without itself.
    std::vector<unsigned int> neighbours(const unsigned int piece_vertex, const unsigned int n_rings) const;
    /// The vectors to others.
    std::vector<dealii::Tensor<1, 3>> ways(const unsigned int               piece_vertex,
                                           const std::vector<unsigned int> &others) const;
    /// The direction in which the surface is straight around a piece vertex, as those of extruded bodies are:
    /// the normals of the triangles nearby lie across it. Nothing if there is none, or many.
    dealii::Tensor<1, 3> find_straight_direction(const unsigned int piece_vertex);

    /// The piece vertex whose surface a triangle takes; nothing if each corner has its own.
    unsigned int lender(const unsigned int triangle);
    unsigned int find_lender(const unsigned int triangle);
    /// Whether the corners of a triangle lie on the surface fitted to a piece vertex.
    bool lies_on(const unsigned int triangle, const unsigned int piece_vertex);
    /// Whether a triangle takes a surface that is the true one, and whether all around a piece vertex do.
    bool is_exact(const unsigned int triangle);
    bool meet_exactly(const unsigned int piece_vertex);
    /// The surface that a triangle takes, at one of its corners.
    Quadric taken_at(const unsigned int triangle, const unsigned int corner);
    /// The mean of what the triangles around a piece vertex took.
    const dealii::Tensor<1, 3> &normal(const unsigned int piece_vertex);

    const SurfaceMesh   &mesh;
    const SmoothPieces  &pieces;
    const SmoothingRule &rule;
    /// By piece vertex.
    std::vector<Quadric> quadrics;
    /// What vertices of tori and cones lie on.
    std::map<unsigned int, RevolvedArc> arcs;
    std::vector<dealii::Tensor<1, 3>>   normals;
    std::vector<bool>                   was_tried, has_fit;
    /// By triangle, once it has been asked for.
    std::vector<unsigned int>     lenders;
    static constexpr unsigned int unknown = SurfaceTopology::none - 1;
    std::vector<unsigned int>     near;
  };
} // namespace Signorini

#endif
