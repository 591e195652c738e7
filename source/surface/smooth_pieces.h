// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_smooth_pieces_h
#define signorini_source_surface_smooth_pieces_h

#include <signorini/surface/surface_mesh.h>

#include <vector>

namespace Signorini
{
  /// A vertex as seen from one smooth piece: the corners of triangles there that no crease separates.
  struct PieceVertex
  {
    unsigned int vertex = SurfaceTopology::none;
    /// Triangles of the piece around the vertex.
    std::vector<unsigned int> triangles;
    /// Whether the triangles go all the way round.
    bool is_closed = true;
  };

  /// The smooth pieces of a surface, vertex by vertex. Edges are numbered as in the topology.
  class SmoothPieces
  {
  public:
    SmoothPieces(const SurfaceTopology &topology, const std::vector<bool> &is_cut);

    /// The piece vertices in up to `n_rings` rings of triangles around one, ring by ring, without itself.
    void neighbours(std::vector<unsigned int> &found, const unsigned int centre,
                    const unsigned int n_rings) const;

    /// Which corner of a triangle a piece vertex is.
    unsigned int corner_of(const unsigned int triangle, const unsigned int piece_vertex) const
    {
      unsigned int i = 0;
      while (of_corner[3 * triangle + i] != piece_vertex)
        ++i;
      return i;
    }

    std::vector<PieceVertex> vertices;
    /// Piece vertex of corner i of triangle t: of_corner[3 t + i].
    std::vector<unsigned int> of_corner;

  private:
    unsigned int root(unsigned int c);
    void         join(const unsigned int a, const unsigned int b);
  };
} // namespace Signorini

#endif
