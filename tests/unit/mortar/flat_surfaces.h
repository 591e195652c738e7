// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_mortar_flat_surfaces_h
#define signorini_tests_mortar_flat_surfaces_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/pair_coupling.h>
#include <signorini/surface/overlay.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

/// Surfaces over the plane, their overlay by polygon clipping, and integrals computed independently of the
/// library.
namespace FlatSurfaces
{
  using namespace Signorini;
  using dealii::Point;
  using dealii::Tensor;
  using P2 = std::array<double, 2>;

  struct Grid
  {
    unsigned int                                    nx = 1, ny = 1;
    double                                          x0 = 0., x1 = 1., y0 = 0., y1 = 1.;
    std::set<std::pair<unsigned int, unsigned int>> refined = {};
    /// Inner vertices move by up to half of this part of the cell size.
    double       distortion = 0.;
    double       rotation   = 0.;
    NodeIndex    first_node = 0;
    bool         faces_up   = true;
    unsigned int n_ranks    = 1;
  };

  inline double cross(const P2 &a, const P2 &b, const P2 &c)
  {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  inline P2 flat(const Point<3> &p)
  {
    return {{p[0], p[1]}};
  }

  /// Makes a surface from a grid. Nodes are numbered against the order of the vertices.
  class GridBuilder
  {
  public:
    ContactSurface build(const Grid &grid)
    {
      std::vector<std::array<P2, 4>> quads = make_quads(grid);
      for (const auto &quad : quads)
        {
          std::array<unsigned int, 4> corners;
          for (unsigned int a = 0; a < 4; ++a)
            corners[a] = vertex(quad[grid.faces_up ? a : (4 - a) % 4]);
          const auto rank = static_cast<unsigned int>(surface.faces.size() % grid.n_ranks);
          surface.faces.push_back({corners, rank, rank});
        }
      const std::size_t n = surface.mesh.vertices.size();
      surface.hanging.resize(n);
      surface.vertex_fixed.assign(n, 0);
      for (unsigned int v = 0; v < n; ++v)
        surface.vertex_node.push_back(grid.first_node + (n - 1 - v));
      surface.mesh.vertex_normals.assign(n, Point<3>(0., 0., grid.faces_up ? 1. : -1.));
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        triangulate(f);
      return surface;
    }

  private:
    std::vector<std::array<P2, 4>> make_quads(const Grid &g) const
    {
      std::mt19937                           random(7);
      std::uniform_real_distribution<double> move(-.5, .5);
      const double                           hx = (g.x1 - g.x0) / g.nx, hy = (g.y1 - g.y0) / g.ny;
      std::vector<std::vector<P2>>           p(g.nx + 1, std::vector<P2>(g.ny + 1));
      for (unsigned int i = 0; i <= g.nx; ++i)
        for (unsigned int j = 0; j <= g.ny; ++j)
          {
            P2 x = {{g.x0 + i * hx, g.y0 + j * hy}};
            if (i > 0 && i < g.nx && j > 0 && j < g.ny)
              {
                x[0] += g.distortion * hx * move(random);
                x[1] += g.distortion * hy * move(random);
              }
            const P2     c  = {{.5 * (g.x0 + g.x1), .5 * (g.y0 + g.y1)}};
            const double dx = x[0] - c[0], dy = x[1] - c[1], co = std::cos(g.rotation),
                         si = std::sin(g.rotation);
            p[i][j]         = g.rotation == 0. ? x : P2{{c[0] + co * dx - si * dy, c[1] + si * dx + co * dy}};
          }
      const auto mid = [](const P2 &a, const P2 &b) { return P2{{.5 * (a[0] + b[0]), .5 * (a[1] + b[1])}}; };
      std::vector<std::array<P2, 4>> quads;
      for (unsigned int i = 0; i < g.nx; ++i)
        for (unsigned int j = 0; j < g.ny; ++j)
          {
            const std::array<P2, 4> q = {{p[i][j], p[i + 1][j], p[i + 1][j + 1], p[i][j + 1]}};
            if (g.refined.count({i, j}) == 0)
              {
                quads.push_back(q);
                continue;
              }
            const P2 centre = mid(mid(q[0], q[1]), mid(q[2], q[3]));
            for (unsigned int k = 0; k < 4; ++k)
              quads.push_back({{q[k], mid(q[k], q[(k + 1) % 4]), centre, mid(q[(k + 3) % 4], q[k])}});
          }
      return quads;
    }

    unsigned int vertex(const P2 &x)
    {
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (std::abs(surface.mesh.vertices[v][0] - x[0]) + std::abs(surface.mesh.vertices[v][1] - x[1]) <
            1e-10)
          return v;
      surface.mesh.vertices.emplace_back(x[0], x[1], 0.);
      return static_cast<unsigned int>(surface.mesh.vertices.size() - 1);
    }

    /// Inserts hanging vertices into the polygon of a face and cuts it into triangles.
    void triangulate(const unsigned int f)
    {
      std::vector<unsigned int> polygon;
      const auto               &x       = surface.mesh.vertices;
      const auto               &corners = surface.faces[f].corners;
      for (unsigned int a = 0; a < 4; ++a)
        {
          const unsigned int v = surface.faces[f].corners[a], w = surface.faces[f].corners[(a + 1) % 4];
          polygon.push_back(v);
          for (unsigned int h = 0; h < x.size(); ++h)
            if (h != v && h != w && x[h].distance(Point<3>(.5 * (x[v] + x[w]))) < 1e-10)
              {
                polygon.push_back(h);
                surface.hanging[h] = {{v, .5}, {w, .5}};
              }
        }
      // A fan around a hanging vertex: it has no flat triangles.
      const auto centre = std::find_if(polygon.begin(), polygon.end(), [&](const unsigned int v) {
        return std::find(corners.begin(), corners.end(), v) == corners.end();
      });
      if (centre != polygon.end())
        std::rotate(polygon.begin(), centre, polygon.end());
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        {
          surface.mesh.triangles.push_back({{polygon[0], polygon[i], polygon[i + 1]}});
          surface.triangle_face.push_back(f);
        }
    }

    ContactSurface surface;
  };

  inline ContactSurface make_surface(const Grid &grid)
  {
    return GridBuilder().build(grid);
  }

  /// Vertices where a condition on the position holds.
  inline void fix(ContactSurface &surface, const std::function<bool(const Point<3> &)> &where,
                  const FixedDirections &mask = all_fixed)
  {
    for (unsigned int v = 0; v < surface.vertex_node.size(); ++v)
      if (where(surface.mesh.vertices[v]))
        surface.vertex_fixed[v] = mask;
  }

  using Polygon = std::vector<P2>;

  /// Sutherland-Hodgman; both counterclockwise and convex.
  inline Polygon clip(Polygon polygon, const Polygon &window)
  {
    for (std::size_t e = 0; e < window.size() && polygon.size() > 2; ++e)
      {
        const P2 &a = window[e], &b = window[(e + 1) % window.size()];
        Polygon   rest;
        for (std::size_t i = 0; i < polygon.size(); ++i)
          {
            const P2    &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const double sp = cross(a, b, p), sq = cross(a, b, q);
            if (sp >= 0.)
              rest.push_back(p);
            if ((sp > 0. && sq < 0.) || (sp < 0. && sq > 0.))
              rest.push_back(
                  {{p[0] + sp / (sp - sq) * (q[0] - p[0]), p[1] + sp / (sp - sq) * (q[1] - p[1])}});
          }
        polygon = std::move(rest);
      }
    return polygon;
  }

  inline Polygon triangle(const ContactSurface &surface, const unsigned int t)
  {
    Polygon p;
    for (const unsigned int v : surface.mesh.triangles[t])
      p.push_back(flat(surface.mesh.vertices[v]));
    if (cross(p[0], p[1], p[2]) < 0.)
      std::swap(p[1], p[2]);
    return p;
  }

  inline std::array<double, 3> barycentric(const ContactSurface &surface, const unsigned int t, const P2 &x)
  {
    const auto &v = surface.mesh.triangles[t];
    const P2    a = flat(surface.mesh.vertices[v[0]]), b = flat(surface.mesh.vertices[v[1]]),
             c        = flat(surface.mesh.vertices[v[2]]);
    const double area = cross(a, b, c), wb = cross(a, x, c) / area, wc = cross(a, b, x) / area;
    return {{1. - wb - wc, wb, wc}};
  }

  /// The overlay of two surfaces under the projection along z. Only triangles of faces of `rank` if given.
  inline std::vector<OverlayTriangle> make_overlay(const ContactSurface &non, const ContactSurface &mor,
                                                   const int rank = -1)
  {
    std::vector<OverlayTriangle> overlay;
    std::vector<Polygon>         windows;
    for (unsigned int m = 0; m < mor.mesh.triangles.size(); ++m)
      windows.push_back(triangle(mor, m));
    for (unsigned int t = 0; t < non.mesh.triangles.size(); ++t)
      {
        if (rank >= 0 && static_cast<int>(non.faces[non.triangle_face[t]].worker) != rank)
          continue;
        const Polygon own  = triangle(non, t);
        const double  size = cross(own[0], own[1], own[2]);
        for (unsigned int m = 0; m < mor.mesh.triangles.size(); ++m)
          {
            const Polygon p = clip(own, windows[m]);
            for (std::size_t i = 1; i + 1 < p.size(); ++i)
              if (cross(p[0], p[i], p[i + 1]) > 1e-15 * size)
                {
                  OverlayTriangle cell;
                  cell.nonmortar_triangle = t;
                  cell.mortar_triangle    = m;
                  const P2 *corners[3]    = {&p[0], &p[i], &p[i + 1]};
                  for (unsigned int c = 0; c < 3; ++c)
                    {
                      cell.nonmortar[c] = barycentric(non, t, *corners[c]);
                      cell.mortar[c]    = barycentric(mor, m, *corners[c]);
                    }
                  // Surfaces seen from below come clockwise.
                  if (cell.share() < 0.)
                    {
                      std::swap(cell.nonmortar[1], cell.nonmortar[2]);
                      std::swap(cell.mortar[1], cell.mortar[2]);
                    }
                  overlay.push_back(cell);
                }
          }
      }
    return overlay;
  }

  /// Bilinear functions of a face at a point of the plane, by Newton in the plane.
  inline std::array<double, 4> shape(const ContactSurface &surface, const unsigned int f, const P2 &x)
  {
    P2 v[4];
    for (unsigned int a = 0; a < 4; ++a)
      v[a] = flat(surface.mesh.vertices[surface.faces[f].corners[a]]);
    double                s = .5, t = .5;
    std::array<double, 4> n;
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        n = {{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}};
        double r[2], ds[2], dt[2];
        for (unsigned int c = 0; c < 2; ++c)
          {
            r[c]  = x[c] - n[0] * v[0][c] - n[1] * v[1][c] - n[2] * v[2][c] - n[3] * v[3][c];
            ds[c] = (1 - t) * (v[1][c] - v[0][c]) + t * (v[2][c] - v[3][c]);
            dt[c] = (1 - s) * (v[3][c] - v[0][c]) + s * (v[2][c] - v[1][c]);
          }
        const double det = ds[0] * dt[1] - ds[1] * dt[0];
        s += (dt[1] * r[0] - dt[0] * r[1]) / det;
        t += (-ds[1] * r[0] + ds[0] * r[1]) / det;
      }
    return {{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}};
  }

  /// Integrals of the condensed nodal functions of both sides over the covered part, by 12x12 points on each
  /// polygon's triangles.
  inline std::map<NodeIndex, double> covered_loads(const ContactSurface &non, const ContactSurface &mor)
  {
    static const dealii::QGauss<1> gauss(12);
    std::map<NodeIndex, double>    loads;
    const auto add = [&](const ContactSurface &surface, const unsigned int f, const P2 &x, const double w) {
      const auto phi = shape(surface, f, x);
      for (unsigned int a = 0; a < 4; ++a)
        {
          const unsigned int v = surface.faces[f].corners[a];
          if (surface.hanging[v].empty())
            loads[surface.vertex_node[v]] += w * phi[a];
          for (const auto &[parent, weight] : surface.hanging[v])
            loads[surface.vertex_node[parent]] += w * weight * phi[a];
        }
    };
    const auto polygon = [](const ContactSurface &surface, const unsigned int f) {
      Polygon p;
      for (const unsigned int v : surface.faces[f].corners)
        p.push_back(flat(surface.mesh.vertices[v]));
      if (cross(p[0], p[1], p[2]) < 0.)
        std::reverse(p.begin(), p.end());
      return p;
    };
    for (unsigned int f = 0; f < non.faces.size(); ++f)
      for (unsigned int g = 0; g < mor.faces.size(); ++g)
        {
          const Polygon p = clip(polygon(non, f), polygon(mor, g));
          for (std::size_t k = 1; k + 1 < p.size(); ++k)
            for (unsigned int i = 0; i < gauss.size(); ++i)
              for (unsigned int j = 0; j < gauss.size(); ++j)
                {
                  const double s = gauss.point(i)[0], t = gauss.point(j)[0] * (1. - s);
                  const double w = gauss.weight(i) * gauss.weight(j) * (1. - s) * cross(p[0], p[k], p[k + 1]);
                  const P2     x = {{(1 - s - t) * p[0][0] + s * p[k][0] + t * p[k + 1][0],
                                     (1 - s - t) * p[0][1] + s * p[k][1] + t * p[k + 1][1]}};
                  add(non, f, x, w);
                  add(mor, g, x, w);
                }
        }
    return loads;
  }

  /// Turns a surface about an axis that is no coordinate axis and moves it.
  inline void incline(ContactSurface &surface, const double scale = 1.)
  {
    const Tensor<1, 3> axis = Point<3>(1., 2., -.5) / Point<3>(1., 2., -.5).norm();
    const auto         turn = [&](const Tensor<1, 3> &v) {
      return std::cos(.7) * v + std::sin(.7) * cross_product_3d(axis, v) +
             (1. - std::cos(.7)) * (axis * v) * axis;
    };
    for (Point<3> &x : surface.mesh.vertices)
      x = Point<3>(scale * (turn(x) + Point<3>(.3, -.2, .5)));
    for (Tensor<1, 3> &n : surface.mesh.vertex_normals)
      n = turn(n);
  }
} // namespace FlatSurfaces

#endif
