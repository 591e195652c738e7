// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/solvers/free_motion_correction.h>
#include <signorini/solvers/smoother.h>

#include <deal.II/base/mpi.h>

#include <limits>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::vector<double> dot_products(const std::vector<Vector> &vectors, const Vector &x)
    {
      std::vector<double> result;
      for (const Vector &vector : vectors)
        result.push_back(vector * x);
      return result;
    }

    std::vector<double> multiply(const std::vector<double> &matrix, const std::vector<double> &x)
    {
      const std::size_t   n = x.size();
      std::vector<double> result(n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          result[i] += matrix[n * i + j] * x[j];
      return result;
    }
  } // namespace



  FreeMotionCorrection::FreeMotionCorrection(const NodeBlockMatrix     &matrix,
                                             const std::vector<Vector> &free_motions, const Vector &rhs)
    : matrix(matrix)
    , motions(free_motions)
    , tangential(free_motions)
    , products(free_motions)
  {
    if (motions.empty())
      return;
    const double scale = Rule().rounding * rhs.l1_norm();
    for (const Vector &motion : motions)
      {
        const double work = motion * rhs;
        loads.push_back(std::abs(work) > scale * motion.linfty_norm() ? work : 0.);
      }
  }



  void FreeMotionCorrection::restore_work(Vector &residual) const
  {
    const std::vector<double> work = dot_products(motions, residual);
    residual.zero_out_ghost_values();
    for (std::size_t i = 0; i < motions.size(); ++i)
      residual.add(loads[i] - work[i], motions[i]);
  }



  void FreeMotionCorrection::update(const ContactState &contact)
  {
    const bool changes = !motions.empty() && (!active || *active != contact.active());
    if (Utilities::MPI::max(static_cast<int>(changes), matrix.partition().communicator()) == 0)
      return;
    active                   = contact.active();
    const auto        n      = static_cast<Eigen::Index>(motions.size());
    const HalfSpaces &spaces = contact.half_spaces();
    Eigen::MatrixXd   energies(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      {
        tangential[i] = motions[i];
        products[i]   = 0.;
        for (std::size_t p = 0; p < spaces.size(); ++p)
          if ((*active)[p])
            {
              const double  length      = spaces.normal_part(p, motions[i]);
              const Vector3 normal_part = length * spaces.normals[p];
              spaces.add_normal(tangential[i], p, -length);
              subtract_change(products[i].begin(), matrix, spaces.nodes[p], &normal_part[0]);
            }
        products[i].compress(VectorOperation::add);
        const std::vector<double> row = dot_products(tangential, products[i]);
        for (Eigen::Index j = 0; j <= i; ++j)
          energies(i, j) = energies(j, i) = row[j];
      }
    const double         opposed          = largest_opposition(spaces);
    const SymmetricEigen eigen            = symmetric_eigen(energies);
    Eigen::MatrixXd      inverse_energies = Eigen::MatrixXd::Zero(n, n), idle = inverse_energies;
    for (Eigen::Index k = 0; k < n; ++k)
      {
        const double          energy = eigen.values[k];
        const Eigen::MatrixXd part   = eigen.vectors.col(k) * eigen.vectors.col(k).transpose();
        if (energy <= Rule().costs_nothing * opposed)
          idle += part;
        else
          inverse_energies += part / energy;
      }
    const Eigen::Map<const Eigen::VectorXd> work(loads.data(), n);
    const Eigen::VectorXd                   way = idle * work;
    driven                                      = way.norm() > Rule().no_work * work.norm();
    if (driven)
      idle -= way * way.transpose() / way.squaredNorm();
    flight.assign(way.data(), way.data() + n);
    inverse.assign(inverse_energies.data(), inverse_energies.data() + n * n);
    projector.assign(idle.data(), idle.data() + n * n);
  }



  double FreeMotionCorrection::drive(Vector &c, const ContactState &contact) const
  {
    if (!driven)
      return 0.;
    Vector motion = c;
    motion        = 0.;
    add(motion, flight);
    const double length = contact.longest_step(c, motion);
    if (length == std::numeric_limits<double>::max())
      return 0.;
    c.add(length, motion);
    return length * std::inner_product(flight.begin(), flight.end(), loads.begin(), 0.);
  }



  double FreeMotionCorrection::largest_opposition(const HalfSpaces &spaces) const
  {
    std::vector<double> sums(motions.size(), 0.);
    for (std::size_t p = 0; p < active->size(); ++p)
      if ((*active)[p])
        {
          const unsigned int  row   = spaces.nodes[p];
          const double *const block = matrix.block(matrix.diagonal(row));
          for (std::size_t i = 0; i < motions.size(); ++i)
            for (unsigned int c = 0; c < dim; ++c)
              sums[i] += (block[0] + block[4] + block[8]) / dim *
                         Utilities::fixed_power<2>(motions[i].local_element(dim * row + c));
        }
    Utilities::MPI::sum(sums, matrix.partition().communicator(), sums);
    return *std::max_element(sums.begin(), sums.end());
  }



  void FreeMotionCorrection::add(Vector &c, const std::vector<double> &coefficients) const
  {
    c.zero_out_ghost_values();
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      if (coefficients[i] != 0.)
        c.add(coefficients[i], tangential[i]);
  }



  std::vector<double> FreeMotionCorrection::minimize(Vector &residual) const
  {
    const std::vector<double> s = multiply(inverse, dot_products(tangential, residual));
    residual.zero_out_ghost_values();
    for (std::size_t i = 0; i < s.size(); ++i)
      residual.add(-s[i], products[i]);
    return s;
  }



  void FreeMotionCorrection::complete(Vector &c, const std::vector<double> &s, const Vector &residual,
                                      const Vector &z, const ContactState &contact) const
  {
    std::vector<double>       work   = dot_products(tangential, residual);
    const std::vector<double> change = dot_products(products, c);
    for (std::size_t i = 0; i < work.size(); ++i)
      work[i] -= change[i];
    add(c, s);
    add(c, multiply(inverse, work));
    remove_idle(c, z, contact);
  }



  void FreeMotionCorrection::remove_idle(Vector &c, const Vector &z, const ContactState &contact) const
  {
    std::vector<double> idle = multiply(projector, dot_products(motions, c));
    if (std::all_of(idle.begin(), idle.end(), [](const double x) { return x == 0.; }))
      return;
    const double before = std::min(1., contact.longest_step(z, c));
    for (double &x : idle)
      x = -x;
    Vector shifted = c;
    add(shifted, idle);
    if (contact.longest_step(z, shifted) >= (1. - Rule().shorter) * before)
      c.swap(shifted);
  }
} // namespace Signorini
