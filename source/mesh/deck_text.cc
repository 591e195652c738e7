// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck_text.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace Signorini
{
  namespace
  {
    std::string trimmed(const std::string &text)
    {
      const auto begin = text.find_first_not_of(" \t\r\f\v");
      if (begin == std::string::npos)
        return "";
      return text.substr(begin, text.find_last_not_of(" \t\r\f\v") - begin + 1);
    }

    /// Without quotes around it.
    std::string unquoted(const std::string &text)
    {
      if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
        return trimmed(text.substr(1, text.size() - 2));
      return text;
    }

    /// Capitals, one blank between words.
    std::string keyword_name(const std::string &text)
    {
      std::string name;
      for (const char c : deck_upper(trimmed(text)))
        if (c != ' ' && c != '\t')
          name += c;
        else if (!name.empty() && name.back() != ' ')
          name += ' ';
      return name;
    }

    bool is_comment(const std::string &line)
    {
      return line.empty() || line.compare(0, 2, "**") == 0;
    }

    /// A file that ends: neither a folder nor a device. Names too long for a file are no error of their own.
    bool is_readable_file(const std::string &file)
    {
      std::error_code error;
      return std::filesystem::is_regular_file(file, error) && std::ifstream(file);
    }
  } // namespace



  std::string deck_upper(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](const unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
  }



  bool is_deck_label(const std::string &word)
  {
    return !word.empty() &&
           std::all_of(word.begin(), word.end(), [](const unsigned char c) { return std::isdigit(c) != 0; });
  }



  std::vector<std::string> deck_words(const std::string &line)
  {
    std::vector<std::string> words;
    std::size_t              begin = 0;
    char                     quote = 0;
    for (std::size_t i = 0; i <= line.size(); ++i)
      if (i == line.size() || (line[i] == ',' && quote == 0))
        {
          words.push_back(unquoted(trimmed(line.substr(begin, i - begin))));
          begin = i + 1;
        }
      else if (quote != 0)
        quote = line[i] == quote ? 0 : quote;
      else if (line[i] == '"')
        quote = line[i];
    while (!words.empty() && words.back().empty())
      words.pop_back();
    return words;
  }



  bool DeckKeyword::has(const std::string &option) const
  {
    return std::any_of(options.begin(), options.end(), [&](const auto &o) { return o.first == option; });
  }



  const std::string &DeckKeyword::get(const std::string &option) const
  {
    static const std::string none;
    for (const auto &[name, value] : options)
      if (name == option)
        return value;
    return none;
  }



  DeckText::DeckText(const std::string &file)
  {
    read(file, 0);
  }



  std::string DeckText::where(const DeckPlace &place) const
  {
    return file_names[place.file] + ", line " + std::to_string(place.line);
  }



  void DeckText::fail(const DeckPlace &place, const std::string &text) const
  {
    throw InputError(where(place) + ": " + text);
  }



  double DeckText::number(const std::string &word, const DeckPlace &place) const
  {
    std::string text = word;
    for (char &c : text)
      if (c == 'd' || c == 'D')
        c = 'e';
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0 || !std::isfinite(value))
      fail(place, "\"" + word + "\" should be a number.");
    return value;
  }



  long DeckText::label(const std::string &word, const DeckPlace &place) const
  {
    char      *end   = nullptr;
    const long value = std::strtol(word.c_str(), &end, 10);
    if (word.empty() || *end != 0)
      fail(place, "\"" + word + "\" should be a whole number.");
    // Sums of numbers are taken, and strtol() gives the largest one for all that are larger.
    constexpr long largest = std::numeric_limits<int>::max();
    if (value > largest || value < -largest)
      fail(place,
           "the number " + word + " is too large: at most " + std::to_string(largest) + " is possible.");
    return value;
  }



  std::string DeckText::path_of(const std::string &name, const DeckPlace &place) const
  {
    namespace fs = std::filesystem;
    if (fs::path(name).is_absolute())
      return name;
    const fs::path  beside_first = fs::path(file_names[0]).parent_path() / name;
    std::error_code error;
    if (fs::exists(beside_first, error))
      return beside_first.string();
    return (fs::path(file_names[place.file]).parent_path() / name).string();
  }



  void DeckText::read(const std::string &file, const unsigned int depth)
  {
    std::ifstream   in(file);
    std::error_code error;
    if (!in || std::filesystem::is_directory(file, error))
      throw InputError("The file \"" + file + "\" cannot be opened.");
    const auto number = static_cast<unsigned int>(file_names.size());
    file_names.push_back(file);
    std::string  line;
    unsigned int n = 0;
    while (std::getline(in, line))
      {
        // Editors of Windows begin files with a mark of their coding.
        if (++n == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0)
          line.erase(0, 3);
        line = trimmed(line);
        if (is_comment(line))
          continue;
        const DeckPlace place{number, n};
        if (line[0] != '*')
          {
            if (list.empty())
              fail(place, "data before the first keyword. Is this an Abaqus or CalculiX input file?");
            list.back().lines.push_back({line, place});
            continue;
          }
        // A comma at the end: the options go on.
        std::string next;
        while (line.back() == ',' && std::getline(in, next))
          {
            ++n;
            next = trimmed(next);
            if (!is_comment(next))
              line += next;
          }
        add_keyword(line, place, depth);
      }
  }



  void DeckText::read_data(DeckKeyword &keyword, const std::string &file)
  {
    if (!is_readable_file(file))
      fail(keyword.place, "the file \"" + file + "\" cannot be opened.");
    std::ifstream in(file);
    const auto    number = static_cast<unsigned int>(file_names.size());
    file_names.push_back(file);
    std::string  line;
    unsigned int n = 0;
    while (std::getline(in, line))
      {
        ++n;
        line = trimmed(line);
        if (!is_comment(line))
          keyword.lines.push_back({line, {number, n}});
      }
  }



  void DeckText::add_keyword(const std::string &line, const DeckPlace &place, const unsigned int depth)
  {
    constexpr unsigned int   deepest = 20;
    std::vector<std::string> words   = deck_words(line.substr(1));
    DeckKeyword              keyword;
    keyword.name  = words.empty() ? "" : keyword_name(words[0]);
    keyword.place = place;
    for (std::size_t i = 1; i < words.size(); ++i)
      {
        const auto equals = words[i].find('=');
        keyword.options.emplace_back(
            keyword_name(words[i].substr(0, equals)),
            equals == std::string::npos ? "" : unquoted(trimmed(words[i].substr(equals + 1))));
      }
    if (keyword.name == "INCLUDE")
      {
        if (depth == deepest)
          fail(place, "files include each other.");
        if (keyword.get("INPUT").empty())
          fail(place, "INCLUDE needs a file: *INCLUDE, INPUT=FILE.");
        const std::string file = path_of(keyword.get("INPUT"), place);
        if (!is_readable_file(file))
          fail(place, "the included file \"" + file + "\" cannot be opened.");
        read(file, depth + 1);
        return;
      }
    if (keyword.has("INPUT") && (keyword.name == "NODE" || keyword.name == "ELEMENT"))
      read_data(keyword, path_of(keyword.get("INPUT"), place));
    list.push_back(std::move(keyword));
  }
} // namespace Signorini
