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
#include <tuple>

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
        const std::vector<unsigned int> vertices = vertices_within(set.nodes, *body.cells);
        if (vertices.empty())
          return;
        for (const unsigned int vertex : vertices)
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
        for (const std::set<unsigned int> &group : divided_groups())
          {
            const std::vector<unsigned int> vertices(group.begin(), group.end());
            result.push_back({name_of(vertices), vertices, component, frame, value_at(vertices)});
          }
        return result;
      }

    private:
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

      using Edge = std::pair<unsigned int, unsigned int>;

      static std::vector<Edge> edges_of(const VolumeMesh::Face &v)
      {
        if (n_corners(v) == 3)
          return {std::minmax(v[0], v[1]), std::minmax(v[1], v[2]), std::minmax(v[2], v[0])};
        // deal.II's order.
        return {std::minmax(v[0], v[1]), std::minmax(v[1], v[3]), std::minmax(v[3], v[2]),
                std::minmax(v[2], v[0])};
      }

      /// Pairs of faces that are one surface, with the edge between them.
      std::vector<std::tuple<unsigned int, unsigned int, Edge>> smooth_neighbours() const
      {
        std::map<Edge, std::vector<unsigned int>> beside;
        for (unsigned int f = 0; f < faces.size(); ++f)
          for (const Edge &edge : edges_of(faces[f]))
            beside[edge].push_back(f);
        std::vector<std::tuple<unsigned int, unsigned int, Edge>> result;
        for (const auto &[edge, both] : beside)
          if (both.size() == 2 &&
              std::abs(normal(faces[both[0]]) * normal(faces[both[1]])) >= JoinRule().one_surface)
            result.emplace_back(both[0], both[1], edge);
        return result;
      }

      bool share_a_set(const unsigned int one, const unsigned int other) const
      {
        return std::any_of(sets_of[one].begin(), sets_of[one].end(), [&](const unsigned int set) {
          return std::binary_search(sets_of[other].begin(), sets_of[other].end(), set);
        });
      }

      /// Whether the nodes of a divided face beyond an edge that is of one set are of one other set.
      bool goes_on_with_another_set(const VolumeMesh::Face &face, const Edge &edge) const
      {
        std::vector<unsigned int> rest;
        for (unsigned int i = 0; i < n_corners(face); ++i)
          if (face[i] != edge.first && face[i] != edge.second)
            rest.push_back(face[i]);
        for (const unsigned int vertex : rest)
          if (!share_a_set(vertex, rest[0]) || share_a_set(vertex, edge.first) ||
              share_a_set(vertex, edge.second))
            return false;
        return true;
      }

      /// The vertices of divided faces that hang together, where they are held.
      std::vector<std::set<unsigned int>> divided_groups() const
      {
        DisjointSets      smooth(faces.size()), groups(faces.size());
        std::vector<bool> goes_on(faces.size(), false);
        for (const auto &[one, other, edge] : smooth_neighbours())
          {
            smooth.unite(one, other);
            if (!is_of_one_set[one] && !is_of_one_set[other])
              groups.unite(one, other);
            for (const auto &[divided, whole] : {std::make_pair(one, other), std::make_pair(other, one)})
              if (!is_of_one_set[divided] && is_of_one_set[whole])
                goes_on[divided] = goes_on[divided] || goes_on_with_another_set(faces[divided], edge);
          }
        // By vertex the smooth part that it lies in; several count as none.
        std::map<unsigned int, std::set<std::size_t>> parts;
        std::map<std::size_t, std::set<unsigned int>> vertices;
        std::map<std::size_t, bool>                   is_joined;
        for (unsigned int f = 0; f < faces.size(); ++f)
          for (unsigned int i = 0; i < n_corners(faces[f]); ++i)
            parts[faces[f][i]].insert(smooth.find(f));
        for (unsigned int f = 0; f < faces.size(); ++f)
          if (!is_of_one_set[f])
            {
              bool &joined = is_joined[groups.find(f)];
              joined       = joined || goes_on[f];
              for (unsigned int i = 0; i < n_corners(faces[f]); ++i)
                {
                  vertices[groups.find(f)].insert(faces[f][i]);
                  joined = joined || parts[faces[f][i]].size() == 1;
                }
            }
        std::vector<std::set<unsigned int>> result;
        for (const auto &[group, list] : vertices)
          if (is_joined[group])
            result.push_back(list);
        return result;
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
      std::vector<bool>                      is_of_one_set;
    };
  } // namespace



  std::vector<JoinedSet> join_held_sets(const DeckBody &body, const std::vector<HeldSet> &sets)
  {
    std::map<std::pair<unsigned int, unsigned int>, HeldDirection> directions;
    for (const HeldSet &set : sets)
      for (unsigned int c = 0; c < 3; ++c)
        if (set.values[c])
          directions.try_emplace({set.frame, c}, body, c, set.frame).first->second.add(set);
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
