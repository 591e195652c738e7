// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_expression_h
#define signorini_mesh_expression_h

#include <signorini/mesh/field.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// A scalar function of x, y, z and the pseudo-time t given by a user as text, e.g. "0.01*t*sin(2*pi*x)".
  class Expression
  {
  public:
    Expression() = default;

    /// `where` names the parameter; it appears in the InputError for text that cannot be understood.
    Expression(const std::string &text, const std::string &where);

    /// Errors: InputError where the value is not finite (not collective: one rank alone may throw).
    double operator()(const dealii::Point<3> &p, const double time = ScalarField::end) const;

    /// As it was written.
    const std::string &text() const
    {
      return source;
    }

  private:
    std::string source   = "0", place;
    double      constant = 0.;
    /// Its time is set before each use.
    std::shared_ptr<dealii::FunctionParser<3>> parser;
  };



  /// For what stays as it is at all times. Errors: InputError if one of the words of a text is t.
  void refuse_time(const std::string &text, const std::string &where);

  /// A number, which may be an expression like sqrt(2).
  double parse_number(const std::string &text, const std::string &where);

  /// A point "(x, y, z)" of such numbers.
  dealii::Point<3> parse_point(const std::string &text, const std::string &where);

  /// A function from three expressions "(f, g, h)".
  VectorField parse_vector_field(const std::string &text, const std::string &where);

  /// Pieces of a list; separators inside parentheses do not count. Pieces are trimmed.
  std::vector<std::string> split_list(const std::string &text, const char separator,
                                      const std::string &where);

  /// A vector of text entries "(a, b, c)"; commas inside nested parentheses do not separate.
  std::vector<std::string> split_vector(const std::string &text, const std::string &where);

  /// Entries "name: value; name: value", in order. Semicolons inside parentheses do not separate.
  std::vector<std::pair<std::string, std::string>> split_named_entries(const std::string &text,
                                                                       const std::string &where);
} // namespace Signorini

#endif
