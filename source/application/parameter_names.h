// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_parameter_names_h
#define signorini_source_application_parameter_names_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace Signorini
{
  /// The names that a parameter file may use, for messages about others.
  class ParameterNames
  {
  public:
    /// Of what is declared.
    explicit ParameterNames(const dealii::ParameterHandler &prm);

    /// What is wrong with a parameter of a section ("" for the top level), and what may be meant; empty if
    /// there is one.
    std::string objection(const std::string &section, const std::string &name) const;

    /// The same of a line of a file, counted from 1: a parameter or the beginning of a section that does not
    /// exist. Empty if it is something else that is wrong there.
    std::string objection_to_line(const std::string &text, const std::size_t line) const;

  private:
    std::string objection_to_section(const std::string &section) const;

    std::string other_sections_with(const std::string &name) const;

    /// By section.
    std::map<std::string, std::vector<std::string>> entries;
  };
} // namespace Signorini

#endif
