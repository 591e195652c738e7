// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/pair_coupling.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/Dense>

namespace Signorini
{
  using namespace dealii;

  const char *
  to_string(const DroppedNode::Reason reason)
  {
    static const char *const texts[] = {"all components prescribed",
                                        "normal direction prescribed",
                                        "node of another contact pair",
                                        "thinly covered",
                                        "extrapolating"};
    return texts[reason];
  }



  namespace
  {
    /// Below this share of its own integral a node extrapolates too far (method.md, section 3, Dropping).
    constexpr double smallest_share = .15;
    constexpr double largest_row_sum = 5.;
    constexpr double empty_share     = 1e-13;

    using SparseRow = std::map<unsigned int, double>;

    void
    add_scaled(SparseRow &target, const double factor, const SparseRow &source)
    {
      for (const auto &[index, value] : source)
        target[index] += factor * value;
    }

    /// State of the vertices of the nonmortar surface and the integrals with the uncondensed dual basis.
    class Assembler
    {
    public:
      Assembler(const ContactSurface           &nonmortar,
                const ContactSurface           &mortar,
                const std::vector<FaceMoments> &moments,
                const std::set<NodeIndex>      &excluded,
                const bool                      prescribed_gap)
        : non(nonmortar)
        , mor(mortar)
        , moments(moments)
        , prescribed_gap(prescribed_gap)
        , covered(non.vertex_node.size(), 0.)
        , full(covered)
        , in_r(non.vertex_node.size(), false)
        , reason(non.vertex_node.size(), -1)
      {
        for (const FaceMoments &m : moments)
          for (unsigned int a = 0; a < 4; ++a)
            {
              const unsigned int v = non.faces[m.face].corners[a];
              full[v] += m.full[a];
              for (unsigned int b = 0; b < 4; ++b)
                covered[v] += m.mass[4 * a + b];
            }
        for (unsigned int v = 0; v < in_r.size(); ++v)
          if (non.hanging[v].empty())
            {
              if (non.vertex_fixed[v] == all_fixed)
                drop(v, DroppedNode::fixed);
              else if (non.normal_share[v] < .5)
                drop(v, DroppedNode::normal_fixed);
              else if (excluded.count(non.vertex_node[v]) > 0)
                drop(v, DroppedNode::other_pair);
              else if (covered[v] < smallest_share * full[v])
                drop(v, DroppedNode::thin_cover);
            }
      }

      PairCoupling
      run()
      {
        PairCoupling result;
        for (unsigned int round = 0; round < 10; ++round)
          {
            keep_faces_covered();
            integrate_dual_basis(result);
            combine_hanging();
            make_rows(result);
            if (!drop_large_rows(result) || round == 9)
              break;
          }
        report_dropped(result);
        return result;
      }

    private:
      void
      drop(const unsigned int v, const DroppedNode::Reason why)
      {
        in_r[v]   = true;
        reason[v] = why;
      }

      bool
      may_return(const unsigned int v) const
      {
        return in_r[v] && (reason[v] == DroppedNode::thin_cover || reason[v] == DroppedNode::large_row);
      }

      double
      share(const unsigned int v) const
      {
        return full[v] > 0. ? covered[v] / full[v] : 0.;
      }

      bool
      is_empty(const FaceMoments &m) const
      {
        return m.covered <= empty_share * m.area;
      }

      /// A hanging vertex needs a parent with a multiplier.
      bool
      has_kept_parent(const unsigned int h) const
      {
        return std::any_of(non.hanging[h].begin(), non.hanging[h].end(), [&](const auto &p) { return !in_r[p.first]; });
      }

      /// Puts the best of the vertices that may return back among those with a multiplier.
      bool
      return_best(const std::vector<unsigned int> &candidates)
      {
        int best = -1;
        for (const unsigned int v : candidates)
          if (may_return(v) && covered[v] > 0. && (best < 0 || share(v) > share(best)))
            best = static_cast<int>(v);
        if (best < 0)
          return false;
        in_r[best]     = false;
        protected_vertex.insert(best);
        return true;
      }

      /// Never leave a covered face without a function, nor a hanging vertex without a kept parent.
      void
      keep_faces_covered()
      {
        for (unsigned int h = 0; h < in_r.size(); ++h)
          if (!non.hanging[h].empty() && covered[h] > 0.)
            {
              std::vector<unsigned int> parents;
              for (const auto &p : non.hanging[h])
                parents.push_back(p.first);
              in_r[h] = !has_kept_parent(h) && !return_best(parents);
            }
        for (const FaceMoments &m : moments)
          {
            if (is_empty(m))
              continue;
            const auto &c = non.faces[m.face].corners;
            if (std::all_of(c.begin(), c.end(), [&](const unsigned int v) { return in_r[v]; }))
              return_best({c.begin(), c.end()});
          }
      }

      /// psi of each face as combinations of its corner functions; D, M and gap integrals per vertex.
      void
      integrate_dual_basis(PairCoupling &result)
      {
        d_rows.assign(in_r.size(), {});
        m_rows.assign(in_r.size(), {});
        gaps.assign(in_r.size(), Vector3());
        result.area = result.covered_area = result.lost_area = 0.;
        for (const FaceMoments &m : moments)
          {
            result.area += m.area;
            result.covered_area += m.covered;
            if (is_empty(m))
              continue;
            const auto               &corners = non.faces[m.face].corners;
            std::vector<unsigned int> local;
            for (unsigned int a = 0; a < 4; ++a)
              if (!in_r[corners[a]])
                local.push_back(a);
            if (local.empty())
              {
                result.lost_area += m.covered;
                continue;
              }
            const Eigen::MatrixXd psi = dual_functions(m, local);
            for (std::size_t i = 0; i < local.size(); ++i)
              {
                const unsigned int v = corners[local[i]];
                for (unsigned int j = 0; j < 4; ++j)
                  {
                    double sum = 0.;
                    for (unsigned int a = 0; a < 4; ++a)
                      sum += psi(i, a) * m.mass[4 * a + j];
                    d_rows[v][corners[j]] += sum;
                    gaps[v] += psi(i, j) * m.gap[j];
                  }
                for (const auto &[q, values] : m.coupling)
                  {
                    double sum = 0.;
                    for (unsigned int a = 0; a < 4; ++a)
                      sum += psi(i, a) * values[a];
                    m_rows[v][q] += sum;
                  }
              }
          }
      }

      /// psi_v = psi0_v + rho / |V|, psi0 = diag(d) M_F^-1 phi, rho = 1 - sum psi0; rows: V, columns: corners.
      static Eigen::MatrixXd
      dual_functions(const FaceMoments &m, const std::vector<unsigned int> &local)
      {
        const Eigen::Index n = static_cast<Eigen::Index>(local.size());
        Eigen::MatrixXd    mass(n, n);
        Eigen::VectorXd    d(n), scale(n);
        for (Eigen::Index i = 0; i < n; ++i)
          {
            d[i] = 0.;
            for (unsigned int b = 0; b < 4; ++b)
              d[i] += m.mass[4 * local[i] + b];
            scale[i] = m.mass[5 * local[i]] > 0. ? 1. / std::sqrt(m.mass[5 * local[i]]) : 0.;
          }
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            mass(i, j) = scale[i] * m.mass[4 * local[i] + local[j]] * scale[j];
        // Thin covers make M_F nearly singular: pseudo-inverse of the scaled matrix.
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(mass);
        Eigen::VectorXd                                      inverse = eigen.eigenvalues();
        for (Eigen::Index i = 0; i < n; ++i)
          inverse[i] = inverse[i] > 1e-13 * eigen.eigenvalues()[n - 1] ? 1. / inverse[i] : 0.;
        const Eigen::MatrixXd small = d.cwiseProduct(scale).asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() *
                                      eigen.eigenvectors().transpose() * scale.asDiagonal();
        Eigen::MatrixXd psi = Eigen::MatrixXd::Zero(n, 4);
        for (Eigen::Index j = 0; j < n; ++j)
          psi.col(local[j]) = small.col(j);
        const Eigen::RowVectorXd rho = Eigen::RowVectorXd::Ones(4) - psi.colwise().sum();
        psi.rowwise() += rho / static_cast<double>(n);
        return psi;
      }

      /// The second step: psi~_k = (D~_k/D_k) psi_k + sum_h w_kh rho_h.
      void
      combine_hanging()
      {
        combination.assign(in_r.size(), {});
        diagonal.assign(in_r.size(), 0.);
        for (unsigned int v = 0; v < in_r.size(); ++v)
          if (const auto it = d_rows[v].find(v); it != d_rows[v].end())
            diagonal[v] = it->second;
        for (unsigned int v = 0; v < in_r.size(); ++v)
          if (is_row(v))
            combination[v][v] = 1.;
        for (unsigned int h = 0; h < in_r.size(); ++h)
          {
            if (non.hanging[h].empty() || in_r[h] || !(diagonal[h] > 0.))
              continue;
            double                                          weight_sum = 0.;
            std::vector<std::pair<unsigned int, double>> kept;
            for (const auto &[k, c] : non.hanging[h])
              if (is_row(k))
                {
                  kept.emplace_back(k, c);
                  weight_sum += c;
                }
            SparseRow rho;
            rho[h] = 1.;
            for (const auto &[k, c] : kept)
              {
                rho[k] -= c * diagonal[h] / diagonal[k];
                combination[k][k] += c * diagonal[h] / diagonal[k];
              }
            for (const auto &[k, c] : kept)
              add_scaled(combination[k], c / weight_sum, rho);
          }
      }

      bool
      is_row(const unsigned int v) const
      {
        return non.hanging[v].empty() && !in_r[v] && diagonal[v] > 0.;
      }

      /// Adds a vertex entry to node entries, hanging vertices resolved.
      static void
      add_resolved(std::map<NodeIndex, double> &row, const ContactSurface &surface, const unsigned int v, const double value)
      {
        if (surface.hanging[v].empty())
          row[surface.vertex_node[v]] += value;
        else
          for (const auto &[parent, weight] : surface.hanging[v])
            row[surface.vertex_node[parent]] += weight * value;
      }

      void
      make_rows(PairCoupling &result)
      {
        std::vector<unsigned int> order;
        for (unsigned int v = 0; v < in_r.size(); ++v)
          if (is_row(v))
            order.push_back(v);
        std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
          return non.vertex_node[a] < non.vertex_node[b];
        });
        std::set<NodeIndex> row_nodes, r_nodes;
        for (const unsigned int v : order)
          row_nodes.insert(non.vertex_node[v]);

        result.coupling = InterfaceCoupling();
        result.normals.clear();
        result.gaps.clear();
        result.positions.clear();
        result.fixed.clear();
        result.vertices = order;
        for (const unsigned int k : order)
          {
            std::map<NodeIndex, double> d_row, m_row;
            Vector3                     gap;
            for (const auto &[v, factor] : combination[k])
              {
                for (const auto &[j, value] : d_rows[v])
                  add_resolved(d_row, non, j, factor * value);
                for (const auto &[q, value] : m_rows[v])
                  add_resolved(m_row, mor, q, factor * value);
                gap += factor * gaps[v];
              }
            const NodeIndex node   = non.vertex_node[k];
            const double    weight = d_row[node];
            result.coupling.rows.push_back(node);
            result.coupling.weight.push_back(weight);
            // Off the diagonal D has entries toward R only; what rounding leaves toward K is dropped.
            std::map<NodeIndex, double> entries;
            for (const auto &[j, value] : d_row)
              if (row_nodes.count(j) == 0 && std::abs(value) > 1e-14 * weight)
                {
                  entries[j] -= value / weight;
                  r_nodes.insert(j);
                }
            for (const auto &[q, value] : m_row)
              if (value != 0.)
                entries[q] += value / weight;
            for (const auto &[q, value] : entries)
              result.coupling.entries.push_back({q, value});
            result.coupling.row_start.push_back(result.coupling.entries.size());
            result.normals.push_back(non.mesh.vertex_normals[k]);
            result.gaps.push_back((prescribed_gap ? gap[0] : gap * non.mesh.vertex_normals[k]) / weight);
            result.positions.push_back(non.mesh.vertices[k]);
            result.fixed.push_back(non.vertex_fixed[k]);
          }
        result.r_nodes.assign(r_nodes.begin(), r_nodes.end());
      }

      bool
      drop_large_rows(const PairCoupling &result)
      {
        bool any = false;
        for (std::size_t row = 0; row < result.coupling.n_rows(); ++row)
          {
            double sum = 0.;
            for (const auto *entry = result.coupling.begin(row); entry != result.coupling.end(row); ++entry)
              sum += std::abs(entry->weight);
            if (sum > largest_row_sum && protected_vertex.count(result.vertices[row]) == 0)
              {
                drop(result.vertices[row], DroppedNode::large_row);
                any = true;
              }
          }
        return any;
      }

      void
      report_dropped(PairCoupling &result) const
      {
        for (unsigned int v = 0; v < in_r.size(); ++v)
          if (in_r[v] && non.hanging[v].empty() && covered[v] > empty_share * full[v])
            result.dropped.push_back(
              {non.vertex_node[v], non.mesh.vertices[v], static_cast<DroppedNode::Reason>(reason[v]), share(v)});
      }

      const ContactSurface           &non, &mor;
      const std::vector<FaceMoments> &moments;
      const bool                      prescribed_gap;
      std::vector<double>             covered, full, diagonal;
      std::vector<bool>               in_r;
      std::vector<int>                reason;
      std::set<unsigned int>          protected_vertex;
      std::vector<SparseRow>          d_rows, m_rows, combination;
      std::vector<Vector3>            gaps;
    };

    void
    insert_conforming(std::set<NodeIndex> &nodes, const ContactSurface &surface, const unsigned int v)
    {
      if (surface.hanging[v].empty())
        nodes.insert(surface.vertex_node[v]);
      else
        for (const auto &parent : surface.hanging[v])
          nodes.insert(surface.vertex_node[parent.first]);
    }
  } // namespace



  PairCoupling
  couple(const ContactSurface           &nonmortar,
         const ContactSurface           &mortar,
         const std::vector<FaceMoments> &moments,
         const std::set<NodeIndex>      &excluded,
         const bool                      prescribed_gap)
  {
    return Assembler(nonmortar, mortar, moments, excluded, prescribed_gap).run();
  }



  std::set<NodeIndex>
  touched_nonmortar_nodes(const ContactSurface &nonmortar, const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      if (m.covered > empty_share * m.area)
        for (const unsigned int v : nonmortar.faces[m.face].corners)
          insert_conforming(nodes, nonmortar, v);
    return nodes;
  }



  std::set<NodeIndex>
  touched_mortar_nodes(const ContactSurface &mortar, const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      for (const auto &entry : m.coupling)
        insert_conforming(nodes, mortar, entry.first);
    return nodes;
  }



  std::vector<std::pair<unsigned int, std::size_t>>
  join_couplings(InterfaceCoupling &joined, const std::vector<PairCoupling> &pairs)
  {
    std::vector<std::pair<NodeIndex, std::pair<unsigned int, std::size_t>>> order;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (std::size_t row = 0; row < pairs[p].coupling.n_rows(); ++row)
        order.push_back({pairs[p].coupling.rows[row], {p, row}});
    std::sort(order.begin(), order.end());
    joined = InterfaceCoupling();
    std::vector<std::pair<unsigned int, std::size_t>> origin;
    for (const auto &[node, where] : order)
      {
        const InterfaceCoupling &c = pairs[where.first].coupling;
        AssertThrow(joined.rows.empty() || joined.rows.back() != node, ExcMessage("A node carries two multipliers."));
        joined.rows.push_back(node);
        joined.weight.push_back(c.weight[where.second]);
        joined.entries.insert(joined.entries.end(), c.begin(where.second), c.end(where.second));
        joined.row_start.push_back(joined.entries.size());
        origin.push_back(where);
      }
    for (const auto &entry : joined.entries)
      AssertThrow(joined.find(entry.node) < 0, ExcMessage("The contact pairs form a cycle: a node is nonmortar and mortar."));
    return origin;
  }
} // namespace Signorini
