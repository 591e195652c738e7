// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Reads the files that the standard input names, each in a process of its own, and tells what became of it:
// for mutate.py. A line of the input is "KIND FILE", one of the output
//   OUTCOME SECONDS BYTES FILE <tab> MESSAGE
// with the time of the processor, the memory beyond that at the start, and OUTCOME one of
//   read      without an error
//   refused   with the message of an InputError
//   thrown    with another exception
//   time, memory, signal N

#include "read_input.h"

#include <signorini/algebra/input_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  /// Of a child. Larger than the readers' own limits of the processes that they start.
  struct Limits
  {
    double        seconds = 10., wall_seconds = 120.;
    std::uint64_t bytes = 2000000000;
  };

  enum ExitCode
  {
    is_read = 0,
    is_refused,
    is_thrown,
    is_out_of_memory
  };

  std::uint64_t size_of_process()
  {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  }

  [[noreturn]] void run_child(const std::string &kind, const std::string &file, const int pipe_end,
                              const Limits &limits)
  {
    const struct rlimit none   = {0, 0},
                        memory = {size_of_process() + limits.bytes, size_of_process() + limits.bytes},
                        time = {static_cast<rlim_t>(limits.seconds), static_cast<rlim_t>(limits.seconds) + 1};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_AS, &memory);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (std::getenv("SIGNORINI_FUZZ_VERBOSE") == nullptr)
      for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        dup2(nowhere, stream);
    std::string message;
    ExitCode    code = is_read;
    try
      {
        read_input(kind, file);
      }
    catch (const Signorini::InputError &e)
      {
        code    = is_refused;
        message = e.what();
      }
    catch (const std::bad_alloc &)
      {
        code = is_out_of_memory;
      }
    catch (const std::exception &e)
      {
        code    = is_thrown;
        message = e.what();
      }
    catch (...)
      {
        code = is_thrown;
      }
    std::replace(message.begin(), message.end(), '\n', ' ');
    // The parent takes as much as there is.
    if (write(pipe_end, message.data(), std::min<std::size_t>(message.size(), 4000)) < 0)
      code = is_thrown;
    _exit(code);
  }

  std::string read_all(const int pipe_end)
  {
    std::string text;
    char        buffer[4096];
    for (ssize_t n; (n = read(pipe_end, buffer, sizeof(buffer))) > 0;)
      text.append(buffer, n);
    return text;
  }

  std::string outcome_of(const int status)
  {
    if (WIFSIGNALED(status))
      return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
                 ? "time"
                 : "signal " + std::to_string(WTERMSIG(status));
    switch (WEXITSTATUS(status))
      {
        case is_read:
          return "read";
        case is_refused:
          return "refused";
        case is_out_of_memory:
          return "memory";
        default:
          return "thrown";
      }
  }

  void read_one(const std::string &kind, const std::string &file, const Limits &limits)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child < 0)
      throw std::runtime_error("no process");
    if (child == 0)
      run_child(kind, file, ends[1], limits);
    close(ends[1]);
    // Of one that waits for something no time of the processor runs out.
    const pid_t watch = fork();
    if (watch == 0)
      {
        close(ends[0]);
        std::this_thread::sleep_for(std::chrono::duration<double>(limits.wall_seconds));
        kill(child, SIGKILL);
        _exit(0);
      }
    const std::string message = read_all(ends[0]);
    close(ends[0]);
    int           status = 0;
    struct rusage used;
    wait4(child, &status, 0, &used);
    kill(watch, SIGKILL);
    waitpid(watch, nullptr, 0);
    const double seconds =
        used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1e-6 * (used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    std::cout << outcome_of(status) << '\t' << seconds << '\t' << 1024. * used.ru_maxrss << '\t' << file
              << '\t' << message << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::string                              kind, file;
  while (std::cin >> kind && std::getline(std::cin >> std::ws, file))
    read_one(kind, file, Limits());
  return 0;
}
