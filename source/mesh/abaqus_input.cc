// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/abaqus_input.h>
#include <signorini/mesh/mesh_input.h>

#include <deal.II/base/utilities.h>

#include <fstream>
#include <map>
#include <set>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::string upper(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), ::toupper);
      return text;
    }

    /// Sets of node or element labels by name, in the order of the file.
    struct LabelSets
    {
      std::vector<std::pair<std::string, std::set<long>>> sets;

      std::set<long> *find(const std::string &name)
      {
        for (auto &[n, labels] : sets)
          if (upper(n) == upper(name))
            return &labels;
        return nullptr;
      }

      std::set<long> &get(const std::string &name)
      {
        if (std::set<long> *labels = find(name))
          return *labels;
        sets.emplace_back(name, std::set<long>());
        return sets.back().second;
      }
    };

    /// Corners (numbered as in Abaqus) of the faces S1, S2, ...
    const std::vector<std::vector<unsigned int>> &faces_of(const std::size_t n_vertices)
    {
      static const std::vector<std::vector<unsigned int>> tetrahedron = {
          {0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
      static const std::vector<std::vector<unsigned int>> hexahedron = {
          {0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
      return n_vertices == 4 ? tetrahedron : hexahedron;
    }

    class AbaqusReader
    {
    public:
      explicit AbaqusReader(const std::string &file)
        : file(file)
      {
        std::ifstream in(file);
        std::string   line;
        while (std::getline(in, line))
          {
            ++line_number;
            line = Utilities::trim(line);
            if (line.empty() || line.compare(0, 2, "**") == 0)
              continue;
            if (line[0] == '*')
              start_keyword(line);
            else
              add_data(line);
          }
        finish_element();
      }

      VolumeMesh mesh()
      {
        VolumeMesh mesh;
        if (elements.empty())
          throw InputError("Mesh file \"" + file + "\": it contains neither C3D4 nor C3D8 elements.");
        std::unordered_map<long, std::string> volume_of;
        for (const auto &[name, labels] : element_sets.sets)
          for (const long label : labels)
            volume_of[label] = name;
        // Abaqus runs around the bottom, then the top.
        constexpr unsigned int lexicographic[8] = {0, 1, 3, 2, 4, 5, 7, 6};
        for (const auto &[label, vertices] : elements)
          {
            const auto         name = volume_of.find(label);
            const unsigned int n    = static_cast<unsigned int>(vertices.size());
            mesh.cells.push_back(
                {{}, n, index_of(mesh.volume_names, name == volume_of.end() ? "unnamed" : name->second)});
            for (unsigned int v = 0; v < n; ++v)
              mesh.cells.back().vertices[v] = vertex(mesh, vertices[n == 8 ? lexicographic[v] : v]);
          }
        name_faces(mesh, named_faces(mesh));
        return mesh;
      }

    private:
      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("Mesh file \"" + file + "\", line " + std::to_string(line_number) + ": " + text);
      }

      /// A word read as a whole by std::stol or std::stod; `what` it should be.
      template <typename Number, typename Parse>
      Number number_in(const std::string &word, const Parse &parse, const std::string &what) const
      {
        std::size_t used  = 0;
        Number      value = 0;
        try
          {
            value = parse(word, &used);
          }
        catch (const std::exception &)
          {
          }
        if (used == 0 || used != word.size() || !std::isfinite(static_cast<double>(value)))
          fail("\"" + word + "\" should be a " + what + ".");
        return value;
      }

      long label_in(const std::string &word) const
      {
        return number_in<long>(
            word, [](const std::string &w, std::size_t *used) { return std::stol(w, used); }, "number");
      }

      double coordinate_in(const std::string &word) const
      {
        return number_in<double>(
            word, [](const std::string &w, std::size_t *used) { return std::stod(w, used); }, "coordinate");
      }

      void start_keyword(const std::string &line)
      {
        finish_element();
        const auto words = Utilities::split_string_list(line, ',');
        keyword          = upper(words[0]);
        options.clear();
        for (std::size_t i = 1; i < words.size(); ++i)
          {
            const auto equals = words[i].find('=');
            options[upper(Utilities::trim(words[i].substr(0, equals)))] =
                equals == std::string::npos ? "" : Utilities::trim(words[i].substr(equals + 1));
          }
        if (keyword == "*PART" && ++n_parts > 1)
          fail("more than one PART is not supported; use one file for each body.");
        if (keyword == "*INCLUDE")
          fail("INCLUDE is not supported.");
        if (keyword == "*ELEMENT")
          {
            const std::string type = upper(options["TYPE"]);
            // Variants with reduced integration and the like have the same nodes.
            n_corners = type.compare(0, 5, "C3D10") == 0  ? 0
                        : type.compare(0, 4, "C3D4") == 0 ? 4
                        : type.compare(0, 4, "C3D8") == 0 ? 8
                                                          : 0;
            if (n_corners == 0)
              fail("elements of type \"" + type + "\" are not supported; use C3D4 or C3D8.");
          }
        if (keyword == "*SURFACE")
          {
            if (options.count("TYPE") > 0 && upper(options["TYPE"]) != "ELEMENT")
              keyword = "";
            else
              surfaces.emplace_back(options["NAME"], std::vector<std::pair<std::string, std::string>>());
          }
      }

      void add_data(const std::string &line)
      {
        std::vector<std::string> words = Utilities::split_string_list(line, ',');
        while (!words.empty() && words.back().empty())
          words.pop_back();
        if (keyword == "*NODE")
          {
            if (words.size() < 4)
              fail("a node needs a number and three coordinates. Is the file cut off?");
            const long     label = label_in(words[0]);
            const Point<3> position(coordinate_in(words[1]), coordinate_in(words[2]),
                                    coordinate_in(words[3]));
            const auto [it, is_new] = nodes.insert({label, position});
            if (!is_new && it->second != position)
              fail("node " + words[0] +
                   " is there twice, in different places. Give each node its own number.");
            if (options.count("NSET") > 0)
              node_sets.get(options["NSET"]).insert(label);
          }
        else if (keyword == "*ELEMENT")
          {
            for (const std::string &word : words)
              element.push_back(label_in(word));
            if (element.size() == n_corners + 1)
              add_element();
            else if (element.size() > n_corners + 1)
              fail("too many nodes in an element.");
          }
        else if (keyword == "*NSET" || keyword == "*ELSET")
          add_to_set(keyword == "*NSET" ? node_sets : element_sets,
                     options[keyword == "*NSET" ? "NSET" : "ELSET"], words);
        else if (keyword == "*SURFACE" && words.size() >= 2)
          surfaces.back().second.emplace_back(words[0], upper(words[1]));
        else if (keyword == "*INSTANCE")
          fail("an INSTANCE that is moved is not supported; move the body with its own parameters.");
      }

      void add_element()
      {
        if (!elements.insert({element[0], {element.begin() + 1, element.end()}}).second)
          fail("element " + std::to_string(element[0]) +
               " is there twice. Give each element its own number, or take the copy out.");
        if (options.count("ELSET") > 0)
          element_sets.get(options["ELSET"]).insert(element[0]);
        element.clear();
      }

      void finish_element() const
      {
        if (!element.empty())
          fail("an element has too few nodes. Is the file cut off?");
      }

      void add_to_set(LabelSets &sets, const std::string &name, const std::vector<std::string> &words)
      {
        std::set<long> &labels = sets.get(name);
        if (options.count("GENERATE") > 0)
          {
            if (words.size() < 2)
              fail("GENERATE needs first, last and step.");
            const long first = label_in(words[0]), last = label_in(words[1]),
                       step = words.size() > 2 ? label_in(words[2]) : 1;
            if (step < 1)
              fail("the step must be positive.");
            for (long label = first; label <= last; label += step)
              labels.insert(label);
            return;
          }
        for (const std::string &word : words)
          if (std::isdigit(static_cast<unsigned char>(word[0])))
            labels.insert(label_in(word));
          else if (const std::set<long> *other = sets.find(word))
            {
              const std::set<long> copy = *other;
              sets.get(name).insert(copy.begin(), copy.end());
            }
          else
            fail("there is no set \"" + word + "\".");
      }

      unsigned int vertex(VolumeMesh &mesh, const long label)
      {
        const auto it = nodes.find(label);
        if (it == nodes.end())
          throw InputError("Mesh file \"" + file + "\": an element refers to node " + std::to_string(label) +
                           ", which is missing. Is the file cut off?");
        const auto [entry, is_new] = number.insert({label, static_cast<unsigned int>(mesh.vertices.size())});
        if (is_new)
          mesh.vertices.push_back(it->second);
        return entry->second;
      }

      std::map<VolumeMesh::Face, std::string> named_faces(VolumeMesh &mesh)
      {
        std::map<VolumeMesh::Face, std::string> named;
        for (const auto &[name, entries] : surfaces)
          for (const auto &[set, side] : entries)
            for (const long label : elements_in(set, name))
              if (const auto it = elements.find(label); it != elements.end())
                named.insert({face_key(side_of(mesh, it->second, side, name)), name});
        name_by_nodes(named, mesh);
        return named;
      }

      /// The elements that a line of a surface names: a label or a set.
      std::set<long> elements_in(const std::string &set, const std::string &surface)
      {
        if (std::isdigit(static_cast<unsigned char>(set[0])))
          return {std::stol(set)};
        if (const auto *found = element_sets.find(set))
          return *found;
        throw InputError("Mesh file \"" + file + "\": surface \"" + surface + "\" refers to ELSET \"" + set +
                         "\", which does not exist.");
      }

      /// Side S1, S2, ... of an element with given nodes.
      VolumeMesh::Face side_of(VolumeMesh &mesh, const std::vector<long> &nodes, const std::string &side,
                               const std::string &surface)
      {
        const long  face  = side.size() > 1 && side[0] == 'S' ? std::atol(side.c_str() + 1) : 0;
        const auto &faces = faces_of(nodes.size());
        if (face < 1 || face > static_cast<long>(faces.size()))
          throw InputError("Mesh file \"" + file + "\": surface \"" + surface + "\" has a side \"" + side +
                           "\"; sides are S1, S2, ...");
        VolumeMesh::Face result;
        result.fill(VolumeMesh::no_vertex);
        for (std::size_t v = 0; v < faces[face - 1].size(); ++v)
          result[v] = vertex(mesh, nodes[faces[face - 1][v]]);
        return result;
      }

      /// Boundary faces without a name all of whose nodes belong to a set have the name of the smallest one.
      void name_by_nodes(std::map<VolumeMesh::Face, std::string> &named, const VolumeMesh &mesh) const
      {
        std::unordered_map<unsigned int, std::set<std::size_t>> sets_of;
        for (std::size_t s = 0; s < node_sets.sets.size(); ++s)
          for (const long label : node_sets.sets[s].second)
            if (const auto it = number.find(label); it != number.end())
              sets_of[it->second].insert(s);
        for (const auto &face : find_boundary_faces(mesh))
          {
            std::set<std::size_t> common = sets_of[face.first[0]];
            for (const unsigned int v : face.first)
              if (v != VolumeMesh::no_vertex)
                for (auto it = common.begin(); it != common.end();)
                  it = sets_of[v].count(*it) > 0 ? std::next(it) : common.erase(it);
            if (common.empty())
              continue;
            const std::size_t smallest = *std::min_element(
                common.begin(), common.end(), [&](const std::size_t a, const std::size_t b) {
                  return node_sets.sets[a].second.size() < node_sets.sets[b].second.size();
                });
            named.insert({face_key(face.first), node_sets.sets[smallest].first});
          }
      }

      const std::string                  file;
      std::size_t                        line_number = 0;
      std::string                        keyword;
      std::map<std::string, std::string> options;
      unsigned int                       n_parts   = 0;
      std::size_t                        n_corners = 0;
      std::vector<long>                  element;

      std::unordered_map<long, Point<3>> nodes;
      std::map<long, std::vector<long>>  elements;
      LabelSets                          node_sets, element_sets;
      std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> surfaces;
      std::unordered_map<long, unsigned int>                                                number;
    };
  } // namespace



  VolumeMesh read_abaqus_mesh(const std::string &file)
  {
    return AbaqusReader(file).mesh();
  }
} // namespace Signorini
