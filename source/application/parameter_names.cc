// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "parameter_names.h"

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>
#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Names that people know from elsewhere, in lower case, and ours.
    const std::multimap<std::string, std::string> &other_names()
    {
      static const std::multimap<std::string, std::string> names = {{"e", "Young modulus"},
                                                                    {"young's modulus", "Young modulus"},
                                                                    {"youngs modulus", "Young modulus"},
                                                                    {"elastic modulus", "Young modulus"},
                                                                    {"nu", "Poisson ratio"},
                                                                    {"poisson's ratio", "Poisson ratio"},
                                                                    {"fixed", "Dirichlet"},
                                                                    {"displacement", "Dirichlet"},
                                                                    {"displacements", "Dirichlet"},
                                                                    {"boundary conditions", "Dirichlet"},
                                                                    {"neumann", "Tractions"},
                                                                    {"neumann", "Forces"},
                                                                    {"load", "Forces"},
                                                                    {"load", "Pressures"},
                                                                    {"loads", "Forces"},
                                                                    {"loads", "Pressures"},
                                                                    {"gravity", "Volume force"},
                                                                    {"body force", "Volume force"},
                                                                    {"master", "Second"},
                                                                    {"slave", "First"},
                                                                    {"slave", "Nonmortar"},
                                                                    {"file", "Mesh"},
                                                                    {"mesh file", "Mesh"},
                                                                    {"material", "Young modulus"},
                                                                    {"adaptive steps", "Adaptive cycles"}};
      return names;
    }

    /// Letters that have to be changed, added or left out (Levenshtein).
    std::size_t distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), std::size_t(0));
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t change = diagonal + (a[i] != b[j]);
              diagonal                 = row[j + 1];
              row[j + 1]               = std::min({change, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }

    bool is_similar(const std::string &name, const std::string &candidate)
    {
      const std::string a                      = boost::algorithm::to_lower_copy(name),
                        b                      = boost::algorithm::to_lower_copy(candidate);
      constexpr std::size_t shortest_beginning = 4;
      if (a.size() >= shortest_beginning && b.size() >= shortest_beginning &&
          (boost::algorithm::starts_with(a, b) || boost::algorithm::starts_with(b, a)))
        return true;
      return distance(a, b) <= std::max(a.size(), b.size()) / 3;
    }

    std::string quoted_list(const std::vector<std::string> &names, const std::string &last_word)
    {
      // All parameters of a body are half of that; names of hundreds of bodies help nobody.
      constexpr std::size_t longest = 1500, longest_name = 100;
      std::string           text;
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          if (text.size() > longest)
            return text + " and " + std::to_string(names.size() - i) + " more";
          const std::string &name = names[i];
          text += (i == 0                 ? ""
                   : i + 1 < names.size() ? ", "
                                          : last_word) +
                  "\"" + (name.size() > longest_name ? name.substr(0, longest_name) + " ..." : name) + "\"";
        }
      return text;
    }

    /// The names that may be meant, the most similar one first.
    std::vector<std::string> similar_names(const std::string &name, const std::vector<std::string> &names)
    {
      std::vector<std::string> result;
      const auto [begin, end] = other_names().equal_range(boost::algorithm::to_lower_copy(name));
      for (auto it = begin; it != end; ++it)
        if (std::find(names.begin(), names.end(), it->second) != names.end())
          result.push_back(it->second);
      if (!result.empty())
        return result;
      std::copy_if(names.begin(), names.end(), std::back_inserter(result),
                   [&](const std::string &candidate) { return is_similar(name, candidate); });
      std::stable_sort(result.begin(), result.end(), [&](const std::string &a, const std::string &b) {
        return distance(boost::algorithm::to_lower_copy(name), boost::algorithm::to_lower_copy(a)) <
               distance(boost::algorithm::to_lower_copy(name), boost::algorithm::to_lower_copy(b));
      });
      return result;
    }

    using Tree = boost::property_tree::ptree;

    void collect(std::map<std::string, std::vector<std::string>> &entries, const Tree &tree,
                 const std::string &section)
    {
      for (const auto &[name, child] : tree)
        if (child.count("value") > 0)
          entries[section].push_back(name);
        else
          {
            const std::string inner = section.empty() ? name : section + "/" + name;
            entries[inner];
            collect(entries, child, inner);
          }
    }

    /// What follows a word at the beginning of a line; empty if it begins with something else.
    std::string after_word(const std::string &line, const std::string &word)
    {
      return line.compare(0, word.size(), word) == 0 && line.size() > word.size() &&
                     std::isspace(static_cast<unsigned char>(line[word.size()])) != 0
                 ? Utilities::trim(line.substr(word.size()))
                 : "";
    }

    std::string text_of_section(const std::string &section)
    {
      return section.empty() ? "outside of the subsections" : "in subsection \"" + section + "\"";
    }
  } // namespace



  ParameterNames::ParameterNames(const ParameterHandler &prm)
  {
    std::stringstream text;
    prm.print_parameters(text, ParameterHandler::JSON);
    Tree tree;
    try
      {
        boost::property_tree::read_json(text, tree);
      }
    catch (const boost::property_tree::json_parser_error &)
      {
        // Texts that are not in UTF-8 (names of bodies become names of subsections): nothing is suggested.
        return;
      }
    entries[""];
    collect(entries, tree, "");
  }



  std::string ParameterNames::other_sections_with(const std::string &name) const
  {
    for (const auto &[section, names] : entries)
      if (std::find(names.begin(), names.end(), name) != names.end())
        return section.empty() ? "It belongs outside of the subsections."
                               : "It is a parameter of subsection \"" + section + "\".";
    return "";
  }



  std::string ParameterNames::objection_to_section(const std::string &section) const
  {
    std::vector<std::string> names;
    for (const auto &[name, list] : entries)
      if (!name.empty())
        names.push_back(name);
    const std::vector<std::string> similar = similar_names(section, names);
    return "there is no subsection \"" + section + "\". " +
           (similar.empty() ? "Those that this file may have: " + quoted_list(names, " and ")
                            : "Perhaps " + quoted_list(similar, " or ") + " is meant") +
           ". (\"Body ...\" and \"Pair ...\" are those of the names in Bodies and Contact pairs.)";
  }



  std::string ParameterNames::objection(const std::string &section, const std::string &name) const
  {
    if (entries.empty())
      return "";
    const auto it = entries.find(section);
    if (it == entries.end())
      return objection_to_section(section);
    const std::vector<std::string> &names = it->second;
    if (std::find(names.begin(), names.end(), name) != names.end())
      return "";
    std::string text = "there is no parameter \"" + name + "\" " + text_of_section(section) + ". ";
    const std::vector<std::string> similar   = similar_names(name, names);
    const std::string              elsewhere = other_sections_with(name);
    if (!elsewhere.empty())
      text += elsewhere;
    else if (!similar.empty())
      text += "Perhaps " + quoted_list(similar, " or ") + " is meant.";
    else
      text += "Those that there are: " + quoted_list(names, " and ") + ".";
    return text + " Option --print-parameters explains them.";
  }



  std::string ParameterNames::objection_to_line(const std::string &text, const std::size_t line) const
  {
    if (entries.empty())
      return "";
    std::istringstream in(text);
    std::string        content, section;
    for (std::size_t i = 1; std::getline(in, content); ++i)
      {
        content                = Utilities::trim(content);
        const std::string name = after_word(content, "subsection");
        if (i == line)
          return !name.empty()
                     ? objection_to_section(section.empty() ? name : section + "/" + name)
                     : objection(
                           section,
                           Utilities::trim(
                               after_word(content, "set").substr(0, after_word(content, "set").find('='))));
        if (!name.empty())
          section += (section.empty() ? "" : "/") + name;
        else if (content == "end")
          section.erase(section.rfind('/') == std::string::npos ? 0 : section.rfind('/'));
      }
    return "";
  }
} // namespace Signorini
