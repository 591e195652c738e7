// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/checked_count.h>
#include <signorini/algebra/input_error.h>
#include <signorini/mesh/size_limit.h>

#include <deal.II/base/types.h>

#include <gtest/gtest.h>

using namespace Signorini;

// Before a mesh is made whose numbers would overflow, not after.
TEST(SizeLimit, RefusesUnknownsThatCannotBeNumbered)
{
  const double largest = std::numeric_limits<dealii::types::global_dof_index>::max();
  EXPECT_NO_THROW(refuse_too_many_unknowns(largest));
  try
    {
      refuse_too_many_unknowns(1.01 * largest);
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("DEAL_II_WITH_64BIT_INDICES"), std::string::npos);
    }
}



TEST(SizeLimit, RefusesCountsThatOverflow)
{
  EXPECT_EQ(checked_count(2147483647u, "numbers"), 2147483647);
  EXPECT_THROW(checked_count(2147483648u, "numbers"), std::length_error);
}
