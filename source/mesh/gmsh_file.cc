// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/gmsh_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmsh.h>
#include <map>
#include <sstream>
#include <vector>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Runs through the sections $Elements of a file.
    class ElementCounter
    {
    public:
      explicit ElementCounter(const std::string &file)
        : file(file)
        , in(file, std::ios::binary)
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        std::error_code error;
        const auto      found = std::filesystem::file_size(file, error);
        file_size             = error ? 0 : found;
      }

      ~ElementCounter()
      {
        try
          {
            gmsh::finalize();
          }
        catch (...)
          {
          }
      }

      ElementCounter(const ElementCounter &) = delete;

      std::size_t run()
      {
        std::string line;
        while (next_line(line))
          if (line == "$MeshFormat" && !read_format())
            return unknown_number;
          else if (line == "$Elements")
            {
              if (version < 2.)
                return unknown_number;
              if (is_binary)
                version < 4. ? count_binary_2() : count_binary_4();
              else
                count_text();
            }
        return version < 2. ? unknown_number : n_volume_elements;
      }

    private:
      struct Type
      {
        int dimension;
        int n_nodes;
      };

      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("Mesh file \"" + file + "\"" +
                         (is_binary ? "" : ", line " + std::to_string(line_number)) + ": " + text);
      }

      bool next_line(std::string &line)
      {
        if (!std::getline(in, line))
          return false;
        ++line_number;
        line = Utilities::trim(line);
        return true;
      }

      /// Whether the version and the kind of numbers are known.
      bool read_format()
      {
        int         kind = 0, size = 0;
        std::string line;
        next_line(line);
        std::istringstream(line) >> version >> kind >> size;
        is_binary = kind == 1;
        if (is_binary && get<int>() != 1)
          return false;
        return version >= 2. && version < 5. && size == sizeof(std::size_t);
      }

      Type type_of(const int type)
      {
        const auto [it, is_new] = types.insert({type, Type()});
        if (is_new)
          {
            std::string         name;
            int                 order, n_primary;
            std::vector<double> coordinates;
            try
              {
                gmsh::model::mesh::getElementProperties(type, name, it->second.dimension, order,
                                                        it->second.n_nodes, coordinates, n_primary);
              }
            catch (...)
              {
                fail("elements of type " + std::to_string(type) + " are not known.");
              }
          }
        return it->second;
      }

      template <typename Number>
      Number get()
      {
        Number value = 0;
        if (!in.read(reinterpret_cast<char *>(&value), sizeof(Number)))
          fail("it ends within its elements. Is it cut off?");
        return value;
      }

      /// Passes over n items of some bytes each.
      void skip(const std::size_t n, const std::size_t size)
      {
        if (n > file_size / std::max<std::size_t>(size, 1))
          fail("it ends within its elements. Is it cut off?");
        in.seekg(static_cast<std::streamoff>(n * size), std::ios::cur);
      }

      /// A number of elements, tags or lines.
      std::size_t count_of(const long n) const
      {
        if (n < 0)
          fail("it has a count of " + std::to_string(n) + ". Was it edited? Write it again.");
        return static_cast<std::size_t>(n);
      }

      void compare(const std::size_t announced, const std::size_t counted) const
      {
        if (announced != counted)
          fail("the section of elements announces " + std::to_string(announced) + " elements and has " +
               std::to_string(counted) + ". Was the file cut off or edited? Write it again.");
      }

      void add(const Type &type, const std::size_t n)
      {
        if (type.dimension == 3)
          n_volume_elements += n;
      }

      /// The integers of a line.
      static void split(std::vector<long> &numbers, const std::string &line)
      {
        numbers.clear();
        const char *at = line.c_str();
        for (char *end = nullptr;; at = end)
          {
            const long value = std::strtol(at, &end, 10);
            if (end == at)
              return;
            numbers.push_back(value);
          }
      }

      /// Format 2 has a line "tag type n_tags tags... nodes..." for each element, format 4 has blocks of
      /// lines "tag nodes..." with a line "dimension entity type number" in front.
      void count_text()
      {
        std::string       line;
        std::vector<long> numbers;
        next_line(line);
        split(numbers, line);
        const std::size_t position  = version < 4. ? 0 : 1;
        const std::size_t announced = numbers.size() > position ? count_of(numbers[position]) : 0;
        std::size_t       counted = 0, left_in_block = 0;
        Type              type = {};
        while (next_line(line) && line != "$EndElements")
          {
            split(numbers, line);
            if (numbers.empty())
              continue;
            if (version >= 4. && left_in_block == 0)
              {
                if (numbers.size() != 4)
                  fail("a block of elements should begin here. Does the block before announce the right "
                       "number of elements?");
                type          = type_of(static_cast<int>(numbers[2]));
                left_in_block = count_of(numbers[3]);
                continue;
              }
            std::size_t n_others = 1;
            if (version < 4.)
              {
                if (numbers.size() < 3)
                  fail("an element needs a type, tags and nodes.");
                type     = type_of(static_cast<int>(numbers[1]));
                n_others = 3 + count_of(numbers[2]);
              }
            else
              --left_in_block;
            if (numbers.size() != n_others + type.n_nodes)
              fail("the element has " +
                   std::to_string(static_cast<long>(numbers.size()) - static_cast<long>(n_others)) +
                   " nodes, its type has " + std::to_string(type.n_nodes) + ".");
            add(type, 1);
            ++counted;
          }
        compare(announced, counted + left_in_block);
      }

      void count_binary_2()
      {
        std::string       line;
        std::vector<long> numbers;
        next_line(line);
        split(numbers, line);
        const std::size_t announced = numbers.empty() ? 0 : count_of(numbers[0]);
        std::size_t       counted   = 0;
        while (counted < announced)
          {
            const Type        type   = type_of(get<int>());
            const std::size_t n      = count_of(get<int>());
            const std::size_t n_tags = count_of(get<int>());
            skip(n, sizeof(int) * (1 + n_tags + type.n_nodes));
            add(type, n);
            counted += n;
          }
        finish_binary(announced, counted);
      }

      void count_binary_4()
      {
        const bool        is_newest = version > 4.05;
        const std::size_t n_blocks = get<std::size_t>(), announced = get<std::size_t>();
        if (is_newest)
          in.seekg(2 * sizeof(std::size_t), std::ios::cur);
        std::size_t counted = 0;
        for (std::size_t block = 0; block < n_blocks; ++block)
          {
            in.seekg(2 * sizeof(int), std::ios::cur);
            const Type        type = type_of(get<int>());
            const std::size_t n    = get<std::size_t>();
            skip(n, (is_newest ? sizeof(std::size_t) : sizeof(int)) * (1 + type.n_nodes));
            add(type, n);
            counted += n;
          }
        finish_binary(announced, counted);
      }

      void finish_binary(const std::size_t announced, const std::size_t counted)
      {
        compare(announced, counted);
        std::string line;
        while (line.empty() && next_line(line))
          ;
        if (line != "$EndElements")
          fail("the section of elements goes on after the " + std::to_string(announced) +
               " elements that it announces. Was the file cut off or edited? Write it again.");
      }

      const std::string   file;
      std::ifstream       in;
      std::size_t         line_number = 0, n_volume_elements = 0, file_size = 0;
      double              version   = 0.;
      bool                is_binary = false;
      std::map<int, Type> types;
    };

    /// The ending of names of the format that a file has: its own, or that of gmsh's own format, which is
    /// known by its first line.
    std::string mesh_ending(const std::string &file)
    {
      std::string extension = std::filesystem::path(file).extension().string();
      std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
      constexpr std::array<const char *, 11> known = {
          {".mesh", ".meshb", ".vtk", ".unv", ".bdf", ".nas", ".med", ".cgns", ".neu", ".p3d", ".diff"}};
      if (std::find(known.begin(), known.end(), extension) != known.end())
        return extension;
      std::ifstream in(file, std::ios::binary);
      std::string   head(11, ' ');
      in.read(head.data(), static_cast<std::streamsize>(head.size()));
      for (const char *const word : {"$MeshFormat", "$NOD", "$Comments"})
        if (head.compare(0, std::string(word).size(), word) == 0)
          return ".msh";
      throw InputError(
          "Mesh file \"" + file + "\": it does not begin with $MeshFormat, as gmsh's files do" +
          (extension == ".msh" ? "" : ", and \"" + extension + "\" is the ending of no format known here") +
          ". Write the mesh as .msh.");
    }
  } // namespace



  GmshAlias::GmshAlias(const std::string &file)
  {
    const std::string ending = mesh_ending(file);
    std::error_code   error;
    folder            = (std::filesystem::temp_directory_path(error) / "signorini-gmsh-XXXXXX").string();
    const bool exists = !error && mkdtemp(&folder[0]) != nullptr;
    link              = folder + "/mesh" + ending;
    if (exists)
      std::filesystem::create_symlink(std::filesystem::absolute(file), link, error);
    if (!exists || error)
      {
        if (exists)
          std::filesystem::remove(folder, error);
        throw InputError("Mesh file \"" + file +
                         "\": gmsh reads it through a link in a temporary folder, which cannot be made. Let "
                         "TMPDIR be a folder that can be written to.");
      }
  }



  GmshAlias::~GmshAlias()
  {
    std::error_code error;
    std::filesystem::remove(link, error);
    std::filesystem::remove(folder, error);
  }



  std::size_t count_volume_elements(const std::string &file)
  {
    return ElementCounter(file).run();
  }
} // namespace Signorini
