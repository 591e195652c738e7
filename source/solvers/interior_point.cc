// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "interior_point.h"
#include "gathered_states.h"
#include "single_threaded.h"

namespace Signorini
{
  namespace
  {
    constexpr std::size_t none = -1;
  } // namespace



  InteriorPoint::InteriorPoint(const GatheredBlocks &matrix, const std::vector<NodeState> &states,
                               GatheredBlocks::UpperHalf &upper, Cholesky &cholesky)
    : matrix(matrix)
    , states(states)
    , upper(upper)
    , cholesky(cholesky)
    , place(states.size(), none)
    , load(residual_of(states))
    , s(Eigen::VectorXd::Zero(dim * states.size()))
    , regularization(Rule().regularization)
  {
    for (std::size_t i = 0; i < states.size(); ++i)
      if (states[i].room >= 0.)
        {
          place[i] = constrained.size();
          constrained.push_back(i);
        }
  }



  Eigen::VectorXd InteriorPoint::normal_parts(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd result(constrained.size());
    for (std::size_t p = 0; p < constrained.size(); ++p)
      result[p] = normal_part(x, constrained[p], states[constrained[p]].normal);
    return result;
  }



  void InteriorPoint::subtract_pressures(Eigen::VectorXd &forces, const Eigen::VectorXd &pressures) const
  {
    for (std::size_t p = 0; p < constrained.size(); ++p)
      add_normal(forces, constrained[p], states[constrained[p]].normal, -pressures[p]);
  }



  bool InteriorPoint::factorize()
  {
    for (; regularization <= Rule().most_regularization; regularization *= Rule().growth)
      {
        matrix.fill_upper(upper,
                          [&](const std::size_t row, const std::size_t column, const double *const block) {
                            Block result = read_block(block);
                            if (row != column)
                              return result;
                            result *= 1. + regularization;
                            if (const std::size_t p = place[row]; p != none)
                              result += (l[p] / w[p]) * outer_product(states[row].normal, states[row].normal);
                            return result;
                          });
        const SingleThreaded single_threaded;
        cholesky.factorize(upper);
        if (cholesky.info() == Eigen::Success)
          return true;
      }
    return false;
  }



  InteriorPoint::Change InteriorPoint::newton(const Eigen::VectorXd &products) const
  {
    const Eigen::VectorXd pressures = ((products - l.cwiseProduct(way_defect)).array() / w.array()).matrix();
    Eigen::VectorXd       forces    = force_defect;
    subtract_pressures(forces, pressures);
    Change                result;
    const Eigen::VectorXd way = normal_parts(result.s = cholesky.solve(forces));
    result.w                  = way_defect - way;
    result.l                  = pressures + (l.cwiseProduct(way).array() / w.array()).matrix();
    return result;
  }



  double InteriorPoint::longest(const Change &change) const
  {
    double result = 1.;
    for (Eigen::Index p = 0; p < w.size(); ++p)
      {
        if (change.w[p] < 0.)
          result = std::min(result, -Rule().part_of_way * w[p] / change.w[p]);
        if (change.l[p] < 0.)
          result = std::min(result, -Rule().part_of_way * l[p] / change.l[p]);
      }
    return result;
  }



  bool InteriorPoint::run()
  {
    const auto n = static_cast<Eigen::Index>(constrained.size());
    if (n == 0)
      return false;
    Eigen::VectorXd room(n);
    double          stiffness = 0.;
    for (Eigen::Index p = 0; p < n; ++p)
      {
        room[p] = states[constrained[p]].room;
        stiffness += trace(matrix.diagonal_block(constrained[p])) / (dim * static_cast<double>(n));
      }
    scale_l     = std::max(load.norm() / std::sqrt(n), std::numeric_limits<double>::min());
    scale_w     = scale_l / stiffness;
    l           = normal_parts(load).cwiseMax(0.).array() + scale_l;
    w           = room.array() + scale_w;
    double rest = 1.;
    for (unsigned int k = 0; k < Rule().n_iterations && rest > Rule().tolerance; ++k)
      {
        force_defect = load - matrix * s;
        subtract_pressures(force_defect, l);
        way_defect              = room - normal_parts(s) - w;
        const double complement = w.dot(l) / static_cast<double>(n);
        rest = std::max({complement / (scale_w * scale_l), force_defect.norm() / load.norm(),
                         way_defect.lpNorm<Eigen::Infinity>() / scale_w});
        if (!factorize())
          break;
        const Change predicted = newton(-w.cwiseProduct(l));
        const double length    = longest(predicted);
        const double then = (w + length * predicted.w).dot(l + length * predicted.l) / static_cast<double>(n);
        const double center = complement * std::pow(then / complement, 3);
        const Eigen::VectorXd products =
            (center - w.array() * l.array() - predicted.w.array() * predicted.l.array()).matrix();
        const Change change = newton(products);
        const double step   = longest(change);
        s += step * change.s;
        w += step * change.w;
        l += step * change.l;
      }
    return rest <= Rule().enough;
  }



  std::vector<unsigned char> InteriorPoint::active() const
  {
    std::vector<unsigned char> result(states.size(), 0);
    for (std::size_t p = 0; p < constrained.size(); ++p)
      result[constrained[p]] = l[p] * scale_w > w[p] * scale_l;
    return result;
  }
} // namespace Signorini
