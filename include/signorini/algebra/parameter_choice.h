// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_parameter_choice_h
#define signorini_algebra_parameter_choice_h

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <string>

namespace Signorini
{
  /// A word as it is compared with others: in small letters, without blanks around it, "auto" for
  /// "automatic".
  inline std::string plain_word(std::string word)
  {
    const auto is_blank = [](const unsigned char c) { return std::isspace(c) != 0; };
    word.erase(word.begin(), std::find_if_not(word.begin(), word.end(), is_blank));
    word.erase(std::find_if_not(word.rbegin(), word.rend(), is_blank).base(), word.end());
    std::transform(word.begin(), word.end(), word.begin(),
                   [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word == "automatic" ? "auto" : word;
  }



  /// One of several words, by plain_word().
  class WordPattern : public dealii::Patterns::Selection
  {
  public:
    /// @param words separated by "|"
    explicit WordPattern(const std::string &words)
      : Selection(words)
      , words(words)
    {
    }

    /// Whether it is one of them.
    bool match(const std::string &text) const override
    {
      for (std::size_t begin = 0; begin <= words.size();)
        {
          const std::size_t end = std::min(words.find('|', begin), words.size());
          if (plain_word(words.substr(begin, end - begin)) == plain_word(text))
            return true;
          begin = end + 1;
        }
      return false;
    }

    /// A copy.
    std::unique_ptr<PatternBase> clone() const override
    {
      return std::make_unique<WordPattern>(words);
    }

  private:
    const std::string words;
  };



  /// Declares a parameter with one name for each value of an enum, in the current subsection. The present
  /// value is the default. `value` must outlive the handler's last use. The names are listed after the
  /// documentation; capital letters and small ones are the same, and so are "auto" and "automatic".
  template <typename Enum>
  void add_choice(dealii::ParameterHandler &prm, const std::string &name, Enum &value,
                  const std::map<Enum, std::string> &names, const std::string &documentation)
  {
    std::string selection, list;
    for (const auto &entry : names)
      {
        selection += (selection.empty() ? "" : "|") + entry.second;
        list += (list.empty() ? "" : ", ") + entry.second;
      }
    prm.declare_entry(name, names.at(value), WordPattern(selection),
                      documentation + " One of: " + list + ".");
    prm.add_action(name, [&value, names](const std::string &text) {
      for (const auto &entry : names)
        if (plain_word(entry.second) == plain_word(text))
          value = entry.first;
    });
  }
} // namespace Signorini

#endif
