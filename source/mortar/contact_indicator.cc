// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/sent_lists.h>
#include <signorini/mortar/contact_indicator.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using FaceKey = std::array<NodeIndex, 4>;

    FaceKey sorted(FaceKey key)
    {
      std::sort(key.begin(), key.end());
      return key;
    }

    /// Three points in a triangle, exact for degree two.
    constexpr std::array<double, 3> points[3] = {{{2. / 3., 1. / 6., 1. / 6.}},
                                                 {{1. / 6., 2. / 3., 1. / 6.}},
                                                 {{1. / 6., 1. / 6., 2. / 3.}}};

    double longest_edge(const ContactSurface &surface, const unsigned int face)
    {
      const auto &f       = surface.faces[face];
      double      longest = 0.;
      for (unsigned int v = 0; v < f.n_corners; ++v)
        longest = std::max(longest, surface.mesh.vertices[f.corners[v]].distance(
                                        surface.mesh.vertices[f.corners[(v + 1) % f.n_corners]]));
      return longest;
    }
  } // namespace



  ContactFaces::ContactFaces(const NodalSpace &space, const ContactSurface &surface,
                             const std::set<types::boundary_id> &ids)
    : space(space)
    , surface(surface)
    , boundary_face(surface.faces.size(), -1)
  {
    std::map<FaceKey, unsigned int> index;
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      {
        FaceKey key;
        key.fill(invalid_node);
        for (unsigned int v = 0; v < surface.faces[f].n_corners; ++v)
          key[v] = surface.vertex_node[surface.faces[f].corners[v]];
        index[sorted(key)] = f;
      }
    for (unsigned int b = 0; b < space.boundary_faces().size(); ++b)
      {
        const NodalSpace::BoundaryFace &face = space.boundary_faces()[b];
        const NodalSpace::Cell         &cell = space.cells()[face.cell];
        if (!cell.is_owned || ids.count(face.id) == 0)
          continue;
        FaceKey key;
        key.fill(invalid_node);
        const auto corners = CellShape::face(cell.n_vertices, face.face);
        for (unsigned int v = 0; v < corners.size(); ++v)
          key[v] = space.nodes(cell)[corners[v]];
        if (const auto it = index.find(sorted(key)); it != index.end())
          boundary_face[it->second] = static_cast<int>(b);
      }
  }



  void ContactFaces::add(std::map<unsigned int, FaceTraction> &tractions, const unsigned int f,
                         const FaceTraction &traction) const
  {
    if (boundary_face[f] < 0 || traction.square == 0.)
      return;
    const NodalSpace::BoundaryFace &face    = space.boundary_faces()[boundary_face[f]];
    const NodalSpace::Cell         &cell    = space.cells()[face.cell];
    const auto                      corners = CellShape::face(cell.n_vertices, face.face);
    FaceTraction                   &sum     = tractions[boundary_face[f]];
    sum.square += traction.square;
    for (unsigned int v = 0; v < corners.size(); ++v)
      for (unsigned int a = 0; a < surface.faces[f].n_corners; ++a)
        if (surface.vertex_node[surface.faces[f].corners[a]] == space.nodes(cell)[corners[v]])
          sum.moments[v] += traction.moments[a];
  }



  std::vector<FaceTraction> nonmortar_tractions(const ContactSurface           &nonmortar,
                                                const std::vector<FaceMoments> &moments,
                                                const CornerValues             &stress)
  {
    std::vector<FaceTraction> result(nonmortar.faces.size());
    for (const FaceMoments &m : moments)
      {
        const auto   &face     = nonmortar.faces[m.face];
        FaceTraction &traction = result[m.face];
        for (unsigned int a = 0; a < face.n_corners; ++a)
          {
            for (unsigned int b = 0; b < face.n_corners; ++b)
              traction.moments[a] -= m.mass[4 * a + b] * stress[m.face][b];
            traction.square -= traction.moments[a] * stress[m.face][a];
          }
      }
    return result;
  }



  namespace
  {
    /// Collective. The sums over all ranks of the tractions of faces, on the ranks that own their cells.
    std::vector<FaceTraction> sums_of_owners(const std::vector<FaceTraction> &tractions,
                                             const ContactSurface &surface, const MPI_Comm communicator)
    {
      struct SentTraction
      {
        unsigned int number;
        FaceTraction traction;
      };
      ListsByRank<SentTraction> parcels;
      for (unsigned int f = 0; f < tractions.size(); ++f)
        if (const auto &moments = tractions[f].moments;
            tractions[f].square != 0. || std::any_of(moments.begin(), moments.end(),
                                                     [](const Vector3 &m) { return m.norm_square() > 0.; }))
          parcels[surface.faces[f].owner].push_back({surface.number_of_face(f), tractions[f]});
      std::vector<FaceTraction> result(tractions.size());
      for (const auto &[sender, list] : send_lists(parcels, communicator))
        for (const SentTraction &sent : list)
          {
            FaceTraction &sum = result[surface.face_of_number(sent.number)];
            sum.square += sent.traction.square;
            for (unsigned int a = 0; a < sum.moments.size(); ++a)
              sum.moments[a] += sent.traction.moments[a];
          }
      return result;
    }
  } // namespace



  std::vector<FaceTraction> mortar_tractions(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                             const std::vector<OverlayTriangle> &overlay,
                                             const CornerValues &stress, const MPI_Comm communicator)
  {
    const SurfaceValues       non(nonmortar), mor(mortar);
    std::vector<FaceTraction> sums(mortar.faces.size());
    for (const OverlayTriangle &cell : overlay)
      {
        FaceTraction           &sum = sums[mortar.triangle_face[cell.mortar_triangle]];
        std::array<Point<3>, 3> y;
        for (unsigned int c = 0; c < 3; ++c)
          y[c] = evaluate(mortar.mesh, cell.mortar_triangle, cell.mortar[c]);
        const double area = cell.share() * Signorini::triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
        const double image_area = .5 * cross_product_3d(y[1] - y[0], y[2] - y[0]).norm();
        for (const auto &point : points)
          {
            const auto     w = compose(cell.nonmortar, point), w_image = compose(cell.mortar, point);
            const Point<3> x     = non.point(cell.nonmortar_triangle, w);
            const Point<3> image = mor.point(cell.mortar_triangle, w_image);
            const Vector3  force = (area / 3.) * non.value(stress, cell.nonmortar_triangle,
                                                           non.shape(cell.nonmortar_triangle, x));
            const auto     theta = mor.shape(cell.mortar_triangle, image);
            for (unsigned int a = 0; a < 4; ++a)
              sum.moments[a] += theta[a] * force;
            if (image_area > 0.)
              sum.square += 3. * force.norm_square() / image_area;
          }
      }
    return sums_of_owners(sums, mortar, communicator);
  }



  namespace
  {
    /// Sums up both terms of every face.
    class Violation
    {
    public:
      explicit Violation(const ContactSurface &surface)
        : surface(surface)
        , penetration(surface.faces.size(), 0.)
        , complementarity(penetration)
      {
      }

      void add(const unsigned int face, const double weight, const double opening, const double pressure)
      {
        const double depth = std::max(0., -opening);
        penetration[face] += weight * depth * depth;
        complementarity[face] += weight * opening * pressure;
      }

      std::vector<double> finish(const double shear_modulus) const
      {
        std::vector<double> result;
        for (unsigned int f = 0; f < penetration.size(); ++f)
          result.push_back(shear_modulus / longest_edge(surface, f) * penetration[f] +
                           std::abs(complementarity[f]));
        return result;
      }

    private:
      const ContactSurface &surface;
      std::vector<double>   penetration, complementarity;
    };
  } // namespace



  std::vector<double> contact_violation(const FacingSurfaces &pair, const CornerValues &stress,
                                        const std::vector<Vector3> &displacement_nonmortar,
                                        const std::vector<Vector3> &displacement_mortar,
                                        const GapFunction &prescribed_gap, const double shear_modulus)
  {
    const auto &[nonmortar, mortar, overlay, sharp_vertices] = pair;
    const SurfaceValues non(nonmortar, sharp_vertices), mor(mortar);
    Violation           violation(nonmortar);
    for (const OverlayTriangle &cell : overlay)
      {
        const double area = cell.share() * Signorini::triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
        for (const auto &point : points)
          {
            const auto     w = compose(cell.nonmortar, point), w_image = compose(cell.mortar, point);
            const Point<3> x     = non.point(cell.nonmortar_triangle, w);
            const Point<3> image = mor.point(cell.mortar_triangle, w_image);
            const Vector3  n     = non.normal(cell.nonmortar_triangle, w);
            const auto     phi   = non.shape(cell.nonmortar_triangle, x);
            const double   gap   = prescribed_gap ? prescribed_gap(x)
                                                  : initial_gap(nonmortar, mortar, cell, point, x, image) * n;
            const double   opening =
                gap - n * (non.value(displacement_nonmortar, cell.nonmortar_triangle, phi) -
                           mor.value(displacement_mortar, cell.mortar_triangle,
                                     mor.shape(cell.mortar_triangle, image)));
            violation.add(nonmortar.triangle_face[cell.nonmortar_triangle], std::abs(area) / 3., opening,
                          n * non.value(stress, cell.nonmortar_triangle, phi));
          }
      }
    return violation.finish(shear_modulus);
  }



  std::vector<double> tie_violation(const FacingSurfaces       &pair,
                                    const std::vector<Vector3> &displacement_nonmortar,
                                    const std::vector<Vector3> &displacement_mortar,
                                    const double                shear_modulus)
  {
    const auto &[nonmortar, mortar, overlay, sharp_vertices] = pair;
    const SurfaceValues non(nonmortar, sharp_vertices), mor(mortar);
    Violation           violation(nonmortar);
    for (const OverlayTriangle &cell : overlay)
      for (const auto &point : points)
        {
          const Point<3> x     = non.point(cell.nonmortar_triangle, compose(cell.nonmortar, point));
          const Point<3> image = mor.point(cell.mortar_triangle, compose(cell.mortar, point));
          const Vector3  jump =
              non.value(displacement_nonmortar, cell.nonmortar_triangle,
                        non.shape(cell.nonmortar_triangle, x)) -
              mor.value(displacement_mortar, cell.mortar_triangle, mor.shape(cell.mortar_triangle, image));
          const double area =
              cell.share() * Signorini::triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
          violation.add(nonmortar.triangle_face[cell.nonmortar_triangle], std::abs(area) / 3., -jump.norm(),
                        0.);
        }
    return violation.finish(shear_modulus);
  }



  std::vector<double> contact_violation(const ContactSurface &nonmortar, const ImageFunction &image,
                                        const CornerValues &stress, const std::vector<Vector3> &displacement,
                                        const double shear_modulus, const std::vector<bool> &faces)
  {
    const SurfaceValues non(nonmortar);
    Violation           violation(nonmortar);
    for (unsigned int t = 0; t < nonmortar.mesh.triangles.size(); ++t)
      if (faces[nonmortar.triangle_face[t]])
        for (const auto &point : points)
          {
            const Point<3> x   = non.point(t, point);
            const Vector3  n   = non.normal(t, point);
            const auto     phi = non.shape(t, x);
            Vector3        gap;
            if (image(gap, x + nonmortar.offset(t, point), n))
              violation.add(nonmortar.triangle_face[t], Signorini::triangle_area(nonmortar.mesh, t) / 3.,
                            n * (gap - non.value(displacement, t, phi)), n * non.value(stress, t, phi));
          }
    return violation.finish(shear_modulus);
  }
} // namespace Signorini
