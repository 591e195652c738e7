// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/facing_sides.h>
#include <signorini/application/journal.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/surface/box_tree.h>
#include <signorini/surface/normal_projection.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  void leave_out_blind_parts(std::vector<ContactSide> &sides, const PairModel &pair,
                             const MPI_Comm communicator, Journal &journal)
  {
    std::vector<FacingParts> parts;
    for (const ContactSide &side : sides)
      parts.emplace_back(side.surface);
    if (std::all_of(parts.begin(), parts.end(), [](const FacingParts &p) { return p.n_parts() == 1; }))
      return;
    const double size = sides[0].surface.extent();
    if (const auto &obstacle = pair.definition.obstacle)
      see(
          parts[0], sides[0].surface,
          [&](double &distance, const Point<3> &p, const Vector3 &n) {
            return obstacle->gap(distance, p, n, size) && obstacle->is_faced(p + distance * n, n, size);
          },
          communicator);
    else
      see_each_other(parts[0], sides[0].surface, parts[1], sides[1].surface, communicator);
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (parts[s].leaves_out_anything())
        {
          const std::size_t n_faces = sides[s].surface.faces.size();
          sides[s].surface          = without_blind_parts(sides[s].surface, parts[s], pair.sides[s].shapes);
          if (const std::size_t left = n_faces - sides[s].surface.faces.size(); left > 0)
            journal.note("pair " + pair.definition.name + ": " + std::to_string(left) + " of " +
                         std::to_string(n_faces) + " faces of \"" + sides[s].name +
                         "\" lie beyond sharp edges and face nothing of the other side: they are left out.");
        }
  }



  namespace
  {
    /// Whether segments leave the body of a whole surface.
    class WayOut
    {
    public:
      explicit WayOut(const ContactSurface &surface)
        : surface(surface)
        , tree(tree_of_triangles(surface.mesh))
      {
      }

      /// Whether the segment from x in a triangle to y goes out through another face, farther from x than
      /// half a width of the face.
      bool leads_from(const unsigned int triangle, const Point<3> &x, const Point<3> &y, const double width)
      {
        const double  length    = x.distance(y);
        const Vector3 direction = (y - x) / length;
        found.clear();
        tree.find_along_segment(found, x, y);
        return std::any_of(found.begin(), found.end(), [&](const unsigned int t) {
          if (surface.triangle_face[t] == surface.triangle_face[triangle])
            return false;
          const auto                   &c       = surface.mesh.triangles[t];
          const std::array<Point<3>, 3> corners = {
              {surface.mesh.vertices[c[0]], surface.mesh.vertices[c[1]], surface.mesh.vertices[c[2]]}};
          std::array<double, 3> weights;
          double                along;
          return cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]) * direction > 0. &&
                 NormalProjection::intersect_line(weights, along, x, direction, corners) &&
                 along > .5 * width && along < length &&
                 std::all_of(weights.begin(), weights.end(), [](const double w) { return w >= 0.; });
        });
      }

    private:
      const ContactSurface     &surface;
      const BoxTree             tree;
      std::vector<unsigned int> found;
    };

    /// Of each face the area that is covered and the part of it whose image lies behind the body, on this
    /// rank.
    struct CoveredFaces
    {
      std::vector<double> all, behind;

      explicit CoveredFaces(const ContactPair &pair)
        : all(pair.nonmortar.surface.faces.size(), 0.)
        , behind(all)
      {
        constexpr std::array<double, 3> centre = {{1. / 3., 1. / 3., 1. / 3.}};
        const ContactSurface           &non    = pair.nonmortar.surface;
        const SurfaceValues             on_nonmortar(non), on_mortar(pair.mortar.surface);
        std::optional<WayOut>           way;
        for (const OverlayTriangle &cell : pair.mapping->overlay())
          {
            const unsigned int t = cell.nonmortar_triangle, f = non.triangle_face[t];
            const double       whole = triangle_area(non.mesh, t), area = std::abs(cell.share()) * whole;
            const auto         weights = compose(cell.nonmortar, centre);
            const Point<3>     x       = on_nonmortar.point(t, weights),
                           y           = on_mortar.point(cell.mortar_triangle, compose(cell.mortar, centre));
            const double width         = std::sqrt(whole);
            all[f] += area;
            if ((y - x) * on_nonmortar.normal(t, weights) > -width)
              continue;
            if (!way)
              way.emplace(non);
            if (way->leads_from(t, x, y, width))
              behind[f] += area;
          }
      }
    };
  } // namespace



  std::vector<bool> faces_with_images_behind(const ContactPair &pair, const MPI_Comm communicator)
  {
    const CoveredFaces        covered(pair);
    std::vector<unsigned int> mine;
    bool                      others = false;
    for (unsigned int f = 0; f < covered.all.size(); ++f)
      if (covered.behind[f] > .5 * covered.all[f])
        mine.push_back(f);
      else
        others = others || covered.all[f] > 0.;
    const auto list = gather_lists(std::move(mine), communicator, Receivers::all);
    if (list.empty() || Utilities::MPI::max(static_cast<int>(others), communicator) == 0)
      return {};
    std::vector<bool> result(covered.all.size(), false);
    for (const unsigned int f : list)
      result[f] = true;
    return result;
  }



  void leave_out(ContactSurface &surface, const std::vector<bool> &faces)
  {
    std::vector<bool> kept = faces;
    kept.flip();
    surface =
        cut_out(surface, SurfacePiece(surface, kept, std::vector<bool>(surface.mesh.vertices.size(), false)));
    surface.origin.reset();
  }
} // namespace Signorini
