// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_piece_h
#define signorini_mesh_surface_piece_h

#include <signorini/algebra/gathered_lists.h>
#include <signorini/mesh/contact_surface.h>

#include <vector>

namespace Signorini
{
  /// What a rank keeps of a contact surface: some faces with all of their triangles, the vertices of these,
  /// and the parents of those that hang.
  struct SurfacePiece
  {
    /// @param faces,vertices what must be there
    SurfacePiece(const ContactSurface &whole, const std::vector<bool> &faces, std::vector<bool> vertices);

    /// What there is.
    Renumbering faces;
    SurfacePart part;
  };

  /// By vertex of a surface: whether a face on which a rank works has it as a corner or on an edge.
  std::vector<bool> vertices_of_worker(const ContactSurface &surface, const unsigned int rank);

  /// A piece as a surface of its own, which knows where it comes from (ContactSurface::origin).
  ContactSurface cut_out(const ContactSurface &whole, const SurfacePiece &piece);

  /// Collective. Faces, triangles and vertices (places, nodes) of the whole surface from the pieces of all
  /// ranks, of which each has the faces on which it works; empty where it is not received. Nothing else is
  /// known of it.
  ContactSurface join_pieces(const ContactSurface &piece, const MPI_Comm communicator,
                             const Receivers receivers);
} // namespace Signorini

#endif
