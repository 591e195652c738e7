// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_gmsh_file_h
#define signorini_mesh_gmsh_file_h

#include <cstddef>
#include <string>

namespace Signorini
{
  /// A name under which gmsh reads a mesh and does nothing else: that of a link, in a folder that goes with
  /// the object. Beside a file gmsh runs FILE.opt as a script, commands to the shell included; so it does
  /// with files that have no head and no ending that it knows. Files of some other endings it hands to a
  /// shell.
  class GmshAlias
  {
  public:
    /// Errors: InputError for what gmsh would not read as a mesh, and where no folder can be made.
    explicit GmshAlias(const std::string &file);
    ~GmshAlias();

    GmshAlias(const GmshAlias &)            = delete;
    GmshAlias &operator=(const GmshAlias &) = delete;

    /// The name of the link.
    const std::string &path() const
    {
      return link;
    }

  private:
    std::string folder, link;
  };

  /// How many elements of dimension 3 a file in gmsh's own format (2 and 4, text and binary) contains; all
  /// versions of others, and files in other formats: `unknown_number`. gmsh reads as many elements as a file
  /// announces, drops some that it cannot place, and says so nowhere; lines that are too short spoil its
  /// memory. Errors: InputError with the line where the file announces another number of elements than it
  /// has, or where an element is of an unknown type or has another number of nodes than its type.
  std::size_t count_volume_elements(const std::string &file);

  constexpr std::size_t unknown_number = static_cast<std::size_t>(-1);
} // namespace Signorini

#endif
