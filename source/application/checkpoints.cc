// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/checkpoints.h>
#include <signorini/application/journal.h>
#include <signorini/application/problem_identity.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <chrono>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace Signorini
{
  using namespace dealii;
  namespace fs = std::filesystem;

  double parse_duration(const std::string &text, const std::string &where)
  {
    if (Utilities::trim(text).empty())
      return 0.;
    double                         seconds = 0.;
    const std::vector<std::string> parts   = Utilities::split_string_list(text, ':');
    for (const std::string &part : parts)
      {
        if (parts.size() > 3 || part.empty() || part.find_first_not_of("0123456789.") != std::string::npos ||
            part[0] == '.' || std::count(part.begin(), part.end(), '.') > 1 || part.size() > 8)
          throw InputError(where + ": \"" + text +
                           "\" should be seconds, minutes:seconds or hours:minutes:seconds.");
        seconds = 60. * seconds + std::stod(part);
      }
    return seconds;
  }



  namespace
  {
    std::string duration_text(const double seconds)
    {
      const auto s = static_cast<unsigned long>(seconds + .5);
      return std::to_string(s / 3600) + ":" + Utilities::int_to_string(s / 60 % 60, 2) + ":" +
             Utilities::int_to_string(s % 60, 2);
    }

    bool is_root(const MPI_Comm comm)
    {
      return Utilities::MPI::this_mpi_process(comm) == 0;
    }

    /// Runs on rank 0; an error there is raised everywhere.
    template <typename F>
    void on_root(const MPI_Comm comm, const F &action)
    {
      std::string error;
      if (is_root(comm))
        try
          {
            action();
          }
        catch (const std::exception &e)
          {
            error = e.what();
          }
      error = broadcast_value(error, comm);
      if (!error.empty())
        throw InputError(error);
    }

    constexpr const char *start_of_folder = "files-";

    /// Whether a step writes a file once; lists of all steps are written again after each of them.
    bool is_final(const std::string &name)
    {
      const std::string list = "-steps.pvd";
      return name[0] != '.' &&
             (name.size() < list.size() || name.compare(name.size() - list.size(), list.size(), list) != 0);
    }

    /// A second name for a file, or a copy where the file system has no such names.
    void give_name(const std::string &from, const std::string &to)
    {
      std::error_code error;
      fs::create_hard_link(from, to, error);
      if (error)
        fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    }

    void sync(const std::string &file)
    {
      if (const int descriptor = open(file.c_str(), O_RDONLY); descriptor >= 0)
        {
          fsync(descriptor);
          close(descriptor);
        }
    }
  } // namespace



  Checkpoints::Checkpoints(OutputFolder &folder, const std::string &identity, const std::string &program,
                           const CheckpointParameters &parameters)
    : folder(folder)
    , identity(identity)
    , program(program)
    , parameters(parameters)
    , place(folder.checkpoint())
    , state_file(place + "/state")
  {
    on_root(folder.communicator(), [&] {
      std::error_code error;
      found_earlier   = fs::exists(state_file, error);
      const auto time = std::chrono::system_clock::now().time_since_epoch().count();
      folder_of_files = start_of_folder + std::to_string(getpid()) + "-" + std::to_string(time);
    });
  }



  Checkpoints::~Checkpoints() = default;



  void Checkpoints::refuse(const std::string &reason) const
  {
    throw InputError("--resume: the checkpoint \"" + state_file + "\" " + reason +
                     " Nothing was changed. Without --resume the run begins at its beginning.");
  }



  void Checkpoints::check_identity() const
  {
    const std::string difference = identity_difference(open_file->text("identity"), identity);
    if (!difference.empty())
      refuse("belongs to another problem: " + difference);
  }



  void Checkpoints::resume()
  {
    on_root(folder.communicator(), [&] {
      if (found_earlier)
        return;
      const std::string results = folder.earlier_results();
      if (results.empty())
        throw InputError("--resume: there is no checkpoint \"" + state_file +
                         "\". Without --resume the run begins at its beginning.");
      throw InputError("--resume: there is no checkpoint \"" + state_file +
                       "\", and the last run with this "
                       "output folder has ended; its results are " +
                       results + ".");
    });
    try
      {
        open_file = std::make_unique<CheckpointReader>(state_file, folder.communicator());
        check_identity();
        the_state = read_state(*open_file);
        take_files();
      }
    catch (const InputError &e)
      {
        const std::string text = e.what();
        if (text.compare(0, 8, "--resume") == 0)
          throw;
        refuse(text);
      }
    earlier_seconds = the_state.wall_time;
    has_resumed     = true;
    folder.set_last_words("The checkpoint " + place + " is as it was: --resume goes on from it.");
  }



  std::string Checkpoints::hint() const
  {
    const bool is_passed_over = found_earlier && !has_resumed;
    return is_passed_over ? "an interrupted run has left the checkpoint " + place +
                                ", which --resume would go on from; this run takes its place."
                          : "";
  }



  bool Checkpoints::is_time(const double now) const
  {
    if (parameters.times != CheckpointTimes::automatic)
      return parameters.times == CheckpointTimes::always;
    return last_cost <= CheckpointRule().share * (now - last_saved);
  }



  void Checkpoints::end_of_stage(const std::string &stage, const double growth, Journal &journal)
  {
    const MPI_Comm comm = folder.communicator();
    if (!are_wanted())
      return;
    if (!has_saved)
      {
        const CheckpointRule rule;
        double               bytes = 0.;
        for (const auto &values : the_state.nested.displacement)
          bytes += static_cast<double>(sizeof(double) * values.size());
        last_cost = rule.first_seconds + Utilities::MPI::sum(bytes, comm) / rule.first_speed;
      }
    // Clocks differ from rank to rank.
    const double now   = Utilities::MPI::broadcast(comm, clock.wall_time(), 0);
    const double times = growth == 0. && steps_follow && !the_state.series ? 1. : growth;
    const double next  = times * (now - last_stage);
    const bool   is_end =
        parameters.wall_time_limit > 0. && times > 0. && now + next + last_cost > parameters.wall_time_limit;
    last_stage = now;
    if (!is_end && !is_time(now))
      return;
    try
      {
        save(stage, journal);
      }
    catch (const InputError &e)
      {
        journal.note(std::string("no checkpoint after ") + stage + ": " + e.what());
        return;
      }
    last_saved = Utilities::MPI::broadcast(comm, clock.wall_time(), 0);
    last_cost  = last_saved - now;
    if (is_end)
      throw RunStopped("stopped after " + stage + " and " + duration_text(now) +
                       ": what comes next would take about " + duration_text(next) +
                       ", and Output/Wall time limit is " + duration_text(parameters.wall_time_limit) +
                       ". The state is in " + place + ".");
  }



  void Checkpoints::collect_files()
  {
    const std::string to = place + "/" + folder_of_files;
    if (fs::create_directories(place))
      sync(fs::path(place).parent_path().string());
    std::set<std::string> known;
    for (const auto &[name, size] : the_state.files)
      known.insert(name);
    // Those of a run that this one continues are in its folder.
    if (the_state.folder_of_files != folder_of_files)
      known.clear();
    the_state.files.clear();
    for (const auto &entry : fs::directory_iterator(folder.path()))
      if (const std::string name = entry.path().filename().string();
          entry.is_regular_file() && is_final(name))
        {
          fs::create_directories(to);
          if (known.count(name) == 0)
            {
              give_name(entry.path().string(), to + "/" + name);
              sync(to + "/" + name);
            }
          the_state.files.emplace_back(name, entry.file_size());
        }
    std::sort(the_state.files.begin(), the_state.files.end());
    the_state.folder_of_files = folder_of_files;
    if (!the_state.files.empty())
      sync(to);
  }



  void Checkpoints::save(const std::string &stage, Journal &journal)
  {
    const auto     time = journal.measure(Phase::output);
    const MPI_Comm comm = folder.communicator();
    journal.show("saving the state");
    // All ranks must have closed their files.
    MPI_Barrier(comm);
    on_root(comm, [&] { collect_files(); });
    the_state.notes     = journal.notes();
    the_state.wall_time = earlier_seconds + clock.wall_time();
    CheckpointWriter writer(program, comm);
    writer.add("identity", identity);
    write_state(writer, the_state);
    // Who finds the file may end the run at once: what is said then is right.
    writer.write(state_file, [&](const TerminationWatch::Delay &delay) {
      folder.set_last_words("The state after " + stage + " is saved in " + place +
                                ": --resume goes on from it, on any number of ranks.",
                            delay);
    });
    if (!has_saved)
      on_root(comm, [&] { clean_up(); });
    has_saved = true;
  }



  void Checkpoints::clean_up()
  {
    // What other runs have left, from which this one is now independent.
    std::error_code       ignored;
    std::vector<fs::path> old;
    for (const auto &entry : fs::directory_iterator(place, ignored))
      if (const std::string name = entry.path().filename().string();
          name.compare(0, 11, "state.part-") == 0 ||
          (name.compare(0, 6, start_of_folder) == 0 && name != folder_of_files))
        old.push_back(entry.path());
    for (const fs::path &path : old)
      fs::remove_all(path, ignored);
  }



  void Checkpoints::take_files()
  {
    on_root(folder.communicator(), [&] {
      const std::string from = place + "/" + the_state.folder_of_files;
      for (const auto &[name, size] : the_state.files)
        {
          std::error_code error;
          if (fs::file_size(from + "/" + name, error) != size || error)
            throw InputError("lacks the file \"" + from + "/" + name + "\" as a load step wrote it.");
        }
      for (const auto &[name, size] : the_state.files)
        give_name(from + "/" + name, folder.path() + name);
    });
  }



  void Checkpoints::remove()
  {
    MPI_Barrier(folder.communicator());
    if (!is_root(folder.communicator()))
      return;
    std::error_code ignored;
    // First what makes it one.
    fs::remove(state_file, ignored);
    folder_of_files.clear();
    clean_up();
    fs::remove(place, ignored);
  }
} // namespace Signorini
