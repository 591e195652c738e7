// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/rounded_gauss_seidel.h>

namespace Signorini
{
  RoundedGaussSeidel::RoundedGaussSeidel(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &exact)
    : matrix(matrix)
    , exact(exact)
    , rounded(matrix)
  {
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    update(rows);
  }



  void RoundedGaussSeidel::update(const std::vector<unsigned int> &rows)
  {
    rounded.update(rows, exact.inverse_diagonal());
  }



  void RoundedGaussSeidel::start(const Vector &v, const Vector &rhs, const ContactState &contact)
  {
    rounded.start(v, rhs);
    contact_residual.resize(contact.size());
    for (const unsigned int row : contact.half_spaces().nodes)
      if (exact.is_ordered(row))
        rounded.leave_out_rhs(row);
  }



  void RoundedGaussSeidel::relax_half_space(double *const y, const double *const rhs, const unsigned int row,
                                            ContactState &contact, const bool keeps_residual)
  {
    double s[dim] = {rhs[0], rhs[1], rhs[2]};
    rounded.subtract_product(s, row);
    exact.minimize_row(y, s, row, contact);
    if (!keeps_residual)
      return;
    const double *const a = matrix.block(matrix.diagonal(row));
    Vector3            &r = contact_residual[contact.at(row)];
    for (unsigned int c = 0; c < dim; ++c)
      r[c] = s[c] - (a[dim * c] * y[0] + a[dim * c + 1] * y[1] + a[dim * c + 2] * y[2]);
    rounded.leave_out_rhs(row);
  }



  void RoundedGaussSeidel::relax_apart(Vector &v, const Vector &rhs, const unsigned int row,
                                       ContactState &contact, const RoundedSweep::Options &options)
  {
    double *const y        = v.begin() + dim * static_cast<std::size_t>(row);
    const double  old[dim] = {y[0], y[1], y[2]};
    if (!exact.is_ordered(row))
      exact.relax<Direction::forward>(v.begin(), rhs.begin(), row, contact);
    else
      relax_half_space(y, rhs.begin() + dim * static_cast<std::size_t>(row), row, contact,
                       options.keeps_residual);
    double change[dim];
    for (unsigned int c = 0; c < dim; ++c)
      change[c] = options.passes_all ? y[c] : y[c] - old[c];
    rounded.set(row, y);
    rounded.pass_down(row, change);
  }



  void RoundedGaussSeidel::sweep(Vector &v, const Vector &rhs, ContactState &contact,
                                 const RoundedSweep::Options &options)
  {
    const auto is_apart = [&](const unsigned int row) {
      return !exact.is_ordered(row) || contact.at(row) >= 0;
    };
    const auto       &phases   = exact.schedule().phases();
    const std::size_t n_phases = phases.size();
    for (std::size_t phase = 0; phase < n_phases; ++phase)
      {
        v.update_ghost_values();
        const auto &rows = phases[options.backward ? n_phases - 1 - phase : phase];
        const auto at = [&](const std::size_t k) { return rows[options.backward ? rows.size() - 1 - k : k]; };
        for (std::size_t k = 0; k < rows.size();)
          {
            const std::size_t begin = k;
            while (k < rows.size() && !is_apart(at(k)))
              ++k;
            rounded.relax(v, rows.data() + (options.backward ? rows.size() - k : begin), k - begin, options);
            for (; k < rows.size() && is_apart(at(k)); ++k)
              relax_apart(v, rhs, at(k), contact, options);
          }
      }
  }



  void RoundedGaussSeidel::follow(const Vector &v, const unsigned int row, const double *const change,
                                  const bool passes_on)
  {
    rounded.set(row, v.begin() + dim * static_cast<std::size_t>(row));
    if (passes_on)
      rounded.pass_down(row, change);
  }



  void RoundedGaussSeidel::get_residual(Vector &residual, const ContactState &contact) const
  {
    rounded.get_residual(residual);
    const std::vector<unsigned int> &nodes = contact.half_spaces().nodes;
    for (std::size_t p = 0; p < nodes.size(); ++p)
      if (exact.is_ordered(nodes[p]))
        for (unsigned int c = 0; c < dim; ++c)
          residual.local_element(dim * nodes[p] + c) += contact_residual[p][c];
  }
} // namespace Signorini
