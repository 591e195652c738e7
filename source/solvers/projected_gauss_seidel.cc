// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/projected_gauss_seidel.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// From here on sweeps over the contact nodes are called slow: they leave 0.8 to 0.93 of an error where
    /// the nonmortar side is as stiff as the mortar side or softer, 0.96 where it is ten times as stiff.
    constexpr double slow = .95;
    /// Sweeps after which that is measured. Soft motions that the first ones leave behind show only when
    /// the stiff ones are gone: a stiffness ratio of 1e6 takes 15.
    constexpr unsigned int n_measured_sweeps = 20;
  } // namespace



  ProjectedGaussSeidel::ProjectedGaussSeidel(const NodeBlockMatrix &matrix)
    : matrix(matrix)
    , all_rows(matrix.partition())
    , blocks(matrix, all_rows)
    , interface_rows(all_rows.subset({}))
    , rounded(matrix)
    , inverse_diagonal(9 * static_cast<std::size_t>(matrix.n_rows()))
    , half_space_of_row(matrix.n_rows(), -1)
  {
    find_ordered_rows();
    block_rows = blocks.rows();
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    update(rows);
  }



  void ProjectedGaussSeidel::find_ordered_rows()
  {
    // The last phase is for nodes that no other rank sees.
    std::vector<bool> is_inner(matrix.n_rows(), false);
    for (const unsigned int row : all_rows.phases().back())
      is_inner[row] = true;
    is_ordered = is_inner;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const BlockRange upper = matrix.upper(row);
        for (std::size_t k = upper.begin; k < upper.end && is_ordered[row]; ++k)
          is_ordered[row] = matrix.column(k) < matrix.n_rows() && is_inner[matrix.column(k)];
      }
  }



  void ProjectedGaussSeidel::update(const std::vector<unsigned int> &rows)
  {
    blocks.update(rows);
    if (interface_correction)
      interface_correction->update(rows);
    for (const unsigned int row : rows)
      write_block(inverse_diagonal.data() + 9 * static_cast<std::size_t>(row),
                  invert(read_block(matrix.block(matrix.diagonal(row)))));
    rounded.update(rows, inverse_diagonal.data());
  }



  void ProjectedGaussSeidel::set_half_spaces(const HalfSpaces &half_spaces)
  {
    constraints = half_spaces;
    is_active.assign(constraints.size(), 0);
    projection_direction.resize(constraints.size());
    contact_residual.resize(constraints.size());
    std::fill(half_space_of_row.begin(), half_space_of_row.end(), -1);
    for (std::size_t p = 0; p < constraints.size(); ++p)
      {
        const unsigned int row  = constraints.nodes[p];
        half_space_of_row[row]  = static_cast<int>(p);
        const Block   inverse   = read_block(inverse_diagonal.data() + 9 * static_cast<std::size_t>(row));
        const Vector3 w         = inverse * constraints.normals[p];
        projection_direction[p] = w / (w * constraints.normals[p]);
      }
  }



  void ProjectedGaussSeidel::set_bounds_from(const HalfSpaces &half_spaces, const Vector &v)
  {
    for (std::size_t p = 0; p < constraints.size(); ++p)
      constraints.bounds[p] = half_spaces.bounds[p] - half_spaces.normal_part(p, v);
  }



  void ProjectedGaussSeidel::set_interface(const std::vector<unsigned int> &rows)
  {
    interface_rows = all_rows.subset(rows);
  }



  bool ProjectedGaussSeidel::correct_slow_interface(const std::vector<NodeIndex> &contact_nodes)
  {
    std::vector<unsigned int> contact_rows;
    for (const NodeIndex node : contact_nodes)
      if (matrix.partition().owns(node))
        contact_rows.push_back(matrix.partition().to_local(node));
    if (sweep_rate(all_rows.subset(contact_rows)) < slow)
      return false;
    interface_correction = std::make_unique<InterfaceCorrection>(matrix, contact_nodes);
    blocks.drop_within(interface_correction->contact_rows());
    block_rows = blocks.rows();
    return true;
  }



  double ProjectedGaussSeidel::sweep_rate(const SweepSchedule &schedule)
  {
    Vector error, zero;
    for (Vector *vector : {&error, &zero})
      matrix.partition().reinit(*vector);
    for (const auto &rows : schedule.phases())
      for (const unsigned int row : rows)
        for (unsigned int c = 0; c < dim; ++c)
          error.local_element(dim * row + c) =
              1. + .1 * std::sin(1. + 7. * (dim * matrix.partition().to_global(row) + c));
    const auto energy = [&] {
      error.update_ghost_values();
      double sum = 0.;
      for (const auto &rows : schedule.phases())
        for (const unsigned int row : rows)
          {
            double product[3];
            matrix.multiply_row(product, row, error);
            for (unsigned int c = 0; c < dim; ++c)
              sum += error.local_element(dim * row + c) * product[c];
          }
      return Utilities::MPI::sum(sum, matrix.partition().communicator());
    };
    double before = 0.;
    for (unsigned int sweep = 0; sweep < n_measured_sweeps; ++sweep)
      {
        if (sweep + 1 == n_measured_sweeps)
          before = energy();
        run(error, zero, schedule, forward);
        run(error, zero, schedule, backward);
      }
    return before > 0. ? std::sqrt(std::max(0., energy() / before)) : 0.;
  }



  void ProjectedGaussSeidel::run(Vector &v, const Vector &rhs, const SweepSchedule &schedule,
                                 const Direction direction)
  {
    visit(v, schedule, direction, [&](const unsigned int row) {
      direction == forward ? relax<forward>(v.begin(), rhs.begin(), row)
                           : relax<backward>(v.begin(), rhs.begin(), row);
    });
  }



  void ProjectedGaussSeidel::sweep(Vector &v, const Vector &rhs, const Direction direction)
  {
    run(v, rhs, all_rows, direction);
  }



  void ProjectedGaussSeidel::interface_sweep(Vector &v, const Vector &rhs, const Direction direction)
  {
    run(v, rhs, interface_rows, direction);
  }



  void ProjectedGaussSeidel::smooth_interface(Vector &v, const Vector &rhs,
                                              const SmoothingParameters &parameters,
                                              const Direction            direction)
  {
    for (unsigned int i = 0; i < parameters.n_interface_sweeps; ++i)
      {
        if (interface_correction && direction == backward)
          correct_interface(v, rhs);
        interface_sweep(v, rhs, direction);
        if (interface_correction && direction == forward)
          correct_interface(v, rhs);
      }
  }



  void ProjectedGaussSeidel::correct_interface(Vector &v, const Vector &rhs)
  {
    interface_correction->apply(v, rhs, ContactState{constraints, half_space_of_row, is_active});
  }



  void ProjectedGaussSeidel::sweep_blocks(Vector &v, const Vector &rhs, const Direction direction)
  {
    blocks.sweep(v, rhs, direction == forward, constraints, half_space_of_row, is_active);
  }



  void ProjectedGaussSeidel::smooth(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                                    const Direction direction)
  {
    if (direction == forward)
      for (unsigned int i = 0; i < parameters.n_pre; ++i)
        {
          sweep(v, rhs, forward);
          sweep_blocks(v, rhs, forward);
        }
    smooth_interface(v, rhs, parameters, direction);
    if (direction == backward)
      for (unsigned int i = 0; i < parameters.n_post; ++i)
        {
          sweep_blocks(v, rhs, backward);
          sweep(v, rhs, backward);
        }
  }



  void ProjectedGaussSeidel::project(Vector &v)
  {
    for (std::size_t p = 0; p < constraints.size(); ++p)
      project_row(v.begin() + dim * static_cast<std::size_t>(constraints.nodes[p]), static_cast<int>(p));
  }



  void ProjectedGaussSeidel::find_active(Vector &v, const Vector &rhs)
  {
    project(v);
    interface_sweep(v, rhs, forward);
  }



  void ProjectedGaussSeidel::restrict_to_tangents(Vector &residual) const
  {
    for (std::size_t p = 0; p < constraints.size(); ++p)
      if (is_active[p])
        {
          double *const  r      = residual.begin() + dim * static_cast<std::size_t>(constraints.nodes[p]);
          const Vector3 &n      = constraints.normals[p];
          const double   normal = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
          for (unsigned int c = 0; c < dim; ++c)
            r[c] -= normal * n[c];
        }
  }



  double ProjectedGaussSeidel::normal_product(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (std::size_t p = 0; p < constraints.size(); ++p)
      if (is_active[p])
        {
          double normal_a = 0., normal_b = 0.;
          for (unsigned int c = 0; c < dim; ++c)
            {
              const std::size_t i = dim * static_cast<std::size_t>(constraints.nodes[p]) + c;
              normal_a += constraints.normals[p][c] * a.local_element(i);
              normal_b += constraints.normals[p][c] * b.local_element(i);
            }
          sum += normal_a * normal_b;
        }
    return Utilities::MPI::sum(sum, matrix.partition().communicator());
  }



  void ProjectedGaussSeidel::project_correction(Vector &correction, const Vector &v) const
  {
    restrict_to_tangents(correction);
    for (std::size_t p = 0; p < constraints.size(); ++p)
      if (!is_active[p])
        {
          const std::size_t i      = dim * static_cast<std::size_t>(constraints.nodes[p]);
          double            excess = -constraints.bounds[p];
          for (unsigned int c = 0; c < dim; ++c)
            excess += constraints.normals[p][c] * (v.local_element(i + c) + correction.local_element(i + c));
          if (excess > 0.)
            for (unsigned int c = 0; c < dim; ++c)
              correction.local_element(i + c) -= excess * projection_direction[p][c];
        }
  }



  double ProjectedGaussSeidel::sweep_bytes() const
  {
    // Blocks and columns, row pointers and half-space index, inverse diagonal, right hand side,
    // solution read and written once; the diagonal blocks are skipped.
    const double rows = matrix.n_rows(), blocks_read = static_cast<double>(matrix.n_owned_blocks()) - rows;
    return blocks_read * (9. * sizeof(double) + sizeof(unsigned int)) +
           rows * (9. * sizeof(double) + 2 * sizeof(std::size_t) + 2 * sizeof(int) + 9. * sizeof(double));
  }
} // namespace Signorini
