// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/convergence_report.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Signorini;

namespace
{
  /// After how many iterations rounding ends these; 0: never.
  std::size_t end_at_rounding(const std::vector<double> &corrections)
  {
    for (std::size_t n = 1; n <= corrections.size(); ++n)
      if (is_at_rounding({corrections.begin(), corrections.begin() + static_cast<std::ptrdiff_t>(n)}, 1.))
        return n;
    return 0;
  }

  std::vector<double> geometric(const double rate, const double last)
  {
    std::vector<double> result = {1.};
    while (result.back() > last)
      result.push_back(rate * result.back());
    return result;
  }
} // namespace



TEST(Convergence, RoundingGoesUpAndDown)
{
  // A light shaft in a V-block: the corrections of 40 iterations, from the 14th on.
  const std::vector<double> shaft = {
      5.748e-04, 7.742e-05, 8.899e-06, 1.547e-06, 2.370e-07, 2.799e-08, 2.982e-09, 2.585e-10, 1.598e-10,
      2.051e-10, 2.051e-10, 2.483e-10, 1.131e-10, 9.375e-11, 9.374e-11, 2.258e-10, 2.696e-10, 3.289e-10,
      2.348e-10, 1.268e-10, 7.680e-12, 5.583e-11, 1.299e-10, 1.972e-10, 5.827e-11, 9.828e-11, 9.828e-11};
  EXPECT_EQ(end_at_rounding(shaft), 15u);
}



TEST(Convergence, SlowIsNotRounding)
{
  for (const double rate : {.3, .9, .99, .999})
    EXPECT_EQ(end_at_rounding(geometric(rate, 1e-13)), 0u) << rate;
}



TEST(Convergence, LargeCorrectionsAreNoRounding)
{
  std::vector<double> corrections = geometric(.3, 1e-8);
  for (unsigned int i = 0; i < 30; ++i)
    corrections.push_back(1e-8 * (1.5 + std::sin(i)));
  EXPECT_EQ(end_at_rounding(corrections), 0u);
}
