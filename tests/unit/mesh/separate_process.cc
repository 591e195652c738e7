// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "expect_in.h"
#include "mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/separate_process.h>

#include <gtest/gtest.h>

#include <csignal>
#include <iostream>
#include <numeric>
#include <stdexcept>

using namespace Signorini;

namespace
{
  using Numbers = std::vector<double>;

  Numbers read(const std::function<Numbers()> &work, const ReadingRule &rule = {})
  {
    return read_in_separate_process<Numbers>("/no/file", "the reader", work, rule);
  }

  std::string error_of(const std::function<Numbers()> &work, const ReadingRule &rule = {})
  {
    try
      {
        read(work, rule);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "none";
  }
} // namespace



TEST(SeparateProcess, GivesBackWhatWasRead)
{
  Numbers numbers(1000000);
  std::iota(numbers.begin(), numbers.end(), .5);
  EXPECT_EQ(read([&] { return numbers; }), numbers);
  EXPECT_EQ(read([] { return Numbers(); }), Numbers());
}



TEST(SeparateProcess, PassesErrorsOn)
{
  EXPECT_EQ(error_of([]() -> Numbers { throw InputError("line 7: no number."); }), "line 7: no number.");
  EXPECT_THROW(read([]() -> Numbers { throw std::runtime_error("broken"); }), std::runtime_error);
  EXPECT_THROW(read([]() -> Numbers { throw 1; }), std::runtime_error);
}



// What happens there stays there.
TEST(SeparateProcess, SurvivesTheEndOfTheReader)
{
  testing::internal::CaptureStderr();
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGKILL, SIGTERM})
    expect_in(error_of([signal]() -> Numbers {
                std::cerr << "Segmentation fault" << std::endl;
                raise(signal);
                return {};
              }),
              "the reader breaks down over it (signal " + std::to_string(signal) + ")");
  expect_in(error_of([]() -> Numbers { _exit(0); }), "breaks down");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}



TEST(SeparateProcess, EndsWhatTakesTooLong)
{
  ReadingRule rule;
  rule.seconds = 1.;
  expect_in(error_of(
                []() -> Numbers {
                  for (volatile unsigned int i = 0;;)
                    i = i + 1;
                },
                rule),
            "has not read it within 1 s");
}



TEST(SeparateProcess, EndsWhatTakesTooMuchMemory)
{
#ifdef SIGNORINI_SANITIZED
  GTEST_SKIP() << "the sanitizer itself ends a process that gets no more memory";
#endif
  ReadingRule rule;
  rule.bytes = 2e8;
  expect_in(error_of([] { return Numbers(100000000, 1.); }, rule), "more than 0.2 GB");
}



// Batch systems block signals, and programs have handlers: neither concerns the reader.
TEST(SeparateProcess, HasTheUsualSignals)
{
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGXCPU);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const std::string error = error_of([]() -> Numbers {
    raise(SIGTERM);
    return {};
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  expect_in(error, "signal " + std::to_string(SIGTERM));
}
