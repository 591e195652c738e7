// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// As messages quote what a user wrote: the beginning and the end of a long one.
    std::string in_quotes(const std::string &text)
    {
      constexpr std::size_t longest = 200, kept = 80;
      if (text.size() <= longest)
        return "\"" + text + "\"";
      return "\"" + text.substr(0, kept) + " ... " + text.substr(text.size() - kept) + "\" (" +
             std::to_string(text.size()) + " characters)";
    }

    /// An expression is evaluated at every node: what is longer was not written by a person. (The parser has
    /// a bound of its own, and needs no recursion.)
    constexpr std::size_t longest_expression = 10000;

    /// Whether an expression has one of some words.
    bool has_word(const std::string &expression, const std::set<std::string> &words)
    {
      std::string word;
      for (const char c : expression + ' ')
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
          word += c;
        else
          {
            if (words.count(word) > 0)
              return true;
            word.clear();
          }
      return false;
    }
  } // namespace



  std::vector<std::string> split_list(const std::string &text, const char separator, const std::string &where)
  {
    std::vector<std::string> pieces(1);
    int                      depth = 0;
    for (const char c : text)
      {
        depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
        if (depth < 0)
          break;
        if (c == separator && depth == 0)
          pieces.emplace_back();
        else
          pieces.back() += c;
      }
    if (depth != 0)
      throw InputError(where + ": the parentheses in " + in_quotes(text) + " do not match.");
    for (std::string &piece : pieces)
      piece = Utilities::trim(piece);
    return pieces;
  }



  Expression::Expression(const std::string &text, const std::string &where)
    : source(Utilities::trim(text))
    , place(where)
  {
    std::size_t used = 0;
    try
      {
        constant = std::stod(source, &used);
      }
    catch (const std::exception &)
      {
        used = 0;
      }
    if (used == source.size() && used > 0)
      {
        if (!std::isfinite(constant))
          throw InputError(where + ": " + in_quotes(source) + " is not a finite number.");
        return;
      }
    if (source.size() > longest_expression)
      throw InputError(where + ": the expression " + in_quotes(source) + " is too long: at most " +
                       std::to_string(longest_expression) + " characters are read.");
    if (has_word(source, {"rand", "rand_seed"}))
      throw InputError(
          where + ": " + in_quotes(source) +
          " has random numbers: the problem would be another one at each evaluation, and on each "
          "number of ranks. Write a function of x, y, z, t.");
    // deal.II tells what the parser found on the standard error: take it into our message instead.
    std::ostringstream    words;
    std::streambuf *const standard_error = std::cerr.rdbuf(words.rdbuf());
    std::string           error;
    try
      {
        auto function = std::make_shared<FunctionParser<3>>(1);
        function->initialize("x,y,z,t", source, {{"pi", numbers::PI}}, true);
        function->set_time(ScalarField::end);
        (void)function->value(Point<3>(.1, .2, .3));
        parser = function;
      }
    catch (const std::exception &)
      {
        error = where + ": " + in_quotes(source) + " is not an expression in x, y, z, t";
        std::string       line;
        const std::string key = "Message:  <";
        for (std::istringstream lines(words.str()); std::getline(lines, line);)
          if (line.compare(0, key.size(), key) == 0 && line.back() == '>')
            {
              const std::string said = line.substr(key.size(), line.size() - key.size() - 1);
              error += " (" + (said.size() > 200 ? said.substr(0, 200) + " ..." : said) + ")";
            }
        error += ".";
      }
    std::cerr.rdbuf(standard_error);
    if (!error.empty())
      throw InputError(error);
  }



  double Expression::operator()(const Point<3> &p, const double time) const
  {
    if (!parser)
      return constant;
    parser->set_time(time);
    const double value = parser->value(p);
    if (!std::isfinite(value))
      {
        std::ostringstream message;
        message << place << ": " << in_quotes(source) << " has no finite value at (" << p << ").";
        throw InputError(message.str());
      }
    return value;
  }



  void refuse_time(const std::string &text, const std::string &where)
  {
    if (has_word(text, {"t"}))
      throw InputError(where + ": " + in_quotes(text) +
                       " depends on the pseudo-time t, but obstacles, regions and gaps stay as they are. "
                       "Displacements and loads may depend on t.");
  }



  double parse_number(const std::string &text, const std::string &where)
  {
    return Expression(text, where)(Point<3>());
  }



  Point<3> parse_point(const std::string &text, const std::string &where)
  {
    const auto entries = split_vector(text, where);
    return Point<3>(parse_number(entries[0], where), parse_number(entries[1], where),
                    parse_number(entries[2], where));
  }



  VectorField parse_vector_field(const std::string &text, const std::string &where)
  {
    const auto                  entries = split_vector(text, where);
    std::array<Expression, dim> components;
    for (unsigned int c = 0; c < dim; ++c)
      components[c] = Expression(entries[c], where);
    return [components](const Point<3> &p, const double time) {
      return Vector3({components[0](p, time), components[1](p, time), components[2](p, time)});
    };
  }



  std::vector<std::string> split_vector(const std::string &text, const std::string &where)
  {
    const std::string trimmed = Utilities::trim(text);
    if (trimmed.size() < 2 || trimmed.front() != '(' || trimmed.back() != ')')
      throw InputError(where + ": " + in_quotes(trimmed) +
                       " should be a vector in parentheses, like (0, 0, -1).");
    const auto entries = split_list(trimmed.substr(1, trimmed.size() - 2), ',', where);
    if (entries.size() != dim)
      throw InputError(where + ": " + in_quotes(trimmed) + " should have three entries.");
    return entries;
  }



  std::vector<std::pair<std::string, std::string>> split_named_entries(const std::string &text,
                                                                       const std::string &where)
  {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const std::string &piece : split_list(text, ';', where))
      {
        if (piece.empty())
          continue;
        const std::size_t colon = piece.find(':');
        if (colon == std::string::npos || colon == 0)
          throw InputError(where + ": " + in_quotes(piece) + " should read \"name: value\".");
        entries.emplace_back(Utilities::trim(piece.substr(0, colon)),
                             Utilities::trim(piece.substr(colon + 1)));
      }
    return entries;
  }
} // namespace Signorini
