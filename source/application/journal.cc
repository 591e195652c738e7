// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/journal.h>

#include <algorithm>

namespace Signorini
{
  std::string note_line(const std::string &remark)
  {
    return (remark.rfind("warning: ", 0) == 0 ? "" : "note: ") + remark;
  }



  void Journal::note(const std::string &text)
  {
    if (std::find(remarks.begin(), remarks.end(), text) != remarks.end())
      return;
    remarks.push_back(text);
    print(note_line(text));
  }
} // namespace Signorini
