// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/final_words.h>
#include <signorini/output/results.h>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

using namespace Signorini;

namespace
{
  /// Two surfaces that lie over each other.
  MappingReport perfect_report()
  {
    MappingReport report;
    report.area_nonmortar = report.area_covered = 2.;
    report.area_mortar = report.area_mortar_covered = 3.;
    report.worst_tiling_defect                      = 1e-14;
    return report;
  }

  std::string words_at_the_end(const MappingReport &report, const bool errors_matter = true)
  {
    Results results;
    results.mappings.emplace_back();
    results.mappings[0].pair          = "interface";
    results.mappings[0].report        = report;
    results.mappings[0].errors_matter = errors_matter;
    std::ostringstream out;
    print_final_words(out, results);
    return out.str();
  }
} // namespace



// A bearing has many pairs.
TEST(FinalWords, ErrorsThatDoNotMatterAreSaidOnce)
{
  Results results;
  for (const char *const name : {"in", "out", "seat"})
    {
      results.mappings.emplace_back();
      results.mappings.back().pair                       = name;
      results.mappings.back().report                     = perfect_report();
      results.mappings.back().report.worst_tiling_defect = 1e-3;
      results.mappings.back().errors_matter              = std::string(name) == "seat";
    }
  std::ostringstream out;
  print_final_words(out, results);
  const std::string text = out.str();
  EXPECT_NE(text.find("WARNING: pair seat: the contact mapping has errors (a triangle"), std::string::npos)
      << text;
  EXPECT_NE(
      text.find("WARNING: pairs in, out: the contact mapping has errors (of each pair: mappings/errors in "
                "summary.json): none is near"),
      std::string::npos)
      << text;
}

TEST(FinalWords, TellScatterOfPressures)
{
  const auto words = [](const double scatter) {
    Results results;
    results.pairs.emplace_back();
    PairResult &pair            = results.pairs.back();
    pair.load                   = 1.;
    pair.contact_area           = 1.;
    pair.max_pressure           = 2.;
    pair.max_recovered_pressure = 1.5;
    pair.pressure_scatter       = scatter;
    std::ostringstream out;
    print_final_words(out, results);
    return out.str();
  };
  EXPECT_EQ(words(.02).find("scatter"), std::string::npos) << words(.02);
  EXPECT_NE(words(.123).find("smoothed 1.5\n  pressures of nodes scatter: half of the load is on nodes that "
                             "differ by 12 % or more from the smoothed pressure\n"),
            std::string::npos)
      << words(.123);
}

// Damaged surfaces: what covers a triangle twice or not at all, or a surface more than once, is the last
// thing that is read, whatever else has been printed.
TEST(FinalWords, WarnOfMappingErrors)
{
  EXPECT_EQ(describe_errors(perfect_report()), "");
  EXPECT_EQ(words_at_the_end(perfect_report()).find("WARNING"), std::string::npos);
  const auto expect_warning = [](const MappingReport &report, const std::string &what) {
    const std::string text = words_at_the_end(report);
    EXPECT_NE(text.find("WARNING: pair interface: the contact mapping has errors ("), std::string::npos)
        << text;
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  MappingReport report       = perfect_report();
  report.worst_tiling_defect = 1e-3;
  expect_warning(report, "covered wrongly by 0.001 of its area");
  report              = perfect_report();
  report.area_covered = 3.;
  expect_warning(report, "nonmortar surface covered to 150 %");
  report                     = perfect_report();
  report.area_mortar_covered = 4.5;
  expect_warning(report, "the mortar surface covered to 150 %");
  report.area_mortar_covered = std::numeric_limits<double>::quiet_NaN();
  expect_warning(report, "the mortar surface covered to nan %");
  report                     = perfect_report();
  report.worst_tiling_defect = 1e-3;
  EXPECT_NE(words_at_the_end(report, false).find("none is near where the bodies touch"), std::string::npos);
  report.area_covered = 3.;
  EXPECT_TRUE(covers_twice(report));
  EXPECT_FALSE(covers_twice(perfect_report()));
}



// The worst body is told, and each one that is too coarse; what is no number is not fine.
TEST(FinalWords, CoarseMeshes)
{
  Results results;
  for (const char *const name : {"pin", "spring", "plate"})
    {
      results.bodies.emplace_back();
      results.bodies.back().name = name;
    }
  const auto words = [&] {
    std::ostringstream out;
    print_final_words(out, results);
    return out.str();
  };
  results.bodies[0].stress_error = .12;
  EXPECT_TRUE(coarse_meshes(results).empty());
  EXPECT_NE(words().find("meshes are fine: yes (estimated error of stresses 12 % or less, most in body pin)"),
            std::string::npos)
      << words();
  results.bodies[1].stress_error = .5;
  ASSERT_EQ(coarse_meshes(results).size(), 1u);
  EXPECT_NE(words().find(
                "meshes are fine: NO (estimated error of stresses 50 % or less, most in body spring)\n"
                "  the mesh of body spring is coarse for it: estimated error of its stresses 50 %, and under "
                "given forces it moves less than it would, by about 25 %."),
            std::string::npos)
      << words();
  results.bodies[2].stress_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(coarse_meshes(results).size(), 2u);
}
