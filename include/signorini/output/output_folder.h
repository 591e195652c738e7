// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_output_folder_h
#define signorini_output_output_folder_h

#include <signorini/output/termination.h>

#include <mpi.h>

#include <string>

namespace Signorini
{
  /// What the results in a folder are worth.
  enum class Outcome
  {
    complete,
    not_converged
  };

  /// A folder of results that is never half-written: files go to a temporary folder beside it, which takes
  /// the final name in commit(). Without commit(), and when a signal ends the process (TerminationWatch), the
  /// temporary folder is removed and earlier results stay. Which files are results stands in the file
  /// .signorini of the folder; others that lie there stay, too.
  class OutputFolder
  {
  public:
    /// Collective. Errors: InputError if the folder cannot be made, or if it exists, is not empty and was not
    /// written by this program (known by its file .signorini).
    OutputFolder(const std::string &folder, const MPI_Comm communicator);
    ~OutputFolder();

    OutputFolder(const OutputFolder &) = delete;

    /// The ranks that write there.
    MPI_Comm communicator() const
    {
      return comm;
    }

    /// The folder for what an interrupted run needs to go on: beside the results, or in their folder where
    /// that keeps its place. It is no result and stays when results are replaced.
    const std::string &checkpoint() const
    {
      return for_checkpoint;
    }

    /// On rank 0: "complete" or "not converged" where there were results at the beginning, else empty.
    std::string earlier_results() const;

    /// What the user hears last if a signal ends the run, beside that earlier results are unchanged.
    void set_last_words(const std::string &text);

    /// The same for one who has a Delay.
    void set_last_words(const std::string &text, const TerminationWatch::Delay &delay);

    /// Where to write, with a slash at the end.
    const std::string &path() const
    {
      return temporary;
    }

    /// Collective. Replaces older results by the new ones and returns where they are: in the folder, or
    /// beside it where earlier results are worth more (those that did not converge do not replace complete
    /// ones) and where somebody else has written there meanwhile. Errors: InputError if the disk is full,
    /// and the like; then earlier results are as they were.
    std::string commit(const Outcome outcome = Outcome::complete);

  private:
    std::string target, temporary, for_checkpoint;
    /// Which results were there at the beginning: see the file .signorini.
    std::string    found;
    const MPI_Comm comm;
    /// Whether the temporary folder lies in the folder, because that cannot be renamed.
    bool in_place = false, committed = false;

    std::string last_words() const;
    void        make_temporary();
    void        remove_abandoned() const;
    std::string destination(const Outcome outcome) const;
    std::string beside(const std::string &word) const;
    void        replace(const std::string &folder);
    void        replace_contents();
  };
} // namespace Signorini

#endif
