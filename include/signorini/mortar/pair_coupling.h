// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_pair_coupling_h
#define signorini_mortar_pair_coupling_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/mortar/face_moments.h>
#include <signorini/mortar/surface_halo.h>

#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  /// A node of the nonmortar surface that touches the covered part but carries no multiplier.
  struct DroppedNode
  {
    /// Why: displacements or the normal are prescribed, another pair needs the node, it lies on a sharp edge
    /// between faces that are covered, or the rule drops it.
    enum Reason
    {
      fixed,
      normal_fixed,
      other_pair,
      sharp_edge,
      thin_cover,
      large_row
    };
    /// Number of reasons.
    static constexpr unsigned int n_reasons = 6;

    /// Which node, where (length), and why.
    NodeIndex        node;
    dealii::Point<3> position;
    Reason           reason;
    /// Covered share of the integral of the node's function.
    double share;
  };

  /// The reason in words, for messages.
  const char *to_string(const DroppedNode::Reason reason);

  /// When a node loses its multiplier: a thinly covered one, or one whose normal is nearly fixed
  /// (doc/algorithm.md, chapter 3, which nodes are in R). Pure numbers.
  struct DroppingRule
  {
    /// Least covered share of the integral of the node's own function.
    double smallest_share = .15;
    /// Largest row sum of |S|.
    double largest_row_sum = 5.;
    /// Least length |m| of the part of the normal in free directions (blocks under pressure, the border of
    /// one fixed in x only, normal at acos |m| to x: with |m| = .42, .31, .26, .17, .10 accelerated takes
    /// 10, 12, 12, 17, 42 iterations, truncated Newton 10, 14, 18, 76, 310, without these nodes 11 and 14;
    /// the forces differ by about a tenth of their errors, 16 % at most). Where a covered face would have no
    /// multiplier left its best node keeps it down to RowProjection::smallest_share.
    double smallest_free_normal = .25;
    /// Whether nodes on sharp edges are dropped (vertices_on_sharp_edges(), of faces covered by
    /// smallest_share of their area): their normal is none of the surface, and what slides along one of the
    /// faces presses on the other. Not of tied surfaces, where normals mean nothing.
    bool drops_sharp_edges = true;
  };

  /// D, M, S = D^-1 M and the weighted gap of one contact pair (doc/algorithm.md, (12) to (17)): the rows of
  /// the vertices that belong to this rank (SurfaceHalo), and what it knows of its own faces.
  struct PairCoupling
  {
    /// Rows: the nodes K of this rank. Entries: M_kq/D_kk for mortar nodes and -D_kr/D_kk for nodes in R;
    /// weight D_kk (area), with what other pairs cover around the node if they cede it: the force on it is
    /// the pressure times the weight.
    InterfaceCoupling coupling;
    /// In the order of the rows: outward unit normal n_p; weighted gap
    /// g_p = (1/D_pp) int psi_p (Phi(x) - x)·n_p (length; where n_p lies across the normals of the other
    /// side, along those); position; int psi_p (area; not D_pp beside nodes in R, then a constant gap g gives
    /// g_p = g int psi_p / D_pp); covered share of the node's function; prescribed components; vertex of the
    /// nonmortar surface.
    std::vector<Vector3>          normals;
    std::vector<double>           gaps;
    std::vector<dealii::Point<3>> positions;
    std::vector<double>           areas;
    std::vector<double>           shares;
    std::vector<FixedDirections>  fixed;
    std::vector<unsigned int>     vertices;
    /// By row whether its normal is that of none of the covered faces around it: its node lies on a sharp
    /// edge, and they have no others, or only one of them is covered.
    std::vector<unsigned char> on_sharp_edge;
    /// Nodes of these columns that belong to the nonmortar surface (the set R), sorted.
    std::vector<NodeIndex> r_nodes;

    /// The mean gap in reach of a row that belongs to a value g_p or to an opening g_p - n·û_p (lengths):
    /// beside nodes in R int psi_p is not D_pp. The value itself where int psi_p is too small to divide by.
    double mean_gap(const std::size_t row, const double value) const
    {
      const double weight = coupling.weight[row];
      return areas[row] > .1 * weight ? value * weight / areas[row] : value;
    }

    /// Of the dropped nodes those that are no row of another pair either.
    std::vector<DroppedNode> nodes_without_multiplier() const;

    /// Bytes.
    std::size_t memory_consumption() const;

    /// A face of which no node has a multiplier although it is covered, and what took them away.
    struct LostFace
    {
      /// Index into ContactSurface::faces.
      unsigned int        face;
      DroppedNode::Reason reason;
    };

    /// A node of this rank that is another pair's (NodesOfOtherPairs::ceded).
    struct CededNode
    {
      /// Which one, and the integral of its function over what is covered here (area).
      NodeIndex node;
      double    area;
    };
    /// Those of this rank.
    std::vector<CededNode> ceded;

    /// This rank's nodes without a multiplier, and its faces without any.
    std::vector<DroppedNode> dropped;
    std::vector<LostFace>    lost_faces;
    /// Areas, over all ranks: of the nonmortar surface, of its covered part, and of the covered part without
    /// any multiplier.
    double area = 0., covered_area = 0., lost_area = 0.;
    /// Number of rows of all ranks.
    std::size_t n_rows_of_all = 0;
  };

  /// The surfaces of a pair, and what this rank does of the nonmortar one.
  struct SharedPair
  {
    /// All must outlive the object.
    const ContactSurface &nonmortar, &mortar;
    const SurfaceHalo    &halo;
  };

  /// What other pairs make of nodes of a nonmortar surface (couple_pairs()).
  struct NodesOfOtherPairs
  {
    /// Nodes that must not carry a multiplier: columns where rows need them.
    std::set<NodeIndex> excluded;
    /// Nodes that another pair has as rows: neither rows nor columns here. The dual functions of their
    /// neighbours are those that there would be with them; theirs are left out.
    std::set<NodeIndex> ceded;
    /// Nodes that carry one, however thinly covered, because they do in another pair.
    std::set<NodeIndex> kept;
  };

  /// Collective. The coupling of one pair from the moments of own and ghost faces
  /// (SurfaceHalo::add_ghosts()). A row is the same, bit by bit, on any number of ranks.
  /// @param prescribed_gap whether the moments hold gap values instead of vectors
  PairCoupling couple(const SharedPair &pair, const std::vector<FaceMoments> &moments,
                      const NodesOfOtherPairs &others, const bool prescribed_gap,
                      const DroppingRule &rule = {});

  /// Collective. Largest distance of a row's node from that of the first row of all ranks (length).
  double width_of_rows(const PairCoupling &pair, const MPI_Comm communicator);

  /// couple() of a surface that belongs to this rank alone.
  PairCoupling couple(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const std::vector<FaceMoments> &moments, const NodesOfOtherPairs &others,
                      const bool prescribed_gap, const DroppingRule &rule = {});

  /// Collective. Values of the rows of all ranks by vertex of the nonmortar surface: at the vertices of this
  /// rank and the corners of its own and ghost faces; T() where there is no row.
  template <typename T>
  std::vector<T> spread_rows(const PairCoupling &pair, const SurfaceHalo &halo, const std::vector<T> &values)
  {
    std::vector<T> result(halo.n_vertices());
    for (std::size_t row = 0; row < values.size(); ++row)
      result[pair.vertices[row]] = values[row];
    halo.update(result);
    return result;
  }
} // namespace Signorini

#endif
