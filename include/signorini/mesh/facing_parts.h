// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_facing_parts_h
#define signorini_mesh_facing_parts_h

#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/contact_surface.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace Signorini
{
  /// The parts of a whole contact surface between sharp edges (of more than 60 degrees), and how far each is
  /// from what it faces of the other side. Boundaries are often given with more than what may touch: a block
  /// with its walls, a plate with a slot. At such an edge the mean of the normals points nowhere. Pieces of
  /// parts between creases (find_creases()) are left out if they face nothing: beside the bore of a fork with
  /// a chamfer at its mouth the outer faces see nothing of the pin.
  class FacingParts
  {
  public:
    /// @param surface must outlive this
    /// @param boundary that of the body with what the surface has lost already; must outlive this
    FacingParts(const ContactSurface &surface, const SurfaceMesh &boundary);
    /// The same with the boundary that the surface is.
    explicit FacingParts(const ContactSurface &surface)
      : FacingParts(surface, surface.mesh)
    {
    }

    /// Through which nothing is seen.
    const SurfaceMesh &boundary_of_body() const
    {
      return boundary;
    }

    /// How many pieces there are.
    std::size_t n_pieces() const
    {
      return is_blind.size();
    }

    /// A face faces something at a distance along its normal (length, no sign).
    void see(const unsigned int face, const double distance)
    {
      seen[face] = std::min(seen[face], distance);
    }

    /// Collective, after all that this rank has seen. Where nothing is seen by any part all of it stays.
    void finish(const MPI_Comm communicator);

    /// From what a face faces (length), infinite if that is nothing; after finish().
    double distance(const unsigned int face) const
    {
      return seen[face];
    }

    /// Whether that is more than the face is wide.
    bool is_far(const unsigned int face) const;

    /// Leaves out the parts all of whose faces that face anything are among some. Nothing if nothing else
    /// would be left. Returns how many faces that are.
    std::size_t leave(const std::vector<bool> &some);

    /// How many faces belong to pieces that face nothing; none where nothing is seen by any.
    std::size_t n_blind() const;

    /// Whether a piece faces nothing, or a normal does not count at some vertex.
    bool leaves_out_anything() const;

    /// Whether a face belongs to a piece that faces something, and to a part that stays.
    bool is_kept(const unsigned int face) const
    {
      return parts[part_of[face]].distance < infinite && !is_blind[piece_of[face]];
    }

    /// Whether the normal of a face counts for the mapping at one of its vertices: not if its part is farther
    /// away than its faces are wide, and another part is nearer there. In a groove all do.
    bool counts(const unsigned int face, const unsigned int vertex) const;

    /// Whether the multiplier of a vertex acts on a face there: if its normal counts, and in a groove if no
    /// other part is nearer to what it faces around the vertex.
    bool acts(const unsigned int face, const unsigned int vertex) const;

  private:
    struct Part
    {
      /// From what it faces (length), and that in widths of the face there, the least of each.
      double distance = infinite, widths = infinite;
    };

    static constexpr double infinite = std::numeric_limits<double>::infinity();

    void find_nearest();
    void find_far_in_grooves();

    const ContactSurface &surface;
    const SurfaceMesh    &boundary;
    /// By face: its part, its piece.
    std::vector<unsigned int> part_of, piece_of;
    std::vector<Part>         parts;
    /// By piece, whether it faces nothing.
    std::vector<bool> is_blind;
    /// By face: the least distance of what it faces.
    std::vector<double> seen;
    /// By vertex: the least distance of a part there.
    std::vector<double> nearest;
    /// By vertex in a groove the parts that do not act there: a rib may touch with its foot, and face nothing
    /// where it ends.
    std::map<unsigned int, std::set<unsigned int>> far_in_grooves;
  };

  /// Of the normals beside a sharp edge: more than 60 degrees. Six facets around a pin are none, up to
  /// rounding, chamfers neither.
  constexpr double cosine_of_sharp_edges = .5 - 1e-6;

  /// Whether some of unit normals are not linked with the others by steps of at least a cosine.
  bool fall_apart(const std::vector<Vector3> &normals, const double least_cosine = cosine_of_sharp_edges);

  /// Which faces are looked at, at which of their vertices.
  using FaceFilter = std::function<bool(unsigned int face, unsigned int vertex)>;

  /// All of them.
  inline bool all_faces(const unsigned int, const unsigned int)
  {
    return true;
  }

  /// Per vertex, whether not all triangles around it hang together without a sharp edge of the true surface
  /// (here of more than 40 degrees): the vertex normal is that of none of them then. Those of a piece count
  /// if they are there.
  std::vector<bool> vertices_on_sharp_edges(const ContactSurface &surface, const FaceFilter &counts);

  /// The distance along a unit normal from a point of a surface to what it faces there (length, negative if
  /// that lies behind); false if it faces nothing.
  using Sight = std::function<bool(double &, const dealii::Point<3> &, const Vector3 &)>;

  /// Collective. Looks from the faces of two surfaces along their normals for the other one, first for what
  /// is there on either side. Centres and places near the corners of the faces are shared by the ranks.
  void see_each_other(FacingParts &first_parts, const ContactSurface &first, FacingParts &second_parts,
                      const ContactSurface &second, const MPI_Comm communicator);

  /// The same for one surface and something that is known by what is seen of it.
  void see(FacingParts &parts, const ContactSurface &surface, const Sight &sight,
           const MPI_Comm communicator);

  /// A whole surface without the parts that face nothing, with the normals of what is left.
  ContactSurface without_blind_parts(ContactSurface surface, const FacingParts &parts,
                                     const SurfaceShapes &shapes);
} // namespace Signorini

#endif
