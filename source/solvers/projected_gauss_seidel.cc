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
    , sees_interface(matrix.n_rows(), false)
    , inverse_diagonal(9 * static_cast<std::size_t>(matrix.n_rows()))
    , half_space_of_row(matrix.n_rows(), -1)
  {
    split_rows();
    std::vector<unsigned int> block_rows;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (blocks.contains(row))
        block_rows.push_back(row);
    sees_blocks = rows_that_see(block_rows);
    update_diagonal();
  }



  void ProjectedGaussSeidel::split_rows()
  {
    // The last phase is for nodes that no other rank sees.
    is_inner.assign(matrix.n_rows(), false);
    for (const unsigned int row : all_rows.phases().back())
      is_inner[row] = true;
    first_above.resize(matrix.n_rows());
    is_ordered                        = is_inner;
    const unsigned int *const columns = matrix.column_data();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const std::size_t end = matrix.row_end(row);
        first_above[row] =
            std::upper_bound(columns + matrix.row_begin(row) + 1, columns + end, row) - columns;
        for (std::size_t k = first_above[row]; k < end && is_ordered[row]; ++k)
          is_ordered[row] = columns[k] < matrix.n_rows() && is_inner[columns[k]];
      }
  }



  void ProjectedGaussSeidel::update_diagonal()
  {
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    update_diagonal(rows);
  }



  void ProjectedGaussSeidel::update_diagonal(const std::vector<unsigned int> &rows)
  {
    blocks.update(rows);
    if (interface_correction)
      interface_correction->update(rows);
    for (const unsigned int row : rows)
      write_block(inverse_diagonal.data() + 9 * static_cast<std::size_t>(row),
                  invert(read_block(matrix.block(matrix.row_begin(row)))));
  }



  void ProjectedGaussSeidel::set_half_spaces(const HalfSpaces &half_spaces)
  {
    constraints = half_spaces;
    is_active.assign(constraints.size(), 0);
    projection_direction.resize(constraints.size());
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



  std::vector<bool> ProjectedGaussSeidel::rows_that_see(const std::vector<unsigned int> &rows) const
  {
    std::vector<bool> result(matrix.n_rows(), false);
    for (const unsigned int row : rows)
      for (std::size_t k = matrix.row_begin(row); k < matrix.row_end(row); ++k)
        if (matrix.column(k) < matrix.n_rows())
          result[matrix.column(k)] = true;
    return result;
  }



  void ProjectedGaussSeidel::set_interface(const std::vector<unsigned int> &rows)
  {
    interface_rows = all_rows.subset(rows);
    sees_interface = rows_that_see(rows);
  }



  void ProjectedGaussSeidel::correct_slow_interface(const std::vector<NodeIndex> &contact_nodes)
  {
    std::vector<unsigned int> contact_rows;
    for (const NodeIndex node : contact_nodes)
      if (matrix.partition().owns(node))
        contact_rows.push_back(matrix.partition().to_local(node));
    if (sweep_rate(all_rows.subset(contact_rows)) < slow)
      return;
    interface_correction = std::make_unique<InterfaceCorrection>(matrix, contact_nodes);
    blocks.drop_within(interface_correction->contact_rows());
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
            double            product[3];
            const std::size_t begin = matrix.row_begin(row);
            multiply_block_row(product, matrix.block(begin), matrix.column_data() + begin,
                               matrix.row_end(row) - begin, error.begin(), matrix.block(begin));
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
        run(error, zero, schedule, forward, {});
        run(error, zero, schedule, backward, {});
      }
    return before > 0. ? std::sqrt(std::max(0., energy() / before)) : 0.;
  }



  inline void ProjectedGaussSeidel::project_row(double *const v, const int p)
  {
    const Vector3 &n      = constraints.normals[p];
    const double   excess = n[0] * v[0] + n[1] * v[1] + n[2] * v[2] - constraints.bounds[p];
    is_active[p]          = excess >= 0.;
    if (excess > 0.)
      for (unsigned int c = 0; c < dim; ++c)
        v[c] -= excess * projection_direction[p][c];
  }



  inline std::pair<std::size_t, std::size_t> ProjectedGaussSeidel::range(const unsigned int  row,
                                                                         const SweepOptions &options) const
  {
    return {matrix.row_begin(row) + 1,
            options.from_zero && is_ordered[row] ? first_above[row] : matrix.row_end(row)};
  }



  template <ProjectedGaussSeidel::Direction direction>
  inline void ProjectedGaussSeidel::relax(double *const v, const double *const rhs, const unsigned int row,
                                          const unsigned int later_row, const SweepOptions &options)
  {
    double sum[3];
    const auto [begin, end] = range(row, options);
    // Memory is read in one direction throughout, also within a row.
    (direction == forward ? multiply_block_row : multiply_block_row_backward)(
        sum, matrix.block(begin), matrix.column_data() + begin, end - begin, v,
        matrix.block(range(later_row, options).first));
    const double s0 = rhs[dim * row] - sum[0], s1 = rhs[dim * row + 1] - sum[1],
                 s2            = rhs[dim * row + 2] - sum[2];
    const double *const d      = inverse_diagonal.data() + 9 * static_cast<std::size_t>(row);
    double *const       y      = v + dim * static_cast<std::size_t>(row);
    const double        old[3] = {y[0], y[1], y[2]};
    y[0]                       = d[0] * s0 + d[1] * s1 + d[2] * s2;
    y[1]                       = d[3] * s0 + d[4] * s1 + d[5] * s2;
    y[2]                       = d[6] * s0 + d[7] * s1 + d[8] * s2;
    if (half_space_of_row[row] >= 0)
      project_row(y, half_space_of_row[row]);
    if (options.residual != nullptr && (is_inner[row] || direction == backward))
      {
        // To those that were visited before.
        const double      change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
        const std::size_t from =
            direction == forward || !is_inner[row] ? matrix.row_begin(row) + 1 : first_above[row];
        const std::size_t to = direction == backward ? matrix.row_end(row) : first_above[row];
        subtract_transposed_block_row(options.residual, matrix.block(from), matrix.column_data() + from,
                                      to - from, change);
      }
  }



  void ProjectedGaussSeidel::run(Vector &v, const Vector &rhs, const SweepSchedule &schedule,
                                 const Direction direction, const SweepOptions &options)
  {
    const std::size_t n_phases = schedule.phases().size();
    for (std::size_t i = 0; i < n_phases; ++i)
      {
        v.update_ghost_values();
        const auto       &rows = schedule.phases()[direction == forward ? i : n_phases - 1 - i];
        const std::size_t n    = rows.size();
        if (direction == forward)
          for (std::size_t k = 0; k < n; ++k)
            relax<forward>(v.begin(), rhs.begin(), rows[k], rows[std::min(k + rows_ahead, n - 1)], options);
        else
          for (std::size_t k = n; k-- > 0;)
            relax<backward>(v.begin(), rhs.begin(), rows[k],
                            rows[std::max<std::size_t>(k, rows_ahead) - rows_ahead], options);
      }
  }



  void ProjectedGaussSeidel::sweep(Vector &v, const Vector &rhs, const Direction direction)
  {
    run(v, rhs, all_rows, direction, {});
  }



  void ProjectedGaussSeidel::interface_sweep(Vector &v, const Vector &rhs, const Direction direction)
  {
    run(v, rhs, interface_rows, direction, {});
  }



  void ProjectedGaussSeidel::smooth_interface(Vector &v, const Vector &rhs,
                                              const SmoothingParameters &parameters,
                                              const Direction            direction)
  {
    const ContactState contact{constraints, half_space_of_row, is_active};
    for (unsigned int i = 0; i < parameters.n_interface_sweeps; ++i)
      {
        if (interface_correction && direction == backward)
          interface_correction->apply(v, rhs, contact);
        interface_sweep(v, rhs, direction);
        if (interface_correction && direction == forward)
          interface_correction->apply(v, rhs, contact);
      }
  }



  void ProjectedGaussSeidel::sweep_with_blocks(Vector &v, const Vector &rhs, const Direction direction,
                                               const SweepOptions &options)
  {
    if (direction == backward)
      blocks.sweep(v, rhs, false, constraints, half_space_of_row, is_active);
    run(v, rhs, all_rows, direction, options);
    if (direction == forward)
      blocks.sweep(v, rhs, true, constraints, half_space_of_row, is_active);
  }



  void ProjectedGaussSeidel::smooth(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                                    const Direction direction)
  {
    if (direction == forward)
      for (unsigned int i = 0; i < parameters.n_pre; ++i)
        sweep_with_blocks(v, rhs, direction, {});
    smooth_interface(v, rhs, parameters, direction);
    if (direction == backward)
      for (unsigned int i = 0; i < parameters.n_post; ++i)
        sweep_with_blocks(v, rhs, direction, {});
  }



  void ProjectedGaussSeidel::complete_residual(Vector &residual, const Vector &v, const Vector &rhs,
                                               const std::vector<bool> *const changed,
                                               const std::vector<bool> *const also_changed)
  {
    // What the sweep left at ghosts.
    residual.zero_out_ghost_values();
    v.update_ghost_values();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (!is_inner[row] || half_space_of_row[row] >= 0 || (changed != nullptr && (*changed)[row]) ||
          (also_changed != nullptr && (*also_changed)[row]))
        {
          double *const     r     = residual.begin() + dim * static_cast<std::size_t>(row);
          const std::size_t begin = matrix.row_begin(row);
          multiply_block_row(r, matrix.block(begin), matrix.column_data() + begin,
                             matrix.row_end(row) - begin, v.begin(), matrix.block(begin));
          for (unsigned int c = 0; c < dim; ++c)
            r[c] = rhs.local_element(dim * row + c) - r[c];
        }
  }



  void ProjectedGaussSeidel::smooth_from_zero(Vector &v, const Vector &rhs,
                                              const SmoothingParameters &parameters, Vector &residual)
  {
    v        = 0.;
    residual = 0.;
    for (unsigned int i = 0; i < parameters.n_pre; ++i)
      sweep_with_blocks(v, rhs, forward, {i == 0, i + 1 == parameters.n_pre ? residual.begin() : nullptr});
    smooth_interface(v, rhs, parameters, forward);
    if (parameters.n_pre > 0)
      complete_residual(residual, v, rhs, &sees_blocks,
                        parameters.n_interface_sweeps > 0 ? &sees_interface : nullptr);
    else
      {
        matrix.vmult(residual, v);
        residual.sadd(-1., 1., rhs);
      }
  }



  void ProjectedGaussSeidel::smooth_to_residual(Vector &v, const Vector &rhs,
                                                const SmoothingParameters &parameters, Vector &residual)
  {
    SmoothingParameters all_but_last = parameters;
    all_but_last.n_post              = std::max(parameters.n_post, 1u) - 1;
    smooth(v, rhs, all_but_last, backward);
    if (parameters.n_post > 0)
      {
        residual = 0.;
        sweep_with_blocks(v, rhs, backward, {false, residual.begin()});
        complete_residual(residual, v, rhs, nullptr, nullptr);
      }
    else
      {
        matrix.vmult(residual, v);
        residual.sadd(-1., 1., rhs);
      }
  }



  void ProjectedGaussSeidel::project(Vector &v)
  {
    for (std::size_t p = 0; p < constraints.size(); ++p)
      project_row(v.begin() + dim * static_cast<std::size_t>(constraints.nodes[p]), static_cast<int>(p));
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
    const double rows = matrix.n_rows();
    return (matrix.row_end(matrix.n_rows() - 1) - rows) * (9. * sizeof(double)) +
           static_cast<double>(matrix.row_end(matrix.n_rows() - 1)) * sizeof(unsigned int) +
           rows * (9. * sizeof(double) + sizeof(std::size_t) + 2 * sizeof(int) + 9. * sizeof(double));
  }
} // namespace Signorini
