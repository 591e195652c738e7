// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_parameter_choice_h
#define signorini_algebra_parameter_choice_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace Signorini
{
  /// Declares a parameter with one name for each value of an enum, in the current subsection. The present
  /// value is the default. `value` must outlive the handler's last use.
  template <typename Enum>
  void add_choice(dealii::ParameterHandler &prm, const std::string &name, Enum &value,
                  const std::map<Enum, std::string> &names, const std::string &documentation)
  {
    std::string selection;
    for (const auto &entry : names)
      selection += (selection.empty() ? "" : "|") + entry.second;
    prm.declare_entry(name, names.at(value), dealii::Patterns::Selection(selection), documentation);
    prm.add_action(name, [&value, names](const std::string &text) {
      for (const auto &entry : names)
        if (entry.second == text)
          value = entry.first;
    });
  }
} // namespace Signorini

#endif
