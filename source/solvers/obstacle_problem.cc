// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/obstacle_problem.h>

namespace Signorini
{
  double HalfSpaces::normal_part(const std::size_t p, const Vector &v) const
  {
    double sum = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      sum += normals[p][c] * v.local_element(dim * nodes[p] + c);
    return sum;
  }



  void HalfSpaces::add_normal(Vector &v, const std::size_t p, const double length) const
  {
    for (unsigned int c = 0; c < dim; ++c)
      v.local_element(dim * nodes[p] + c) += length * normals[p][c];
  }



  double HalfSpaces::longest_step(const Vector &v, const Vector &c,
                                  const std::vector<unsigned char> *const ignored) const
  {
    double step = std::numeric_limits<double>::max();
    for (std::size_t p = 0; p < size(); ++p)
      if (ignored == nullptr || !(*ignored)[p])
        if (const double motion = normal_part(p, c); motion > 0.)
          step = std::min(step, std::max(bounds[p] - normal_part(p, v), 0.) / motion);
    return step;
  }



  Block restrict_to_planes(const Block &block, const Vector3 &row_normal, const Vector3 &column_normal,
                           const bool is_diagonal)
  {
    Block        result    = block;
    const double stiffness = row_normal * (result * row_normal);
    result -= outer_product(row_normal, row_normal * result);
    result -= outer_product(result * column_normal, column_normal);
    if (is_diagonal)
      result += stiffness * outer_product(row_normal, row_normal);
    return result;
  }
} // namespace Signorini
