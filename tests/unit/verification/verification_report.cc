// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// What passes and what does not, for errors that are known.

#include <signorini/algebra/input_error.h>
#include <signorini/verification/verification_report.h>

#include <gtest/gtest.h>

#include <regex>

using namespace Signorini;

namespace
{
  /// A problem of one quantity with given errors on its meshes.
  VerificationProblem problem(const VerifiedQuantity &quantity, const std::vector<double> &errors)
  {
    VerificationProblem result;
    result.name       = "made-up";
    result.quantities = {quantity};
    result.meshes.assign(errors.size(), "a mesh");
    result.run = [errors](const MPI_Comm, const unsigned int mesh) {
      VerificationRun run;
      run.errors = {errors[mesh]};
      return run;
    };
    return result;
  }

  VerifiedProblem judged(const VerifiedQuantity &quantity, const std::vector<double> &errors)
  {
    return verify(problem(quantity, errors), static_cast<unsigned int>(errors.size()), MPI_COMM_SELF);
  }

  std::string json(const VerifiedProblem &result)
  {
    std::ostringstream out;
    write_json(out, {result}, {"program", 2, true});
    return out.str();
  }

  const double no_number = std::numeric_limits<double>::quiet_NaN(),
               infinite  = std::numeric_limits<double>::infinity();
} // namespace



TEST(Verify, BarsAreByMesh)
{
  const VerifiedQuantity q{"force", "", {.1, .01}};
  EXPECT_TRUE(judged(q, {.1, .01}).passes());
  EXPECT_TRUE(judged(q, {.1, .01, .01}).passes());
  EXPECT_FALSE(judged(q, {.11, .01}).passes());
  EXPECT_FALSE(judged(q, {.1, .01, .011}).passes());
  EXPECT_EQ(judged(q, {.2, .2, .2}).failures.size(), 3u);
}

TEST(Verify, OrderIsThatOfTheLastMeshes)
{
  const VerifiedQuantity q{"L2", "", {}, 1.9};
  EXPECT_TRUE(judged(q, {.4, .1}).passes());
  EXPECT_TRUE(judged(q, {.4, .4, .1}).passes());
  EXPECT_FALSE(judged(q, {.4, .1, .03}).passes());
  // A single mesh has no order.
  EXPECT_TRUE(judged(q, {.4}).passes());
  EXPECT_NEAR(observed_orders({.4, .1, .05})[0], 2., 1e-12);
  EXPECT_NE(verdict_line(judged(q, {.4, .1})).find("order 2.00"), std::string::npos);
}

TEST(Verify, NoNumberNeverPasses)
{
  for (const VerifiedQuantity &q : {VerifiedQuantity{"L2", "", {}, 1.9}, VerifiedQuantity{"L2", "", {}},
                                    VerifiedQuantity{"L2", "", {1.}}})
    for (const double bad : {no_number, infinite, -infinite})
      {
        EXPECT_FALSE(judged(q, {.4, bad}).passes());
        EXPECT_FALSE(judged(q, {bad, .1}).passes());
        // Texts may say so; in place of a number it would be no JSON.
        EXPECT_FALSE(std::regex_search(json(judged(q, {.4, bad})), std::regex(R"([:\[,]\s*-?(nan|inf))")));
      }
}

TEST(Verify, CertificateAndExceptionsCount)
{
  const VerifiedQuantity q{"force", "", {1.}};
  VerificationProblem    with_objection = problem(q, {.1});
  with_objection.run                    = [](const MPI_Comm, const unsigned int) {
    VerificationRun run;
    run.errors     = {.1};
    run.objections = {"tension"};
    return run;
  };
  EXPECT_FALSE(verify(with_objection, 1, MPI_COMM_SELF).passes());

  VerificationProblem ends = problem(q, {.1, .1});
  ends.run                 = [&](const MPI_Comm, const unsigned int mesh) -> VerificationRun {
    if (mesh == 1)
      throw InputError("it went wrong");
    return {{.1}, 10, 3, {}};
  };
  const VerifiedProblem result = verify(ends, 2, MPI_COMM_SELF);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_NE(result.failures[0].find("it went wrong"), std::string::npos);
  std::ostringstream out;
  print_details(out, result);
  EXPECT_NE(out.str().find("FAIL: mesh 2 was not solved"), std::string::npos) << out.str();
  EXPECT_NE(json(result).find("\"passes\": false"), std::string::npos);
}

TEST(Verify, EveryProblemHasBarsAndEnoughMeshes)
{
  std::set<std::string> names;
  for (const VerificationProblem &p : verification_problems())
    {
      EXPECT_TRUE(names.insert(p.name).second) << p.name;
      EXPECT_EQ(p.name.find(' '), std::string::npos) << p.name;
      EXPECT_FALSE(p.what.empty() || p.reference.empty()) << p.name;
      EXPECT_LE(p.n_quick, p.meshes.size()) << p.name;
      for (const VerifiedQuantity &q : p.quantities)
        {
          EXPECT_TRUE(!q.most.empty() || q.least_order != VerifiedQuantity::any_order) << p.name << q.name;
          EXPECT_TRUE(p.n_quick >= 2 || q.least_order == VerifiedQuantity::any_order) << p.name;
        }
    }
}
