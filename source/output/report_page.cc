// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "report_template.h"
#include <signorini/output/report_page.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <streambuf>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Passes text on with '<' as JSON also writes it in strings, where alone it can be: an element can't end
    /// within.
    class EscapingBuffer : public std::streambuf
    {
    public:
      explicit EscapingBuffer(std::ostream &out)
        : out(out)
      {
      }

    protected:
      int_type overflow(const int_type c) override
      {
        if (c == '<')
          out << "\\u003c";
        else if (c != traits_type::eof())
          out.put(traits_type::to_char_type(c));
        return out ? traits_type::not_eof(c) : traits_type::eof();
      }

    private:
      std::ostream &out;
    };

    std::string html_text(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
      return result;
    }
  } // namespace



  void ReportBlocks::json(const std::string &id, const std::function<void(std::ostream &)> &write)
  {
    out << "<script type=\"application/json\" id=\"" << id << "\">\n";
    EscapingBuffer buffer(out);
    std::ostream   escaped(&buffer);
    write(escaped);
    out << "</script>\n";
  }



  void ReportBlocks::bytes(const std::string &id, const char *const type, const void *const data,
                           const std::size_t size)
  {
    out << "<script type=\"text/plain\" id=\"" << id << "\" data-type=\"" << type << "\">";
    // Pieces without padding between them.
    constexpr std::size_t      piece = 3 << 14;
    const unsigned char *const begin = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < size; i += piece)
      out << Utilities::encode_base64(
          std::vector<unsigned char>(begin + i, begin + std::min(i + piece, size)));
    out << "</script>\n";
  }



  void ReportBlocks::array(const std::string &id, const std::vector<float> &values)
  {
    bytes(id, "float32", values.data(), values.size() * sizeof(float));
  }



  void ReportBlocks::array(const std::string &id, const std::vector<unsigned int> &values)
  {
    static_assert(sizeof(unsigned int) == 4, "as the page reads it");
    bytes(id, "uint32", values.data(), values.size() * sizeof(unsigned int));
  }



  std::pair<double, double> ReportBlocks::rounded_array(const std::string         &id,
                                                        const std::vector<double> &values)
  {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const double value : values)
      if (std::isfinite(value))
        {
          low  = std::min(low, value);
          high = std::max(high, value);
        }
    if (low > high)
      low = high = 0.;
    constexpr double           steps = 65534.;
    std::vector<std::uint16_t> rounded;
    rounded.reserve(values.size());
    for (const double value : values)
      rounded.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(std::lround(
                                                   high > low ? steps * (value - low) / (high - low) : 0.))
                                             : std::numeric_limits<std::uint16_t>::max());
    bytes(id, "uint16", rounded.data(), rounded.size() * sizeof(std::uint16_t));
    return {low, high};
  }



  void write_report_page(std::ostream &out, const std::string &title,
                         const std::function<void(ReportBlocks &)> &write)
  {
    const std::string text = report_template(), title_mark = "<!-- title -->", data_mark = "<!-- data -->";
    const std::size_t title_place = text.find(title_mark), data_place = text.find(data_mark);
    AssertThrow(title_place < data_place && data_place != std::string::npos,
                ExcMessage("The template of the report has no places for title and data."));
    out << text.substr(0, title_place) << html_text(title)
        << text.substr(title_place + title_mark.size(), data_place - title_place - title_mark.size());
    ReportBlocks blocks(out);
    write(blocks);
    out << text.substr(data_place + data_mark.size());
  }



  void write_verification_report(std::ostream &out, const std::string &json)
  {
    write_report_page(out, "Signorini: verification", [&](ReportBlocks &blocks) {
      blocks.json("verification", [&](std::ostream &o) { o << json; });
    });
  }
} // namespace Signorini
