// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/frd_output.h>

#include <deal.II/base/exceptions.h>

#include <cstdio>

namespace Signorini
{
  namespace
  {
    /// A piece of a line with a format of printf.
    template <typename... Values>
    std::string text(const char *const format, const Values... values)
    {
      char buffer[128];
      std::snprintf(buffer, sizeof(buffer), format, values...);
      return buffer;
    }

    /// A number in twelve columns; exponents have two digits.
    std::string number(const double value)
    {
      if (!(std::abs(value) < 1e100))
        return value < 0. ? "-9.99999E+99" : " 9.99999E+99";
      return text("%12.5E", std::abs(value) < 1e-99 ? 0. : value);
    }

    struct Component
    {
      const char *name;
      int         type, row, column;
    };

    const std::vector<Component> &components_of(const std::string &field)
    {
      static const std::vector<Component> displacement = {{"D1", 2, 1, 0}, {"D2", 2, 2, 0}, {"D3", 2, 3, 0}},
                                          stress  = {{"SXX", 4, 1, 1}, {"SYY", 4, 2, 2}, {"SZZ", 4, 3, 3},
                                                     {"SXY", 4, 1, 2}, {"SYZ", 4, 2, 3}, {"SZX", 4, 3, 1}},
                                          contact = {{"COPEN", 4, 1, 1},   {"CSLIP1", 4, 2, 2},
                                                     {"CSLIP2", 4, 3, 3},  {"CPRESS", 4, 1, 2},
                                                     {"CSHEAR1", 4, 2, 3}, {"CSHEAR2", 4, 3, 1}};
      AssertThrow(field == "DISP" || field == "STRESS" || field == "CONTACT", dealii::ExcInternalError());
      return field == "DISP" ? displacement : field == "STRESS" ? stress : contact;
    }

    /// The viewer's number of a kind of elements, and its order of their nodes.
    std::pair<int, std::vector<unsigned int>> element_type(const std::size_t n_nodes)
    {
      // The viewer has the mid nodes of upright edges before those of the top.
      static const std::vector<unsigned int> hexahedron = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                           10, 11, 16, 17, 18, 19, 12, 13, 14, 15},
                                             wedge      = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
      std::vector<unsigned int> order;
      for (unsigned int i = 0; i < n_nodes; ++i)
        order.push_back(i);
      switch (n_nodes)
        {
          case 8:
            return {1, order};
          case 6:
            return {2, order};
          case 4:
            return {3, order};
          case 20:
            return {4, hexahedron};
          case 15:
            return {5, wedge};
          default:
            return {6, order};
        }
    }

    void write_mesh(std::ostream &out, const FrdMesh &mesh)
    {
      out << text("    2C%30zu                                     1\n", mesh.labels.size());
      for (std::size_t i = 0; i < mesh.labels.size(); ++i)
        {
          out << text(" -1%10ld", mesh.labels[i]);
          for (unsigned int c = 0; c < 3; ++c)
            out << number(mesh.positions[i][c]);
          out << '\n';
        }
      out << " -3\n" << text("    3C%30zu                                     1\n", mesh.elements.size());
      for (const FrdElement &element : mesh.elements)
        {
          const auto [type, order] = element_type(element.nodes.size());
          out << text(" -1%10ld%5d    0    1\n", element.label, type);
          for (std::size_t i = 0; i < order.size(); ++i)
            out << (i % 10 == 0 ? " -2" : "") << text("%10ld", element.nodes[order[i]])
                << (i % 10 == 9 || i + 1 == order.size() ? "\n" : "");
        }
      out << " -3\n";
    }
  } // namespace



  void write_frd(std::ostream &out, const FrdMesh &mesh, const std::vector<FrdField> &fields,
                 const double time)
  {
    out << "    1C\n    1UPGM               Signorini\n";
    write_mesh(out, mesh);
    unsigned int step = 0;
    for (const FrdField &field : fields)
      {
        const auto &components = components_of(field.name);
        const bool  has_norm   = field.name == "DISP";
        out << text("    1PSTEP%26u%12u%12u\n", ++step, 1u, 1u)
            << text("  100CL  101%s%12zu                     0    1           1\n", number(time).c_str(),
                    field.labels.size())
            << text(" -4  %-8s%5zu    1\n", field.name.c_str(), components.size() + (has_norm ? 1 : 0));
        for (const Component &c : components)
          out << text(" -5  %-8s%5d%5d%5d%5d\n", c.name, 1, c.type, c.row, c.column);
        if (has_norm)
          out << " -5  ALL         1    2    0    0    1ALL\n";
        for (std::size_t i = 0; i < field.labels.size(); ++i)
          {
            out << text(" -1%10ld", field.labels[i]);
            for (std::size_t c = 0; c < components.size(); ++c)
              out << number(field.values[components.size() * i + c]);
            out << '\n';
          }
        out << " -3\n";
      }
    out << " 9999\n";
  }
} // namespace Signorini
