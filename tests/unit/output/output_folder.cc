// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/output/output_folder.h>
#include <signorini/output/termination.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace Signorini;
namespace fs = std::filesystem;

namespace
{
  /// Whether a signal comes as soon as a folder has been made.
  bool signal_comes = false;
} // namespace

/// In place of libc's, for libstdc++ too.
extern "C" int
mkdir(const char *path, const mode_t mode) noexcept
{
  const int result = mkdirat(AT_FDCWD, path, mode);
  if (result == 0 && signal_comes)
    {
      kill(getpid(), SIGTERM);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  return result;
}

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

TEST_F(OutputFolders, NothingIsLeftBySignalAtTheFirstMoment)
{
  if (is_root())
    {
      const auto begin = [this] {
        std::signal(SIGTERM, SIG_DFL);
        TerminationWatch::start();
        signal_comes = true;
        const OutputFolder folder(base + "/out", MPI_COMM_SELF);
        alarm(20);
        pause();
      };
      EXPECT_EXIT(begin(), testing::KilledBySignal(SIGTERM), "no results were written");
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

TEST_F(OutputFolders, NeedANameOfTheirOwn)
{
  EXPECT_THROW(OutputFolder("", MPI_COMM_WORLD), InputError);
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

namespace
{
  /// Writes one file with a text and commits.
  std::string write_results_of(const std::string &name, const std::string &file, const bool is_root,
                               const Outcome outcome = Outcome::complete)
  {
    OutputFolder folder(name, MPI_COMM_WORLD);
    if (is_root)
      std::ofstream(folder.path() + file) << file;
    return folder.commit(outcome);
  }
} // namespace

TEST_F(OutputFolders, FilesOfTheUserStay)
{
  write_results_of(base + "/out", "first", is_root());
  if (is_root())
    std::ofstream(base + "/out/remarks") << "text";
  MPI_Barrier(MPI_COMM_WORLD);
  write_results_of(base + "/out", "second", is_root());
  EXPECT_TRUE(fs::exists(base + "/out/remarks"));
  EXPECT_TRUE(fs::exists(base + "/out/second"));
  EXPECT_FALSE(fs::exists(base + "/out/first"));
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(OutputFolders, FolderThatOneWorksInIsReplacedInPlace)
{
  write_results_of(base + "/out", "first", is_root());
  const fs::path before = fs::current_path();
  fs::current_path(base + "/out");
  if (is_root())
    std::ofstream("remarks") << "text";
  MPI_Barrier(MPI_COMM_WORLD);
  for (const char *name : {".", "../out", "./"})
    {
      EXPECT_EQ(fs::canonical(write_results_of(name, "second", is_root())), fs::canonical(base + "/out"));
      MPI_Barrier(MPI_COMM_WORLD);
      // Through the working directory, which must be the same folder as before.
      EXPECT_TRUE(fs::exists("second"));
      EXPECT_TRUE(fs::exists("remarks"));
      EXPECT_FALSE(fs::exists("first"));
      EXPECT_EQ(std::distance(fs::directory_iterator("."), fs::directory_iterator()), 3);
    }
  {
    OutputFolder unfinished(".", MPI_COMM_WORLD);
    EXPECT_TRUE(fs::exists("second"));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(std::distance(fs::directory_iterator("."), fs::directory_iterator()), 3);
  MPI_Barrier(MPI_COMM_WORLD);
  fs::current_path(before);
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(OutputFolders, ResultsThatDidNotConvergeDoNotReplaceOthers)
{
  EXPECT_EQ(fs::path(write_results_of(base + "/out", "bad", is_root(), Outcome::not_converged)).filename(),
            "out");
  EXPECT_EQ(fs::path(write_results_of(base + "/out", "good", is_root())).filename(), "out");
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_EQ(fs::path(write_results_of(base + "/out", "bad", is_root(), Outcome::not_converged)).filename(),
              "out-not-converged");
  EXPECT_TRUE(fs::exists(base + "/out/good"));
  EXPECT_FALSE(fs::exists(base + "/out/bad"));
  EXPECT_EQ(n_entries(), 2u);
}

TEST_F(OutputFolders, FolderThatSomebodyElseMakesMeanwhileStays)
{
  for (const std::string mine : {"", ".signorini"})
    {
      OutputFolder folder(base + "/out", MPI_COMM_WORLD);
      if (is_root())
        {
          std::ofstream(folder.path() + "result") << "text";
          fs::create_directories(base + "/out");
          std::ofstream(base + "/out/thesis") << "text";
          if (!mine.empty())
            std::ofstream(base + "/out/" + mine) << "id another\nfile thesis\n";
        }
      EXPECT_EQ(fs::path(folder.commit()).filename(), "out-2");
      MPI_Barrier(MPI_COMM_WORLD);
      EXPECT_TRUE(fs::exists(base + "/out/thesis"));
      EXPECT_TRUE(fs::exists(base + "/out-2/result"));
      EXPECT_EQ(n_entries(), 2u);
      if (is_root())
        for (const char *name : {"/out", "/out-2"})
          fs::remove_all(base + name);
      MPI_Barrier(MPI_COMM_WORLD);
    }
}

TEST_F(OutputFolders, WhatKilledProcessesLeaveIsRemoved)
{
  if (is_root())
    for (const std::string outcome : {"unfinished", "complete"})
      {
        fs::create_directories(base + "/out.part-99999999-" + outcome);
        char host[256] = "";
        gethostname(host, sizeof(host) - 1);
        std::ofstream(base + "/out.part-99999999-" + outcome + "/.signorini")
            << "host " << host << "\nprocess 99999999\noutcome " << outcome << "\n";
      }
  MPI_Barrier(MPI_COMM_WORLD);
  write_results_of(base + "/out", "result", is_root());
  EXPECT_TRUE(fs::exists(base + "/out.part-99999999-complete"));
  EXPECT_EQ(n_entries(), 2u);
}
