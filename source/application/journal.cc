// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/journal.h>

#include <algorithm>

namespace Signorini
{
  void Journal::note(const std::string &text)
  {
    if (std::find(remarks.begin(), remarks.end(), text) != remarks.end())
      return;
    remarks.push_back(text);
    print("note: " + text);
  }
} // namespace Signorini
