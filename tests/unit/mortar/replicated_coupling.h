// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_mortar_replicated_coupling_h
#define signorini_tests_mortar_replicated_coupling_h

#include <signorini/mortar/dual_basis.h>
#include <signorini/mortar/pair_coupling.h>

#include <algorithm>

/// The coupling of a pair with the moments of all of its faces at hand, one vertex after the other: what
/// Signorini::couple() has to give bit by bit on any number of ranks.
namespace ReplicatedCoupling
{
  using namespace Signorini;
  using namespace dealii;

  /// Faces covered by less than this share of their area are ignored.
  constexpr double empty_share = 1e-13;

  inline bool is_empty(const FaceMoments &m)
  {
    return m.covered <= empty_share * m.area;
  }

  /// Vertex indices with values; an index may occur several times.
  using Entries = std::vector<std::pair<unsigned int, double>>;

  /// Adds to the entry of an index in a short list.
  inline void add_to(Entries &list, const unsigned int index, const double value)
  {
    for (auto &entry : list)
      if (entry.first == index)
        {
          entry.second += value;
          return;
        }
    list.emplace_back(index, value);
  }

  /// A sum of sparse vectors over the conforming vertices of a surface: hanging ones are resolved.
  class VertexSum
  {
  public:
    explicit VertexSum(const ContactSurface &surface)
      : surface(surface)
      , values(surface.vertex_node.size(), 0.)
      , is_touched(values.size(), false)
    {
    }

    void clear()
    {
      for (const unsigned int v : touched)
        {
          values[v]     = 0.;
          is_touched[v] = false;
        }
      touched.clear();
    }

    void add(const double factor, const Entries &entries)
    {
      for (const auto &[v, value] : entries)
        if (surface.hanging[v].empty())
          add_conforming(v, factor * value);
        else
          for (const auto &[parent, weight] : surface.hanging[v])
            add_conforming(parent, factor * weight * value);
    }

    const ContactSurface     &surface;
    std::vector<double>       values;
    std::vector<unsigned int> touched;

  private:
    void add_conforming(const unsigned int v, const double value)
    {
      if (!is_touched[v])
        {
          is_touched[v] = true;
          touched.push_back(v);
        }
      values[v] += value;
    }

    std::vector<bool> is_touched;
  };

  /// Which nonmortar vertices are in R, and why.
  class MultiplierNodes
  {
  public:
    MultiplierNodes(const ContactSurface &surface, const std::vector<FaceMoments> &moments,
                    const std::set<NodeIndex> &excluded, const DroppingRule &rule)
      : surface(surface)
      , moments(moments)
      , covered(surface.vertex_node.size(), 0.)
      , full(covered)
      , in_r(covered.size(), false)
      , is_protected(in_r)
      , reason(covered.size(), DroppedNode::thin_cover)
    {
      for (const FaceMoments &m : moments)
        for (unsigned int a = 0; a < 4; ++a)
          {
            const unsigned int v = surface.faces[m.face].corners[a];
            full[v] += m.full[a];
            if (!is_empty(m))
              for (unsigned int b = 0; b < 4; ++b)
                covered[v] += m.mass[4 * a + b];
          }
      for (unsigned int v = 0; v < in_r.size(); ++v)
        if (!is_hanging(v))
          {
            if (surface.vertex_fixed[v].all())
              drop(v, DroppedNode::fixed);
            else if (excluded.count(surface.vertex_node[v]) > 0)
              drop(v, DroppedNode::other_pair);
            else if (free_normal(v) < rule.smallest_free_normal)
              drop(v, DroppedNode::normal_fixed);
            else if (!(covered[v] > 0.) || covered[v] < rule.smallest_share * full[v])
              drop(v, DroppedNode::thin_cover);
          }
    }

    bool is_in_r(const unsigned int v) const
    {
      return in_r[v];
    }

    bool is_hanging(const unsigned int v) const
    {
      return !surface.hanging[v].empty();
    }

    /// Whether a vertex carries a multiplier, i.e. belongs to K.
    bool is_row(const unsigned int v) const
    {
      return !is_hanging(v) && !in_r[v];
    }

    double share(const unsigned int v) const
    {
      return full[v] > 0. ? covered[v] / full[v] : 0.;
    }

    void drop(const unsigned int v, const DroppedNode::Reason why)
    {
      in_r[v]   = true;
      reason[v] = why;
    }

    /// Whether a vertex came back because a face or a hanging vertex needs it: then it stays.
    bool must_stay(const unsigned int v) const
    {
      return is_protected[v];
    }

    /// Brings vertices back until no covered face is without a function and no covered hanging vertex
    /// without a parent in K, as far as there are vertices that may come back. Hanging vertices without go
    /// to R.
    void complete()
    {
      for (bool changed = true; changed;)
        {
          changed = false;
          for (unsigned int h = 0; h < in_r.size(); ++h)
            if (is_hanging(h))
              {
                std::vector<unsigned int> parents;
                for (const auto &parent : surface.hanging[h])
                  parents.push_back(parent.first);
                in_r[h] = all_in_r(parents);
                if (in_r[h] && covered[h] > 0. && return_best(parents))
                  {
                    in_r[h] = false;
                    changed = true;
                  }
              }
          for (const FaceMoments &m : moments)
            if (const auto &corners = surface.faces[m.face].corners; !is_empty(m) && all_in_r(corners))
              changed = return_best(corners) || changed;
        }
    }

    std::vector<DroppedNode> report() const
    {
      std::vector<DroppedNode> list;
      for (unsigned int v = 0; v < in_r.size(); ++v)
        if (in_r[v] && !is_hanging(v) && covered[v] > empty_share * full[v])
          list.push_back({surface.vertex_node[v], surface.mesh.vertices[v], reason[v], share(v)});
      return list;
    }

  private:
    template <typename List>
    bool all_in_r(const List &vertices) const
    {
      return std::all_of(vertices.begin(), vertices.end(), [&](const unsigned int v) { return in_r[v]; });
    }

    /// Length of the part of the normal in free directions.
    double free_normal(const unsigned int v) const
    {
      return project_free(surface.vertex_fixed[v], surface.mesh.vertex_normals[v]).norm();
    }

    /// Whether a vertex could carry a multiplier, if not as well as others.
    bool may_return(const unsigned int v) const
    {
      return in_r[v] && !is_hanging(v) && covered[v] > 0. &&
             (reason[v] == DroppedNode::thin_cover || reason[v] == DroppedNode::large_row ||
              (reason[v] == DroppedNode::normal_fixed && free_normal(v) >= RowProjection::smallest_share));
    }

    /// Of the vertices that were dropped for their thin cover, or a nearly fixed normal, brings the best
    /// covered one back.
    template <typename List>
    bool return_best(const List &candidates)
    {
      int best = -1;
      for (const unsigned int v : candidates)
        if (may_return(v) && (best < 0 || share(v) > share(best)))
          best = static_cast<int>(v);
      if (best < 0)
        return false;
      in_r[best]         = false;
      is_protected[best] = true;
      return true;
    }

    const ContactSurface            &surface;
    const std::vector<FaceMoments>  &moments;
    std::vector<double>              covered, full;
    std::vector<bool>                in_r, is_protected;
    std::vector<DroppedNode::Reason> reason;
  };

  /// The integrals with the uncondensed dual basis, their combination over hanging vertices, the rows.
  class CouplingAssembler
  {
  public:
    CouplingAssembler(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const std::vector<FaceMoments> &moments, const bool prescribed_gap)
      : non(nonmortar)
      , mor(mortar)
      , moments(moments)
      , prescribed_gap(prescribed_gap)
      , d_sum(nonmortar)
      , m_sum(mortar)
    {
    }

    PairCoupling assemble(const MultiplierNodes &nodes)
    {
      PairCoupling result;
      integrate_dual_basis(result, nodes);
      combine_hanging(nodes);

      std::vector<unsigned int> order;
      for (unsigned int v = 0; v < non.vertex_node.size(); ++v)
        if (nodes.is_row(v))
          order.push_back(v);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return non.vertex_node[a] < non.vertex_node[b];
      });
      for (const unsigned int k : order)
        add_row(result, nodes, k);
      std::sort(result.r_nodes.begin(), result.r_nodes.end());
      result.r_nodes.erase(std::unique(result.r_nodes.begin(), result.r_nodes.end()), result.r_nodes.end());
      return result;
    }

  private:
    /// D, M and gap integrals of psi_v, for all vertices v not in R (hanging ones too).
    void integrate_dual_basis(PairCoupling &result, const MultiplierNodes &nodes)
    {
      d_rows.assign(non.vertex_node.size(), {});
      m_rows.assign(non.vertex_node.size(), {});
      gaps.assign(non.vertex_node.size(), Vector3());
      diagonal.assign(non.vertex_node.size(), 0.);
      for (const FaceMoments &m : moments)
        {
          result.area += m.area;
          result.covered_area += m.covered;
          if (is_empty(m))
            continue;
          const auto         &corners = non.faces[m.face].corners;
          std::array<bool, 4> in_v;
          for (unsigned int a = 0; a < 4; ++a)
            in_v[a] = a < non.faces[m.face].n_corners && !nodes.is_in_r(corners[a]);
          const DualBasis psi = compute_dual_basis(m.mass, in_v);
          if (psi.n_functions == 0)
            result.lost_area += m.covered;
          for (unsigned int i = 0; i < psi.n_functions; ++i)
            add_function(m, corners, psi.corner[i], psi.coefficients[i]);
        }
    }

    void add_function(const FaceMoments &m, const std::array<unsigned int, 4> &corners,
                      const unsigned int corner, const std::array<double, 4> &c)
    {
      const unsigned int v = corners[corner];
      for (unsigned int j = 0; j < 4; ++j)
        {
          const double value =
              c[0] * m.mass[j] + c[1] * m.mass[4 + j] + c[2] * m.mass[8 + j] + c[3] * m.mass[12 + j];
          d_rows[v].emplace_back(corners[j], value);
          if (j == corner)
            diagonal[v] += value;
          gaps[v] += c[j] * m.gap[j];
        }
      for (const auto &[q, values] : m.coupling)
        m_rows[v].emplace_back(q, c[0] * values[0] + c[1] * values[1] + c[2] * values[2] + c[3] * values[3]);
    }

    /// The second step: psi~_k = (D~_k/D_k) psi_k + sum_h w_kh rho_h as combinations of the psi.
    void combine_hanging(const MultiplierNodes &nodes)
    {
      combination.assign(non.vertex_node.size(), {});
      for (unsigned int v = 0; v < combination.size(); ++v)
        if (nodes.is_row(v))
          combination[v].emplace_back(v, 1.);
      for (unsigned int h = 0; h < combination.size(); ++h)
        {
          if (!nodes.is_hanging(h) || nodes.is_in_r(h) || !(diagonal[h] > 0.))
            continue;
          double  weight_sum = 0.;
          Entries rho        = {{h, 1.}};
          for (const auto &[k, c] : non.hanging[h])
            if (nodes.is_row(k))
              {
                weight_sum += c;
                rho.emplace_back(k, -c * diagonal[h] / diagonal[k]);
                add_to(combination[k], k, c * diagonal[h] / diagonal[k]);
              }
          for (const auto &[k, c] : non.hanging[h])
            if (nodes.is_row(k))
              for (const auto &[v, value] : rho)
                add_to(combination[k], v, c / weight_sum * value);
        }
    }

    void add_row(PairCoupling &result, const MultiplierNodes &nodes, const unsigned int k)
    {
      d_sum.clear();
      m_sum.clear();
      Vector3 gap;
      for (const auto &[v, factor] : combination[k])
        {
          d_sum.add(factor, d_rows[v]);
          m_sum.add(factor, m_rows[v]);
          gap += factor * gaps[v];
        }
      // D is diagonal on K up to rounding (more on slivers): the rest goes to the diagonal, so that the row
      // sums of D and M stay equal.
      const double negligible = 1e-14 * d_sum.values[k];
      const auto   is_column  = [&](const unsigned int j) {
        return !nodes.is_row(j) && std::abs(d_sum.values[j]) > negligible;
      };
      double weight = 0., area = 0.;
      for (const unsigned int j : d_sum.touched)
        {
          area += d_sum.values[j];
          if (!is_column(j))
            weight += d_sum.values[j];
        }

      std::vector<InterfaceCoupling::Entry> entries;
      for (const unsigned int j : d_sum.touched)
        if (is_column(j))
          {
            entries.push_back({non.vertex_node[j], -d_sum.values[j] / weight});
            result.r_nodes.push_back(non.vertex_node[j]);
          }
      for (const unsigned int q : m_sum.touched)
        if (m_sum.values[q] != 0.)
          entries.push_back({mor.vertex_node[q], m_sum.values[q] / weight});
      append_sorted(result.coupling, entries);
      result.coupling.rows.push_back(non.vertex_node[k]);
      result.coupling.weight.push_back(weight);

      const Vector3 &normal = non.mesh.vertex_normals[k];
      result.normals.push_back(normal);
      result.gaps.push_back((prescribed_gap ? gap[0] : gap * normal) / weight);
      result.positions.push_back(non.mesh.vertices[k]);
      result.areas.push_back(area);
      result.shares.push_back(nodes.share(k));
      result.fixed.push_back(non.vertex_fixed[k]);
      result.vertices.push_back(k);
    }

    /// Appends a row; a node that occurs on both sides gets one entry.
    static void append_sorted(InterfaceCoupling &coupling, std::vector<InterfaceCoupling::Entry> &entries)
    {
      std::stable_sort(entries.begin(), entries.end(),
                       [](const auto &a, const auto &b) { return a.node < b.node; });
      for (const auto &entry : entries)
        if (coupling.entries.size() > coupling.row_start.back() && coupling.entries.back().node == entry.node)
          coupling.entries.back().weight += entry.weight;
        else
          coupling.entries.push_back(entry);
      coupling.row_start.push_back(coupling.entries.size());
    }

    const ContactSurface           &non, &mor;
    const std::vector<FaceMoments> &moments;
    const bool                      prescribed_gap;
    std::vector<Entries>            d_rows, m_rows, combination;
    std::vector<Vector3>            gaps;
    /// int psi_v phi_v.
    std::vector<double> diagonal;
    VertexSum           d_sum, m_sum;
  };

  /// Drops the nodes whose rows extrapolate. Returns whether there were any.
  inline bool drop_large_rows(MultiplierNodes &nodes, const PairCoupling &pair, const double largest_row_sum)
  {
    bool any = false;
    for (std::size_t row = 0; row < pair.coupling.n_rows(); ++row)
      {
        double sum = 0.;
        for (const auto *entry = pair.coupling.begin(row); entry != pair.coupling.end(row); ++entry)
          sum += std::abs(entry->weight);
        if (sum > largest_row_sum && !nodes.must_stay(pair.vertices[row]))
          {
            nodes.drop(pair.vertices[row], DroppedNode::large_row);
            any = true;
          }
      }
    return any;
  }


  inline PairCoupling couple(const ContactSurface &nonmortar, const ContactSurface &mortar,
                             const std::vector<FaceMoments> &moments, const std::set<NodeIndex> &excluded,
                             const bool prescribed_gap, const DroppingRule &rule)
  {
    MultiplierNodes   nodes(nonmortar, moments, excluded, rule);
    CouplingAssembler assembler(nonmortar, mortar, moments, prescribed_gap);
    nodes.complete();
    PairCoupling result = assembler.assemble(nodes);
    // Every round drops or keeps for good at least one node; a few rounds are the rule.
    while (drop_large_rows(nodes, result, rule.largest_row_sum))
      {
        nodes.complete();
        result = assembler.assemble(nodes);
      }
    result.dropped = nodes.report();
    return result;
  }
} // namespace ReplicatedCoupling

#endif
