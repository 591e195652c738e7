// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Amplitudes of decks: loads that follow time, also in steps that do not name them again.

#include "deck_model_reader.h"

#include <algorithm>

namespace Signorini
{
  void DeckModelReader::read_amplitude(const Keyword &keyword, const unsigned int)
  {
    const std::string definition = deck_upper(keyword.get("DEFINITION"));
    if (!definition.empty() && definition != "TABULAR")
      fail(keyword.place, "amplitudes are tables, DEFINITION=" + definition + " is not supported.");
    Amplitude amplitude;
    amplitude.is_total =
        deck_upper(keyword.get("TIME")) == "TOTALTIME" || deck_upper(keyword.get("TIME")) == "TOTAL TIME";
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        for (std::size_t i = 0; i + 1 < words.size(); i += 2)
          amplitude.points.emplace_back(number(words, i, line), number(words, i + 1, line));
      }
    if (amplitude.points.empty())
      fail(keyword.place, "an AMPLITUDE needs times and values.");
    amplitudes[deck_upper(keyword.get("NAME"))] = amplitude;
  }



  double DeckModelReader::factor(const Keyword &keyword) const
  {
    if (!keyword.has("AMPLITUDE"))
      return 1.;
    const auto it = amplitudes.find(deck_upper(keyword.get("AMPLITUDE")));
    if (it == amplitudes.end())
      fail(keyword.place, "there is no AMPLITUDE \"" + keyword.get("AMPLITUDE") + "\".");
    const auto  &points = it->second.points;
    const double time   = it->second.is_total ? total_time : period;
    if (time <= points.front().first)
      return points.front().second;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (const auto [t0, a0] = points[i - 1]; time <= points[i].first)
        return a0 + (points[i].second - a0) * (time - t0) / (points[i].first - t0);
    return points.back().second;
  }



  bool DeckModelReader::follows_total_time(const Keyword &keyword) const
  {
    const auto it = amplitudes.find(deck_upper(keyword.get("AMPLITUDE")));
    return keyword.has("AMPLITUDE") && it != amplitudes.end() && it->second.is_total;
  }



  void DeckModelReader::follow_total_time()
  {
    if (std::none_of(history.begin(), history.end(), [this](const HistoryEntry &entry) {
          return entry.step < step && follows_total_time(*entry.keyword);
        }))
      return;
    const std::size_t  n_remarks   = model.remark_list.size();
    const unsigned int this_step   = step;
    const double       this_period = period;
    total_time                     = state.time;
    DeckState again;
    again.time               = state.time;
    again.nonlinear_geometry = state.nonlinear_geometry;
    state                    = again;
    for (const HistoryEntry &entry : history)
      {
        step   = entry.step;
        period = entry.period;
        (this->*entry.handler)(*entry.keyword, entry.instance);
      }
    step   = this_step;
    period = this_period;
    model.remark_list.resize(n_remarks);
  }
} // namespace Signorini
