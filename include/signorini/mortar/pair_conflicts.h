// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_pair_conflicts_h
#define signorini_mortar_pair_conflicts_h

#include <signorini/mortar/pair_coupling.h>

#include <optional>
#include <string>
#include <vector>

namespace Signorini
{
  /// When a node that is nonmortar in several pairs is a row of some of them (doc/algorithm.md, chapter 3,
  /// several pairs). Pure numbers.
  struct SharedRowRule
  {
    /// Least cosine between what two pairs cover around the node: 60 degrees apart the surfaces are two, as
    /// those of a sharp edge (FacingParts), and no normal stands for both. A hexagon is round, up to
    /// rounding.
    double least_cosine = .5 - 1e-6;
    /// From this ratio on areas differ by more than rounding.
    double greater = 1. + 1e-6;
    /// Parts of a face that several bodies cover add up to this at most where they lie beside each other: the
    /// borders of curved ones overlap a little.
    double beside = 1.1;
    /// Least cosine between what pairs with different mortar bodies cover around a node that they share: 15
    /// degrees. One normal is none of a bend: in packs of polyhedra under 3 from all sides, pressures where
    /// bodies share bends are up to 14, else 6.
    double flat_cosine = .966;
    /// Where bodies that part move along the surface, up to this sine, a node is as open to one as to the
    /// other.
    double along = .05;
  };

  /// Another pair with the same nonmortar nodes, whose mortar body does not stay beside that of this one.
  struct PartingPair
  {
    /// Its number.
    unsigned int other;
    /// A node with the outward normal n is open to the body of this pair by n·shift more than to that of the
    /// other one (length).
    Vector3 shift;
  };

  /// One pair among several.
  struct PairToCouple
  {
    /// Its surfaces, and the moments of own and ghost faces, which must outlive this.
    SharedPair                      surfaces;
    const std::vector<FaceMoments> &moments;
    /// As in couple(); whether the surfaces are glued together.
    bool prescribed_gap, is_tied;
    /// Number of the body on each side; for an obstacle one that no body and no other obstacle has.
    unsigned int nonmortar_body, mortar_body;
    /// Those whose mortar bodies part from that of this one; each two in one of them.
    std::vector<PartingPair> partings;
  };

  /// Collective. couple() of several pairs, so that join_couplings() cannot fail. A node that is mortar in
  /// one pair is a row in another one (a chain) unless it is tied there, has prescribed components, or its
  /// body is nonmortar and mortar in a cycle of pairs: then it is a row in none. So is one that is nonmortar
  /// in several if they do not look the same way there (SharedRowRule), are not all tied or all in contact,
  /// are tied to different bodies, or cover a face twice with one body. Else it belongs to the pairs with the
  /// mortar body that covers most around it (the first of equal ones; of bodies that part that to which it is
  /// less open), and to those whose mortar bodies lie beside that one and each other and do not part from
  /// them: they share the row. If one of them has it, all do, however thinly they cover it. The others cede
  /// the node; the weight of the row has what they cover. It is a row in none if that does not work out
  /// (hanging vertices beside ceded nodes).
  std::vector<PairCoupling> couple_pairs(const std::vector<PairToCouple> &pairs, const MPI_Comm communicator,
                                         const DroppingRule  &rule        = {},
                                         const SharedRowRule &shared_rule = {});

  /// Nodes (conforming) of either side that the covered part of this rank's faces touches.
  std::set<NodeIndex> touched_nonmortar_nodes(const ContactSurface           &nonmortar,
                                              const std::vector<FaceMoments> &moments);
  std::set<NodeIndex> touched_mortar_nodes(const ContactSurface           &mortar,
                                           const std::vector<FaceMoments> &moments);

  /// The rows of all pairs at the nodes that a rank owns, sorted by node.
  struct JoinedCouplings
  {
    /// S and D of all pairs. A row that pairs a, b, ... share (doc/algorithm.md, (16a)):
    /// D = D_a + D_b + ..., S = (D_a S_a + D_b S_b + ...) / D.
    InterfaceCoupling coupling;
    /// S + S² + ... if S² has entries on any rank: u = v + A (S + S² + ...) v.
    std::optional<InterfaceCoupling> chained;
    /// By row: the (first) pair it comes from, and as in PairCoupling; means with the weights D if shared.
    std::vector<unsigned int>     pairs;
    std::vector<Vector3>          normals;
    std::vector<double>           gaps;
    std::vector<FixedDirections>  fixed;
    std::vector<dealii::Point<3>> positions;
  };

  /// Collective. Joins the couplings of all pairs: rows go to the ranks that own their nodes.
  /// @param names of the pairs, for messages; numbers if left out
  /// Errors: InputError naming the pairs if they form a cycle (no power of S is zero) or a chain in a node
  /// with prescribed components (S is not all of T⁻¹), or if the normals of a shared row are opposite.
  JoinedCouplings join_couplings(const std::vector<PairCoupling> &pairs,
                                 const std::vector<std::string> &names, const NodePartition &partition);
} // namespace Signorini

#endif
