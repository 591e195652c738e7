// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/mesh/surface_creases.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/face_seats.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Angles in degrees, between one side and the other one, turned over.
    struct SeatRule
    {
      /// The seat of a face is what of it lies along the other side best, this share; flanks lie away by this
      /// many times the angle of the seat. Under balls and rollers angles grow with the distance: wherever a
      /// face lies, none of it is farther away than that. (With a share of .3 a contact of gears was smaller
      /// by a tenth.)
      double share = .5, ratio = 4.;
      /// Of true surfaces that lie along each other exactly a smaller share will do. (With .01 to .15 nodes
      /// of a refined plate under a turned block moved two to five times as far as under the sole alone, with
      /// .3 by 5 % more. Of the seat of a spherical washer a twentieth was lost at its rim with .5, with .3 a
      /// sixtieth.) Times the ratio it is more than one: where angles grow with the distance nothing is a
      /// flank.
      double share_of_fits = .3;
      /// Angles below are no angles.
      double rounding = .25;
      /// Flanks lie away by at least this where their true shape is not known: facets of round surfaces do,
      /// too.
      double facets = 20.;
      /// Of a face as a whole: its cells that count lie along up to the angle of this share of them, away
      /// from that share on.
      double along = .9, away = .5;
      /// Least part of a node's function that is covered without the flanks (as DroppingRule).
      double least_cover = .15;
    };

    /// How the two sides lie to each other over one cell of the overlay.
    struct CellLie
    {
      /// Largest angle over the cell (degrees).
      double angle;
      /// The same; nothing where facets of a round surface might lie so, too.
      double away;
      /// Absolute value.
      double area;
      /// Along the normal of the nonmortar facet, at the centre (length).
      double gap;
      /// Whether a known true surface lies along a known one there.
      bool is_fit;
    };

    /// By triangle, whether a surface is known to be a plane there, or to end at one.
    class KnownPlanes
    {
    public:
      explicit KnownPlanes(const ContactSurface &surface)
        : surface(surface)
      {
        for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
          normals.push_back(facet_normal(surface, t));
        find_flat_vertices();
      }

      bool has(const unsigned int triangle)
      {
        const auto &corners     = surface.mesh.triangles[triangle];
        const auto  n_at_planes = std::count_if(corners.begin(), corners.end(),
                                                [&](const unsigned int v) { return is_at_plane[v]; });
        if (n_at_planes >= 2)
          return true;
        if (in_flat_piece.empty())
          find_flat_pieces();
        return in_flat_piece[triangle];
      }

    private:
      bool are_parallel(const unsigned int one, const unsigned int other) const
      {
        // Mesh files have few digits; a fourth of what SeatRule takes for an angle.
        constexpr double rounding = 1e-3;
        return (normals[one] - normals[other]).norm() <= rounding;
      }

      /// All triangles around such a vertex lie in a plane, and surround it: its neighbours follow and
      /// precede each other (sums of mixed numbers cancel; to build the topology of a large surface takes
      /// longer than all else here). Strips of facets around a roller have none. Other vertices of these
      /// triangles lie at the plane.
      void find_flat_vertices()
      {
        const std::size_t          n = surface.mesh.vertices.size();
        std::vector<unsigned int>  first(n, SurfaceTopology::none);
        std::vector<std::uint64_t> open(n, 0);
        std::vector<bool>          is_flat(n, true);
        const auto                 mixed = [](std::uint64_t v) {
          v = (v + 1) * 0x9e3779b97f4a7c15ULL;
          return v ^ v >> 29;
        };
        for (unsigned int t = 0; t < normals.size(); ++t)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto        &c = surface.mesh.triangles[t];
              const unsigned int v = c[i];
              open[v] += mixed(c[(i + 1) % 3]) - mixed(c[(i + 2) % 3]);
              if (first[v] == SurfaceTopology::none)
                first[v] = t;
              is_flat[v] = is_flat[v] && are_parallel(first[v], t);
            }
        is_at_plane.assign(n, false);
        for (const auto &corners : surface.mesh.triangles)
          if (std::any_of(corners.begin(), corners.end(),
                          [&](const unsigned int v) { return is_flat[v] && open[v] == 0; }))
            for (const unsigned int v : corners)
              is_at_plane[v] = true;
      }

      /// Between creases.
      void find_flat_pieces()
      {
        const SurfaceTopology   topology(surface.mesh.triangles, surface.mesh.vertices.size());
        const std::vector<bool> is_crease = creases_of(surface, topology);
        DisjointSets            pieces(normals.size());
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!topology.is_border(e) && !is_crease[e])
            pieces.unite(topology.edge_triangles[e][0], topology.edge_triangles[e][1]);
        std::vector<bool> is_flat(normals.size(), true);
        for (unsigned int t = 0; t < normals.size(); ++t)
          if (const auto piece = static_cast<unsigned int>(pieces.find(t)); !are_parallel(piece, t))
            is_flat[piece] = false;
        for (unsigned int t = 0; t < normals.size(); ++t)
          in_flat_piece.push_back(is_flat[pieces.find(t)]);
      }

      const ContactSurface &surface;
      std::vector<Vector3>  normals;
      /// By vertex; by triangle, made when first asked for.
      std::vector<bool> is_at_plane, in_flat_piece;
    };

    /// Normals of the true surface, linear on triangles. What is known of a triangle is worked out once.
    class TrueNormals
    {
    public:
      explicit TrueNormals(const ContactSurface &surface)
        : surface(surface)
      {
      }

      /// Whether they are more than those of a facet of an unknown surface.
      bool is_known(const unsigned int triangle)
      {
        return is_curved(triangle) || is_plane(triangle);
      }

      /// Whether a triangle is one of a plane, or ends at one, as far as is known.
      bool is_plane(const unsigned int triangle)
      {
        const auto [entry, is_new] = in_plane.try_emplace(triangle, false);
        if (is_new)
          entry->second = !is_curved(triangle) && is_at_plane(triangle);
        return entry->second;
      }

      Vector3 operator()(const unsigned int triangle, const std::array<double, 3> &weights)
      {
        const auto [entry, is_new] = known.try_emplace(triangle);
        if (is_new)
          entry->second = corner_normals(triangle);
        Vector3 sum;
        for (unsigned int i = 0; i < 3; ++i)
          sum += weights[i] * entry->second[i];
        const double norm = sum.norm();
        return norm > 0. ? sum / norm : sum;
      }

    private:
      bool is_curved(const unsigned int triangle) const
      {
        constexpr std::array<double, 3> centre   = {{1. / 3., 1. / 3., 1. / 3.}};
        constexpr double                rounding = 1e-6;
        return surface.offset(triangle, centre).norm_square() >
               rounding * rounding * triangle_area(surface.mesh, triangle);
      }

      bool is_at_plane(const unsigned int triangle)
      {
        if (!planes)
          planes.emplace(surface);
        return planes->has(triangle);
      }

      std::array<Vector3, 3> corner_normals(const unsigned int triangle) const
      {
        const Vector3          facet  = facet_normal(surface, triangle);
        std::array<Vector3, 3> result = {{facet, facet, facet}};
        if (is_curved(triangle))
          for (unsigned int i = 0; i < 3; ++i)
            result[i] = true_normal(surface, triangle, i);
        return result;
      }

      const ContactSurface &surface;
      /// Made when first asked for.
      std::optional<KnownPlanes>                               planes;
      std::unordered_map<unsigned int, std::array<Vector3, 3>> known;
      std::unordered_map<unsigned int, bool>                   in_plane;
    };

    class CellLies
    {
    public:
      CellLies(const ContactSurface &nonmortar, const ContactSurface &mortar)
        : nonmortar(nonmortar)
        , mortar(mortar)
        , nonmortar_normals(nonmortar)
        , mortar_normals(mortar)
      {
      }

      CellLie operator()(const OverlayTriangle &cell) const
      {
        constexpr std::array<double, 3> centre = {{1. / 3., 1. / 3., 1. / 3.}};
        CellLie                         result;
        result.angle = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          result.angle = std::max(result.angle, angle(cell, cell.nonmortar[i], cell.mortar[i]));
        const auto     at_centre = compose(cell.mortar, centre);
        const Point<3> x = evaluate(nonmortar.mesh, cell.nonmortar_triangle, compose(cell.nonmortar, centre)),
                       y = evaluate(mortar.mesh, cell.mortar_triangle, at_centre);
        result.area      = std::abs(cell.share()) * triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
        result.gap       = (y - x) * facet_normal(nonmortar, cell.nonmortar_triangle);
        const bool is_parallel = result.angle <= SeatRule().rounding;
        const bool is_known =
            result.angle > SeatRule().facets || (nonmortar_normals.is_known(cell.nonmortar_triangle) &&
                                                 mortar_normals.is_known(cell.mortar_triangle));
        result.away   = is_known && !is_parallel ? result.angle : 0.;
        result.is_fit = is_known && is_parallel;
        return result;
      }

    private:
      double angle(const OverlayTriangle &cell, const std::array<double, 3> &at_x,
                   const std::array<double, 3> &at_image) const
      {
        const Vector3 n   = nonmortar_normals(cell.nonmortar_triangle, at_x),
                      m   = mortar_normals(cell.mortar_triangle, at_image);
        const double sine = std::min(1., cross_product_3d(n, m).norm());
        return n * m < 0. ? std::asin(sine) * 180. / numbers::PI : 90.;
      }

      const ContactSurface &nonmortar, &mortar;
      mutable TrueNormals   nonmortar_normals, mortar_normals;
    };

    /// The angle up to which a share of the area of cells lies.
    double quantile(const std::vector<CellLie> &cells, const double share, double CellLie::*const angle_of)
    {
      std::vector<std::pair<double, double>> angles;
      double                                 area = 0.;
      for (const CellLie &cell : cells)
        {
          angles.emplace_back(cell.*angle_of, cell.area);
          area += cell.area;
        }
      std::sort(angles.begin(), angles.end());
      constexpr double rounding = 1e-6;
      double           sum      = 0.;
      for (const auto &[angle, part] : angles)
        if (sum += part; sum >= (share - rounding) * area)
          return angle;
      return angles.empty() ? 0. : angles.back().first;
    }

    double angle_of_seat(const std::vector<CellLie> &cells)
    {
      const SeatRule rule;
      double         fits = 0., area = 0.;
      for (const CellLie &cell : cells)
        {
          area += cell.area;
          fits += cell.is_fit ? cell.area : 0.;
        }
      return fits > rule.share_of_fits * area
                 ? rule.rounding
                 : std::max(rule.rounding, quantile(cells, rule.share, &CellLie::angle));
    }

    /// Appends the cells of one face that count.
    FaceLie add_cells(std::vector<OverlayTriangle> &result, const CellLies &lie_of,
                      const OverlayTriangle *const begin, const OverlayTriangle *const end)
    {
      const SeatRule       rule;
      std::vector<CellLie> lies, kept;
      std::transform(begin, end, std::back_inserter(lies), lie_of);
      const double seat = angle_of_seat(lies);
      double       area = 0., gap = 0.;
      for (const CellLie &cell : lies)
        if (cell.angle <= seat)
          {
            area += cell.area;
            gap += cell.area * cell.gap;
          }
      for (std::size_t i = 0; i < lies.size(); ++i)
        if (!(lies[i].away > rule.ratio * seat && lies[i].gap * area > gap))
          {
            result.push_back(begin[i]);
            kept.push_back(lies[i]);
          }
      return {std::max(rule.rounding, quantile(kept, rule.along, &CellLie::angle)),
              quantile(kept, rule.away, &CellLie::away)};
    }

    /// What lies over some of the faces around a vertex.
    struct Cover
    {
      /// Integrals of the node's function over the faces, over their covered parts (area), and there times
      /// the gap along its normal (area * length).
      double full = 0., covered = 0., gap = 0.;

      void add(const ContactSurface &surface, const FaceMoments &m, const unsigned int corner)
      {
        full += m.full[corner];
        gap += m.gap[corner] * surface.mesh.vertex_normals[surface.faces[m.face].corners[corner]];
        for (unsigned int b = 0; b < 4; ++b)
          covered += m.mass[4 * corner + b];
      }
    };
  } // namespace



  SeatedOverlay without_flanks(const ContactSurface &nonmortar, const ContactSurface &mortar,
                               const std::vector<OverlayTriangle> &overlay)
  {
    SeatedOverlay  result;
    const CellLies lie_of(nonmortar, mortar);
    result.lies.resize(nonmortar.faces.size());
    const auto face_of = [&](const std::size_t cell) {
      return nonmortar.triangle_face[overlay[cell].nonmortar_triangle];
    };
    for (std::size_t first = 0, last = 0; first < overlay.size(); first = last)
      {
        while (last < overlay.size() && face_of(last) == face_of(first))
          ++last;
        result.lies[face_of(first)] =
            add_cells(result.overlay, lie_of, overlay.data() + first, overlay.data() + last);
      }
    return result;
  }



  void leave_flanks(ContactSurface &nonmortar, const SurfaceHalo &halo,
                    const std::vector<FaceMoments> &moments)
  {
    const SeatRule rule;
    const auto     for_corners = [&](const auto &visit) {
      for (const FaceMoments &m : moments)
        if (m.covered > 0.)
          for (unsigned int a = 0; a < nonmortar.faces[m.face].n_corners; ++a)
            visit(m, a, nonmortar.faces[m.face].corners[a]);
    };
    std::vector<double> along(nonmortar.vertex_node.size(), std::numeric_limits<double>::infinity());
    for_corners([&](const FaceMoments &m, const unsigned int, const unsigned int v) {
      along[v] = std::min(along[v], m.lie.along);
    });
    halo.update(along);
    // What hangs belongs to its parents: of a refined flank beside a coarse seat.
    std::vector<bool> follows(along.size(), false);
    for (unsigned int v = 0; v < along.size(); ++v)
      if (!nonmortar.hanging[v].empty())
        {
          double of_parents = std::numeric_limits<double>::infinity();
          for (const auto &parent : nonmortar.hanging[v])
            of_parents = std::min(of_parents, along[parent.first]);
          follows[v] = of_parents < along[v];
          along[v]   = std::min(along[v], of_parents);
        }
    std::vector<Cover> seats(nonmortar.vertex_node.size());
    for_corners([&](const FaceMoments &m, const unsigned int a, const unsigned int v) {
      if (m.lie.along < rule.ratio * along[v] && !nonmortar.faces[m.face].leaves(a))
        seats[v].add(nonmortar, m, a);
    });
    halo.update(seats);
    for_corners([&](const FaceMoments &m, const unsigned int a, const unsigned int v) {
      if (!(m.lie.away > rule.ratio * along[v]))
        return;
      Cover flank;
      flank.add(nonmortar, m, a);
      if (follows[v] || (seats[v].covered > rule.least_cover * seats[v].full &&
                         flank.gap * seats[v].covered > seats[v].gap * flank.covered))
        {
          ContactSurface::Face &face = nonmortar.faces[m.face];
          face.left_corners |= static_cast<unsigned char>(1u << a);
          face.flank_corners |= static_cast<unsigned char>(1u << a);
        }
    });
  }
} // namespace Signorini
