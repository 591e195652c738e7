// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_surface_halo_h
#define signorini_mortar_surface_halo_h

#include <signorini/algebra/sent_lists.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/mortar/face_moments.h>

#include <vector>

namespace Signorini
{
  /// How the ranks share the vertices of a nonmortar surface, and what each needs of the others to finish the
  /// rows of its own: a vertex belongs to the rank that works on the first of its faces. The dual functions
  /// of its row, those of the hanging vertices that depend on it and of their other parents, live on faces
  /// around these vertices; what of them are not the rank's own are its ghost faces.
  class SurfaceHalo
  {
  public:
    /// Collective.
    SurfaceHalo(const ContactSurface &surface, const MPI_Comm communicator);

    /// The same for a piece of the surface, which has the own and ghost faces, and the parents of their
    /// corners. Ghosts of moments it cannot add any more.
    SurfaceHalo(const SurfaceHalo &whole, const SurfacePiece &piece);

    /// Whether the row of a vertex is finished on this rank. Vertices without faces are nobody's.
    bool owns(const unsigned int vertex) const
    {
      return owner[vertex] == rank;
    }

    /// Number of vertices of the surface.
    std::size_t n_vertices() const
    {
      return owner.size();
    }

    /// Whether this rank works on a face.
    bool owns_face(const unsigned int face) const
    {
      return is_own_face[face];
    }

    /// Vertices whose dual functions are complete on this rank, sorted: its own, and what their rows need.
    const std::vector<unsigned int> &functions() const
    {
      return function_vertices;
    }

    /// Faces of other ranks whose moments this rank needs.
    std::vector<unsigned int> ghost_faces() const;

    /// Collective. The moments of own and ghost faces, sorted by face, from those of the own ones.
    std::vector<FaceMoments> add_ghosts(std::vector<FaceMoments> own) const;

    /// Collective. Values by vertex: fetches those at the corners of own and ghost faces, and at their
    /// parents if they hang, from the ranks that own these vertices.
    template <typename T>
    void update(std::vector<T> &values) const
    {
      vertices->update(values);
    }

    /// Bytes.
    std::size_t memory_consumption() const;

    /// The ranks that share the surface.
    MPI_Comm communicator() const
    {
      return comm;
    }

  private:
    MPI_Comm                            comm;
    unsigned int                        rank;
    std::vector<bool>                   is_own_face;
    std::vector<unsigned int>           owner, function_vertices;
    std::unique_ptr<const ItemExchange> faces, vertices;
  };
} // namespace Signorini

#endif
