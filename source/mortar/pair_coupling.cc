// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "multiplier_nodes.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/mortar/dual_basis.h>
#include <signorini/mortar/pair_coupling.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  const char *to_string(const DroppedNode::Reason reason)
  {
    static const char *const texts[] = {"all components prescribed",
                                        "normal direction prescribed",
                                        "node of another surface in contact, too",
                                        "on a sharp edge",
                                        "thinly covered",
                                        "extrapolating"};
    return texts[reason];
  }



  namespace
  {
    /// Pure number.
    struct CrossNormalRule
    {
      /// Least cosine between the normal of a node and those of the other side, in the mean over its
      /// function, along which gaps are measured.
      double least = .2;
    };

    /// The gap of a node (area * length). Along a normal that lies across those of the other side there is
    /// none, whatever the distance: where a fillet of two faces that stands on a table goes over into the
    /// upright wall, nodes carried twice the load of the block, two of its radii away from the table. They
    /// are as far away as along the steepest normal that counts.
    /// @param gap integral of the node's function times Phi(x) - x (area * length)
    /// @param facing integral of the node's function times the unit normals of the other side (area)
    double gap_along(const Vector3 &normal, const Vector3 &gap, const Vector3 &facing)
    {
      const CrossNormalRule rule;
      const double          size = facing.norm();
      const double          away = size > 0. ? -(gap * facing) / size : 0.;
      return away > 0. && std::abs(facing * normal) < rule.least * size ? away / rule.least : gap * normal;
    }

    /// Vertex indices with values; an index may occur several times.
    using Entries = std::vector<std::pair<unsigned int, double>>;

    /// Adds to the entry of an index in a short list.
    void add_to(Entries &list, const unsigned int index, const double value)
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

    /// The integrals with the uncondensed dual basis, their combination over hanging vertices, the rows.
    class CouplingAssembler
    {
    public:
      CouplingAssembler(const ContactSurface &nonmortar, const ContactSurface &mortar,
                        const SurfaceHalo &halo, const std::vector<FaceMoments> &moments,
                        const bool prescribed_gap)
        : non(nonmortar)
        , mor(mortar)
        , halo(halo)
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
          if (halo.owns(v) && nodes.is_row(v))
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
        facing = gaps;
        diagonal.assign(non.vertex_node.size(), 0.);
        for (const FaceMoments &m : moments)
          {
            const bool is_own = halo.owns_face(m.face);
            result.area += is_own ? m.area : 0.;
            result.covered_area += is_own ? m.covered : 0.;
            if (is_empty(m))
              continue;
            const auto         &corners = non.faces[m.face].corners;
            std::array<bool, 4> in_v;
            for (unsigned int a = 0; a < 4; ++a)
              in_v[a] = a < non.faces[m.face].n_corners &&
                        (!nodes.is_in_r(corners[a]) || nodes.is_ceded(corners[a]));
            const DualBasis psi     = compute_dual_basis(m.mass, in_v);
            bool            is_lost = true;
            for (unsigned int i = 0; i < psi.n_functions; ++i)
              if (!nodes.is_ceded(corners[psi.corner[i]]) && !non.faces[m.face].leaves(psi.corner[i]))
                {
                  add_function(m, corners, psi.corner[i], psi.coefficients[i]);
                  is_lost = false;
                }
            // Nothing touches a flank.
            if (is_lost && is_own && non.faces[m.face].flank_corners == 0)
              result.lost_area += m.covered;
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
            facing[v] += c[j] * m.facing[j];
          }
        for (const auto &[q, values] : m.coupling)
          m_rows[v].emplace_back(q,
                                 c[0] * values[0] + c[1] * values[1] + c[2] * values[2] + c[3] * values[3]);
      }

      /// The second step: psi~_k = (D~_k/D_k) psi_k + sum_h w_kh rho_h as combinations of the psi.
      void combine_hanging(const MultiplierNodes &nodes)
      {
        combination.assign(non.vertex_node.size(), {});
        for (const unsigned int v : halo.functions())
          if (nodes.is_row(v))
            combination[v].emplace_back(v, 1.);
        gap_combination                   = combination;
        const std::vector<bool> has_kinks = vertices_beside_flanks();
        for (const unsigned int h : halo.functions())
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
                  add_to(gap_combination[k], k, c * diagonal[h] / diagonal[k]);
                }
            for (const auto &[k, c] : non.hanging[h])
              if (nodes.is_row(k))
                for (const auto &[v, value] : rho)
                  {
                    add_to(combination[k], v, c / weight_sum * value);
                    if (!has_kinks[h])
                      add_to(gap_combination[k], v, c / weight_sum * value);
                  }
          }
      }

      /// Beside these the gap is no linear function: the rho of a hanging one, which sees what is not linear,
      /// would take the gap of a parent over the flank from that of one at the seat.
      std::vector<bool> vertices_beside_flanks() const
      {
        std::vector<bool> result(non.vertex_node.size(), false);
        for (const FaceMoments &m : moments)
          for (unsigned int a = 0; a < non.faces[m.face].n_corners; ++a)
            if (non.faces[m.face].sees_flank(a))
              result[non.faces[m.face].corners[a]] = true;
        return result;
      }

      void add_row(PairCoupling &result, const MultiplierNodes &nodes, const unsigned int k)
      {
        d_sum.clear();
        m_sum.clear();
        Vector3 gap, normals;
        for (const auto &[v, factor] : combination[k])
          {
            d_sum.add(factor, d_rows[v]);
            m_sum.add(factor, m_rows[v]);
          }
        for (const auto &[v, factor] : gap_combination[k])
          {
            gap += factor * gaps[v];
            normals += factor * facing[v];
          }
        // D is diagonal on K up to rounding (more on slivers), and zero at ceded nodes without hanging
        // neighbours: the rest goes to the diagonal, so that the row sums of D and M stay equal.
        const auto is_column = [&](const unsigned int j) {
          return !nodes.is_row(j) &&
                 std::abs(d_sum.values[j]) > (nodes.is_ceded(j) ? 1e-10 : 1e-14) * d_sum.values[k];
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
        result.gaps.push_back((prescribed_gap ? gap[0] : gap_along(normal, gap, normals)) / weight);
        result.positions.push_back(non.mesh.vertices[k]);
        result.areas.push_back(area);
        result.shares.push_back(nodes.share(k));
        result.fixed.push_back(non.vertex_fixed[k]);
        result.vertices.push_back(k);
        result.on_sharp_edge.push_back(nodes.is_on_sharp_edge(k) ? 1 : 0);
      }

      /// Appends a row; a node that occurs on both sides gets one entry.
      static void append_sorted(InterfaceCoupling &coupling, std::vector<InterfaceCoupling::Entry> &entries)
      {
        std::stable_sort(entries.begin(), entries.end(),
                         [](const auto &a, const auto &b) { return a.node < b.node; });
        for (const auto &entry : entries)
          if (coupling.entries.size() > coupling.row_start.back() &&
              coupling.entries.back().node == entry.node)
            coupling.entries.back().weight += entry.weight;
          else
            coupling.entries.push_back(entry);
        coupling.row_start.push_back(coupling.entries.size());
      }

      const ContactSurface           &non, &mor;
      const SurfaceHalo              &halo;
      const std::vector<FaceMoments> &moments;
      const bool                      prescribed_gap;
      /// By vertex: of functions; of rows, the functions of which they are combinations, and those of which
      /// their gaps are.
      std::vector<Entries> d_rows, m_rows, combination, gap_combination;
      std::vector<Vector3> gaps, facing;
      /// int psi_v phi_v.
      std::vector<double> diagonal;
      VertexSum           d_sum, m_sum;
    };

    /// The vertices of rows that extrapolate, of this rank.
    std::vector<unsigned int> large_rows(const MultiplierNodes &nodes, const PairCoupling &pair,
                                         const double largest_row_sum)
    {
      std::vector<unsigned int> result;
      for (std::size_t row = 0; row < pair.coupling.n_rows(); ++row)
        {
          double sum = 0.;
          for (const auto *entry = pair.coupling.begin(row); entry != pair.coupling.end(row); ++entry)
            sum += std::abs(entry->weight);
          if (sum > largest_row_sum && !nodes.must_stay(pair.vertices[row]))
            result.push_back(pair.vertices[row]);
        }
      return result;
    }
  } // namespace



  PairCoupling couple(const SharedPair &pair, const std::vector<FaceMoments> &moments,
                      const NodesOfOtherPairs &others, const bool prescribed_gap, const DroppingRule &rule)
  {
    MultiplierNodes   nodes(pair.nonmortar, pair.halo, moments, others, rule);
    CouplingAssembler assembler(pair.nonmortar, pair.mortar, pair.halo, moments, prescribed_gap);
    nodes.complete();
    PairCoupling result = assembler.assemble(nodes);
    // Every round drops or keeps for good at least one node; a few rounds are the rule.
    while (nodes.drop_rows(large_rows(nodes, result, rule.largest_row_sum)))
      {
        nodes.complete();
        result = assembler.assemble(nodes);
      }
    result.dropped    = nodes.report();
    result.ceded      = nodes.ceded_nodes();
    result.lost_faces = nodes.lost_faces();
    for (double *const area : {&result.area, &result.covered_area, &result.lost_area})
      *area = Utilities::MPI::sum(*area, pair.halo.communicator());
    result.n_rows_of_all = Utilities::MPI::sum(result.coupling.n_rows(), pair.halo.communicator());
    return result;
  }



  std::vector<DroppedNode> PairCoupling::nodes_without_multiplier() const
  {
    std::set<NodeIndex> elsewhere;
    for (const CededNode &node : ceded)
      elsewhere.insert(node.node);
    std::vector<DroppedNode> result;
    std::copy_if(dropped.begin(), dropped.end(), std::back_inserter(result),
                 [&](const DroppedNode &node) { return elsewhere.count(node.node) == 0; });
    return result;
  }



  std::size_t PairCoupling::memory_consumption() const
  {
    return list_bytes(coupling.rows) + list_bytes(coupling.row_start) + list_bytes(coupling.entries) +
           list_bytes(coupling.weight) + list_bytes(normals) + list_bytes(gaps) + list_bytes(positions) +
           list_bytes(areas) + list_bytes(shares) + list_bytes(fixed) + list_bytes(vertices) +
           list_bytes(on_sharp_edge) + list_bytes(r_nodes) + list_bytes(ceded) + list_bytes(dropped) +
           list_bytes(lost_faces);
  }



  double width_of_rows(const PairCoupling &pair, const MPI_Comm communicator)
  {
    struct First
    {
      NodeIndex node;
      Point<3>  position;
    };
    std::vector<First> firsts;
    if (!pair.positions.empty())
      firsts.push_back({pair.coupling.rows[0], pair.positions[0]});
    firsts = gather_lists(std::move(firsts), communicator, Receivers::all);
    if (firsts.empty())
      return 0.;
    const Point<3> first = std::min_element(firsts.begin(), firsts.end(), [](const First &a, const First &b) {
                             return a.node < b.node;
                           })->position;
    double         width = 0.;
    for (const Point<3> &x : pair.positions)
      width = std::max(width, x.distance(first));
    return Utilities::MPI::max(width, communicator);
  }



  PairCoupling couple(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const std::vector<FaceMoments> &moments, const NodesOfOtherPairs &others,
                      const bool prescribed_gap, const DroppingRule &rule)
  {
    return couple(SharedPair{nonmortar, mortar, SurfaceHalo(nonmortar, MPI_COMM_SELF)}, moments, others,
                  prescribed_gap, rule);
  }
} // namespace Signorini
