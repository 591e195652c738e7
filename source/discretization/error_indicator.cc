// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/discretization/face_conditions.h>

#include <deal.II/base/mpi.h>

#include <optional>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::array<Vector3, CellShape::max_vertices> cell_values(const NodalSpace       &space,
                                                             const NodePartition    &partition,
                                                             const Vector           &displacement,
                                                             const NodalSpace::Cell &cell)
    {
      std::array<Vector3, CellShape::max_vertices> u;
      const auto                                   nodes = space.nodes(cell);
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int c = 0; c < dim; ++c)
          u[v][c] = displacement.local_element(dim * partition.to_local(nodes[v]) + c);
      return u;
    }

    /// Stress of the discrete solution in one cell.
    class CellStress : public CellDisplacement
    {
    public:
      CellStress(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                 const Loads &loads, const Vector &displacement, const NodalSpace::Cell &cell)
        : CellDisplacement(Element(space, cell), bodies.material(cell.material),
                           cell_values(space, partition, displacement, cell), loads.eigenstrain(space, cell))
      {
      }

      /// At a point in space.
      Block at_point(const Point<3> &point) const
      {
        // Everywhere the same in a tetrahedron, but for the eigenstrain.
        const bool is_hexahedron = element.n_vertices() == CellShape::hexahedron;
        Point<3>   reference(.25, .25, .25);
        if ((is_hexahedron || !eigenstrain.is_zero) && !element.invert_map(reference, point))
          reference = is_hexahedron ? Point<3>(.5, .5, .5) : Point<3>(.25, .25, .25);
        return stress(reference);
      }

      /// Vertices of this cell, corner by corner of a face.
      using Corners = std::array<unsigned int, 4>;

      /// At a point of a face that this cell has as a whole.
      /// @param shape values of the functions of its n corners
      Block at_face_point(const std::array<double, 4> &shape, const Corners &corners,
                          const unsigned int n) const
      {
        Point<3> reference;
        for (unsigned int v = 0; v < n; ++v)
          reference += shape[v] * Vector3(element.reference_vertex(corners[v]));
        return stress(reference);
      }

      /// At the centre, by differences of the stress between opposite faces (exact where the stress is
      /// quadratic in reference coordinates, as on parallelepipeds). On tetrahedra that of the eigenstrain.
      Vector3 divergence() const
      {
        Vector3 result;
        if (element.n_vertices() == CellShape::tetrahedron)
          return -eigenstress_divergence();
        Block jacobian;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int c = 0; c < dim; ++c)
              jacobian[c][d] += ((v >> d & 1) ? .25 : -.25) * element.corner(v)[c];
        if (!(determinant(jacobian) > 0.))
          return result;
        const Block inverse = invert(jacobian);
        for (unsigned int d = 0; d < dim; ++d)
          {
            Point<3> low(.5, .5, .5), high = low;
            low[d]  = 0.;
            high[d] = 1.;
            result += (stress(high) - stress(low)) * Vector3(inverse[d]);
          }
        return result;
      }
    };



    double cell_residual(const CellStress &cell, const VectorField &force, const double time)
    {
      const Vector3 divergence = cell.divergence();
      double        sum        = 0.;
      for (unsigned int q = 0; q < cell.element.n_points(); ++q)
        {
          const auto [weight, point] = cell.element.volume_element(q);
          Vector3 residual           = divergence;
          if (force)
            residual += force(point, time);
          sum += weight * residual.norm_square();
        }
      const double h = cell.element.diameter();
      return h * h * sum / (2. * cell.material.mu());
    }



    CellStress::Corners corners_of(const ElementFace &face)
    {
      CellStress::Corners corners = {};
      for (unsigned int v = 0; v < face.n_corners(); ++v)
        corners[v] = face.vertex(v);
      return corners;
    }



    /// The squared norm of sigma n - t on a boundary face, without the components in `fixed`.
    double boundary_residual(const CellStress &cell, const unsigned int face, const FaceTraction &traction,
                             const FixedDirections &fixed)
    {
      const ElementFace         shape(cell.element, face);
      const CellStress::Corners corners = corners_of(shape);
      double                    square  = traction.square;
      Vector3                   normal;
      for (unsigned int q = 0; q < shape.n_points(); ++q)
        {
          const auto    point = shape.point(q);
          const double  da    = point.area.norm();
          const Vector3 t     = cell.at_face_point(point.shape, corners, shape.n_corners()) * point.area / da;
          square += da * project_free(fixed, t).norm_square();
          normal += point.area;
        }
      normal /= normal.norm();
      // The product with t: with sigma n as the combination of its values at the corners.
      for (unsigned int v = 0; v < shape.n_corners(); ++v)
        {
          const Vector3 t = cell.stress(cell.element.reference_vertex(corners[v])) * normal;
          square -= 2. * (project_free(fixed, t) * traction.moments[v]);
        }
      return std::max(0., square);
    }



    /// The loads on a face in the free components.
    void add_load(FaceTraction &sum, const ElementFace &shape, const SurfaceForces &forces,
                  const std::size_t traction, const FixedDirections &fixed)
    {
      for (unsigned int q = 0; q < shape.n_points(); ++q)
        {
          const auto    point = shape.point(q);
          const Vector3 force = project_free(fixed, forces.force(traction, point.position, point.area));
          for (unsigned int v = 0; v < shape.n_corners(); ++v)
            sum.moments[v] += point.shape[v] * force;
          sum.square += force.norm_square() / point.area.norm();
        }
    }

    /// The same corners as vertices of the cell on the other side; nothing if it has not all of them, for it
    /// is larger.
    std::optional<CellStress::Corners> corners_outside(const NodalSpace            &space,
                                                       const NodalSpace::InnerFace &face,
                                                       const CellStress::Corners   &inside,
                                                       const unsigned int           n)
    {
      const auto nodes            = space.nodes(space.cells()[face.cell]),
                 others           = space.nodes(space.cells()[face.other]);
      CellStress::Corners corners = {};
      for (unsigned int v = 0; v < n; ++v)
        {
          const auto it = std::find(others.begin(), others.end(), nodes[inside[v]]);
          if (it == others.end())
            return std::nullopt;
          corners[v] = static_cast<unsigned int>(it - others.begin());
        }
      return corners;
    }

    /// h_F |[sigma n]|^2 / (mu_1 + mu_2), half of it.
    double jump(const NodalSpace &space, const NodalSpace::InnerFace &face, const CellStress &inside,
                const CellStress &outside)
    {
      const ElementFace         shape(inside.element, face.face);
      const unsigned int        n       = shape.n_corners();
      const CellStress::Corners corners = corners_of(shape);
      const auto                others  = corners_outside(space, face, corners, n);
      double                    square  = 0.;
      for (unsigned int q = 0; q < shape.n_points(); ++q)
        {
          const auto  point = shape.point(q);
          const Block other =
              others ? outside.at_face_point(point.shape, *others, n) : outside.at_point(point.position);
          const Vector3 difference = (inside.at_face_point(point.shape, corners, n) - other) * point.area;
          square += difference.norm_square() / point.area.norm();
        }
      return .5 * shape.diameter() * square / (inside.material.mu() + outside.material.mu());
    }

    /// h_F |sigma n - t|^2 / (2 mu), with the loads added to what contact does.
    double boundary_share(const CellStress &cell, const NodalSpace::BoundaryFace &face,
                          const FixedDirections &fixed, const SurfaceForces &forces, FaceTraction traction)
    {
      const ElementFace shape(cell.element, face.face);
      for (const std::size_t load : forces.on(face.id))
        add_load(traction, shape, forces, load, fixed);
      return shape.diameter() * boundary_residual(cell, face.face, traction, fixed) /
             (2. * cell.material.mu());
    }
  } // namespace



  std::vector<double> residual_indicator(const Bodies &bodies, const NodalSpace &space,
                                         const NodePartition &partition, const Loads &loads,
                                         const Vector                               &displacement,
                                         const std::map<unsigned int, FaceTraction> &contact)
  {
    const auto         &cells = space.cells();
    std::vector<double> indicator(cells.size(), 0.);
    const auto          stress_in = [&](const unsigned int cell) {
      return CellStress(bodies, space, partition, loads, displacement, cells[cell]);
    };
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cells[c].is_owned)
        indicator[c] = cell_residual(
            stress_in(c), loads.volume_forces[bodies.body_of_material(cells[c].material)], loads.time);
    for (const NodalSpace::InnerFace &face : space.inner_faces())
      {
        const double share = jump(space, face, stress_in(face.cell), stress_in(face.other));
        indicator[face.cell] += share;
        indicator[face.other] += share;
      }
    const SurfaceForces forces(loads, space);
    for (unsigned int f = 0; f < space.boundary_faces().size(); ++f)
      if (const NodalSpace::BoundaryFace &face = space.boundary_faces()[f]; cells[face.cell].is_owned)
        {
          const auto       it     = contact.find(f);
          const CellStress stress = stress_in(face.cell);
          indicator[face.cell] += boundary_share(
              stress, face, FaceConditions(space, loads, face, ElementFace(stress.element, face.face)).held,
              forces, it == contact.end() ? FaceTraction() : it->second);
        }
    return indicator;
  }



  namespace
  {
    /// The largest threshold for which `measure` (falling with the threshold) is at least `wanted`: by
    /// bisection of its exponent.
    template <typename Measure>
    double find_threshold(const double largest, const double wanted, const Measure &measure)
    {
      double low = 0., high = largest;
      if (!(largest > 0.))
        return 0.;
      for (unsigned int i = 0; i < 60; ++i)
        {
          const double middle = low > 0. ? std::sqrt(low * high) : high * 1e-3;
          if (low == 0. && high < 1e-30 * largest)
            break;
          if (measure(middle) >= wanted)
            low = middle;
          else
            high = middle;
        }
      return low;
    }

    std::vector<bool> mark_above(const NodalSpace &space, const std::vector<double> &indicator,
                                 const double threshold)
    {
      // Cells that are equal but for rounding are marked together, on any number of ranks.
      constexpr double  equal = 1. - 1e-6;
      std::vector<bool> marked(indicator.size());
      for (std::size_t c = 0; c < indicator.size(); ++c)
        marked[c] = space.cells()[c].is_owned && indicator[c] > 0. && indicator[c] >= equal * threshold;
      return marked;
    }

    /// Over the owned cells of all ranks.
    template <typename Value>
    double sum_over_cells(const NodalSpace &space, const Value &value)
    {
      double sum = 0.;
      for (std::size_t c = 0; c < space.cells().size(); ++c)
        if (space.cells()[c].is_owned)
          sum += value(c);
      return Utilities::MPI::sum(sum, space.communicator());
    }

    double largest_of(const NodalSpace &space, const std::vector<double> &indicator)
    {
      double largest = 0.;
      for (std::size_t c = 0; c < indicator.size(); ++c)
        if (space.cells()[c].is_owned)
          largest = std::max(largest, indicator[c]);
      return Utilities::MPI::max(largest, space.communicator());
    }
  } // namespace



  std::vector<bool> mark_share_of_error(const NodalSpace &space, const std::vector<double> &indicator,
                                        const double fraction)
  {
    const double total = sum_over_cells(space, [&](const std::size_t c) { return indicator[c]; });
    return mark_above(
        space, indicator, find_threshold(largest_of(space, indicator), fraction * total, [&](const double t) {
          return sum_over_cells(space,
                                [&](const std::size_t c) { return indicator[c] >= t ? indicator[c] : 0.; });
        }));
  }



  std::vector<bool> mark_share_of_cells(const NodalSpace &space, const std::vector<double> &indicator,
                                        const double fraction)
  {
    return mark_above(space, indicator,
                      find_threshold(largest_of(space, indicator),
                                     fraction * static_cast<double>(space.n_global_cells()),
                                     [&](const double t) {
                                       return sum_over_cells(space, [&](const std::size_t c) {
                                         return indicator[c] >= t ? 1. : 0.;
                                       });
                                     }));
  }
} // namespace Signorini
