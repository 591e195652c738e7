// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_gmsh_file_h
#define signorini_mesh_gmsh_file_h

#include <cstddef>
#include <string>

namespace Signorini
{
  /// Refuses what gmsh would not read as a mesh: it takes files without a head or an ending that it knows for
  /// scripts, and runs them, commands to the shell included. Errors: InputError.
  void check_gmsh_format(const std::string &file);

  /// How many elements of dimension 3 a file in gmsh's own format (2 and 4, text and binary) contains; all
  /// versions of others, and files in other formats: `unknown_number`. gmsh reads as many elements as a file
  /// announces, drops some that it cannot place, and says so nowhere; lines that are too short spoil its
  /// memory. Errors: InputError with the line where the file announces another number of elements than it
  /// has, or where an element is of an unknown type or has another number of nodes than its type.
  std::size_t count_volume_elements(const std::string &file);

  constexpr std::size_t unknown_number = static_cast<std::size_t>(-1);
} // namespace Signorini

#endif
