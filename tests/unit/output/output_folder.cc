// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/output/output_folder.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

using namespace Signorini;
namespace fs = std::filesystem;

namespace
{
  /// A folder of this test, the same on all ranks; rank 0 makes and removes it.
  class OutputFolders : public testing::Test
  {
  protected:
    OutputFolders()
      : base((fs::temp_directory_path() /
              ("signorini-test-" + std::to_string(dealii::Utilities::MPI::broadcast(
                                       MPI_COMM_WORLD, static_cast<long>(getpid()), 0))))
                 .string())
    {
      if (is_root())
        fs::create_directories(base);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    ~OutputFolders() override
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_root())
        fs::remove_all(base);
    }

    static bool is_root()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    std::size_t n_entries() const
    {
      MPI_Barrier(MPI_COMM_WORLD);
      const auto n = std::distance(fs::directory_iterator(base), fs::directory_iterator());
      MPI_Barrier(MPI_COMM_WORLD);
      return static_cast<std::size_t>(n);
    }

    const std::string base;
  };
} // namespace

TEST_F(OutputFolders, NothingIsLeftWithoutCommit)
{
  {
    OutputFolder folder(base + "/out", MPI_COMM_WORLD);
    EXPECT_EQ(n_entries(), 1u);
  }
  EXPECT_EQ(n_entries(), 0u);
}

TEST_F(OutputFolders, CommitReplacesOldResultsAsAWhole)
{
  for (const char *name : {"first", "second"})
    {
      OutputFolder folder(base + "/out", MPI_COMM_WORLD);
      if (is_root())
        std::ofstream(folder.path() + name) << name;
      folder.commit();
    }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(base + "/out/first"));
  EXPECT_TRUE(fs::exists(base + "/out/second"));
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(OutputFolders, ForeignFoldersAndFilesAreNotTouched)
{
  if (is_root())
    {
      fs::create_directories(base + "/mine");
      std::ofstream(base + "/mine/thesis") << "text";
      std::ofstream(base + "/file") << "text";
    }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(OutputFolder(base + "/mine", MPI_COMM_WORLD), InputError);
  EXPECT_THROW(OutputFolder(base + "/file", MPI_COMM_WORLD), InputError);
  EXPECT_EQ(n_entries(), 2u);
}
