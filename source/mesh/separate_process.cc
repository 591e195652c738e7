// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/separate_process.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <new>
#include <sstream>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__linux__)
#  include <sys/prctl.h>
#endif

namespace Signorini
{
  namespace
  {
    /// What the first byte of an answer says.
    enum Answer : char
    {
      result       = 'r',
      input_error  = 'i',
      other_error  = 'o',
      out_of_space = 'm'
    };

    /// The last byte: without it the process ended on its way.
    constexpr char end_of_answer = '.';

    struct Limits
    {
      rlim_t seconds, bytes;
    };

    Limits limits_of(const std::string &file, const ReadingRule &rule)
    {
      std::error_code error;
      const auto      found = std::filesystem::file_size(file, error);
      const double    size  = error ? 0. : static_cast<double>(found);
      return {static_cast<rlim_t>(rule.seconds + rule.seconds_per_byte * size),
              static_cast<rlim_t>(rule.bytes + rule.bytes_per_byte * size)};
    }

    void write_all(const int pipe_end, const char *data, std::size_t size)
    {
      while (size > 0)
        {
          const ssize_t n = write(pipe_end, data, size);
          if (n < 0 && errno != EINTR)
            _exit(1);
          if (n > 0)
            {
              data += n;
              size -= n;
            }
        }
    }

    void set_limit(const decltype(RLIMIT_CPU) what, const rlim_t soft, const rlim_t hard)
    {
      struct rlimit limit;
      if (getrlimit(what, &limit) != 0)
        return;
      limit.rlim_cur = std::min(soft, limit.rlim_max);
      limit.rlim_max = std::min(hard, limit.rlim_max);
      setrlimit(what, &limit);
    }

    /// Addresses that this process has already.
    rlim_t addresses()
    {
      rlim_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      return pages * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE));
    }

    /// Signals end it, and so does the end of its parent; it says nothing itself and leaves no core.
    void become_separate(const Limits &limits)
    {
#if defined(__linux__)
      prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
      for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        std::signal(signal, SIG_DFL);
      sigset_t none;
      sigemptyset(&none);
      sigaddset(&none, SIGPIPE);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      set_limit(RLIMIT_CORE, 0, 0);
      set_limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
      const rlim_t bytes = addresses() + limits.bytes;
      set_limit(RLIMIT_AS, bytes, bytes);
      const int nowhere = open("/dev/null", O_WRONLY);
      for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        dup2(nowhere, stream);
    }

    [[noreturn]] void answer(const int pipe_end, const std::function<std::string()> &read)
    {
      const auto send = [pipe_end](const Answer kind, const auto &bytes) {
        const char head = kind;
        write_all(pipe_end, &head, 1);
        write_all(pipe_end, bytes.data(), bytes.size());
        write_all(pipe_end, &end_of_answer, 1);
      };
      try
        {
          send(result, read());
        }
      catch (const InputError &e)
        {
          send(input_error, std::string(e.what()));
        }
      catch (const std::bad_alloc &)
        {
          send(out_of_space, std::string());
        }
      catch (const std::exception &e)
        {
          send(other_error, std::string(e.what()));
        }
      catch (...)
        {
          // gmsh throws plain strings and numbers as well.
          send(other_error, std::string());
        }
      // Neither destructors nor MPI: they are the parent's.
      _exit(0);
    }

    std::string read_all(const int pipe_end)
    {
      std::string       bytes;
      std::vector<char> buffer(1 << 16);
      for (;;)
        {
          const ssize_t n = ::read(pipe_end, buffer.data(), buffer.size());
          if (n == 0 || (n < 0 && errno != EINTR))
            return bytes;
          if (n > 0)
            bytes.append(buffer.data(), static_cast<std::size_t>(n));
        }
    }

    int status_of(const pid_t child)
    {
      int status = 0;
      while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
      return status;
    }

    [[noreturn]] void complain(const std::string &reader, const std::string &what)
    {
      throw InputError(reader + " " + what +
                       ". The file is damaged, or not what its name says. Write it again.");
    }

    std::string gigabytes(const rlim_t bytes)
    {
      std::ostringstream text;
      text << std::setprecision(2) << static_cast<double>(bytes) / 1e9 << " GB";
      return text.str();
    }

    std::string judge(std::string bytes, const int status, const std::string &reader, const Limits &limits)
    {
      const std::string too_long =
          "has not read it within " + std::to_string(limits.seconds) + " s of processor time";
      if (bytes.size() < 2 || bytes.back() != end_of_answer)
        {
          const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
          complain(reader, signal == SIGXCPU
                               ? too_long
                               : "breaks down over it" +
                                     (signal == 0 ? "" : " (signal " + std::to_string(signal) + ")"));
        }
      const char kind = bytes.front();
      bytes.pop_back();
      bytes.erase(bytes.begin());
      switch (kind)
        {
          case result:
            return bytes;
          case input_error:
            throw InputError(bytes);
          case out_of_space:
            complain(reader, "asks for more than " + gigabytes(limits.bytes) + " of memory for it");
          default:
            throw std::runtime_error(bytes);
        }
    }
  } // namespace



  std::string bytes_of_separate_process(const std::string &file, const std::string &reader,
                                        const std::function<std::string()> &read, const ReadingRule &rule)
  {
    const Limits limits = limits_of(file, rule);
    int          ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      return read();
    const pid_t child = fork();
    if (child == 0)
      {
        // Where the standard streams are closed the pipe has their numbers.
        const int pipe_end = fcntl(ends[1], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        become_separate(limits);
        answer(pipe_end, read);
      }
    close(ends[1]);
    if (child < 0)
      {
        close(ends[0]);
        return read();
      }
    std::string bytes = read_all(ends[0]);
    close(ends[0]);
    return judge(std::move(bytes), status_of(child), reader, limits);
  }
} // namespace Signorini
