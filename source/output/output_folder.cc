// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/output/output_folder.h>
#include <signorini/output/termination.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace Signorini
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const char *const marker = ".signorini";
    /// Of OutputFolder::checkpoint() in the folder itself.
    const char *const checkpoint_inside = ".signorini-checkpoint";

    /// Runs on rank 0; an error there is raised everywhere.
    template <typename F>
    void on_root(const MPI_Comm comm, const F &action)
    {
      std::string error;
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        try
          {
            action();
          }
        catch (const fs::filesystem_error &e)
          {
            error = "\"" + e.path1().string() + "\": " + e.code().message() +
                    ". Is the disk full, or the folder not yours?";
          }
        catch (const std::exception &e)
          {
            error = e.what();
          }
      error = broadcast_value(error, comm);
      if (!error.empty())
        throw InputError("Output folder: " + error);
    }

    /// What the file .signorini of a folder says.
    struct Contents
    {
      /// Of the run: host, process, time.
      std::string host, id;
      long        process = 0;
      /// "unfinished" until commit(), then an Outcome.
      std::string outcome;
      /// Names of the results.
      std::set<std::string> files;

      bool is_complete() const
      {
        return outcome == "complete";
      }

      bool owns(const std::string &name) const
      {
        // Drawn from them.
        return name == marker || name == "pressure.png" || files.count(name) > 0;
      }
    };

    std::string this_host()
    {
      char name[256] = "";
      gethostname(name, sizeof(name) - 1);
      return name;
    }

    void write_marker(const std::string &folder, const std::string &id, const std::string &outcome,
                      const std::set<std::string> &files)
    {
      std::ofstream out(folder + "/" + marker);
      out << "results of signorini\nhost " << this_host() << "\nprocess " << getpid() << "\nid " << id
          << "\noutcome " << outcome << '\n';
      for (const std::string &name : files)
        out << "file " << name << '\n';
      out.close();
      if (!out)
        throw InputError("nothing can be written to \"" + folder + "\": is the disk full?");
    }

    Contents read_marker(const std::string &folder)
    {
      Contents      result;
      std::ifstream in(folder + "/" + marker);
      std::string   key, value;
      while (in >> key && std::getline(in >> std::ws, value))
        if (key == "host")
          result.host = value;
        else if (key == "process")
          result.process = std::atol(value.c_str());
        else if (key == "id")
          result.id = value;
        else if (key == "outcome")
          result.outcome = value;
        else if (key == "file")
          result.files.insert(value);
      // Those of versions that wrote less about them.
      if (result.outcome.empty())
        result.outcome = "complete";
      return result;
    }

    std::set<std::string> entries(const std::string &folder)
    {
      std::set<std::string> names;
      for (const auto &entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
      names.erase(checkpoint_inside);
      return names;
    }

    bool is_void(const std::string &folder)
    {
      return !fs::exists(folder) || (fs::is_directory(folder) && entries(folder).empty());
    }

    /// What tells whether somebody else has been there; "foreign" where no results are.
    std::string identity(const std::string &folder)
    {
      if (is_void(folder))
        return "";
      return fs::exists(folder + "/" + marker) ? "results " + read_marker(folder).id : "foreign";
    }

    /// Whether a folder has to keep its place: because somebody works in it, it is another file system, or
    /// the folder above is not ours.
    bool is_pinned(const std::string &folder)
    {
      const fs::path above = fs::path(folder).parent_path();
      if (!fs::exists(folder))
        return false;
      struct stat own, other;
      if (stat(folder.c_str(), &own) != 0 || stat(above.c_str(), &other) != 0 || own.st_dev != other.st_dev ||
          access(above.c_str(), W_OK) != 0)
        return true;
      std::error_code ignored;
      const fs::path  here   = fs::current_path(ignored);
      const fs::path  inside = here.lexically_relative(folder);
      return !inside.empty() && *inside.begin() != "..";
    }

    bool is_running(const long process)
    {
      // One that has ended but whose parent has not asked for it is still there, by its number.
      std::ifstream status("/proc/" + std::to_string(process) + "/stat");
      std::string   text;
      if (std::getline(status, text))
        if (const auto name_ends = text.rfind(") "); name_ends != std::string::npos)
          return text[name_ends + 2] != 'Z';
      return kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
    }
  } // namespace



  OutputFolder::OutputFolder(const std::string &folder, const MPI_Comm communicator)
    : comm(communicator)
  {
    on_root(comm, [&] {
      if (folder.empty())
        throw InputError("its name is empty.");
      target = fs::weakly_canonical(fs::absolute(folder)).string();
      while (target.size() > 1 && target.back() == '/')
        target.pop_back();
      if (fs::exists(target) && !fs::is_directory(target))
        throw InputError("\"" + target + "\" is a file. Choose another name.");
      // Locked on purpose: it could be exchanged for another one where the folder above is open.
      if (fs::exists(target) && access(target.c_str(), W_OK) != 0)
        throw InputError("nothing can be written to \"" + target +
                         "\": it is locked, or not yours. Choose another name.");
      in_place       = is_pinned(target);
      for_checkpoint = in_place ? target + "/" + checkpoint_inside : target + ".checkpoint";
      remove_abandoned();
      found = identity(target);
      if (found == "foreign")
        throw InputError("\"" + target +
                         "\" exists and was not written by signorini. Choose another name or remove it.");
      make_temporary();
    });
    temporary      = broadcast_value(temporary, comm);
    for_checkpoint = broadcast_value(for_checkpoint, comm);
    TerminationWatch::guard(temporary, last_words());
  }



  std::string OutputFolder::last_words() const
  {
    return Utilities::MPI::this_mpi_process(comm) > 0 ? ""
           : found.empty()                            ? "no results were written."
                           : "the earlier results in " + target + " are unchanged.";
  }



  void OutputFolder::set_last_words(const std::string &text)
  {
    set_last_words(text, TerminationWatch::Delay());
  }



  void OutputFolder::set_last_words(const std::string &text, const TerminationWatch::Delay &delay)
  {
    const std::string words = last_words();
    TerminationWatch::guard(temporary, words.empty() ? words : words + " " + text, delay);
  }



  std::string OutputFolder::earlier_results() const
  {
    return found.empty() ? "" : read_marker(target).outcome;
  }



  void OutputFolder::make_temporary()
  {
    const std::string process = std::to_string(getpid());
    const std::string start   = in_place ? target + "/.signorini-part-" : target + ".part-";
    fs::create_directories(fs::path(start).parent_path());
    // No signal may come before the folder is known to be ours.
    const TerminationWatch::Delay delay;
    // The same process number may be that of another computer.
    for (unsigned int attempt = 0; temporary.empty(); ++attempt)
      if (const std::string name = start + process + std::string(attempt, '+'); fs::create_directory(name))
        temporary = name + "/";
    TerminationWatch::guard(temporary, last_words(), delay);
    const auto        time = std::chrono::system_clock::now().time_since_epoch().count();
    const std::string id   = this_host() + " " + process + " " + std::to_string(time);
    try
      {
        write_marker(temporary, id, "unfinished", {});
      }
    catch (...)
      {
        TerminationWatch::release(temporary, delay);
        fs::remove_all(temporary);
        throw;
      }
  }



  void OutputFolder::remove_abandoned() const
  {
    // What processes have left that were killed: nobody could clean up after them.
    const fs::path    above = in_place ? fs::path(target) : fs::path(target).parent_path();
    const std::string start = in_place ? ".signorini-part-" : fs::path(target).filename().string() + ".part-";
    std::error_code   error;
    std::vector<fs::path> abandoned;
    for (const auto &entry : fs::directory_iterator(above, error))
      if (const std::string name = entry.path().filename().string();
          name.compare(0, start.size(), start) == 0)
        if (fs::exists(entry.path() / marker, error))
          if (const Contents contents = read_marker(entry.path().string());
              contents.outcome == "unfinished" && contents.host == this_host() && contents.process > 0 &&
              !is_running(contents.process))
            abandoned.push_back(entry.path());
    for (const fs::path &path : abandoned)
      fs::remove_all(path, error);
  }



  OutputFolder::~OutputFolder()
  {
    // On every rank: after an error that one rank alone has met, the others never come here.
    std::error_code ignored;
    if (!committed)
      fs::remove_all(temporary, ignored);
    // A signal amid the removal finishes it.
    TerminationWatch::release(temporary);
  }



  std::string OutputFolder::beside(const std::string &word) const
  {
    std::string name = in_place ? target + "/" + word : target + "-" + word;
    for (unsigned int n = 2; !is_void(name) && !fs::exists(name + "/" + marker); ++n)
      name = (in_place ? target + "/" + word : target + "-" + word) + "-" + std::to_string(n);
    return name;
  }



  std::string OutputFolder::destination(const Outcome outcome) const
  {
    // The temporary folder in it does not count.
    const bool        is_empty = in_place && found.empty() && entries(target).size() == 1;
    const std::string now      = is_empty ? "" : identity(target);
    if (now != found)
      {
        for (unsigned int n = 2;; ++n)
          if (const std::string name = beside(std::to_string(n)); is_void(name))
            return name;
      }
    if (outcome == Outcome::not_converged && !now.empty() && read_marker(target).is_complete())
      return beside("not-converged");
    return target;
  }



  namespace
  {
    /// Removes results from a folder, and the folder if nothing else is there.
    void remove_results(const std::string &folder, const Contents &contents)
    {
      std::error_code ignored;
      for (const std::string &name : entries(folder))
        if (contents.owns(name))
          fs::remove_all(folder + "/" + name, ignored);
      fs::remove(folder, ignored);
    }

    /// Moves a folder to a place that may not be empty, and what was there to where it was.
    /// @return whether something was there
    bool exchange(const std::string &from, const std::string &to)
    {
      if (!fs::exists(to))
        {
          fs::rename(from, to);
          return false;
        }
#if defined(RENAME_EXCHANGE)
      if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0)
        return true;
#endif
      const std::string between = to + ".old-" + std::to_string(getpid());
      fs::rename(to, between);
      try
        {
          fs::rename(from, to);
        }
      catch (...)
        {
          fs::rename(between, to);
          throw;
        }
      fs::rename(between, from);
      return true;
    }
  } // namespace



  void OutputFolder::replace(const std::string &folder)
  {
    const std::string from = temporary.substr(0, temporary.size() - 1);
    if (!exchange(from, folder))
      return;
    const Contents  old = fs::exists(from + "/" + marker) ? read_marker(from) : Contents();
    std::error_code ignored;
    for (const std::string &name : entries(from))
      if (!old.owns(name) && !fs::exists(folder + "/" + name))
        fs::rename(from + "/" + name, folder + "/" + name, ignored);
    remove_results(from, old);
  }



  void OutputFolder::replace_contents()
  {
    const Contents    old  = found.empty() ? Contents() : read_marker(target);
    const std::string from = temporary.substr(0, temporary.size() - 1);
    const std::string away = target + "/.signorini-old-" + std::to_string(getpid());
    fs::create_directory(away);
    std::vector<std::pair<std::string, std::string>> moves;
    for (const std::string &name : entries(target))
      if (old.owns(name) || fs::exists(temporary + name))
        moves.emplace_back(target + "/" + name, away + "/" + name);
    for (const std::string &name : entries(from))
      moves.emplace_back(temporary + name, target + "/" + name);
    std::size_t done = 0;
    try
      {
        for (; done < moves.size(); ++done)
          fs::rename(moves[done].first, moves[done].second);
      }
    catch (...)
      {
        while (done-- > 0)
          fs::rename(moves[done].second, moves[done].first);
        fs::remove(away);
        throw;
      }
    remove_results(away, old);
    std::error_code ignored;
    fs::remove(from, ignored);
  }



  std::string OutputFolder::commit(const Outcome outcome)
  {
    // All ranks must have closed their files.
    MPI_Barrier(comm);
    std::string place;
    on_root(comm, [&] {
      std::set<std::string> files = entries(temporary);
      files.erase(marker);
      write_marker(temporary, read_marker(temporary).id,
                   outcome == Outcome::complete ? "complete" : "not converged", files);
      const TerminationWatch::Delay delay;
      place = destination(outcome);
      if (place == target && in_place)
        replace_contents();
      else
        replace(place);
      TerminationWatch::release(temporary, delay);
      committed = true;
    });
    committed = true;
    TerminationWatch::release(temporary);
    return broadcast_value(place, comm);
  }
} // namespace Signorini
