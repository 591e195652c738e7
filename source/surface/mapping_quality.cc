// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/tensor.h>

#include <iomanip>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 3> unit_normal(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      const auto        &t = mesh.triangles[triangle];
      const Tensor<1, 3> n = cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                              mesh.vertices[t[2]] - mesh.vertices[t[0]]);
      return n.norm() > 0. ? n / n.norm() : n;
    }

    /// Gaps along the normals of nonmortar triangles, and angles between the normals, over an overlay.
    struct OverlayGaps
    {
      const ContactMapping &mapping;
      const SurfaceMesh    &nonmortar, &mortar;

      std::array<double, 3> at_corners(const OverlayTriangle &cell, const Tensor<1, 3> &normal) const
      {
        std::array<double, 3> gaps;
        for (unsigned int c = 0; c < 3; ++c)
          gaps[c] = (evaluate(mortar, cell.mortar_triangle, cell.mortar[c]) -
                     evaluate(nonmortar, cell.nonmortar_triangle, cell.nonmortar[c])) *
                    normal;
        return gaps;
      }

      /// Calls visit(polygon, area of the cell, gaps at its corners).
      template <typename Visit>
      void for_each_cell(const Visit &visit) const
      {
        std::vector<OverlayTriangle> cells;
        for (std::size_t i = 0; i < mapping.n_polygons(); ++i)
          {
            const unsigned int t      = mapping.polygon_triangles[i].first;
            const Tensor<1, 3> normal = unit_normal(nonmortar, t);
            cells.clear();
            mapping.triangulate(cells, i);
            for (const OverlayTriangle &cell : cells)
              visit(i, std::abs(cell.share()) * triangle_area(nonmortar, t), at_corners(cell, normal));
          }
      }

      /// In degrees.
      double angle(const std::size_t polygon) const
      {
        const auto [t, m]   = mapping.polygon_triangles[polygon];
        const double cosine = -(unit_normal(nonmortar, t) * unit_normal(mortar, m));
        return std::acos(std::min(1., std::max(-1., cosine))) * 180. / numbers::PI;
      }
    };



    /// @param covered area of this rank; quality has its integral of the angle
    void sum_over_ranks(MappingQuality &quality, const double covered, const MPI_Comm communicator)
    {
      quality.largest_angle = Utilities::MPI::max(quality.largest_angle, communicator);
      quality.mean_angle    = Utilities::MPI::sum(quality.mean_angle, communicator);
      for (double &area : quality.histogram)
        area = Utilities::MPI::sum(area, communicator);
      if (const double area = Utilities::MPI::sum(covered, communicator); area > 0.)
        quality.mean_angle /= area;
    }
  } // namespace



  MappingQuality assess_mapping(const ContactMapping &mapping, const SurfaceMesh &nonmortar,
                                const SurfaceMesh &mortar, const MPI_Comm communicator)
  {
    MappingQuality    quality;
    const OverlayGaps gaps{mapping, nonmortar, mortar};
    double            smallest = std::numeric_limits<double>::infinity(), largest = -smallest, covered = 0.;
    gaps.for_each_cell([&](const std::size_t polygon, const double area, const std::array<double, 3> &gap) {
      const double angle    = gaps.angle(polygon);
      quality.largest_angle = std::max(quality.largest_angle, angle);
      quality.mean_angle += angle * area;
      covered += area;
      for (const double value : gap)
        {
          smallest = std::min(smallest, value);
          largest  = std::max(largest, value);
        }
    });
    quality.min_gap    = Utilities::MPI::min(smallest, communicator);
    quality.max_gap    = Utilities::MPI::max(largest, communicator);
    const double range = quality.max_gap - quality.min_gap;
    gaps.for_each_cell([&](const std::size_t, const double area, const std::array<double, 3> &gap) {
      const double mean  = (gap[0] + gap[1] + gap[2]) / 3.;
      const double place = range > 0. ? 10. * (mean - quality.min_gap) / range : 0.;
      quality.histogram[std::min(9, std::max(0, static_cast<int>(place)))] += area;
    });
    sum_over_ranks(quality, covered, communicator);
    return quality;
  }



  namespace
  {
    /// Adds the edges between parts that are torn: what the triangles on both sides have of them, which is
    /// known to different ranks.
    void add_edges_torn_between_parts(MappingReport &report, const MPI_Comm communicator)
    {
      std::map<unsigned int, MappingReport::OpenEdge> sums;
      for (const auto &part : Utilities::MPI::all_gather(communicator, report.open_edges))
        for (const MappingReport::OpenEdge &side : part)
          {
            MappingReport::OpenEdge &sum =
                sums.insert({side.edge, {side.edge, 0., false, true}}).first->second;
            sum.excess += side.excess;
            sum.can_touch = sum.can_touch || side.can_touch;
            sum.are_tiled = sum.are_tiled && side.are_tiled;
          }
      for (const auto &[edge, sum] : sums)
        report.add_edge(sum);
      report.open_edges.clear();
    }
  } // namespace



  MappingReport sum_reports(MappingReport report, const MPI_Comm communicator)
  {
    for (double *area : {&report.area_nonmortar, &report.area_covered, &report.area_mortar_covered})
      *area = Utilities::MPI::sum(*area, communicator);
    for (std::size_t *number :
         {&report.n_cells, &report.n_pairs, &report.n_flips, &report.n_broken, &report.n_lost_triangles,
          &report.n_torn_edges, &report.n_turned_away, &report.n_slight})
      *number = Utilities::MPI::sum(*number, communicator);
    report.worst_tiling_defect = Utilities::MPI::max(report.worst_tiling_defect, communicator);
    // An edge over several parts may be lost in each of them; a vertex is told by one.
    const auto gather = [&](auto &list) {
      const auto parts = Utilities::MPI::all_gather(communicator, list);
      list.clear();
      for (const auto &part : parts)
        list.insert(list.end(), part.begin(), part.end());
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    add_edges_torn_between_parts(report, communicator);
    gather(report.torn_edges);
    gather(report.wrong_triangles);
    gather(report.lost_edges);
    gather(report.unmapped);
    return report;
  }



  const char *reason_name(const Unmapped reason)
  {
    switch (reason)
      {
        case Unmapped::no_hit:
          return "no hit";
        case Unmapped::outside_rim:
          return "outside the rim";
        case Unmapped::wrong_side:
          return "wrong side";
        case Unmapped::behind:
          return "behind another layer";
        default:
          return "mapped";
      }
  }



  std::map<std::string, std::size_t> count_unmapped(const MappingReport &report)
  {
    std::map<std::string, std::size_t> result;
    for (const auto &[vertex, reason] : report.unmapped)
      ++result[reason_name(reason)];
    return result;
  }



  namespace
  {
    /// Parts of the surfaces that are covered.
    std::array<std::pair<const char *, double>, 2> covered_shares(const MappingReport &report)
    {
      return {{{"nonmortar", report.area_covered / report.area_nonmortar},
               {"mortar", report.area_mortar_covered / report.area_mortar}}};
    }

    /// No point of a surface has more than one image.
    bool is_too_much(const double share)
    {
      return !(share <= 1. + MappingReport::slight);
    }
  } // namespace



  bool covers_twice(const MappingReport &report)
  {
    const auto shares = covered_shares(report);
    return is_too_much(shares[0].second) || is_too_much(shares[1].second);
  }



  std::string describe_errors(const MappingReport &report)
  {
    std::ostringstream text;
    const auto         add = [&](const std::size_t number, const char *what) {
      if (number > 0)
        text << (text.tellp() > 0 ? ", " : "") << number << ' ' << what;
    };
    add(report.n_lost_triangles, "nonmortar triangles without their part of the overlay");
    add(report.n_torn_edges, "nonmortar edges along which the overlay is torn");
    add(report.lost_edges.size(), "mortar edges lost");
    add(report.n_flips, "cells turned");
    add(report.n_broken, "pairs of triangles without a polygon");
    if (report.worst_tiling_defect > MappingReport::slight)
      text << (text.tellp() > 0 ? ", " : "") << "a triangle that is covered wrongly by "
           << report.worst_tiling_defect << " of its area";
    for (const auto &[name, share] : covered_shares(report))
      if (is_too_much(share))
        text << (text.tellp() > 0 ? ", " : "") << "the " << name << " surface covered to " << 100. * share
             << " %";
    return text.str();
  }



  void print_mapping(std::ostream &out, const MappingReport &report, const MappingQuality &quality)
  {
    out << std::setprecision(6) << "  covered          " << 100. * report.area_covered / report.area_nonmortar
        << " % of the nonmortar, " << 100. * report.area_mortar_covered / report.area_mortar
        << " % of the mortar area\n"
        << "  overlay          " << report.n_pairs << " pairs of triangles, " << report.n_cells
        << " cells, area " << report.area_covered << '\n'
        << "  tiling defect    " << report.worst_tiling_defect << " (largest, part of a triangle)\n";
    for (const auto &[reason, number] : count_unmapped(report))
      out << "  unmapped         " << number << " mortar vertices: " << reason << '\n';
    if (report.n_conflicts > 0)
      out << "  surfaces         " << report.n_conflicts
          << " edges where triangles turn to different sides or more than two meet (taken as borders)\n";
    if (report.n_turned_away > 0)
      out << "  turned away      " << report.n_turned_away
          << " places where the overlay does not fit, but the surfaces turn away from each other by more "
             "than "
             "60\n                   degrees: nothing touches there\n";
    if (const std::string errors = describe_errors(report); !errors.empty())
      out << "  errors           " << errors << ": there the mapping is not one-to-one. In a contact run\n"
          << "                   pressures and forces near those places are wrong; the rest is not "
             "affected\n";
    if (report.n_pairs > 0)
      {
        out << "  angle            " << quality.largest_angle << " degrees at most between the normals, "
            << quality.mean_angle << " on average\n"
            << "  gap              from " << quality.min_gap << " to " << quality.max_gap
            << "; area in tenths:";
        for (const double area : quality.histogram)
          out << ' ' << std::setprecision(3) << area;
        out << '\n';
      }
  }
} // namespace Signorini
