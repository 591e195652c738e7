// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/rounded_gauss_seidel.h>

namespace Signorini
{
  RoundedGaussSeidel::RoundedGaussSeidel(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &exact)
    : matrix(matrix)
    , exact(exact)
    , rounded(matrix, exact.schedule().order())
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
      rounded.leave_out_rhs(row);
    for (unsigned int node = matrix.n_rows(); node < matrix.partition().n_local(); ++node)
      rounded.pass_from_ghost(node - matrix.n_rows(), v.begin() + dim * static_cast<std::size_t>(node));
  }



  void RoundedGaussSeidel::relax_apart(Vector &v, const Vector &rhs, const unsigned int row,
                                       ContactState &contact, const RoundedSweep::Options &options)
  {
    const std::size_t i      = dim * static_cast<std::size_t>(row);
    double *const     y      = v.begin() + i;
    const double      old[3] = {y[0], y[1], y[2]};
    double            s[3]   = {0., 0., 0.};
    if (contact.at(row) >= 0)
      std::copy_n(rhs.begin() + i, dim, s);
    rounded.subtract_product(s, row);
    exact.minimize_row(y, s, row, contact);
    if (options.keeps_residual)
      {
        const double *const   a = matrix.block(matrix.diagonal(row));
        std::array<double, 3> r;
        for (unsigned int c = 0; c < dim; ++c)
          r[c] = s[c] - (a[dim * c] * y[0] + a[dim * c + 1] * y[1] + a[dim * c + 2] * y[2]);
        keep_residual(r, row, contact);
      }
    double change[dim];
    for (unsigned int c = 0; c < dim; ++c)
      change[c] = options.passes_all ? y[c] : y[c] - old[c];
    rounded.set(row, y);
    rounded.pass_down(row, change);
  }



  void RoundedGaussSeidel::keep_residual(const std::array<double, 3> &residual, const unsigned int row,
                                         const ContactState &contact)
  {
    if (const int p = contact.at(row); p >= 0)
      {
        for (unsigned int c = 0; c < dim; ++c)
          contact_residual[p][c] = residual[c];
        rounded.leave_out_rhs(row);
      }
    else
      rounded.set_reduced(row, residual);
  }



  void RoundedGaussSeidel::relax(Vector &v, const Vector &rhs, const std::size_t begin, const std::size_t end,
                                 ContactState &contact, const RoundedSweep::Options &options)
  {
    const std::vector<unsigned int> &order = exact.schedule().order();
    const auto at = [&](const std::size_t k) { return options.backward ? begin + end - 1 - k : k; };
    for (std::size_t k = begin; k < end;)
      {
        const std::size_t first = k;
        while (k < end && !is_apart(order[at(k)], contact))
          ++k;
        if (options.backward)
          rounded.relax(v, begin + end - k, begin + end - first, options);
        else
          rounded.relax(v, first, k, options);
        for (; k < end && is_apart(order[at(k)], contact); ++k)
          relax_apart(v, rhs, order[at(k)], contact, options);
      }
  }



  void RoundedGaussSeidel::sweep(Vector &v, const Vector &rhs, ContactState &contact,
                                 const RoundedSweep::Options &options)
  {
    exact.schedule().visit(
        v, options.backward ? Direction::backward : Direction::forward,
        [&](const std::size_t begin, const std::size_t end) { relax(v, rhs, begin, end, contact, options); },
        [&](const unsigned int ghost, const double *const change) {
          rounded.pass_from_ghost(ghost, change);
        });
  }



  void RoundedGaussSeidel::follow(const Vector &v, const unsigned int node, const double *const change,
                                  const bool passes_on)
  {
    if (node >= matrix.n_rows())
      return rounded.pass_from_ghost(node - matrix.n_rows(), change);
    rounded.set(node, v.begin() + dim * static_cast<std::size_t>(node));
    if (passes_on)
      rounded.pass_down(node, change);
  }



  void RoundedGaussSeidel::get_residual(Vector &residual, const ContactState &contact) const
  {
    rounded.get_residual(residual);
    const std::vector<unsigned int> &nodes = contact.half_spaces().nodes;
    for (std::size_t p = 0; p < nodes.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        residual.local_element(dim * nodes[p] + c) += contact_residual[p][c];
  }
} // namespace Signorini
