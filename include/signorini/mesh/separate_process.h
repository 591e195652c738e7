// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_separate_process_h
#define signorini_mesh_separate_process_h

#include <signorini/algebra/byte_archive.h>

#include <functional>
#include <string>

namespace Signorini
{
  /// What reading a file may cost, far above what any intact one needs: a process that takes more is ended.
  struct ReadingRule
  {
    /// Processor time, seconds, and of each byte of the file.
    double seconds = 10., seconds_per_byte = 1e-5;
    /// Memory, bytes, and of each byte of the file. Measured: gmsh takes 10 to 30 for a byte.
    double bytes = 1e9, bytes_per_byte = 100.;
  };

  /// Reads a file in a process of its own (a fork, which ends without a word to MPI), for libraries that
  /// damaged files may bring down, keep busy for ever, or make ask for all memory. Where no process can be
  /// had, it reads in this one. Not collective.
  /// @param file its size sets the limits
  /// @param reader who reads ("gmsh"), for messages
  /// @param read runs in the process; what it does to memory is lost, but for the bytes that it returns
  /// @return those bytes
  /// Errors: InputError of the process, with its text; std::runtime_error with the text of any other
  /// exception of it; InputError where it died, or has taken more time or memory than the rule has.
  std::string bytes_of_separate_process(const std::string &file, const std::string &reader,
                                        const std::function<std::string()> &read,
                                        const ReadingRule                  &rule = {});

  /// The same for any value that ByteWriter takes.
  template <typename T>
  T read_in_separate_process(const std::string &file, const std::string &reader,
                             const std::function<T()> &read, const ReadingRule &rule = {})
  {
    return from_bytes<T>(bytes_of_separate_process(
        file, reader, [&read] { return to_bytes(read()); }, rule));
  }
} // namespace Signorini

#endif
