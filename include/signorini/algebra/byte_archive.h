// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_byte_archive_h
#define signorini_algebra_byte_archive_h

#include <signorini/algebra/input_error.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace Signorini
{
  /// Whether a list of them is copied as a whole.
  template <typename T>
  constexpr bool is_bulk = std::is_arithmetic<T>::value && !std::is_same<T, bool>::value;

  /// What a struct consists of: an overload for it, beside it, calls the archive with all members, the same
  /// for both directions. There is none for all types.
  template <typename Archive, typename T>
  void transfer(Archive &archive, T &value) = delete;

  /// Values as bytes, one after the other: numbers, texts, places, lists and the like, and structs with a
  /// transfer().
  class ByteWriter
  {
  public:
    /// Appends values.
    template <typename... Values>
    void operator()(const Values &...values)
    {
      (write(values), ...);
    }

    /// All so far.
    const std::string &bytes() const &
    {
      return text;
    }

    /// The same of a writer that is done.
    std::string bytes() &&
    {
      return std::move(text);
    }

  private:
    template <typename T>
    void write(const T &value)
    {
      if constexpr (std::is_arithmetic<T>::value || std::is_enum<T>::value)
        text.append(reinterpret_cast<const char *>(&value), sizeof(T));
      else
        transfer(*this, const_cast<T &>(value));
    }

    void write(const std::string &value)
    {
      write(static_cast<std::uint64_t>(value.size()));
      text += value;
    }

    void write(const dealii::Tensor<1, 3> &value)
    {
      for (unsigned int c = 0; c < 3; ++c)
        write(value[c]);
    }

    void write(const dealii::Point<3> &value)
    {
      write(static_cast<const dealii::Tensor<1, 3> &>(value));
    }

    template <typename T>
    void write(const std::vector<T> &values)
    {
      write(static_cast<std::uint64_t>(values.size()));
      if constexpr (is_bulk<T>)
        text.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T));
      else
        for (const auto &value : values)
          write(static_cast<const T &>(value));
    }

    template <typename T, std::size_t n>
    void write(const std::array<T, n> &values)
    {
      for (const T &value : values)
        write(value);
    }

    template <typename... Values>
    void write(const std::tuple<Values...> &values)
    {
      std::apply(*this, values);
    }

    template <typename Key, typename T>
    void write(const std::map<Key, T> &values)
    {
      write(static_cast<std::uint64_t>(values.size()));
      for (const auto &[key, value] : values)
        (*this)(key, value);
    }

    template <typename First, typename Second>
    void write(const std::pair<First, Second> &value)
    {
      (*this)(value.first, value.second);
    }

    template <typename T>
    void write(const std::optional<T> &value)
    {
      write(value.has_value());
      if (value)
        write(*value);
    }

    std::string text;
  };



  /// Gives back what a ByteWriter took, in its order. Errors: InputError for bytes that end too early.
  class ByteReader
  {
  public:
    /// The bytes of a ByteWriter.
    explicit ByteReader(std::string bytes)
      : text(std::move(bytes))
    {
    }

    /// Takes values.
    template <typename... Values>
    void operator()(Values &...values)
    {
      (read(values), ...);
    }

    /// Whether nothing is left.
    bool is_at_end() const
    {
      return position == text.size();
    }

  private:
    template <typename T>
    void read(T &value)
    {
      if constexpr (std::is_arithmetic<T>::value || std::is_enum<T>::value)
        take(&value, sizeof(T));
      else
        transfer(*this, value);
    }

    void read(std::string &value)
    {
      value.resize(length());
      take(&value[0], value.size());
    }

    void read(dealii::Tensor<1, 3> &value)
    {
      for (unsigned int c = 0; c < 3; ++c)
        read(value[c]);
    }

    void read(dealii::Point<3> &value)
    {
      read(static_cast<dealii::Tensor<1, 3> &>(value));
    }

    template <typename T>
    void read(std::vector<T> &values)
    {
      const std::size_t n = length();
      values.clear();
      if constexpr (is_bulk<T>)
        {
          if (n > (text.size() - position) / sizeof(T))
            fail();
          values.resize(n);
          take(values.data(), n * sizeof(T));
        }
      else
        for (std::size_t i = 0; i < n; ++i)
          {
            T value{};
            read(value);
            values.push_back(std::move(value));
          }
    }

    template <typename T, std::size_t n>
    void read(std::array<T, n> &values)
    {
      for (T &value : values)
        read(value);
    }

    template <typename... Values>
    void read(std::tuple<Values...> &values)
    {
      std::apply(*this, values);
    }

    template <typename Key, typename T>
    void read(std::map<Key, T> &values)
    {
      const std::size_t n = length();
      values.clear();
      for (std::size_t i = 0; i < n; ++i)
        {
          Key key{};
          read(key);
          read(values[key]);
        }
    }

    template <typename First, typename Second>
    void read(std::pair<First, Second> &value)
    {
      (*this)(value.first, value.second);
    }

    template <typename T>
    void read(std::optional<T> &value)
    {
      bool is_there = false;
      read(is_there);
      value = is_there ? std::optional<T>(T{}) : std::optional<T>();
      if (value)
        read(*value);
    }

    /// Of a list: none of its entries is shorter than a byte.
    std::size_t length()
    {
      std::uint64_t n = 0;
      read(n);
      if (n > text.size() - position)
        fail();
      return static_cast<std::size_t>(n);
    }

    void take(void *const to, const std::size_t n)
    {
      if (n > text.size() - position)
        fail();
      text.copy(static_cast<char *>(to), n, position);
      position += n;
    }

    [[noreturn]] static void fail()
    {
      throw InputError("it ends too early.");
    }

    const std::string text;
    std::size_t       position = 0;
  };



  /// A value as a ByteWriter has it.
  template <typename T>
  std::string to_bytes(const T &value)
  {
    ByteWriter writer;
    writer(value);
    return std::move(writer).bytes();
  }

  /// Such a value again. Errors: InputError, std::logic_error if they are those of something else.
  template <typename T>
  T from_bytes(std::string bytes)
  {
    T          value{};
    ByteReader reader(std::move(bytes));
    reader(value);
    if (!reader.is_at_end())
      throw std::logic_error("More bytes than those of a value.");
    return value;
  }
} // namespace Signorini

#endif
