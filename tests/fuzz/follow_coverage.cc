// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Reads a file again and again while AFL++ changes it, and dies of what must not be: for follow_coverage.py.
//   follow_coverage KIND FILE
// Processes of readers inherit the table of AFL++, so that what they run counts as well.

#include "read_input.h"

#include <signorini/algebra/input_error.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace
{
  /// What reading may take beyond what the program has at its start: as read_files.cc and mutate.py have it.
  constexpr rlim_t       bytes           = 2000000000;
  constexpr std::size_t  longest_message = 2500, shortest_message = 10;
  constexpr unsigned int files_a_process = 200;

  void limit_memory()
  {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t        limit  = pages * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE)) + bytes;
    const struct rlimit memory = {limit, limit}, none = {0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &none);
  }

  /// Other exceptions than InputError, and those without a message that anybody could read, are findings.
  void read_or_die(const std::string &kind, const std::string &file)
  {
    try
      {
        read_input(kind, file);
      }
    catch (const Signorini::InputError &e)
      {
        const std::string message = e.what();
        if (message.size() < shortest_message || message.size() > longest_message)
          std::abort();
      }
    catch (...)
      {
        std::abort();
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 3)
    {
      std::cerr << "usage: follow_coverage KIND FILE\n";
      return 2;
    }
  limit_memory();
  const std::string kind = argv[1], file = argv[2];
  // From here on AFL++ copies the process: MPI is set up once.
  __AFL_INIT();
  while (__AFL_LOOP(files_a_process))
    read_or_die(kind, file);
  // MPI is the first process's.
  _exit(0);
}
