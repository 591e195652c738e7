// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_output_folder_h
#define signorini_output_output_folder_h

#include <mpi.h>

#include <string>

namespace Signorini
{
  /// A folder of results that is never half-written: files go to a temporary sibling, which takes the final
  /// name in commit(). Without commit() the temporary folder is removed.
  class OutputFolder
  {
  public:
    /// Collective. Errors: InputError if the folder cannot be made, or if it exists, is not empty and was not
    /// written by this program (known by its file .signorini).
    OutputFolder(const std::string &folder, const MPI_Comm communicator);
    ~OutputFolder();

    OutputFolder(const OutputFolder &) = delete;

    /// Where to write, with a slash at the end.
    const std::string &path() const
    {
      return temporary;
    }

    /// Collective. Replaces older results by the new ones.
    void commit();

  private:
    std::string    target, temporary;
    const MPI_Comm comm;
    bool           committed = false;
  };
} // namespace Signorini

#endif
