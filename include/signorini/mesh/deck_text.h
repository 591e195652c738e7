// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_deck_text_h
#define signorini_mesh_deck_text_h

#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// Where something stands in the files of a deck.
  struct DeckPlace
  {
    /// Index into DeckText::files(), and the line in it, from 1.
    unsigned int file = 0, line = 0;
  };

  /// A line of data.
  struct DeckLine
  {
    /// Without the end of the line.
    std::string text;
    /// Where it is.
    DeckPlace place;
  };

  /// A keyword with its options and the data lines below it.
  struct DeckKeyword
  {
    /// In capitals, words separated by one blank, without the star.
    std::string name;
    /// Names in capitals, values without quotes (empty for options without a value).
    std::vector<std::pair<std::string, std::string>> options;
    std::vector<DeckLine>                            lines;
    DeckPlace                                        place;

    /// Whether an option is there.
    bool has(const std::string &option) const;

    /// The value of an option; empty if it is not there.
    const std::string &get(const std::string &option) const;
  };

  /// The keywords of an Abaqus or CalculiX input file in their order, INCLUDEs resolved (relative to the
  /// folder of the first file, or else that of the file that includes), comments left out. Errors: InputError
  /// for files that cannot be opened or include themselves.
  class DeckText
  {
  public:
    /// Reads a file and those that it includes.
    explicit DeckText(const std::string &file);

    /// In their order.
    const std::vector<DeckKeyword> &keywords() const
    {
      return list;
    }

    /// The first file and those that it includes.
    const std::vector<std::string> &files() const
    {
      return file_names;
    }

    /// "FILE, line N".
    std::string where(const DeckPlace &place) const;

    /// Errors: InputError with file and line, always.
    [[noreturn]] void fail(const DeckPlace &place, const std::string &text) const;

    /// A number as Fortran writes it, too (1.D3). Errors: InputError.
    double number(const std::string &word, const DeckPlace &place) const;

    /// A whole number. Errors: InputError.
    long label(const std::string &word, const DeckPlace &place) const;

  private:
    void read(const std::string &file, const unsigned int depth);
    void read_data(DeckKeyword &keyword, const std::string &file);
    void add_keyword(const std::string &line, const DeckPlace &place, const unsigned int depth);
    /// The path of a file that is named in the deck.
    std::string path_of(const std::string &name, const DeckPlace &place) const;

    std::vector<DeckKeyword> list;
    std::vector<std::string> file_names;
  };

  /// The words between the commas of a line, without blanks around them and without quotes; empty ones at the
  /// end are left out.
  std::vector<std::string> deck_words(const std::string &line);

  /// In capitals.
  std::string deck_upper(std::string text);

  /// Whether a word can be a number of a node or an element.
  bool is_deck_label(const std::string &word);
} // namespace Signorini

#endif
