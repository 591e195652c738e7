// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_multiplier_nodes_h
#define signorini_source_mortar_multiplier_nodes_h

#include <signorini/mortar/pair_coupling.h>

#include <set>
#include <vector>

namespace Signorini
{
  /// Faces covered by less than this share of their area are ignored.
  constexpr double empty_share = 1e-13;

  /// Whether that is so of the face that some moments belong to.
  inline bool is_empty(const FaceMoments &m)
  {
    return m.covered <= empty_share * m.area;
  }

  /// Which nonmortar vertices are in R, and why: known to a rank at the corners of its own and ghost faces.
  class MultiplierNodes
  {
  public:
    /// Collective. All arguments must outlive the object.
    /// @param moments of own and ghost faces
    MultiplierNodes(const ContactSurface &surface, const SurfaceHalo &halo,
                    const std::vector<FaceMoments> &moments, const NodesOfOtherPairs &others,
                    const DroppingRule &rule);

    /// Whether a vertex is in R. Hanging vertices are if all of their parents are.
    bool is_in_r(const unsigned int v) const
    {
      return states[v].in_r;
    }

    /// Whether a vertex is another pair's (NodesOfOtherPairs::ceded).
    bool is_ceded(const unsigned int v) const
    {
      return states[v].is_ceded;
    }

    /// Whether a vertex hangs.
    bool is_hanging(const unsigned int v) const
    {
      return !surface.hanging[v].empty();
    }

    /// Whether a vertex carries a multiplier, i.e. belongs to K.
    bool is_row(const unsigned int v) const
    {
      return !is_hanging(v) && !states[v].in_r;
    }

    /// Whether the normal of a row is that of none of the covered faces around it: it lies on a sharp edge,
    /// and a face needs it or is all that is covered there.
    bool is_on_sharp_edge(const unsigned int v) const
    {
      return is_row(v) && states[v].lies_on_sharp_edge;
    }

    /// Covered share of the integral of its function.
    double share(const unsigned int v) const
    {
      return states[v].share;
    }

    /// Collective. Drops the nodes of some rows of this rank, which extrapolate. Returns whether there are
    /// any on any rank.
    bool drop_rows(const std::vector<unsigned int> &rows);

    /// Whether a vertex is there because another pair, a face or a hanging vertex needs it: then it stays.
    bool must_stay(const unsigned int v) const
    {
      return states[v].is_protected;
    }

    /// Collective. Brings vertices back until no covered face is without a function and no covered hanging
    /// vertex without a parent in K, as far as there are vertices that may come back. Hanging vertices
    /// without go to R.
    void complete();

    /// Those of this rank without a multiplier.
    std::vector<DroppedNode> report() const;

    /// Those of this rank that are another pair's.
    std::vector<PairCoupling::CededNode> ceded_nodes() const;

    /// Covered faces of this rank without any.
    std::vector<PairCoupling::LostFace> lost_faces() const;

  private:
    /// What a rank knows of a vertex, its own or one that its rows or faces need.
    struct State
    {
      bool in_r = false, is_protected = false, is_ceded = false, lies_on_sharp_edge = false;
      /// Whether anything is covered around it, and more than a rounding.
      bool                is_covered = false, is_touched = false;
      DroppedNode::Reason reason = DroppedNode::thin_cover;
      double              share  = 0.;
      /// Integral of its function over what is covered (area).
      double covered = 0.;
    };

    /// Where vertices without a multiplier leave nothing to carry a contact stress.
    struct NeedyPlace;

    /// Own and ghost faces of which at least the share is covered that nodes need.
    std::vector<bool> well_covered(const DroppingRule &rule) const;

    /// By vertex whether its normal is more than CreaseEdgeRule::sharp from those of all covered facets on
    /// which it acts.
    std::vector<bool> with_normal_of_none() const;

    void drop(const unsigned int v, const DroppedNode::Reason why);
    bool is_reported(const unsigned int v) const;
    bool all_in_r(const std::vector<unsigned int> &vertices) const;
    void update_hanging();

    std::vector<unsigned int> parents(const unsigned int v) const;
    std::vector<unsigned int> corners(const FaceMoments &m) const;

    /// Length of the part of the normal in free directions.
    double free_normal(const unsigned int v) const;

    /// Whether a vertex could carry a multiplier, if not as well as others.
    bool may_return(const unsigned int v) const;
    bool any_may_return(const std::vector<unsigned int> &vertices) const;

    void add_place(std::vector<NeedyPlace> &places, const bool is_face, const unsigned int index,
                   const bool is_covered, const std::vector<unsigned int> &vertices) const;
    std::vector<NeedyPlace> needy_places() const;

    const ContactSurface           &surface;
    const SurfaceHalo              &halo;
    const std::vector<FaceMoments> &moments;
    std::vector<State>              states;
  };
} // namespace Signorini

#endif
