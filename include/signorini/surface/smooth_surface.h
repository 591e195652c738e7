// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_smooth_surface_h
#define signorini_surface_smooth_surface_h

#include <signorini/surface/surface_mesh.h>

#include <vector>

namespace Signorini
{
  /// When a triangulated surface is taken for a smooth one.
  struct SmoothingRule
  {
    /// What the quadratic surfaces at the corners of a triangle may leave over, relative to the heights of
    /// the neighbours (root mean squares), for the triangle to count as a piece of a smooth surface; and the
    /// disagreement of the estimates of a height, also with the patch, relative to what the largest curvature
    /// there gives. Both are nothing on spheres and cylinders. With these limits all triangles of spheres and
    /// cylinders of six cells across pass, and less than a quarter where noise is as large as the heights of
    /// facets (tests/unit/surface/smooth_surface.cc); on the bones of a knee the residual is 0.11 (median).
    double largest_residual     = .1;
    double largest_disagreement = .35;
    /// Curvatures at the ends of an edge may differ if the patch has both of them, up to this part of their
    /// difference. Of 50,656 triangles of 58 surfaces 49,194 are believed with 0, 49,884, 50,071, 50,185 and
    /// 50,218 with .05, .1, .2 and .5; with noise as many with all of these.
    double agrees = .1;
    /// Residual up to which a fit is the surface itself: vertices of spheres and cylinders from CAD lie on
    /// them to 1e-5 of the heights of coarse facets and better. Such fits hold as far as vertices lie on
    /// them.
    double exact = 1e-3;
    /// A triangle takes the exact fit of a vertex nearby that leaves over less than this part of what those
    /// at its corners do. Blocks whose edges and corners are rounded with 2 to 11 faces: normals wrong by 28
    /// to 4 degrees at the seams without it, to rounding with it. (Fits that are not exact, but four times
    /// better, make rims that are tori six times better as well; but teeth of gears, whose curves are none of
    /// these, ran into each other by .002 to .008 instead of .0007, and a part of a rim that is still not
    /// sure stays facets: beside patches on the other side worse than facets on both.)
    double lends = .02;
    /// How many points more than unknowns there must be: at corners of a surface fits with two are exact by
    /// chance.
    unsigned int least_checks = 3;
    /// Residual up to which tori and cones are the surface itself. With six unknowns instead of five they fit
    /// what is something else: cylinders with fillets, 2 to 4 faces around these, had 836 vertices whose fits
    /// left over less than 1e-8, and five by chance that left over 1e-3; of a stem of an implant 1200 left
    /// over 1e-5 to 1e-3, and gaps were wrong.
    double exact_arc = 1e-5;
    /// Which part of what a quadratic surface leaves over one of third degree may leave over at most to be
    /// taken, per check: of noise both leave as much. With it patches over ellipsoids, waves and other free
    /// surfaces are 1.2 to 14 times nearer to these, and as near with noise of 1 to 30 % of the heights.
    double cubic_leaves = .5;
    /// At the end of a curve that is extruded: how many places along it a fit needs, the rings of neighbours
    /// that may be asked for them, and the residual up to which the curve goes on so far. Ellipses of 64 and
    /// 128 faces are met 4 to 14 times better at ends than with two places, of 32 faces 1.7 times worse.
    unsigned int places_at_ends = 4, rings_at_ends = 4;
    double       goes_on = .01;
    /// What a quadratic surface leaves over at most where a torus or cone is looked for: 0.22 on coarse ones.
    double may_be_arc = .3;
    /// Triangles that lie in one plane up to this share of their size are flat: noise of files with eight
    /// digits is none.
    double flat = 1e-6;
    /// Of what the surface turns by near a vertex, how far three normals are apart at least for it to be
    /// known as straight: two always lie across some direction.
    double distinct = .01;
    /// Degrees between the normals that are found for the end of a curved part and that of the flat one
    /// beside it up to which it may touch that, as fillets of three faces do (7 at corners); and up to what
    /// part of what the curved part turns by within its first faces. A cone does not turn across.
    double touches_flat = 10., of_the_turn = .5;
    /// Or up to what part of the angle to the facets there, and how many degrees: those of a cone have its
    /// normal.
    double of_the_facets = .5, largest_touch = 25.;
  };

  /// The smooth surface that a triangulated one stands for: a curved patch over each triangle, through its
  /// vertices, from their normals:
  ///
  ///   offset(x) = 2 H / (|N| (1 + |N|)) N ,  x = sum_a w_a x_a ,  N = sum_a w_a n_a ,
  ///   H = sum_{a != b} w_a w_b (1 + w_a - w_b) ((x_a - x_b)·n_a) / 2 + B w_1 w_2 w_3    (doc/algorithm.md,
  ///   (19)),
  ///
  /// exact on spheres and cylinders (where x - centre = R N, 2 H is R (1 - |N|²) and the height R (1 - |N|)),
  /// of fourth order where the normals are exact, nothing on flat ones, continuous across edges but at
  /// creases and where exact surfaces meet. B is what the curvatures at the corners say. Normals come from a
  /// quadratic surface through each vertex, fitted to two rings of neighbours, which is exact on spheres,
  /// cylinders, cones and tori, with terms of third degree where these leave much less over; where the
  /// curvature jumps, as where a fillet goes over into a sphere, to one through a vertex nearby on the same
  /// side. Creases, and the borders of flat parts, are borders of the smooth pieces and keep a normal on
  /// either side.
  class SmoothSurface
  {
  public:
    /// The curved patch over a triangle.
    struct Patch
    {
      /// Unit normals at the corners, those of this side of creases.
      std::array<dealii::Tensor<1, 3>, 3> normals;
      /// B, of the third degree: a 27th of it is the height in the middle beyond that by the normals
      /// (length).
      double bubble = 0.;
      /// Largest height of the patch over the triangle (length).
      double height = 0.;
      /// By how much it may be wrong (length): how far the curvatures at either end of an edge, found from
      /// different neighbourhoods (or from one, that of a vertex nearby, where a surface goes over into
      /// another one), are from those that it has there, as heights of the middle; what the fits leave over.
      /// On cones and tori the distance from these.
      double doubt = 0.;
      /// Whether the mesh itself shows that it stands for a smooth surface here.
      bool is_smooth = false;
      /// By edge, from corner i to the next one: whether the triangle beyond it does not, so that what is
      /// believed is straight there.
      std::array<bool, 3> ends_at_edge = {{false, false, false}};
      /// Whether the triangle belongs to a flat part, which stays as it is.
      bool is_flat = false;
    };

    /// @param wanted the triangles that need patches; the others are neighbours only
    SmoothSurface(SurfaceMesh mesh, const std::vector<bool> &wanted, const SmoothingRule &rule = {});

    /// The facets.
    const SurfaceMesh &mesh() const
    {
      return surface;
    }

    /// By edge of the topology of the facets (find_creases()).
    const std::vector<bool> &creases() const
    {
      return is_crease;
    }

    /// The patch over a triangle that was wanted.
    const Patch &patch(const unsigned int triangle) const
    {
      return patches[triangle];
    }

    /// From the point with given barycentric coordinates to the curved patch (length), whether the triangle
    /// is believed to be smooth or not.
    dealii::Tensor<1, 3> offset(const unsigned int triangle, const std::array<double, 3> &weights) const;

    /// The same where the triangle is believed to be smooth, nothing elsewhere: continuous between both.
    dealii::Tensor<1, 3> believed_offset(const unsigned int           triangle,
                                         const std::array<double, 3> &weights) const;

  private:
    SurfaceMesh        surface;
    std::vector<Patch> patches;
    std::vector<bool>  is_crease;
  };
} // namespace Signorini

#endif
