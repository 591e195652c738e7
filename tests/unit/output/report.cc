// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/report_mesh.h>
#include <signorini/output/report_page.h>

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>

namespace
{
  using namespace Signorini;
  using namespace dealii;

  /// A bump of n x n quadrilaterals, finer toward x = 0.
  ReportMesh bump(const unsigned int n)
  {
    ReportMesh mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double x = std::pow(double(i) / n, 3), y = double(j) / n;
          mesh.vertices.emplace_back(x, y, .2 * std::sin(3. * x) * y);
        }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int v = j * (n + 1) + i;
          mesh.add_face({{v, v + 1, v + n + 2, v + n + 1}}, 4, false);
        }
    return mesh;
  }

  double area(const ReportMesh &mesh)
  {
    double sum = 0.;
    for (const auto &t : mesh.triangles)
      sum += .5 * cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                   mesh.vertices[t[2]] - mesh.vertices[t[0]])
                      .norm();
    return sum;
  }

  /// The text of an element of a page.
  std::string element(const std::string &page, const std::string &id)
  {
    const std::size_t at    = page.find("id=\"" + id + "\"");
    const std::size_t begin = page.find('>', at) + 1;
    return at == std::string::npos ? "" : page.substr(begin, page.find("</script>", begin) - begin);
  }
} // namespace



TEST(Report, thinnedMeshesKeepTheirShape)
{
  const ReportMesh full = bump(100);
  for (const std::size_t n : {5000, 500, 50})
    {
      ReportMesh mesh = full;
      const auto kept = thin(mesh, n);
      ASSERT_EQ(kept.size(), mesh.vertices.size());
      EXPECT_LE(mesh.triangles.size(), n);
      EXPECT_GT(mesh.triangles.size(), n / 4);
      for (std::size_t v = 0; v < kept.size(); ++v)
        EXPECT_EQ(mesh.vertices[v], full.vertices[kept[v]]);
      EXPECT_EQ(std::set<unsigned int>(kept.begin(), kept.end()).size(), kept.size());
      // Its border stays: it lies in the middle of cubes.
      EXPECT_NEAR(area(mesh), area(full), n == 50 ? .05 : .01);
      EXPECT_EQ(mesh.kinds.size(), mesh.triangles.size());
    }
  ReportMesh same = full;
  EXPECT_TRUE(thin(same, full.triangles.size()).empty());
  EXPECT_EQ(same.triangles, full.triangles);
}



TEST(Report, pinnedVerticesStayWhileOthersSuffice)
{
  const ReportMesh  full = bump(60);
  std::vector<bool> pinned(full.vertices.size(), false);
  for (std::size_t v = 0; v < pinned.size(); v += 61)
    pinned[v] = true;
  ReportMesh                   mesh = full;
  const auto                   list = thin(mesh, 1500, pinned);
  const std::set<unsigned int> kept(list.begin(), list.end());
  for (unsigned int v = 0; v < pinned.size(); ++v)
    EXPECT_TRUE(!pinned[v] || kept.count(v) == 1);
  // All of them are pinned: they give way.
  mesh = full;
  thin(mesh, 1500, std::vector<bool>(full.vertices.size(), true));
  EXPECT_LE(mesh.triangles.size(), 1500u);
}



TEST(Report, kindsComeOneAfterTheOther)
{
  ReportMesh mesh;
  mesh.vertices.resize(5);
  mesh.add_face({{0, 1, 2, 0}}, 3, true);
  mesh.add_face({{0, 1, 2, 3}}, 4, false);
  mesh.add_face({{2, 3, 4, 2}}, 3, false);
  mesh.sort_by_kind();
  EXPECT_EQ(mesh.kinds, (std::vector<unsigned char>{0, 1, 1, 2}));
  EXPECT_EQ(mesh.triangles[0], (std::array<unsigned int, 3>{{2, 3, 4}}));
  EXPECT_EQ(mesh.triangles[3], (std::array<unsigned int, 3>{{0, 1, 2}}));
}



TEST(Report, budgetShrinksWithTheStates)
{
  const ReportRule rule;
  EXPECT_GT(rule.n_triangles(1), 300000u);
  // What 50 states of so many triangles take: geometry, and fields of half as many vertices.
  EXPECT_LE(rule.n_triangles(50) * (22. + 50 * 4.), rule.bytes);
}



TEST(Report, textsCannotEndTheirElement)
{
  std::ostringstream out;
  ReportBlocks(out).json("a", [](std::ostream &o) { o << "{\"t\": \"</script><!-- <b>\"}"; });
  EXPECT_EQ(element(out.str(), "a"), "\n{\"t\": \"\\u003c/script>\\u003c!-- \\u003cb>\"}");
  std::ostringstream page;
  write_report_page(page, "<&</title>", [](ReportBlocks &) {});
  EXPECT_NE(page.str().find("<title>&lt;&amp;&lt;/title></title>"), std::string::npos);
}



TEST(Report, arraysComeBack)
{
  std::ostringstream        out;
  ReportBlocks              blocks(out);
  std::vector<unsigned int> numbers(100001);
  for (unsigned int i = 0; i < numbers.size(); ++i)
    numbers[i] = 7 * i;
  blocks.array("numbers", numbers);
  const auto decoded = Utilities::decode_base64(element(out.str(), "numbers"));
  ASSERT_EQ(decoded.size(), 4 * numbers.size());
  EXPECT_EQ(std::memcmp(decoded.data(), numbers.data(), decoded.size()), 0);

  const auto range = blocks.rounded_array("r", {-1., std::numeric_limits<double>::quiet_NaN(), 3., 1.});
  EXPECT_EQ(range, (std::pair<double, double>(-1., 3.)));
  std::uint16_t rounded[4];
  std::memcpy(rounded, Utilities::decode_base64(element(out.str(), "r")).data(), sizeof(rounded));
  EXPECT_EQ(rounded[0], 0);
  EXPECT_EQ(rounded[1], 65535);
  EXPECT_EQ(rounded[2], 65534);
  EXPECT_EQ(rounded[3], 32767);
  EXPECT_EQ(blocks.rounded_array("none", {std::nan("")}), (std::pair<double, double>(0., 0.)));
}



TEST(Report, verificationIsAPage)
{
  std::ostringstream out;
  write_verification_report(out, "{\"problems\": [], \"x\": \"<\"}\n");
  EXPECT_EQ(element(out.str(), "verification"), "\n{\"problems\": [], \"x\": \"\\u003c\"}\n");
  EXPECT_EQ(out.str().find("<!-- data -->"), std::string::npos);
  EXPECT_EQ(out.str().substr(out.str().size() - 8), "</html>\n");
}
