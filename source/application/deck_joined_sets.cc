// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "deck_joined_sets.h"

#include "interpolated_field.h"

#include <signorini/algebra/disjoint_sets.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct JoinRule
    {
      /// Cosine between the normals of faces that are one surface (40 degrees, as sides of a vertex are).
      double one_surface = .766;
    };

    /// What holds the nodes of a body in one direction.
    class HeldDirection
    {
    public:
      HeldDirection(const DeckBody &body, const unsigned int component, const unsigned int frame)
        : body(body)
        , component(component)
        , frame(frame)
        , sets_of(body.cells->mesh.vertices.size())
      {
      }

      void add(const HeldSet &set)
      {
        for (const unsigned int vertex : vertices_within(set.nodes, *body.cells))
          sets_of[vertex].push_back(static_cast<unsigned int>(names.size()));
        for (const unsigned int node : set.nodes)
          values[node] = *set.values[component];
        names.push_back(set.name);
        nodes.insert(nodes.end(), set.nodes.begin(), set.nodes.end());
      }

      std::vector<JoinedSet> join()
      {
        std::vector<JoinedSet> result;
        if (names.size() < 2)
          return result;
        find_faces();
        if (std::all_of(is_of_one_set.begin(), is_of_one_set.end(), [](const bool is) { return is; }))
          return result;
        for (const auto &[root, part] : parts())
          if (part.is_divided && (part.is_of_one_set || has_vertex_of_its_own(part)))
            {
              const std::vector<unsigned int> vertices(part.vertices.begin(), part.vertices.end());
              result.push_back({name_of(vertices), vertices, component, frame, value_at(vertices)});
            }
        return result;
      }

    private:
      /// A smooth part of the boundary.
      struct Part
      {
        std::set<unsigned int> vertices;
        /// Whether it has a face of which one set has all nodes; and one of which none has.
        bool is_of_one_set = false, is_divided = false;
      };

      static unsigned int n_corners(const VolumeMesh::Face &face)
      {
        return face[3] == VolumeMesh::no_vertex ? 3 : 4;
      }

      /// Faces all of whose nodes are held.
      void find_faces()
      {
        std::vector<bool> is_held(sets_of.size(), false);
        for (const unsigned int vertex : vertices_within(nodes, *body.cells))
          is_held[vertex] = true;
        for (const auto &[face, cell] : body.boundary)
          {
            std::vector<unsigned int> common = sets_of[face[0]];
            bool                      is_all = true;
            for (unsigned int i = 0; i < n_corners(face); ++i)
              {
                is_all = is_all && is_held[face[i]];
                std::vector<unsigned int> both;
                std::set_intersection(common.begin(), common.end(), sets_of[face[i]].begin(),
                                      sets_of[face[i]].end(), std::back_inserter(both));
                common.swap(both);
              }
            if (!is_all)
              continue;
            faces.push_back(face);
            is_of_one_set.push_back(!common.empty());
          }
      }

      /// Unit normal, of either direction.
      Tensor<1, 3> normal(const VolumeMesh::Face &face) const
      {
        const auto        &x = body.cells->mesh.vertices;
        const Tensor<1, 3> n = n_corners(face) == 3
                                   ? cross_product_3d(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]])
                                   // deal.II's order.
                                   : cross_product_3d(x[face[3]] - x[face[0]], x[face[2]] - x[face[1]]);
        return n.norm() > 0. ? n / n.norm() : n;
      }

      std::map<std::size_t, Part> parts()
      {
        DisjointSets                                                               smooth(faces.size());
        std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>> beside;
        for (unsigned int f = 0; f < faces.size(); ++f)
          {
            const VolumeMesh::Face                                  &v = faces[f];
            const std::vector<std::pair<unsigned int, unsigned int>> edges =
                n_corners(v) == 3 ? std::vector<std::pair<unsigned int, unsigned int>>{{v[0], v[1]},
                                                                                       {v[1], v[2]},
                                                                                       {v[2], v[0]}}
                                  : std::vector<std::pair<unsigned int, unsigned int>>{
                                        {v[0], v[1]}, {v[1], v[3]}, {v[3], v[2]}, {v[2], v[0]}};
            for (const auto &edge : edges)
              beside[std::minmax(edge.first, edge.second)].push_back(f);
          }
        for (const auto &[edge, both] : beside)
          for (std::size_t i = 1; i < both.size(); ++i)
            if (std::abs(normal(faces[both[0]]) * normal(faces[both[i]])) >= JoinRule().one_surface)
              smooth.unite(both[0], both[i]);
        std::map<std::size_t, Part> result;
        for (unsigned int f = 0; f < faces.size(); ++f)
          {
            Part &part = result[smooth.find(f)];
            for (unsigned int i = 0; i < n_corners(faces[f]); ++i)
              part.vertices.insert(faces[f][i]);
            (is_of_one_set[f] ? part.is_of_one_set : part.is_divided) = true;
          }
        std::vector<unsigned int> n_parts(sets_of.size(), 0);
        for (const auto &[root, part] : result)
          for (const unsigned int vertex : part.vertices)
            ++n_parts[vertex];
        is_in_one_part.assign(sets_of.size(), false);
        for (unsigned int vertex = 0; vertex < n_parts.size(); ++vertex)
          is_in_one_part[vertex] = n_parts[vertex] == 1;
        return result;
      }

      bool has_vertex_of_its_own(const Part &part) const
      {
        return std::any_of(part.vertices.begin(), part.vertices.end(),
                           [&](const unsigned int vertex) { return is_in_one_part[vertex]; });
      }

      /// Of the sets that have nodes there.
      std::string name_of(const std::vector<unsigned int> &vertices) const
      {
        std::set<unsigned int> sets;
        for (const unsigned int vertex : vertices)
          sets.insert(sets_of[vertex].begin(), sets_of[vertex].end());
        constexpr std::size_t n_told = 3;
        std::string           result;
        std::size_t           n = 0;
        for (const unsigned int set : sets)
          if (n < n_told)
            result += (n++ > 0 ? " and " : "") + names[set];
        return sets.size() > n_told ? result + " and " + std::to_string(sets.size() - n_told) + " more"
                                    : result;
      }

      ScalarField value_at(const std::vector<unsigned int> &vertices) const
      {
        const DeckSeries        none = values.begin()->second.scaled(0.);
        std::vector<DeckSeries> at_vertices(sets_of.size(), none);
        bool                    is_constant = true;
        for (const unsigned int vertex : vertices)
          {
            DeckSeries &series  = at_vertices[vertex];
            const auto &support = body.cells->support(vertex);
            for (const unsigned int node : support)
              for (std::size_t k = 0; k < series.values.size(); ++k)
                series.values[k] += values.at(node).values[k] / static_cast<double>(support.size());
            is_constant = is_constant && series.values == at_vertices[vertices[0]].values;
          }
        return is_constant ? at_vertices[vertices[0]].field() : nodal_field(body, at_vertices);
      }

      const DeckBody                    &body;
      const unsigned int                 component, frame;
      std::vector<std::string>           names;
      std::vector<unsigned int>          nodes;
      std::map<unsigned int, DeckSeries> values;
      /// By vertex, ascending.
      std::vector<std::vector<unsigned int>> sets_of;
      std::vector<VolumeMesh::Face>          faces;
      std::vector<bool>                      is_of_one_set, is_in_one_part;
    };
  } // namespace



  std::vector<JoinedSet> join_held_sets(const DeckBody &body, const std::vector<HeldSet> &sets)
  {
    std::map<std::pair<unsigned int, unsigned int>, HeldDirection> directions;
    for (const HeldSet &set : sets)
      for (unsigned int c = 0; c < 3; ++c)
        if (set.values[c])
          directions.emplace(std::make_pair(set.frame, c), HeldDirection(body, c, set.frame))
              .first->second.add(set);
    std::vector<JoinedSet> result;
    for (auto &[key, direction] : directions)
      for (JoinedSet &joined : direction.join())
        result.push_back(std::move(joined));
    return result;
  }



  ScalarField nodal_field(const DeckBody &body, const std::vector<DeckSeries> &at_vertices)
  {
    return [mesh   = std::make_shared<const MeshInterpolation>(body.cells->mesh),
            values = std::make_shared<const std::vector<DeckSeries>>(at_vertices)](const Point<3> &p,
                                                                                   const double    t) {
      const MeshInterpolation::Weights weights = mesh->weights(p);
      double                           result  = 0.;
      for (unsigned int i = 0; i < weights.n; ++i)
        result += weights.values[i] * (*values)[weights.vertices[i]].at(t);
      return result;
    };
  }
} // namespace Signorini
