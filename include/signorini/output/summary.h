// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_summary_h
#define signorini_output_summary_h

#include <signorini/output/results.h>

#include <iosfwd>
#include <string>

namespace Signorini
{
  class JsonWriter;

  /// The figures of a mapping as members of the open JSON object.
  void write_mapping_report(JsonWriter &json, const MappingReport &report);

  /// summary.json (keys: doc/output.md). Numbers that are not finite become null.
  void write_summary(std::ostream &out, const Results &results);

  /// table.txt: the columns of Table 1 of the paper, rates and times.
  void write_table(std::ostream &out, const Results &results);

  /// convergence.csv: cycle, iteration, correction (energy norm), relative, active nodes.
  void write_convergence(std::ostream &out, const Results &results);

  /// pressure.csv: a row for each contact node, those of the nonmortar sides first.
  void write_pressure(std::ostream &out, const Results &results);

  /// The certificate in words.
  void print_certificate(std::ostream &out, const Results &results);
} // namespace Signorini

#endif
