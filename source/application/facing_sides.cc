// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/facing_sides.h>
#include <signorini/application/journal.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/mesh/way_out.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/surface_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    void keep_whole(ContactSide &side)
    {
      if (!side.whole)
        side.whole = std::make_shared<const SurfaceMesh>(side.surface.mesh);
    }

    /// What the sides of a pair see of each other.
    struct PairSight
    {
      /// Both must outlive the object.
      PairSight(const PairModel &pair, std::vector<ContactSide> &sides)
        : pair(pair)
        , sides(sides)
        , n_left(sides.size(), 0)
      {
        for (const ContactSide &side : sides)
          parts.emplace_back(side.surface, side.boundary());
      }

      const PairModel          &pair;
      std::vector<ContactSide> &sides;
      std::vector<FacingParts>  parts;
      /// By side: how many faces are left to other pairs.
      std::vector<std::size_t> n_left;

      bool leaves_parts() const
      {
        return std::any_of(n_left.begin(), n_left.end(), [](const std::size_t n) { return n > 0; });
      }

      /// Tied surfaces are as one, and with a prescribed gap they need not lie where they touch.
      bool may_leave_parts() const
      {
        return has_sharp_edges() && !pair.is_tied() && !pair.definition.prescribed_gap;
      }

      bool has_sharp_edges() const
      {
        return std::any_of(parts.begin(), parts.end(), [](const FacingParts &p) { return p.n_pieces() > 1; });
      }

      bool shares_body(const PairSight &other) const
      {
        return std::any_of(sides.begin(), sides.end(), [&](const ContactSide &one) {
          return std::any_of(other.sides.begin(), other.sides.end(),
                             [&](const ContactSide &two) { return one.body == two.body; });
        });
      }

      bool sees_anything() const
      {
        bool result = false;
        for_faces([&](const unsigned int, const unsigned int) { result = true; });
        return result;
      }

      void look(const MPI_Comm communicator)
      {
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
      }

      /// Calls f(side, face) for the faces that face anything.
      template <typename F>
      void for_faces(const F &f) const
      {
        for (unsigned int s = 0; s < sides.size(); ++s)
          for (unsigned int face = 0; face < sides[s].surface.faces.size(); ++face)
            if (std::isfinite(parts[s].distance(face)))
              f(s, face);
      }
    };

    /// Marks parts that lie far from the other side, but nearer to that of another pair.
    void leave_parts_to_nearer_pairs(std::vector<PairSight> &sights)
    {
      std::map<FaceName, double> nearest;
      for (const PairSight &sight : sights)
        sight.for_faces([&](const unsigned int s, const unsigned int face) {
          const double distance = sight.pair.is_tied() ? 0. : sight.parts[s].distance(face);
          const auto   entry    = nearest.emplace(name_of(sight.sides[s].surface, face), distance).first;
          entry->second         = std::min(entry->second, distance);
        });
      for (PairSight &sight : sights)
        if (sight.may_leave_parts())
          {
            std::vector<std::vector<bool>> lost;
            for (const ContactSide &side : sight.sides)
              lost.emplace_back(side.surface.faces.size(), false);
            sight.for_faces([&](const unsigned int s, const unsigned int face) {
              lost[s][face] =
                  sight.parts[s].is_far(face) &&
                  nearest.at(name_of(sight.sides[s].surface, face)) < sight.parts[s].distance(face);
            });
            for (unsigned int s = 0; s < lost.size(); ++s)
              sight.n_left[s] = sight.parts[s].leave(lost[s]);
          }
    }

    /// The sides without the parts that are marked or face nothing, by side.
    std::vector<ContactSide> facing_parts(const PairSight &sight)
    {
      std::vector<ContactSide> result = sight.sides;
      for (unsigned int s = 0; s < result.size(); ++s)
        if (ContactSide &side = result[s]; sight.parts[s].leaves_out_anything())
          {
            keep_whole(side);
            side.surface =
                without_blind_parts(std::move(side.surface), sight.parts[s], sight.pair.sides[s].shapes);
          }
      return result;
    }

    /// What is left out of all pairs, for one note of each reason.
    class LeftOutFaces
    {
    public:
      /// @param rest what of it is left, with what is left out then, or null
      void add_blind(const PairSight &sight, const PairSight *const rest = nullptr)
      {
        std::vector<std::size_t> n_blind;
        for (unsigned int s = 0; s < sight.parts.size(); ++s)
          n_blind.push_back(sight.parts[s].n_blind() + (rest != nullptr ? rest->parts[s].n_blind() : 0));
        add(blind, sight, n_blind);
      }

      void add_nearer(const PairSight &sight)
      {
        add(nearer, sight, sight.n_left);
      }

      void note(Journal &journal) const
      {
        const auto write = [&](const std::vector<std::string> &list, const std::string &which) {
          if (!list.empty())
            journal.note("faces beyond edges that " + which +
                         " are left out: " + Patterns::Tools::to_string(list) + ".");
        };
        write(blind, "face nothing of the other side");
        write(nearer, "lie nearer to the other side of another pair");
      }

    private:
      /// @param n_faces of each side
      static void add(std::vector<std::string> &list, const PairSight &sight,
                      const std::vector<std::size_t> &n_faces)
      {
        std::string numbers;
        for (unsigned int s = 0; s < n_faces.size(); ++s)
          numbers += (s == 0 ? " " : " and ") + std::to_string(n_faces[s]) + " of " +
                     std::to_string(sight.sides[s].surface.faces.size());
        if (std::any_of(n_faces.begin(), n_faces.end(), [](const std::size_t n) { return n > 0; }))
          list.push_back("pair " + sight.pair.definition.name + numbers);
      }

      std::vector<std::string> blind, nearer;
    };

    void take_facing_parts(PairSight &sight, LeftOutFaces &left_out)
    {
      left_out.add_blind(sight);
      sight.sides = facing_parts(sight);
    }

    /// Collective. Takes what is left of a pair that leaves parts to others; all of it, if the rest does not
    /// face each other.
    void take_rest(PairSight &sight, const MPI_Comm communicator, LeftOutFaces &left_out)
    {
      std::vector<ContactSide> rest = facing_parts(sight);
      PairSight                again(sight.pair, rest);
      again.look(communicator);
      if (again.sees_anything())
        {
          left_out.add_blind(sight, &again);
          left_out.add_nearer(sight);
          sight.sides = facing_parts(again);
          return;
        }
      PairSight whole(sight.pair, sight.sides);
      whole.look(communicator);
      take_facing_parts(whole, left_out);
    }
  } // namespace



  void leave_out_blind_parts(std::vector<std::vector<ContactSide>> &sides,
                             const std::vector<PairModel> &pairs, const MPI_Comm communicator,
                             Journal &journal)
  {
    std::vector<PairSight> all, sights;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      all.emplace_back(pairs[p], sides[p]);
    for (const PairSight &sight : all)
      if (std::any_of(all.begin(), all.end(), [&](const PairSight &other) {
            return other.has_sharp_edges() && sight.shares_body(other);
          }))
        sights.push_back(sight);
    for (PairSight &sight : sights)
      sight.look(communicator);
    if (sights.size() > 1)
      leave_parts_to_nearer_pairs(sights);
    LeftOutFaces left_out;
    for (PairSight &sight : sights)
      if (sight.leaves_parts())
        take_rest(sight, communicator, left_out);
      else if (sight.has_sharp_edges())
        take_facing_parts(sight, left_out);
    left_out.note(journal);
  }



  namespace
  {
    /// Calls f(polygon, x, y, width, area) for the cells of the overlay on this rank: their centre, its
    /// image, the width of the nonmortar triangle (lengths), and the area of the cell.
    template <typename F>
    void for_cells(const ContactPair &pair, const F &f)
    {
      const ContactSurface        &non = pair.nonmortar.surface;
      const SurfaceMesh           &mor = pair.mortar.surface.mesh;
      std::vector<OverlayTriangle> cells;
      for (std::size_t i = 0; i < pair.mapping->n_polygons(); ++i)
        {
          const unsigned int t    = pair.mapping->polygon_triangles[i].first;
          const double       area = triangle_area(non.mesh, t);
          cells.clear();
          pair.mapping->triangulate(cells, i);
          for (const OverlayTriangle &cell : cells)
            {
              constexpr std::array<double, 3> centre = {{1. / 3., 1. / 3., 1. / 3.}};
              f(i, evaluate(non.mesh, t, compose(cell.nonmortar, centre)),
                evaluate(mor, cell.mortar_triangle, compose(cell.mortar, centre)), std::sqrt(area),
                std::abs(cell.share()) * area);
            }
        }
    }

    /// Whether the image of a place lies behind it by more than the face is wide.
    bool is_far_behind(const ContactPair &pair, const std::size_t polygon, const Point<3> &x,
                       const Point<3> &y, const double width)
    {
      const unsigned int t = pair.mapping->polygon_triangles[polygon].first;
      return (y - x) * facet_normal(pair.nonmortar.surface, t) <= -width;
    }

    /// Collective.
    bool has_images_far_behind(const ContactPair &pair, const MPI_Comm communicator)
    {
      bool any = false;
      for_cells(pair, [&](const std::size_t i, const Point<3> &x, const Point<3> &y, const double width,
                          const double) { any = any || is_far_behind(pair, i, x, y, width); });
      return Utilities::MPI::max(static_cast<int>(any), communicator) > 0;
    }

    /// What of a mapping has its image behind the nonmortar body.
    struct ImagesBehind
    {
      /// By polygon of this rank; and by face, the areas that are covered, and that so.
      std::vector<bool>   polygons;
      std::vector<double> covered, behind;

      ImagesBehind(const ContactPair &pair, const WayOut &way_out)
        : covered(pair.nonmortar.surface.faces.size(), 0.)
        , behind(covered)
      {
        std::vector<double> of_polygon(pair.mapping->n_polygons(), 0.), behind_of_polygon(of_polygon);
        for_cells(pair, [&](const std::size_t i, const Point<3> &x, const Point<3> &y, const double width,
                            const double area) {
          of_polygon[i] += area;
          if (is_far_behind(pair, i, x, y, width) && way_out.leads_from(x, y, width))
            behind_of_polygon[i] += area;
        });
        for (std::size_t i = 0; i < of_polygon.size(); ++i)
          {
            const unsigned int f =
                pair.nonmortar.surface.triangle_face[pair.mapping->polygon_triangles[i].first];
            covered[f] += of_polygon[i];
            behind[f] += behind_of_polygon[i];
            polygons.push_back(behind_of_polygon[i] > .5 * of_polygon[i]);
          }
      }

      /// Collective. The faces of which that is most, of all ranks; empty if there are none, or nothing else.
      std::vector<bool> faces(const MPI_Comm communicator) const
      {
        std::vector<unsigned int> mine;
        bool                      others = false;
        for (unsigned int f = 0; f < covered.size(); ++f)
          if (behind[f] > .5 * covered[f])
            mine.push_back(f);
          else
            others = others || covered[f] > 0.;
        const auto list = gather_lists(std::move(mine), communicator, Receivers::all);
        if (list.empty() || Utilities::MPI::max(static_cast<int>(others), communicator) == 0)
          return {};
        std::vector<bool> result(covered.size(), false);
        for (const unsigned int f : list)
          result[f] = true;
        return result;
      }

      /// Collective. Whether there is more than such polygons, on any rank.
      bool leave_anything(const MPI_Comm communicator) const
      {
        const bool mine = std::find(polygons.begin(), polygons.end(), false) != polygons.end();
        return Utilities::MPI::max(static_cast<int>(mine), communicator) > 0;
      }
    };

    void leave_out(ContactSide &side, const std::vector<bool> &faces)
    {
      std::vector<bool> kept = faces;
      kept.flip();
      side.surface =
          cut_out(side.surface, SurfacePiece(side.surface, kept,
                                             std::vector<bool>(side.surface.mesh.vertices.size(), false)));
      side.surface.origin.reset();
    }
  } // namespace



  void leave_out_images_behind(ContactPair &pair, const std::function<std::shared_ptr<ContactMapping>()> &map,
                               const std::function<SurfaceMesh()> &boundary_of_body,
                               const MPI_Comm                      communicator)
  {
    std::shared_ptr<ContactMapping> mapping = map();
    pair.mapping                            = mapping;
    pair.nonmortar.whole.reset();
    pair.mortar.whole.reset();
    if (!has_images_far_behind(pair, communicator))
      return;
    const SurfaceMesh boundary = boundary_of_body();
    const WayOut      way_out(boundary);
    ImagesBehind      images(pair, way_out);
    if (const std::vector<bool> faces = images.faces(communicator); !faces.empty())
      {
        pair.n_images_behind = std::count(faces.begin(), faces.end(), true);
        leave_out(pair.nonmortar, faces);
        mapping      = map();
        pair.mapping = mapping;
        images       = ImagesBehind(pair, way_out);
      }
    if (images.leave_anything(communicator) &&
        std::find(images.polygons.begin(), images.polygons.end(), true) != images.polygons.end())
      mapping->leave_out(images.polygons);
  }
} // namespace Signorini
