// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_geometric_penetration_h
#define signorini_mortar_geometric_penetration_h

#include <signorini/mortar/face_moments.h>
#include <signorini/mortar/surface_values.h>

#include <limits>
#include <vector>

namespace Signorini
{
  /// The least gap of a surface and where it is; infinite without any.
  class LeastGap
  {
  public:
    /// A gap somewhere.
    void add(const double gap, const dealii::Point<3> &place);

    /// Collective. Those of all ranks.
    void reduce(const MPI_Comm communicator);

    /// The gap.
    double value() const
    {
      return least;
    }

    /// Where it is.
    const dealii::Point<3> &place() const
    {
      return where;
    }

  private:
    bool is_before(const double gap, const dealii::Point<3> &place) const;

    double           least = std::numeric_limits<double>::infinity();
    dealii::Point<3> where;
  };

  /// How far the deformed true surfaces are apart pointwise, not in the weighted sense of the constraint
  /// (lengths).
  struct GeometricPenetration
  {
    /// Least initial_gap()·n(x), and least of that after deformation; infinite where nothing is covered by
    /// what it may touch.
    double min_initial_gap, min_gap;
    /// Where the latter is: a point of the nonmortar surface before it is deformed.
    dealii::Point<3> min_gap_at;
    /// Over what gap the contact forces act: mean over them of the least gap after deformation of the face
    /// that they act on, none counted below zero; zero without forces.
    double loaded_gap;
    /// The largest doubt of the gap of a triangle of faces with an active corner (DoubtOfGaps).
    double gap_doubt;
    /// The middle of that triangle.
    dealii::Point<3> gap_doubt_at;
    /// Least gaps after deformation by face of the nonmortar surface, of what this rank has sampled.
    std::vector<LeastGap> of_faces;

    /// Largest n(x)·(u_non(x) - u_mor(Phi(x))) - initial_gap()·n(x): negative if the surfaces are apart.
    double max_penetration() const
    {
      return -min_gap;
    }
  };

  /// Edges at which a curved part of a surface ends beside a flatter one, such as the rim of a bore. The true
  /// edge is an arc; its chord, where the triangles of the flat side end, is no place of the body.
  class ChordEdges
  {
  public:
    /// Those of a surface. All triangles beside those that are asked for must be there: on the mortar side
    /// not all are that lie on one rank.
    explicit ChordEdges(const ContactSurface &surface);

    /// Whether a point of a triangle lies inside of such an edge, and the triangle is that of the flat side.
    bool has_point(const unsigned int triangle, const std::array<double, 3> &weights) const;

  private:
    /// By triangle and corner, of the edge opposite to it.
    std::vector<std::array<bool, 3>> is_chord;
  };

  /// Contact at the vertices of a nonmortar surface; both lists must outlive this.
  struct ContactAtVertices
  {
    /// Zero at hanging ones.
    const std::vector<double> &pressure;
    /// Those around which the doubt of the gap is wanted: the active ones, or none.
    const std::vector<bool> &doubted;
  };

  /// What a gap may be wrong by matters where contact may be. Pure numbers.
  struct GapDoubtRule
  {
    /// In doubts, how far a triangle may be open at its centre. A chamfer beside a press fit: its shape is in
    /// doubt by 0.007, a few per cent of how far it is open there.
    double apart = 10.;
  };

  /// By how much the weighted gaps of a surface may be wrong: the mean over each of its triangles of what
  /// gap_doubt() says of its parts, nothing of those that are far apart.
  class DoubtOfGaps
  {
  public:
    /// No parts yet.
    explicit DoubtOfGaps(const ContactSurface &surface);

    /// A part of a triangle.
    /// @param share of the triangle
    /// @param gap after deformation (length)
    void add(const unsigned int triangle, const double share, const double doubt, const double gap);

    /// Collective. Of all triangles: the length, and the middle of that triangle.
    std::pair<double, dealii::Point<3>> largest(const MPI_Comm communicator) const;

  private:
    const SurfaceMesh  &mesh;
    std::vector<double> shares, doubts;
  };

  /// The least gap of every face, and its mean over the contact forces.
  class GapUnderLoad
  {
  public:
    /// @param pressure per vertex of the nonmortar surface; must outlive this
    GapUnderLoad(const ContactSurface &surface, const std::vector<double> &pressure);

    /// Part of a face with its least gap.
    void add(const unsigned int triangle, const double area, const LeastGap &gap);

    /// Collective. See GeometricPenetration::loaded_gap.
    double mean(const MPI_Comm communicator) const;

    /// By face; the gap is infinite without a part.
    const std::vector<LeastGap> &of_faces() const
    {
      return least;
    }

  private:
    const ContactSurface      &surface;
    const std::vector<double> &pressure;
    /// By face.
    std::vector<double>   area;
    std::vector<LeastGap> least;
  };

  /// Collective. Samples seven points (corners, middles of edges, centre) of every overlay triangle of all
  /// ranks but for chords (ChordEdges), with displacements at their true reference points and normals linear
  /// on triangles. The share of
  /// the surface that is covered at all is PairCoupling::covered_area / PairCoupling::area.
  /// @param pair with the overlay of this rank's own faces
  /// @param displacement_nonmortar displacement_mortar per vertex of each surface (hanging ones too)
  /// @param prescribed_gap replaces initial_gap()·n(x) if not empty
  GeometricPenetration sample_geometric_penetration(const FacingSurfaces       &pair,
                                                    const std::vector<Vector3> &displacement_nonmortar,
                                                    const std::vector<Vector3> &displacement_mortar,
                                                    const ContactAtVertices    &contact,
                                                    const GapFunction          &prescribed_gap,
                                                    const MPI_Comm              communicator);

  /// By how much the gap of a triangle may be wrong (length): what the shapes of both sides do not know of
  /// themselves, and the heights over facets that a user wants to stand for the surface; the largest of seven
  /// points.
  double gap_doubt(const SurfaceValues &nonmortar, const ContactSurface &mortar, const OverlayTriangle &cell);

  /// The same for a rigid partner: of the nonmortar surface alone.
  double gap_doubt(const ContactSurface &nonmortar, const unsigned int triangle);

  /// Whether a corner of the face of a triangle is marked.
  bool has_corner(const ContactSurface &surface, const unsigned int triangle,
                  const std::vector<bool> &marked);

  /// Collective. The largest gap_doubt() of faces with a marked corner.
  /// @param is_near per vertex of the nonmortar surface
  double sample_gap_doubt(const ContactSurface &nonmortar, const ContactSurface &mortar,
                          const std::vector<OverlayTriangle> &overlay, const std::vector<bool> &is_near,
                          const MPI_Comm communicator);

  /// The same for a rigid partner: of the nonmortar surface alone.
  double sample_gap_doubt(const ContactSurface &nonmortar, const std::vector<bool> &is_near,
                          const MPI_Comm communicator);
} // namespace Signorini

#endif
