// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "report_template.h"

// The file as it is: an array in a source takes compilers a hundred times as long. SIGNORINI_REPORT_TEMPLATE
// is its path (source/CMakeLists.txt).
asm(".pushsection .rodata\n"
    "signorini_report_template_begin:\n"
    ".incbin \"" SIGNORINI_REPORT_TEMPLATE "\"\n"
    "signorini_report_template_end:\n"
    ".byte 0\n"
    ".global signorini_report_template_begin\n"
    ".global signorini_report_template_end\n"
    ".popsection\n");

extern "C"
{
  extern const char signorini_report_template_begin[], signorini_report_template_end[];
}

namespace Signorini
{
  std::string report_template()
  {
    return {signorini_report_template_begin, signorini_report_template_end};
  }
} // namespace Signorini
