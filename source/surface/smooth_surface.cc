// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "smooth_pieces.h"
#include "vertex_fits.h"

#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/crease_edges.h>
#include <signorini/surface/smooth_surface.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 3> offset_of(const SmoothSurface::Patch &p, const SurfaceMesh &surface,
                           const unsigned int triangle, const std::array<double, 3> &weights,
                           const std::array<bool, 3> &is_straight = {{false, false, false}})
    {
      if (p.is_flat)
        return Tensor<1, 3>();
      const auto  &corners = surface.triangles[triangle];
      Tensor<1, 3> normal;
      for (unsigned int a = 0; a < 3; ++a)
        normal += weights[a] * p.normals[a];
      double height = is_straight[0] || is_straight[1] || is_straight[2]
                          ? 0.
                          : p.bubble * weights[0] * weights[1] * weights[2];
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int i = 1; i < 3; ++i)
          {
            const unsigned int b = (a + i) % 3;
            if (is_straight[i == 1 ? a : b])
              continue;
            height += .5 * weights[a] * weights[b] * (1. + weights[a] - weights[b]) *
                      ((surface.vertices[corners[a]] - surface.vertices[corners[b]]) * p.normals[a]);
          }
      const double length = normal.norm();
      return length > 0. ? 2. * height / (length * (1. + length)) * normal : Tensor<1, 3>();
    }

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
        const SmoothPieces pieces(topology, is_cut);
        VertexFits         fits(mesh, pieces, rule);
        patches.resize(mesh.triangles.size());
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          if (wanted[t])
            {
              patches[t].is_flat = is_flat[t];
              patches[t].normals = {{normals[t], normals[t], normals[t]}};
              if (is_flat[t])
                continue;
              TriangleFit fit = fits.at_corners(t);
              for (unsigned int i = 0; i < 3; ++i)
                if (const unsigned int p = pieces.of_corner[3 * t + i];
                    flat_normals.count(pieces.vertices[p].vertex) > 0)
                  {
                    Quadric at_vertex = fits.at_vertex(p);
                    touch_flat_part(at_vertex, pieces.vertices[p]);
                    turn_frame(fit.corners[i], at_vertex.normal);
                  }
              finish(patches[t], t, fit, fits.arc_of(t));
            }
        find_ends(patches, wanted);
      }

    private:
      /// A vertex whose surroundings lie in one plane makes its triangles flat: those around an inner one,
      /// all of two rings at a border (one cell of a cylinder alone is as flat as a strip along its axis).
      void cut_off_flat_parts()
      {
        const SmoothPieces        pieces(topology, is_cut);
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
        const Tensor<1, 3> turn     = nearest - (nearest * quadric.normal) * quadric.normal;
        const double       angle    = turn.norm();
        double             width    = 0.;
        double             steepest = 0.;
        for (const unsigned int t : centre.triangles)
          {
            steepest = std::max(steepest, (nearest - normals[t]).norm());
            for (const unsigned int v : topology.triangles[t])
              width = std::max(width, std::abs((mesh.vertices[v] - mesh.vertices[centre.vertex]) * turn));
          }
        const bool is_small =
            nearest * quadric.normal >= std::cos(rule.touches_flat * numbers::PI / 180.) &&
            angle * angle * angle * angle <= rule.of_the_turn * std::abs(quadric.along(turn)) * width;
        const bool is_less = angle <= std::sin(rule.largest_touch * numbers::PI / 180.) &&
                             angle <= rule.of_the_facets * steepest;
        if (angle > 0. && (is_small || is_less))
          turn_frame(quadric, nearest);
      }

      /// Edges of believed patches beyond which facets are what is believed.
      void find_ends(std::vector<SmoothSurface::Patch> &patches, const std::vector<bool> &wanted) const
      {
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!is_cut[e])
            for (unsigned int side = 0; side < 2; ++side)
              {
                const unsigned int t     = topology.edge_triangles[e][side],
                                   other = topology.edge_triangles[e][1 - side];
                if (wanted[t] && wanted[other] && patches[t].is_smooth && !patches[other].is_smooth)
                  patches[t].ends_at_edge[topology.local_edge(t, e)] = true;
              }
      }

      /// @param arc what is known to be the true surface
      void finish(SmoothSurface::Patch &patch, const unsigned int t, const TriangleFit &fit,
                  const std::optional<PlacedArc> &arc) const
      {
        for (unsigned int i = 0; i < 3; ++i)
          patch.normals[i] = fit.corners[i].normal;
        patch.bubble     = bubble_of(t, fit);
        double curvature = 0., longest = 0., typical = 0., residual = 0., disagreement = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            // Heights of the middle of an edge: from the normals at its ends and from either curvature.
            const Quadric     &a = fit.corners[i], &b = fit.corners[(i + 1) % 3];
            const Tensor<1, 3> edge =
                mesh.vertices[mesh.triangles[t][(i + 1) % 3]] - mesh.vertices[mesh.triangles[t][i]];
            const double by_normals = edge * (b.normal - a.normal) / 8., by_a = -a.along(edge) / 8.,
                         by_b = -b.along(edge) / 8.;
            patch.height      = std::max(patch.height, std::abs(by_normals));
            disagreement =
                std::max({disagreement, std::abs(by_a - by_b), std::abs(by_normals - .5 * (by_a + by_b))});
            const double rise_a = -(edge * a.normal), rise_b = edge * b.normal;
            patch.doubt = std::max({patch.doubt, std::abs(by_a - .5 * rise_a + .25 * rise_b),
                                    std::abs(by_b - .5 * rise_b + .25 * rise_a)});
            // An edge along which the surface is straight has no height, however long it is.
            typical   = std::max({typical, a.magnitude_along(edge) / 8., b.magnitude_along(edge) / 8.});
            curvature = std::max(curvature, std::abs(a.largest_curvature()));
            longest   = std::max(longest, edge.norm());
            residual  = std::max(residual, a.residual);
          }
        // Curvatures at both ends of an edge differ on cones and tori.
        if (arc)
          patch.doubt = disagreement = distance_from(*arc, patch, t);
        // Where the curvature changes steadily the patch has it at both ends: the ends need not agree.
        if (patch.doubt <= rule.agrees * disagreement)
          disagreement = patch.doubt;
        patch.is_smooth = fit.is_complete && residual <= rule.largest_residual &&
                          std::max(disagreement, patch.doubt) <=
                              rule.largest_disagreement * curvature * longest * longest / 8.;
        patch.doubt = std::max(patch.doubt, residual * typical);
        if (!fit.is_complete)
          patch.doubt = std::max(patch.doubt, patch.height);
      }

      /// What the curvatures at the corners say of the middle, beside the normals there: a function of third
      /// degree that vanishes on the edges has none of these.
      double bubble_of(const unsigned int t, const TriangleFit &fit) const
      {
        double result = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
            const auto        &v    = mesh.triangles[t];
            const Tensor<1, 3> next = mesh.vertices[v[j]] - mesh.vertices[v[i]],
                               last = mesh.vertices[v[k]] - mesh.vertices[v[i]];
            result += fit.corners[i].form(next, last) +
                      .5 * (next * (fit.corners[j].normal - fit.corners[i].normal));
          }
        return result / 3.;
      }

      /// Of a patch, at its middle and those of its edges.
      double distance_from(const PlacedArc &arc, const SmoothSurface::Patch &patch,
                           const unsigned int t) const
      {
        constexpr std::array<std::array<double, 3>, 4> places = {
            {{{1. / 3., 1. / 3., 1. / 3.}}, {{0., .5, .5}}, {{.5, 0., .5}}, {{.5, .5, 0.}}}};
        double result = 0.;
        for (const auto &w : places)
          result =
              std::max(result, std::abs(arc.distance(evaluate(mesh, t, w) + offset_of(patch, mesh, t, w))));
        return result;
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
    return offset_of(patches[triangle], surface, triangle, weights);
  }



  Tensor<1, 3> SmoothSurface::believed_offset(const unsigned int           triangle,
                                              const std::array<double, 3> &weights) const
  {
    const Patch &p = patches[triangle];
    return p.is_smooth ? offset_of(p, surface, triangle, weights, p.ends_at_edge) : Tensor<1, 3>();
  }
} // namespace Signorini
