// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "vertex_quadric.h"

#include <signorini/surface/crease_edges.h>
#include <signorini/surface/smooth_surface.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// What a corner x of a triangle adds to the normal at x: the direction of the sum over the triangles
    /// around a vertex is exact on a sphere (Max: Weights for computing vertex normals from facet normals,
    /// 1999).
    Tensor<1, 3> corner_normal(const Point<3> &x, const Point<3> &next, const Point<3> &previous)
    {
      const Tensor<1, 3> a = next - x, b = previous - x;
      const double       lengths = a.norm() * b.norm();
      return lengths > 0. ? cross_product_3d(a, b) / lengths / lengths : Tensor<1, 3>();
    }

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
    class Pieces
    {
    public:
      Pieces(const SurfaceTopology &topology, const std::vector<bool> &is_cut)
        : of_corner(3 * topology.triangles.size())
      {
        std::iota(of_corner.begin(), of_corner.end(), 0u);
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!is_cut[e])
            for (const unsigned int v : topology.edges[e])
              join(corner(topology, topology.edge_triangles[e][0], v),
                   corner(topology, topology.edge_triangles[e][1], v));
        std::vector<unsigned int> number(of_corner.size(), SurfaceTopology::none);
        for (unsigned int c = 0; c < of_corner.size(); ++c)
          {
            const unsigned int r = root(c);
            if (number[r] == SurfaceTopology::none)
              {
                number[r] = static_cast<unsigned int>(vertices.size());
                vertices.emplace_back();
                vertices.back().vertex = topology.triangles[c / 3][c % 3];
              }
            vertices[number[r]].triangles.push_back(c / 3);
          }
        std::vector<unsigned int> piece_vertex;
        for (unsigned int c = 0; c < of_corner.size(); ++c)
          piece_vertex.push_back(number[root(c)]);
        of_corner = std::move(piece_vertex);
        for (unsigned int t = 0; t < topology.triangles.size(); ++t)
          for (unsigned int i = 0; i < 3; ++i)
            if (is_cut[topology.triangle_edges[t][i]])
              for (const unsigned int k : {i, (i + 1) % 3})
                vertices[of_corner[3 * t + k]].is_closed = false;
      }

      /// The piece vertices in up to `n_rings` rings of triangles around one, without itself.
      void neighbours(std::vector<unsigned int> &found, const unsigned int centre,
                      const unsigned int n_rings) const
      {
        found            = {centre};
        std::size_t next = 0;
        for (unsigned int ring = 0; ring < n_rings; ++ring)
          for (const std::size_t end = found.size(); next < end; ++next)
            for (const unsigned int t : vertices[found[next]].triangles)
              for (unsigned int i = 0; i < 3; ++i)
                if (const unsigned int p = of_corner[3 * t + i];
                    std::find(found.begin(), found.end(), p) == found.end())
                  found.push_back(p);
        found.erase(found.begin());
      }

      std::vector<PieceVertex> vertices;
      /// Piece vertex of corner i of triangle t: of_corner[3 t + i].
      std::vector<unsigned int> of_corner;

    private:
      static unsigned int corner(const SurfaceTopology &topology, const unsigned int t, const unsigned int v)
      {
        return 3 * t + topology.local_corner(t, v);
      }

      unsigned int root(unsigned int c)
      {
        while (of_corner[c] != c)
          c = of_corner[c] = of_corner[of_corner[c]];
        return c;
      }

      void join(const unsigned int a, const unsigned int b)
      {
        const unsigned int ra = root(a), rb = root(b);
        of_corner[std::max(ra, rb)] = std::min(ra, rb);
      }
    };



    /// Makes the patches of a surface.
    class PatchMaker
    {
    public:
      PatchMaker(const SurfaceMesh &mesh, const SmoothingRule &rule)
        : mesh(mesh)
        , rule(rule)
        , topology(mesh.triangles, mesh.vertices.size())
        , normals(mesh.triangles.size())
        , is_crease(find_creases(mesh, topology))
        , is_cut(is_crease)
        , is_flat(mesh.triangles.size(), false)
      {
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          {
            const auto [a, b, c] = mesh.triangles[t];
            normals[t] =
                cross_product_3d(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
            if (const double length = normals[t].norm(); length > 0.)
              normals[t] /= length;
          }
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          is_cut[e] = is_cut[e] || topology.is_border(e);
      }

      const std::vector<bool> &creases() const
      {
        return is_crease;
      }

      void make(std::vector<SmoothSurface::Patch> &patches, const std::vector<bool> &wanted)
      {
        cut_off_flat_parts();
        find_flat_neighbours();
        const Pieces pieces(topology, is_cut);
        enum State : unsigned char
        {
          unknown,
          fitted,
          failed
        };
        std::vector<Quadric> quadrics(pieces.vertices.size());
        std::vector<State>   state(quadrics.size(), unknown);
        patches.resize(mesh.triangles.size());
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          if (wanted[t])
            {
              std::array<const Quadric *, 3> corners;
              bool                           all_fitted = !is_flat[t];
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const unsigned int p = pieces.of_corner[3 * t + i];
                  if (state[p] == unknown)
                    state[p] = is_flat[t] ? (set_frame(quadrics[p], normals[t]), fitted)
                                          : (fit_vertex(quadrics[p], pieces, p) ? fitted : failed);
                  corners[i] = &quadrics[p];
                  all_fitted = all_fitted && state[p] == fitted;
                }
              finish(patches[t], t, corners, all_fitted);
            }
      }

    private:
      /// A vertex whose surroundings lie in one plane makes its triangles flat: those around an inner one,
      /// all of two rings at a border (one cell of a cylinder alone is as flat as a strip along its axis).
      void cut_off_flat_parts()
      {
        const Pieces              pieces(topology, is_cut);
        std::vector<unsigned int> near;
        for (unsigned int p = 0; p < pieces.vertices.size(); ++p)
          {
            const PieceVertex &centre = pieces.vertices[p];
            pieces.neighbours(near, p, centre.is_closed ? 1 : 2);
            const Tensor<1, 3> &n    = normals[centre.triangles[0]];
            double              size = 0., height = 0.;
            for (const unsigned int q : near)
              {
                const Tensor<1, 3> x =
                    mesh.vertices[pieces.vertices[q].vertex] - mesh.vertices[centre.vertex];
                size   = std::max(size, x.norm());
                height = std::max(height, std::abs(x * n));
              }
            if (height <= rule.flat * size)
              for (const unsigned int t : centre.triangles)
                is_flat[t] = true;
          }
        grow_flat_parts();
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!is_cut[e])
            is_cut[e] = is_flat[topology.edge_triangles[e][0]] != is_flat[topology.edge_triangles[e][1]];
      }

      /// Triangles in the plane of a flat neighbour: at corners of a flat part all vertices may lie on its
      /// border.
      void grow_flat_parts()
      {
        std::vector<unsigned int> front;
        for (unsigned int t = 0; t < is_flat.size(); ++t)
          if (is_flat[t])
            front.push_back(t);
        while (!front.empty())
          {
            const unsigned int t = front.back();
            front.pop_back();
            for (unsigned int i = 0; i < 3; ++i)
              if (const unsigned int e = topology.triangle_edges[t][i]; !is_cut[e])
                {
                  const auto        &sides = topology.edge_triangles[e];
                  const unsigned int other = sides[0] == t ? sides[1] : sides[0];
                  if (!is_flat[other] && normals[t] * normals[other] > 0. &&
                      cross_product_3d(normals[t], normals[other]).norm() <= rule.flat)
                    {
                      is_flat[other] = true;
                      front.push_back(other);
                    }
                }
          }
      }

      /// Where curved parts go on from flat ones without a crease.
      void find_flat_neighbours()
      {
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!topology.is_border(e) && !is_crease[e])
            if (const auto &[s, t] = topology.edge_triangles[e]; is_flat[s] != is_flat[t])
              for (const unsigned int v : topology.edges[e])
                flat_normals[v].push_back(normals[is_flat[s] ? s : t]);
      }

      /// A vertex at the end of a flat part has the normal of that, if it is nearly that and the surface is
      /// curved across: a fillet touches it, a flat cone does not. Where it would dip into it, what the flat
      /// part lies on would be penetrated.
      void touch_flat_part(Quadric &quadric, const PieceVertex &centre) const
      {
        const auto known = flat_normals.find(centre.vertex);
        if (known == flat_normals.end())
          return;
        const Tensor<1, 3> &nearest =
            *std::max_element(known->second.begin(), known->second.end(),
                              [&](const Tensor<1, 3> &one, const Tensor<1, 3> &other) {
                                return one * quadric.normal < other * quadric.normal;
                              });
        const Tensor<1, 3> turn  = nearest - (nearest * quadric.normal) * quadric.normal;
        const double       angle = turn.norm();
        double             width = 0.;
        for (const unsigned int t : centre.triangles)
          for (const unsigned int v : topology.triangles[t])
            width = std::max(width, std::abs((mesh.vertices[v] - mesh.vertices[centre.vertex]) * turn));
        if (nearest * quadric.normal >= std::cos(rule.touches_flat * numbers::PI / 180.) && angle > 0. &&
            angle * angle * angle * angle <= rule.of_the_turn * std::abs(quadric.along(turn)) * width)
          turn_frame(quadric, nearest);
      }

      bool fit_vertex(Quadric &quadric, const Pieces &pieces, const unsigned int p) const
      {
        const PieceVertex &centre = pieces.vertices[p];
        Tensor<1, 3>       mean;
        for (const unsigned int t : centre.triangles)
          {
            const unsigned int i = topology.local_corner(t, centre.vertex);
            const auto        &v = mesh.triangles[t];
            mean += corner_normal(mesh.vertices[v[i]], mesh.vertices[v[(i + 1) % 3]],
                                  mesh.vertices[v[(i + 2) % 3]]);
          }
        set_frame(quadric, mean.norm() > 0. ? mean : normals[centre.triangles[0]]);
        std::vector<unsigned int> near;
        std::vector<Tensor<1, 3>> points;
        // A corner of the surface may need one more ring.
        for (unsigned int n_rings = 2; n_rings <= 3; ++n_rings)
          {
            pieces.neighbours(near, p, n_rings);
            points.clear();
            for (const unsigned int q : near)
              if (const Tensor<1, 3> x =
                      mesh.vertices[pieces.vertices[q].vertex] - mesh.vertices[centre.vertex];
                  x.norm() > 0.)
                points.push_back(x);
            Quadric found = quadric;
            if (fit(found, points))
              {
                quadric = found;
                touch_flat_part(quadric, centre);
                return true;
              }
          }
        return false;
      }

      void finish(SmoothSurface::Patch &patch, const unsigned int t,
                  const std::array<const Quadric *, 3> &corners, const bool all_fitted) const
      {
        patch.is_flat = is_flat[t];
        for (unsigned int i = 0; i < 3; ++i)
          patch.normals[i] = patch.is_flat ? normals[t] : corners[i]->normal;
        if (patch.is_flat)
          return;
        double curvature = 0., longest = 0., residual = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            // Heights of the middle of an edge: from the normals at its ends and from either curvature.
            const Quadric     &a = *corners[i], &b = *corners[(i + 1) % 3];
            const Tensor<1, 3> edge =
                mesh.vertices[mesh.triangles[t][(i + 1) % 3]] - mesh.vertices[mesh.triangles[t][i]];
            const double by_normals = edge * (b.normal - a.normal) / 8., by_a = -a.along(edge) / 8.,
                         by_b = -b.along(edge) / 8.;
            patch.height      = std::max(patch.height, std::abs(by_normals));
            patch.doubt =
                std::max({patch.doubt, std::abs(by_a - by_b), std::abs(by_normals - .5 * (by_a + by_b))});
            curvature = std::max(curvature, std::abs(a.largest_curvature()));
            longest   = std::max(longest, edge.norm());
            residual  = std::max(residual, a.residual);
          }
        const double typical = curvature * longest * longest / 8.;
        patch.is_smooth      = all_fitted && residual <= rule.largest_residual &&
                          patch.doubt <= rule.largest_disagreement * typical;
        patch.doubt = std::max(patch.doubt, residual * typical);
        if (!all_fitted)
          patch.doubt = std::max(patch.doubt, patch.height);
      }

      const SurfaceMesh        &mesh;
      const SmoothingRule      &rule;
      const SurfaceTopology     topology;
      std::vector<Tensor<1, 3>> normals;
      const std::vector<bool>   is_crease;
      /// Edges that separate smooth pieces; triangles of flat parts.
      std::vector<bool> is_cut, is_flat;
      /// By vertex between flat and curved parts.
      std::map<unsigned int, std::vector<Tensor<1, 3>>> flat_normals;
    };
  } // namespace



  SmoothSurface::SmoothSurface(SurfaceMesh mesh, const std::vector<bool> &wanted, const SmoothingRule &rule)
    : surface(std::move(mesh))
  {
    PatchMaker maker(surface, rule);
    maker.make(patches, wanted);
    is_crease = maker.creases();
  }



  Tensor<1, 3> SmoothSurface::offset(const unsigned int triangle, const std::array<double, 3> &weights) const
  {
    const Patch &p = patches[triangle];
    if (p.is_flat)
      return Tensor<1, 3>();
    const auto  &corners = surface.triangles[triangle];
    Tensor<1, 3> x, normal;
    for (unsigned int a = 0; a < 3; ++a)
      {
        x += weights[a] * surface.vertices[corners[a]];
        normal += weights[a] * p.normals[a];
      }
    double height = 0.;
    for (unsigned int a = 0; a < 3; ++a)
      height += .5 * weights[a] * ((surface.vertices[corners[a]] - x) * p.normals[a]);
    const double length = normal.norm();
    return length > 0. ? 2. * height / (length * (1. + length)) * normal : Tensor<1, 3>();
  }
} // namespace Signorini
