// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_checkpoints_h
#define signorini_application_checkpoints_h

#include <signorini/application/run_state.h>
#include <signorini/output/output_folder.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <string>

namespace Signorini
{
  class Journal;

  /// After which stages of a run (cycles, load steps) its state is saved.
  enum class CheckpointTimes
  {
    automatic,
    always,
    never
  };

  /// What a user says of checkpoints.
  struct CheckpointParameters
  {
    /// automatic: CheckpointRule.
    CheckpointTimes times = CheckpointTimes::automatic;
    /// Seconds that the process may take; 0 for no limit.
    double wall_time_limit = 0.;
  };

  /// When checkpoints are worth their time.
  struct CheckpointRule
  {
    /// They take at most this share of the time that a power failure would take away.
    double share = .02;
    /// What the first one is expected to take: seconds, and bytes per second; then what the last one took.
    /// (4 MB and 64 MB on the local disk of a virtual machine: 0.03 and 0.2 s, most of it fsync.)
    double first_seconds = .03, first_speed = 1e8;
  };

  /// A run that ended before its time, with a checkpoint from which it can go on.
  class RunStopped : public std::runtime_error
  {
  public:
    /// @param message why, and how to go on
    explicit RunStopped(const std::string &message)
      : std::runtime_error(message)
    {
    }
  };

  /// "3600", "90:00" (minutes) or "1:30:00" (hours) in seconds; 0 for an empty text. Errors: InputError.
  double parse_duration(const std::string &text, const std::string &where);

  /// Saves the state of a run beside its output folder, and has that of an earlier one. The last checkpoint
  /// is valid until the next one is complete; it goes when the results are there.
  class Checkpoints
  {
  public:
    /// Collective. The folder must outlive the object. Time counts from here on.
    /// @param identity of the problem (problem_identity()): who has another one may not go on
    /// @param program with its version
    Checkpoints(OutputFolder &folder, const std::string &identity, const std::string &program,
                const CheckpointParameters &parameters);
    /// The checkpoint stays, for --resume.
    ~Checkpoints();

    /// Collective. Takes the state of an earlier run. Errors: InputError that says why there is none that
    /// could be used; then nothing has been changed.
    void resume();

    /// Whether the state is to be kept up to date.
    bool are_wanted() const
    {
      return parameters.times != CheckpointTimes::never || parameters.wall_time_limit > 0.;
    }

    /// The state of this run, which others fill.
    RunState &state()
    {
      return the_state;
    }

    /// The file that the state came from, until its fields are read; null without one.
    const CheckpointReader *reader() const
    {
      return open_file.get();
    }

    /// The state is complete.
    void end_of_reading()
    {
      open_file.reset();
    }

    /// Collective. What to do with an error of the reader: the same with the name of the file.
    [[noreturn]] void refuse(const std::string &reason) const;

    /// Seconds of the runs that this one continues.
    double earlier_wall_time() const
    {
      return earlier_seconds;
    }

    /// Says whether load steps come after the cycles.
    void announce_steps(const bool follow)
    {
      steps_follow = follow;
    }

    /// Collective. Saves the state if it is time to. Errors: RunStopped if the next stage would take longer
    /// than there is time.
    /// @param stage that has just ended, in words
    /// @param growth how many times as long the next one will take; 0 if it was the last of its kind
    void end_of_stage(const std::string &stage, const double growth, Journal &journal);

    /// Collective. Removes what was saved.
    void remove();

    /// For the user, if an earlier run has left a checkpoint that this one does not go on from; else empty.
    std::string hint() const;

  private:
    bool is_time(const double now) const;
    void save(const std::string &stage, Journal &journal);
    void collect_files();
    void take_files();
    void clean_up();
    void check_identity() const;

    OutputFolder              &folder;
    const std::string          identity, program;
    const CheckpointParameters parameters;
    /// The folder of the checkpoint, its state, and the one for files of this run.
    const std::string                       place, state_file;
    std::string                             folder_of_files;
    const dealii::Timer                     clock;
    RunState                                the_state;
    std::unique_ptr<const CheckpointReader> open_file;
    double earlier_seconds = 0., last_stage = 0., last_saved = 0., last_cost = 0.;
    bool   has_saved = false, found_earlier = false, has_resumed = false, steps_follow = false;
  };
} // namespace Signorini

#endif
