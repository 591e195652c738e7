// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/vtu_file.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace dealii;
using namespace Signorini;

namespace
{
  std::string read(const std::string &path)
  {
    std::ifstream      in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  unsigned int count(const std::string &text, const std::string &word)
  {
    unsigned int n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      ++n;
    return n;
  }

  /// Two triangles that share an edge.
  VtuPiece square()
  {
    VtuPiece piece;
    piece.points      = {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(1, 1, 0), Point<3>(0, 1, 0)};
    piece.point_items = {3, 2, 1, 0};
    piece.add_cell({{0, 1, 2}}, 3, true, 0);
    piece.add_cell({{0, 2, 3}}, 3, true, 1);
    return piece;
  }
} // namespace



TEST(VtuFile, NumberOfFiles)
{
  FileFormat format;
  EXPECT_EQ(n_files(format, 10), 10u);
  EXPECT_EQ(n_files(format, 1000), 64u);
  EXPECT_EQ(n_files(format, 1000, 3), 21u);
  EXPECT_EQ(n_files(format, 1000, 100), 1u);
  format.most_files = 0;
  EXPECT_EQ(n_files(format, 1000, 3), 1000u);
}



TEST(VtuFile, RanksShareAFile)
{
  const MPI_Comm     comm = MPI_COMM_WORLD;
  const unsigned int rank = Utilities::MPI::this_mpi_process(comm), n = Utilities::MPI::n_mpi_processes(comm);
  const std::string  path               = "vtu-file-test-" + std::to_string(n);
  const std::vector<OutputField> points = {{"stress", 6, std::vector<double>(24, 1.)},
                                           {"number", 1, {1., 2., 3., 1e15}, true}},
                                 cells  = {{"level", 1, {0., 1.}, true}};
  for (const bool is_double : {false, true})
    {
      EXPECT_TRUE(write_vtu(path, {5, 1}, square(), {points, cells}, {is_double, 1}, comm));
      MPI_Barrier(comm);
      const std::string text = read(path + ".5.vtu");
      EXPECT_EQ(count(text, "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\""), n);
      EXPECT_EQ(count(text, is_double ? "Float64" : "Float32"), 2 * n);
      EXPECT_EQ(count(text, "Int64"), 2 * n);
      EXPECT_EQ(count(text, "ComponentName5=\"XZ\""), n);
      EXPECT_EQ(count(text, "<VTKFile"), 1u);
      EXPECT_EQ(count(text, "</VTKFile>"), 1u);
      MPI_Barrier(comm);
    }
  if (rank == 0)
    std::filesystem::remove(path + ".5.vtu");
}



TEST(VtuFile, NothingToWrite)
{
  const std::vector<OutputField> none;
  EXPECT_TRUE(write_vtu("vtu-file-empty-" + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)),
                        {0, 1}, VtuPiece(), {none, none}, {}, MPI_COMM_SELF));
  const std::string name =
      "vtu-file-empty-" + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".0.vtu";
  EXPECT_EQ(count(read(name), "NumberOfPoints=\"0\""), 1u);
  std::filesystem::remove(name);
  EXPECT_FALSE(write_vtu("/no such folder/x", {0, 1}, VtuPiece(), {none, none}, {}, MPI_COMM_SELF));
}



TEST(VtuFile, CollectionHasBlocksWithNames)
{
  std::ostringstream out;
  write_collection(out, {{.1, "body a & <b>", "a.pvtu"}, {.1, "", "b.pvtu"}, {.2, "c", "c.pvtu"}});
  EXPECT_EQ(count(out.str(),
                  "timestep=\"0.1\" group=\"\" part=\"0\" name=\"body a &amp; &lt;b&gt;\" file=\"a.pvtu\""),
            1u);
  EXPECT_EQ(count(out.str(), "timestep=\"0.1\" group=\"\" part=\"1\" file=\"b.pvtu\""), 1u);
  EXPECT_EQ(count(out.str(), "timestep=\"0.2\" group=\"\" part=\"0\" name=\"c\""), 1u);
}
