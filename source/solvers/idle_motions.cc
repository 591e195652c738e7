// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/idle_motions.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

namespace Signorini
{
  using namespace dealii;

  void IdleMotions::find(const ContactState &contact)
  {
    projector.clear();
    const auto n = static_cast<Eigen::Index>(motions.size());
    if (n == 0)
      return;
    const HalfSpaces   &spaces = contact.half_spaces();
    std::vector<double> sums(n * n, 0.);
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (contact.active()[p])
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            sums[n * i + j] += spaces.normal_part(p, motions[i]) * spaces.normal_part(p, motions[j]);
    const std::vector<double> mine = sums;
    Utilities::MPI::sum(mine, motions[0].get_mpi_communicator(), sums);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::Map<Eigen::MatrixXd>(sums.data(), n, n));
    const double    largest = eigen.eigenvalues()[n - 1];
    Eigen::MatrixXd result  = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k)
      if (eigen.eigenvalues()[k] <= Rule().opposed * largest)
        result += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose();
    projector.assign(result.data(), result.data() + n * n);
  }



  void IdleMotions::remove(Vector &c, const Vector &z, const ContactState &contact) const
  {
    if (projector.empty())
      return;
    const std::size_t   n = motions.size();
    std::vector<double> parts(n), idle(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      parts[i] = motions[i] * c;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        idle[i] += projector[n * i + j] * parts[j];
    c.zero_out_ghost_values();
    const auto add = [&](const double sign) {
      for (std::size_t i = 0; i < n; ++i)
        if (idle[i] != 0.)
          c.add(sign * idle[i], motions[i]);
    };
    const double before = std::min(1., contact.longest_step(z, c));
    add(-1.);
    if (contact.longest_step(z, c) < before)
      add(1.);
  }
} // namespace Signorini
