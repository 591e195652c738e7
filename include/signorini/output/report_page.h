// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_report_page_h
#define signorini_output_report_page_h

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// The data of a page, one element after the other: JSON that no text in it can break out of, and arrays of
  /// numbers as base64 (little endian). A part of them can be written to a file and taken into a page later.
  class ReportBlocks
  {
  public:
    /// Writes to a stream that outlives the object.
    explicit ReportBlocks(std::ostream &out)
      : out(out)
    {
    }

    /// What `write` writes, which is JSON, for the page to find by its id (letters, digits, '-').
    void json(const std::string &id, const std::function<void(std::ostream &)> &write);

    /// Numbers as they are.
    void array(const std::string &id, const std::vector<float> &values);
    void array(const std::string &id, const std::vector<unsigned int> &values);

    /// Numbers with 16 bits: 0 to 65534 between the smallest and the largest of them, which are returned;
    /// 65535 for what is not finite. (0, 0) where there is no finite number.
    std::pair<double, double> rounded_array(const std::string &id, const std::vector<double> &values);

  private:
    void bytes(const std::string &id, const char *const type, const void *const data, const std::size_t size);

    std::ostream &out;
  };

  /// Writes a whole page: the template (contrib/report) with the blocks that `write` adds.
  void write_report_page(std::ostream &out, const std::string &title,
                         const std::function<void(ReportBlocks &)> &write);

  /// The page of a verification (`signorini verify --report`): the same template, which shows problems with
  /// errors, orders and verdicts. Keys: doc/output.md.
  /// @param json the text of the results
  void write_verification_report(std::ostream &out, const std::string &json);
} // namespace Signorini

#endif
