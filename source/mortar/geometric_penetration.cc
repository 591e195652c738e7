// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/geometric_penetration.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr double half = .5, third = 1. / 3.;
    /// The centre comes last.
    constexpr std::array<double, 3> samples[7] = {
        {{1., 0., 0.}},     {{0., 1., 0.}},     {{0., 0., 1.}},         {{half, half, 0.}},
        {{0., half, half}}, {{half, 0., half}}, {{third, third, third}}};
  } // namespace



  void LeastGap::add(const double gap, const Point<3> &place)
  {
    if (is_before(gap, place))
      {
        least = gap;
        where = place;
      }
  }



  // Of equal ones the first by its coordinates, so that it does not depend on the order.
  bool LeastGap::is_before(const double gap, const Point<3> &place) const
  {
    return gap < std::numeric_limits<double>::infinity() &&
           std::tie(gap, place[0], place[1], place[2]) < std::tie(least, where[0], where[1], where[2]);
  }



  void LeastGap::reduce(const MPI_Comm communicator)
  {
    for (const auto &[gap, place] : gather_values(std::make_pair(least, where), communicator))
      add(gap, place);
  }



  ChordEdges::ChordEdges(const ContactSurface &surface)
    : is_chord(surface.mesh.triangles.size(), {{false, false, false}})
  {
    const auto height = [&](const unsigned int triangle, const unsigned int corner) {
      std::array<double, 3> middle = {{half, half, half}};
      middle[corner]               = 0.;
      return surface.offset(triangle, middle).norm();
    };
    // The largest height over the middle of an edge, of either triangle.
    std::map<std::pair<unsigned int, unsigned int>, double> largest;
    const auto edge = [&](const unsigned int triangle, const unsigned int corner) {
      const auto &v = surface.mesh.triangles[triangle];
      return std::minmax({v[(corner + 1) % 3], v[(corner + 2) % 3]});
    };
    for (unsigned int t = 0; t < is_chord.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        {
          double &value = largest[edge(t, i)];
          value         = std::max(value, height(t, i));
        }
    for (unsigned int t = 0; t < is_chord.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        is_chord[t][i] = height(t, i) < half * largest[edge(t, i)];
  }



  bool ChordEdges::has_point(const unsigned int triangle, const std::array<double, 3> &weights) const
  {
    constexpr double rounding = 1e-12;
    for (unsigned int i = 0; i < 3; ++i)
      if (is_chord[triangle][i] && weights[i] <= rounding && weights[(i + 1) % 3] > rounding &&
          weights[(i + 2) % 3] > rounding)
        return true;
    return false;
  }



  DoubtOfGaps::DoubtOfGaps(const ContactSurface &surface)
    : mesh(surface.mesh)
    , shares(surface.mesh.triangles.size(), 0.)
    , doubts(shares)
  {
  }



  void DoubtOfGaps::add(const unsigned int triangle, const double share, const double doubt, const double gap)
  {
    shares[triangle] += share;
    if (gap <= GapDoubtRule().apart * doubt)
      doubts[triangle] += share * doubt;
  }



  std::pair<double, Point<3>> DoubtOfGaps::largest(const MPI_Comm communicator) const
  {
    constexpr std::array<double, 3> middle = {{1. / 3., 1. / 3., 1. / 3.}};
    LeastGap                        result;
    result.add(0., Point<3>());
    for (unsigned int t = 0; t < shares.size(); ++t)
      if (shares[t] > 0. && doubts[t] > 0.)
        result.add(-doubts[t] / shares[t], evaluate(mesh, t, middle));
    result.reduce(communicator);
    return {0. - result.value(), result.place()};
  }



  GapUnderLoad::GapUnderLoad(const ContactSurface &surface, const std::vector<double> &pressure)
    : surface(surface)
    , pressure(pressure)
    , area(surface.faces.size(), 0.)
    , least(surface.faces.size())
  {
  }



  void GapUnderLoad::add(const unsigned int triangle, const double part, const LeastGap &gap)
  {
    const unsigned int face = surface.triangle_face[triangle];
    if (!(gap.value() < std::numeric_limits<double>::infinity()))
      return;
    area[face] += part;
    least[face].add(gap.value(), gap.place());
  }



  double GapUnderLoad::mean(const MPI_Comm communicator) const
  {
    double sum = 0., load = 0.;
    for (std::size_t f = 0; f < area.size(); ++f)
      {
        const ContactSurface::Face &face = surface.faces[f];
        if (!(area[f] > 0.))
          continue;
        double force = 0.;
        for (unsigned int a = 0; a < face.n_corners; ++a)
          if (!face.leaves(a))
            force += std::max(0., pressure[face.corners[a]]) * area[f] / face.n_corners;
        sum += force * std::max(0., least[f].value());
        load += force;
      }
    sum  = Utilities::MPI::sum(sum, communicator);
    load = Utilities::MPI::sum(load, communicator);
    return load > 0. ? sum / load : 0.;
  }



  namespace
  {
    Vector3 unused_offset(const ContactSurface &surface, const unsigned int triangle,
                          const std::array<double, 3> &weights)
    {
      return surface.true_shape.unused_offset(surface.mesh, triangle, weights);
    }

    double doubt_of(const ContactSurface &surface, const unsigned int triangle)
    {
      return surface.true_shape.doubt(surface.mesh, triangle);
    }
  } // namespace



  double gap_doubt(const SurfaceValues &nonmortar, const ContactSurface &mortar, const OverlayTriangle &cell)
  {
    const ContactSurface &non    = nonmortar.contact_surface();
    double                unused = 0.;
    for (const std::array<double, 3> &sample : samples)
      {
        const auto w = compose(cell.nonmortar, sample);
        unused       = std::max(
                  unused, std::abs((unused_offset(mortar, cell.mortar_triangle, compose(cell.mortar, sample)) -
                              unused_offset(non, cell.nonmortar_triangle, w)) *
                                   nonmortar.normal(cell.nonmortar_triangle, w)));
      }
    return unused + doubt_of(non, cell.nonmortar_triangle) + doubt_of(mortar, cell.mortar_triangle);
  }



  double gap_doubt(const ContactSurface &nonmortar, const unsigned int triangle)
  {
    double unused = 0.;
    for (const std::array<double, 3> &sample : samples)
      unused = std::max(unused, unused_offset(nonmortar, triangle, sample).norm());
    return unused + doubt_of(nonmortar, triangle);
  }



  bool has_corner(const ContactSurface &surface, const unsigned int triangle, const std::vector<bool> &marked)
  {
    const ContactSurface::Face &face = surface.faces[surface.triangle_face[triangle]];
    for (unsigned int a = 0; a < face.n_corners; ++a)
      if (marked[face.corners[a]] && !face.leaves(a))
        return true;
    return false;
  }



  GeometricPenetration sample_geometric_penetration(const FacingSurfaces       &pair,
                                                    const std::vector<Vector3> &displacement_nonmortar,
                                                    const std::vector<Vector3> &displacement_mortar,
                                                    const ContactAtVertices    &contact,
                                                    const GapFunction          &prescribed_gap,
                                                    const MPI_Comm              communicator)
  {
    const auto &[nonmortar, mortar, overlay, sharp_vertices] = pair;
    const SurfaceValues non(nonmortar, sharp_vertices), mor(mortar);
    const ChordEdges    chords(nonmortar);
    GapUnderLoad        under_load(nonmortar, contact.pressure);
    LeastGap            initially, deformed;
    DoubtOfGaps         doubts(nonmortar);
    for (const OverlayTriangle &cell : overlay)
      {
        LeastGap              least;
        std::optional<double> at_centre;
        for (const std::array<double, 3> &sample : samples)
          {
            at_centre.reset();
            const auto weights       = compose(cell.nonmortar, sample),
                       image_weights = compose(cell.mortar, sample);
            if (chords.has_point(cell.nonmortar_triangle, weights))
              continue;
            const Point<3> x     = non.point(cell.nonmortar_triangle, weights);
            const Point<3> image = mor.point(cell.mortar_triangle, image_weights);
            const Vector3  n     = non.normal(cell.nonmortar_triangle, weights);
            if (!prescribed_gap && !may_touch(n, facet_normal(mortar, cell.mortar_triangle)))
              continue;
            const Vector3 relative = non.value(displacement_nonmortar, cell.nonmortar_triangle, x) -
                                     mor.value(displacement_mortar, cell.mortar_triangle, image);
            const double initial = prescribed_gap
                                       ? prescribed_gap(x)
                                       : initial_gap(nonmortar, mortar, cell, sample, x, image) * n;
            const double gap     = initial - n * relative;
            initially.add(initial, x);
            deformed.add(gap, x);
            least.add(gap, x);
            at_centre = gap;
          }
        if (has_corner(nonmortar, cell.nonmortar_triangle, contact.doubted))
          doubts.add(cell.nonmortar_triangle, std::abs(cell.share()), gap_doubt(non, mortar, cell),
                     at_centre.value_or(least.value()));
        under_load.add(cell.nonmortar_triangle,
                       std::abs(cell.share()) * triangle_area(nonmortar.mesh, cell.nonmortar_triangle),
                       least);
      }
    initially.reduce(communicator);
    deformed.reduce(communicator);
    const auto [doubt, doubt_at] = doubts.largest(communicator);
    return {initially.value(), deformed.value(),     deformed.place(), under_load.mean(communicator), doubt,
            doubt_at,          under_load.of_faces()};
  }



  double sample_gap_doubt(const ContactSurface &nonmortar, const ContactSurface &mortar,
                          const std::vector<OverlayTriangle> &overlay, const std::vector<bool> &is_near,
                          const MPI_Comm communicator)
  {
    const SurfaceValues non(nonmortar);
    double              largest = 0.;
    for (const OverlayTriangle &cell : overlay)
      if (has_corner(nonmortar, cell.nonmortar_triangle, is_near))
        largest = std::max(largest, gap_doubt(non, mortar, cell));
    return Utilities::MPI::max(largest, communicator);
  }



  double sample_gap_doubt(const ContactSurface &nonmortar, const std::vector<bool> &is_near,
                          const MPI_Comm communicator)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    double             largest = 0.;
    for (unsigned int t = 0; t < nonmortar.mesh.triangles.size(); ++t)
      if (nonmortar.faces[nonmortar.triangle_face[t]].worker == rank && has_corner(nonmortar, t, is_near))
        largest = std::max(largest, gap_doubt(nonmortar, t));
    return Utilities::MPI::max(largest, communicator);
  }
} // namespace Signorini
