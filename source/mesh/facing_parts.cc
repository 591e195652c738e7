// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_creases.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/mesh/symmetry_planes.h>
#include <signorini/mesh/way_out.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct FacingRule
    {
      /// Normals of neighbours where parts end.
      double sharp_cosine = cosine_of_sharp_edges;
      /// Where a vertex has no normal of its own: from 40 degrees on. A hexagonal bar that lies in the corner
      /// of its hole presses on both flats with 1231 (statics); with nodes at the corners, which act along
      /// the mean of two walls, with 1181. An octagonal one with 1166, and 1146.
      double own_normal_cosine = .766;
      /// Of true normals at creases that are none of the true surface (a circle of eight edges).
      double smooth_cosine = .99;
      /// What of the way from the centre of a face to its corners is looked from.
      double toward_corners = .9;
      /// Distances that differ by less, in widths of the face, are one place: an edge between two triangles.
      double same_place = 1e-6;
      /// Sine of the angle by which a face sees another one in a groove.
      double groove = .3;
      /// In a groove, distances (in widths of a face) by how many times the least one, and from which on, are
      /// those of sides that do not touch: a bolt touches with its head, and has a clearance around its shank
      /// that is a part of a face.
      double alike = 2., touching = .01;
    };

    std::vector<Vector3> face_normals(const ContactSurface &surface)
    {
      std::vector<Vector3> normals;
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        {
          const Vector3 area = area_vector(surface, surface.faces[f]);
          normals.push_back(area.norm() > 0. ? area / area.norm() : area);
        }
      return normals;
    }

    double width_of(const ContactSurface &surface, const unsigned int face)
    {
      return std::sqrt(area_vector(surface, surface.faces[face]).norm());
    }

    Point<3> centre_of(const ContactSurface &surface, const ContactSurface::Face &face)
    {
      Point<3> centre;
      for (unsigned int a = 0; a < face.n_corners; ++a)
        centre += Vector3(surface.mesh.vertices[face.corners[a]]) / face.n_corners;
      return centre;
    }

    /// By member: its set, in the order of the first ones.
    std::vector<unsigned int> number_sets(DisjointSets &sets, const std::size_t size)
    {
      std::vector<unsigned int> number(size);
      unsigned int              next = 0;
      for (std::size_t i = 0; i < size; ++i)
        number[i] = sets.find(i) == i ? next++ : number[sets.find(i)];
      return number;
    }

    /// Whether the true surface goes on from a triangle to the next one without an edge.
    bool is_smooth(const ContactSurface &surface, const unsigned int one, const unsigned int other)
    {
      const auto &t = surface.mesh.triangles;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if (t[one][i] == t[other][j] &&
              true_normal(surface, one, i) * true_normal(surface, other, j) >= FacingRule().smooth_cosine)
            return true;
      return false;
    }

    /// Whether some of the faces around a vertex face others of them, of another part.
    bool is_groove(const ContactSurface &surface, const std::vector<unsigned int> &part_of,
                   const std::vector<unsigned int> &faces, const unsigned int vertex)
    {
      for (const unsigned int f : faces)
        for (const unsigned int g : faces)
          {
            if (part_of[f] == part_of[g])
              continue;
            const Vector3 normal = area_vector(surface, surface.faces[f]),
                          way    = centre_of(surface, surface.faces[g]) - surface.mesh.vertices[vertex];
            if (normal * way > FacingRule().groove * normal.norm() * way.norm())
              return true;
          }
      return false;
    }
  } // namespace



  FacingParts::FacingParts(const ContactSurface &surface, const SurfaceMesh &boundary)
    : surface(surface)
    , boundary(boundary)
    , seen(surface.faces.size(), infinite)
  {
    const std::vector<Vector3> normals = face_normals(surface);
    const SurfaceTopology      topology(surface.mesh.triangles, surface.mesh.vertices.size());
    const std::vector<bool>    is_crease = creases_of(surface, topology);
    DisjointSets               part_sets(surface.faces.size()), piece_sets(surface.faces.size());
    for (std::size_t e = 0; e < topology.edge_triangles.size(); ++e)
      if (const auto &[one, other] = topology.edge_triangles[e];
          one != SurfaceTopology::none && other != SurfaceTopology::none)
        {
          const unsigned int f = surface.triangle_face[one], g = surface.triangle_face[other];
          if (normals[f] * normals[g] < FacingRule().sharp_cosine)
            continue;
          part_sets.unite(f, g);
          if (!is_crease[e] || is_smooth(surface, one, other))
            piece_sets.unite(f, g);
        }
    part_of  = number_sets(part_sets, surface.faces.size());
    piece_of = number_sets(piece_sets, surface.faces.size());
    // Surfaces may be empty on a rank.
    const auto n_sets = [](const std::vector<unsigned int> &number) {
      return number.empty() ? 0 : 1 + *std::max_element(number.begin(), number.end());
    };
    parts.resize(n_sets(part_of));
    is_blind.assign(n_sets(piece_of), true);
  }



  bool fall_apart(const std::vector<Vector3> &normals, const double least_cosine)
  {
    DisjointSets sets = linked_normals(normals, least_cosine);
    for (unsigned int i = 1; i < normals.size(); ++i)
      if (sets.find(i) != sets.find(0))
        return true;
    return false;
  }



  std::vector<bool> vertices_on_sharp_edges(const ContactSurface &surface, const FaceFilter &counts)
  {
    // Few vertices have facets that differ as much from the first one.
    std::vector<Vector3>                         first(surface.mesh.vertices.size());
    std::map<unsigned int, std::vector<Vector3>> suspects;
    const auto                                   for_corners = [&](const auto &f) {
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          if (const unsigned int v = surface.mesh.triangles[t][i]; counts(surface.triangle_face[t], v))
            f(v, t, i);
    };
    for_corners([&](const unsigned int v, const unsigned int t, const unsigned int) {
      const Vector3 n = facet_normal(surface, t);
      if (first[v].norm() == 0.)
        first[v] = n;
      else if (n.norm() > 0. && n * first[v] < FacingRule().own_normal_cosine)
        suspects[v];
    });
    for_corners([&](const unsigned int v, const unsigned int t, const unsigned int i) {
      if (const auto it = suspects.find(v); it != suspects.end())
        if (const Vector3 n = true_normal(surface, t, i); n.norm() > 0.)
          it->second.push_back(n);
    });
    std::vector<bool> result(first.size(), false);
    for (const auto &[v, around] : suspects)
      result[v] = fall_apart(around, FacingRule().own_normal_cosine);
    return result;
  }



  bool FacingParts::is_far(const unsigned int face) const
  {
    return seen[face] > width_of(surface, face);
  }



  void FacingParts::finish(const MPI_Comm communicator)
  {
    Utilities::MPI::min(seen, communicator, seen);
    for (unsigned int f = 0; f < part_of.size(); ++f)
      {
        Part &part    = parts[part_of[f]];
        part.distance = std::min(part.distance, seen[f]);
        part.widths   = std::min(part.widths, seen[f] / width_of(surface, f));
        if (seen[f] < infinite)
          is_blind[piece_of[f]] = false;
      }
    if (std::none_of(parts.begin(), parts.end(), [](const Part &part) { return part.distance < infinite; }))
      {
        for (Part &part : parts)
          part = {0., 0.};
        is_blind.assign(is_blind.size(), false);
      }
    find_nearest();
  }



  void FacingParts::find_nearest()
  {
    find_far_in_grooves();
    nearest.assign(surface.mesh.vertices.size(), infinite);
    for (unsigned int f = 0; f < part_of.size(); ++f)
      if (is_kept(f))
        for (const unsigned int v : surface.faces[f].corners)
          if (const auto far = far_in_grooves.find(v);
              far == far_in_grooves.end() || far->second.count(part_of[f]) == 0)
            nearest[v] = std::min(nearest[v], parts[part_of[f]].distance);
  }



  void FacingParts::find_far_in_grooves()
  {
    far_in_grooves.clear();
    const auto for_corners = [&](const auto &act) {
      for (unsigned int f = 0; f < part_of.size(); ++f)
        for (unsigned int i = 0; i < surface.faces[f].n_corners; ++i)
          act(f, surface.faces[f].corners[i]);
    };
    // Few vertices have several parts.
    std::vector<unsigned int> first(surface.mesh.vertices.size(), SurfaceTopology::none);
    std::map<unsigned int, std::vector<unsigned int>> faces_between_parts;
    for_corners([&](const unsigned int f, const unsigned int v) {
      if (first[v] == SurfaceTopology::none)
        first[v] = part_of[f];
      else if (first[v] != part_of[f])
        faces_between_parts[v];
    });
    for_corners([&](const unsigned int f, const unsigned int v) {
      if (const auto it = faces_between_parts.find(v); it != faces_between_parts.end())
        it->second.push_back(f);
    });
    for (const auto &[v, faces] : faces_between_parts)
      {
        std::map<unsigned int, Part> here;
        for (const unsigned int f : faces)
          {
            Part &part    = here[part_of[f]];
            part.distance = std::min(part.distance, is_kept(f) ? seen[f] : infinite);
            part.widths   = std::min(part.widths, part.distance / width_of(surface, f));
          }
        Part least;
        for (const auto &entry : here)
          if (entry.second.distance < least.distance)
            least = entry.second;
        if (!(least.distance < infinite) || !is_groove(surface, part_of, faces, v))
          continue;
        for (const auto &[part, distances] : here)
          if (distances.widths > FacingRule().alike * least.widths + FacingRule().touching)
            far_in_grooves[v].insert(part);
      }
    // A vertex that hangs on the edge of a larger face of the near side is a corner of the others alone.
    for (unsigned int v = 0; v < surface.hanging.size(); ++v)
      if (!surface.hanging[v].empty())
        {
          std::map<unsigned int, unsigned int> counts;
          for (const auto &parent : surface.hanging[v])
            if (const auto far = far_in_grooves.find(parent.first); far != far_in_grooves.end())
              for (const unsigned int part : far->second)
                ++counts[part];
          for (const auto &[part, count] : counts)
            if (count == surface.hanging[v].size())
              far_in_grooves[v].insert(part);
        }
  }



  std::size_t FacingParts::leave(const std::vector<bool> &some)
  {
    std::vector<bool> stays(parts.size(), false), goes(parts.size(), false);
    for (unsigned int f = 0; f < part_of.size(); ++f)
      if (seen[f] < infinite)
        (some[f] ? goes : stays)[part_of[f]] = true;
    if (std::none_of(stays.begin(), stays.end(), [](const bool stay) { return stay; }))
      return 0;
    std::size_t n_faces = 0;
    for (unsigned int f = 0; f < part_of.size(); ++f)
      if (const unsigned int p = part_of[f]; goes[p] && !stays[p])
        {
          parts[p] = {infinite, infinite};
          n_faces += !is_blind[piece_of[f]];
        }
    find_nearest();
    return n_faces;
  }



  bool FacingParts::counts(const unsigned int face, const unsigned int vertex) const
  {
    const Part &part = parts[part_of[face]];
    return is_kept(face) &&
           (part.widths <= 1. || part.distance <= nearest[vertex] || far_in_grooves.count(vertex) > 0);
  }



  bool FacingParts::acts(const unsigned int face, const unsigned int vertex) const
  {
    const auto far = far_in_grooves.find(vertex);
    return far == far_in_grooves.end() ? counts(face, vertex)
                                       : is_kept(face) && far->second.count(part_of[face]) == 0;
  }



  std::size_t FacingParts::n_blind() const
  {
    return static_cast<std::size_t>(
        std::count_if(piece_of.begin(), piece_of.end(), [&](const unsigned int p) { return is_blind[p]; }));
  }



  bool FacingParts::leaves_out_anything() const
  {
    for (unsigned int f = 0; f < part_of.size(); ++f)
      for (const unsigned int v : surface.faces[f].corners)
        if (!acts(f, v))
          return true;
    return false;
  }



  namespace
  {
    /// Calls f(face, point, unit normal, width) for the places that one looks from, on this rank.
    template <typename F>
    void for_places(const ContactSurface &surface, const MPI_Comm communicator, const F &f)
    {
      const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator),
                         n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      for (unsigned int face = rank; face < surface.faces.size(); face += n_ranks)
        {
          const Vector3 area  = area_vector(surface, surface.faces[face]);
          const double  width = std::sqrt(area.norm());
          if (!(width > 0.))
            continue;
          const auto    &one    = surface.faces[face];
          const Point<3> centre = centre_of(surface, one);
          f(face, centre, area / area.norm(), width);
          for (unsigned int a = 0; a < one.n_corners; ++a)
            f(face, centre + FacingRule().toward_corners * (surface.mesh.vertices[one.corners[a]] - centre),
              area / area.norm(), width);
        }
    }

    void look(FacingParts &from_parts, const ContactSurface &from, FacingParts &to_parts,
              const ContactSurface &to, const MPI_Comm communicator)
    {
      const SurfaceSight    sight(to);
      std::optional<WayOut> way_out;
      for_places(from, communicator,
                 [&](const unsigned int face, const Point<3> &p, const Vector3 &n, const double width) {
                   SurfaceSight::Place seen;
                   // The teeth of a gear would see others through their own.
                   const auto is_open = [&](const double way) {
                     if (way >= -width)
                       return true;
                     if (!way_out)
                       way_out.emplace(from_parts.boundary_of_body());
                     return !way_out->leads_from(p, p + way * n, width);
                   };
                   if (!sight.find(seen, p, n, FacingRule().same_place * width, is_open))
                     return;
                   from_parts.see(face, std::abs(seen.distance));
                   to_parts.see(to.triangle_face[seen.triangle], std::abs(seen.distance));
                 });
    }
  } // namespace



  void see_each_other(FacingParts &first_parts, const ContactSurface &first, FacingParts &second_parts,
                      const ContactSurface &second, const MPI_Comm communicator)
  {
    look(first_parts, first, second_parts, second, communicator);
    look(second_parts, second, first_parts, first, communicator);
    first_parts.finish(communicator);
    second_parts.finish(communicator);
  }



  void see(FacingParts &parts, const ContactSurface &surface, const Sight &sight, const MPI_Comm communicator)
  {
    for_places(surface, communicator,
               [&](const unsigned int face, const Point<3> &p, const Vector3 &n, const double) {
                 if (double distance = 0.; sight(distance, p, n))
                   parts.see(face, std::abs(distance));
               });
    parts.finish(communicator);
  }



  namespace
  {
    /// ContactSurface::beyond of a surface that was cut out of a whole one.
    void add_what_was_left(ContactSurface &surface, const ContactSurface &whole,
                           const std::vector<bool> &is_kept)
    {
      std::map<unsigned int, unsigned int> number;
      for (unsigned int v = 0; v < surface.origin->vertices.size(); ++v)
        number[surface.origin->vertices[v]] = v;
      for (const auto &[v, facets] : whole.beyond)
        if (const auto kept = number.find(v); kept != number.end())
          surface.beyond[kept->second] = facets;
      const auto &x = whole.mesh.vertices;
      for (unsigned int t = 0; t < whole.mesh.triangles.size(); ++t)
        if (const Vector3 normal = facet_normal(whole, t);
            !is_kept[whole.triangle_face[t]] && normal.norm() > 0.)
          {
            const auto    &c = whole.mesh.triangles[t];
            const Point<3> centre((Vector3(x[c[0]]) + Vector3(x[c[1]]) + Vector3(x[c[2]])) / 3.);
            for (const unsigned int v : c)
              if (const auto kept = number.find(v); kept != number.end())
                surface.beyond[kept->second].push_back({normal, centre - x[v]});
          }
    }
  } // namespace



  ContactSurface without_blind_parts(ContactSurface surface, const FacingParts &parts,
                                     const SurfaceShapes &shapes)
  {
    set_normals(surface, shapes,
                [&](const unsigned int face, const unsigned int vertex) { return parts.acts(face, vertex); });
    project_onto_symmetry_planes(surface);
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      {
        ContactSurface::Face &face = surface.faces[f];
        face.left_corners          = 0;
        for (unsigned int i = 0; i < face.n_corners; ++i)
          if (const unsigned int v = face.corners[i]; !parts.acts(f, v))
            {
              face.left_corners |= static_cast<unsigned char>(1u << i);
              surface.normals_of_rows[v] = surface.mesh.vertex_normals[v];
            }
      }
    set_normals(surface, shapes, [&](const unsigned int face, const unsigned int vertex) {
      return parts.counts(face, vertex);
    });
    project_onto_symmetry_planes(surface);
    std::vector<bool> is_kept;
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      is_kept.push_back(parts.is_kept(f));
    ContactSurface result = cut_out(
        surface, SurfacePiece(surface, is_kept, std::vector<bool>(surface.mesh.vertices.size(), false)));
    add_what_was_left(result, surface, is_kept);
    result.origin.reset();
    return result;
  }
} // namespace Signorini
