// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/problem_identity.h>
#include <signorini/mesh/deck_text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace Signorini
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /// What may change from run to run.
    const std::set<std::string> free_parameters = {"Output/Folder", "Output/Verbosity", "Output/Checkpoint",
                                                   "Output/Wall time limit"};

    /// "Section/Name" and values of all parameters.
    std::vector<std::pair<std::string, std::string>> all_parameters(const ParameterFile &file)
    {
      std::stringstream text;
      file.print(text, false);
      std::vector<std::pair<std::string, std::string>> result;
      std::string                                      line, section;
      while (std::getline(text, line))
        {
          line = Utilities::trim(line);
          if (line.compare(0, 11, "subsection ") == 0)
            section += line.substr(11) + "/";
          else if (line == "end" && !section.empty())
            section.erase(section.find_last_of('/', section.size() - 2) + 1);
          else if (const auto equals = line.find('=');
                   line.compare(0, 4, "set ") == 0 && equals != std::string::npos)
            result.emplace_back(section + Utilities::trim(line.substr(4, equals - 4)),
                                Utilities::trim(line.substr(equals + 1)));
        }
      return result;
    }

    /// FNV-1a, and the number of bytes.
    std::string checksum(const std::string &file)
    {
      std::ifstream     in(file, std::ios::binary);
      std::vector<char> bytes(1 << 20);
      std::uint64_t     hash = 0xcbf29ce484222325ull, n = 0;
      while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || in.gcount() > 0)
        {
          for (std::streamsize i = 0; i < in.gcount(); ++i)
            hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ull;
          n += static_cast<std::uint64_t>(in.gcount());
        }
      return std::to_string(n) + " bytes, checksum " + std::to_string(hash);
    }

    /// The files that a value names.
    void add_files(std::set<std::string> &files, const std::string &value, const fs::path &base)
    {
      std::vector<std::string> words = {value};
      for (const char separator : {';', ':', ','})
        {
          std::vector<std::string> next;
          for (const std::string &word : words)
            for (const std::string &piece : Utilities::split_string_list(word, separator))
              next.push_back(piece);
          words.insert(words.end(), next.begin(), next.end());
        }
      for (const std::string &word : words)
        {
          std::error_code error;
          const fs::path  path = fs::path(word).is_absolute() ? fs::path(word) : base / word;
          if (word.find('.') != std::string::npos && fs::is_regular_file(path, error))
            files.insert(path.string());
        }
    }

    /// On one rank.
    std::string make_identity(const ParameterFile &file)
    {
      std::string           text;
      std::set<std::string> files;
      const fs::path        base = fs::absolute(file.path()).parent_path();
      for (const auto &[name, value] : all_parameters(file))
        if (free_parameters.count(name) == 0)
          {
            text += name + " = " + value + '\n';
            add_files(files, value, base);
          }
      if (is_deck(file.path()))
        files.insert(file.path());
      for (const std::string &name : std::set<std::string>(files))
        if (is_deck(name))
          {
            const DeckText text_of_deck(name);
            files.insert(text_of_deck.files().begin(), text_of_deck.files().end());
          }
      for (const std::string &name : files)
        text += "the file " + fs::absolute(name).lexically_proximate(base).string() + " = " + checksum(name) +
                '\n';
      return text;
    }

    std::map<std::string, std::string> lines_of(const std::string &identity)
    {
      std::map<std::string, std::string> lines;
      std::istringstream                 text(identity);
      std::string                        line;
      while (std::getline(text, line))
        if (const auto equals = line.find(" = "); equals != std::string::npos)
          lines[line.substr(0, equals)] = line.substr(equals + 3);
      return lines;
    }
  } // namespace



  std::string problem_identity(const ParameterFile &file, const MPI_Comm communicator)
  {
    std::string text;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          text = make_identity(file);
        }
      catch (const InputError &)
        {
          // Files that cannot be read are refused where they are needed.
        }
    return broadcast_value(text, communicator);
  }



  std::string identity_difference(const std::string &earlier, const std::string &present)
  {
    if (earlier == present)
      return "";
    const auto  before = lines_of(earlier), now = lines_of(present);
    std::string text;
    const auto  add = [&text](const std::string &difference) {
      text += (text.empty() ? "" : "; ") + difference;
    };
    for (const auto &[name, value] : before)
      if (const auto it = now.find(name); it == now.end())
        add(name + " is not there any more");
      else if (it->second != value)
        add(name + " was \"" + value + "\" and is \"" + it->second + "\"");
    for (const auto &[name, value] : now)
      if (before.count(name) == 0)
        add(name + " was not there");
    return text.empty() ? "its parameters come in another order." : text + ".";
  }
} // namespace Signorini
