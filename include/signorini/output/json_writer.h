// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_json_writer_h
#define signorini_output_json_writer_h

#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

namespace Signorini
{
  /// Writes JSON text with commas and nesting in the right places.
  class JsonWriter
  {
  public:
    /// Writes to a stream that outlives the object.
    explicit JsonWriter(std::ostream &out)
      : out(out)
    {
    }

    /// Begins an object '{' or a list '[', in an object with its key.
    void begin(const char bracket, const std::string &key = "")
    {
      item(key);
      out << bracket;
      first = true;
      ++depth;
    }

    /// Ends what the last begin() began, with '}' or ']'.
    void end(const char bracket)
    {
      --depth;
      out << '\n' << std::string(2 * depth, ' ') << bracket;
      first = false;
    }

    /// An entry of an object; numbers with all digits, not finite ones as null.
    void number(const std::string &key, const double value)
    {
      item(key);
      if (std::isfinite(value))
        out << std::setprecision(17) << value;
      else
        out << "null";
    }

    /// An entry of an object, with special characters escaped.
    void text(const std::string &key, const std::string &value)
    {
      item(key);
      out << quoted(value);
    }

    /// An entry of an object.
    void boolean(const std::string &key, const bool value)
    {
      item(key);
      out << (value ? "true" : "false");
    }

    template <typename V>
    /// An entry of an object: a list of numbers.
    void vector(const std::string &key, const V &v)
    {
      begin('[', key);
      for (unsigned int c = 0; c < 3; ++c)
        number("", v[c]);
      end(']');
    }

  private:
    void item(const std::string &key)
    {
      if (!first)
        out << ',';
      if (depth > 0)
        out << '\n' << std::string(2 * depth, ' ');
      first = false;
      if (!key.empty())
        out << quoted(key) << ": ";
    }

    static std::string quoted(const std::string &text)
    {
      std::ostringstream result;
      result << '"';
      for (const char c : text)
        if (c == '"' || c == '\\')
          result << '\\' << c;
        else if (static_cast<unsigned char>(c) < 32)
          result << "\\u" << std::hex << std::setw(4) << std::setfill('0') << static_cast<int>(c) << std::dec;
        else
          result << c;
      result << '"';
      return result.str();
    }

    std::ostream &out;
    bool          first = true;
    int           depth = 0;
  };
} // namespace Signorini

#endif
