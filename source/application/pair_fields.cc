// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/node_request.h>
#include <signorini/application/pair_fields.h>
#include <signorini/mesh/facing_parts.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Own and ghost faces.
    std::vector<bool> covered_faces(const ContactPair &pair)
    {
      std::vector<bool> result(pair.nonmortar.surface.faces.size(), false);
      for (const FaceMoments &m : pair.moments)
        result[m.face] = m.covered > 0.;
      return result;
    }
  } // namespace



  ContactStress stress_of_pair(const Discretization &d, const ContactStress &stress, const unsigned int p)
  {
    struct RowStress
    {
      Vector3       traction;
      double        pressure, opening;
      unsigned char active;
    };
    const NodeRequest request(d.partition(), d.couplings[p].coupling.rows);
    ContactStress     result;
    for (const RowStress &one : request.fetch([&](const unsigned int local) {
           const std::size_t row = d.coupling.find(d.partition().to_global(local));
           return RowStress{stress.traction[row], stress.pressure[row], stress.opening[row],
                            stress.active[row]};
         }))
      {
        result.traction.push_back(one.traction);
        result.pressure.push_back(one.pressure);
        result.opening.push_back(one.opening);
        result.active.push_back(one.active);
      }
    return result;
  }



  std::vector<bool> sharp_vertices(const ContactPair &pair)
  {
    const std::vector<bool> covered = covered_faces(pair),
                            here    = vertices_on_sharp_edges(
                                   pair.nonmortar.surface,
                                   [&](const unsigned int face, const unsigned int) { return covered[face]; });
    std::vector<unsigned char> flags(here.begin(), here.end());
    for (std::size_t v = 0; v < pair.nonmortar.surface.has_partner_normal.size(); ++v)
      if (pair.nonmortar.surface.has_partner_normal[v])
        flags[v] = 0;
    pair.halo->update(flags);
    // Coarse faces beside fine ones have hanging vertices on their edges, which are no corners of theirs.
    const auto &hanging = pair.nonmortar.surface.hanging;
    for (std::size_t v = 0; v < flags.size(); ++v)
      if (!hanging[v].empty())
        flags[v] = std::all_of(hanging[v].begin(), hanging[v].end(),
                               [&](const auto &parent) { return flags[parent.first] != 0; });
    return std::vector<bool>(flags.begin(), flags.end());
  }



  std::vector<bool> faces_of_pair(const ContactPair &pair)
  {
    std::vector<bool> result = covered_faces(pair);
    for (unsigned int f = 0; f < result.size(); ++f)
      result[f] = result[f] && pair.halo->owns_face(f);
    return result;
  }



  std::vector<OverlayTriangle> covered_overlay(const ContactPair &pair)
  {
    const std::vector<bool>      faces = faces_of_pair(pair);
    std::vector<OverlayTriangle> cells = pair.mapping->overlay();
    cells.erase(std::remove_if(cells.begin(), cells.end(),
                               [&](const OverlayTriangle &cell) {
                                 return !faces[pair.nonmortar.surface.triangle_face[cell.nonmortar_triangle]];
                               }),
                cells.end());
    return cells;
  }



  namespace
  {
    /// Values at the rows of a pair, spread over the vertices of its nonmortar surface.
    template <typename Value>
    class RowField
    {
    public:
      /// Collective.
      RowField(const Discretization &d, const unsigned int p, const std::vector<Value> &of_rows)
        : surface(d.pairs[p].nonmortar.surface)
        , halo(*d.pairs[p].halo)
        , values(spread_rows(d.couplings[p], halo, of_rows))
        , is_known(spread_rows(d.couplings[p], halo, std::vector<unsigned char>(of_rows.size(), 1)))
      {
      }

      /// Collective. Gives vertices without a row the mean over the corners with one of the faces around
      /// them.
      /// @param which() tells the vertices
      template <typename Which>
      void fill(const Which &which)
      {
        std::vector<Value>  sum(values.size());
        std::vector<double> n(values.size(), 0.);
        for (const ContactSurface::Face &face : surface.faces)
          for (unsigned int a = 0; a < face.n_corners; ++a)
            if (const unsigned int v = face.corners[a]; !is_known[v] && which(v))
              for (unsigned int b = 0; b < face.n_corners; ++b)
                if (is_known[face.corners[b]])
                  {
                    sum[v] += values[face.corners[b]];
                    n[v] += 1.;
                  }
        for (std::size_t v = 0; v < values.size(); ++v)
          if (n[v] > 0.)
            values[v] = sum[v] / n[v];
        halo.update(values);
      }

      /// The mean over the corners of a face with a row; `otherwise` if there are none.
      Value mean(const ContactSurface::Face &face, const Value &otherwise) const
      {
        Value  sum = Value();
        double n   = 0.;
        for (unsigned int a = 0; a < face.n_corners; ++a)
          if (is_known[face.corners[a]])
            {
              sum += values[face.corners[a]];
              n += 1.;
            }
        return n > 0. ? sum / n : otherwise;
      }

      /// At a vertex as value_of(vertex) gives it, at a hanging one from its parents.
      template <typename ValueOf>
      Value interpolate(const unsigned int v, const ValueOf &value_of) const
      {
        if (surface.hanging[v].empty())
          return value_of(v);
        Value sum = Value();
        for (const auto &[parent, weight] : surface.hanging[v])
          sum += weight * value_of(parent);
        return sum;
      }

      Value value(const unsigned int vertex) const
      {
        return values[vertex];
      }

      bool has_row(const unsigned int vertex) const
      {
        return is_known[vertex] != 0;
      }

      std::size_t n_vertices() const
      {
        return values.size();
      }

    private:
      const ContactSurface      &surface;
      const SurfaceHalo         &halo;
      std::vector<Value>         values;
      std::vector<unsigned char> is_known;
    };
  } // namespace



  CornerValues stress_at_corners(const Discretization &d, const ContactStress &all, const unsigned int p)
  {
    const ContactSurface   &surface = d.pairs[p].nonmortar.surface;
    const std::vector<bool> sharp   = sharp_vertices(d.pairs[p]);
    RowField<Vector3>       stress(d, p, stress_of_pair(d, all, p).traction);
    stress.fill([](const unsigned int) { return true; });
    CornerValues result(surface.faces.size());
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      {
        const ContactSurface::Face &face = surface.faces[f];
        for (unsigned int a = 0; a < face.n_corners; ++a)
          result[f][a] = stress.interpolate(face.corners[a], [&](const unsigned int v) {
            return sharp[v] && !stress.has_row(v) ? stress.mean(face, stress.value(v)) : stress.value(v);
          });
      }
    return result;
  }



  namespace
  {
    /// By vertex: nodes that have no multiplier at all though the other side lies over most of what is around
    /// them. Ceded ones have one in another pair.
    std::vector<unsigned char> covered_without_row(const ContactPair &pair, const PairCoupling &coupling)
    {
      constexpr double    most = .5;
      std::set<NodeIndex> nodes;
      for (const DroppedNode &dropped : coupling.dropped)
        if (dropped.share > most)
          nodes.insert(dropped.node);
      for (const PairCoupling::CededNode &ceded : coupling.ceded)
        nodes.erase(ceded.node);
      std::vector<unsigned char> result(pair.nonmortar.surface.vertex_node.size(), 0);
      for (std::size_t v = 0; v < result.size(); ++v)
        result[v] = nodes.count(pair.nonmortar.surface.vertex_node[v]) > 0;
      pair.halo->update(result);
      return result;
    }

    template <typename Value>
    std::vector<Value> at_all_vertices(const Discretization &d, const unsigned int p,
                                       const std::vector<Value> &of_rows)
    {
      const auto      wants_value = covered_without_row(d.pairs[p], d.couplings[p]);
      RowField<Value> field(d, p, of_rows);
      field.fill([&](const unsigned int v) { return wants_value[v] != 0; });
      std::vector<Value> result;
      result.reserve(field.n_vertices());
      for (unsigned int v = 0; v < field.n_vertices(); ++v)
        result.push_back(field.interpolate(v, [&](const unsigned int w) { return field.value(w); }));
      return result;
    }
  } // namespace



  std::vector<double> at_vertices(const Discretization &d, const unsigned int p,
                                  const std::vector<double> &of_rows)
  {
    return at_all_vertices(d, p, of_rows);
  }



  std::vector<Vector3> at_vertices(const Discretization &d, const unsigned int p,
                                   const std::vector<Vector3> &of_rows)
  {
    return at_all_vertices(d, p, of_rows);
  }
} // namespace Signorini
