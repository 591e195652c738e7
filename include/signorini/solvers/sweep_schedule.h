// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_sweep_schedule_h
#define signorini_solvers_sweep_schedule_h

#include <signorini/algebra/node_exchange.h>
#include <signorini/solvers/node_phases.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// In which direction a sweep goes over its rows.
  enum class Direction
  {
    forward,
    backward
  };

  /// The order of a sweep on many ranks: phase after phase, the rows that other ranks see, then inner ones
  /// while the changes of the former travel. Backward is exactly the opposite. The number of messages of a
  /// sweep to each neighbour is the number of phases, however many ranks there are.
  ///
  /// What is visited is rows, or blocks of rows, both called items here. Ranks that visit neighbouring rows
  /// in the same phase do not see each other's changes: such rows have to be damped (SweepDamping).
  class SweepSchedule
  {
  public:
    /// Positions of the items of a phase in order(): from begin to border_end those that others see.
    struct Phase
    {
      /// See above.
      std::size_t begin, border_end, end;
    };

    SweepSchedule() = default;

    /// Collective. Rows in their phases.
    /// @param rows ascending
    SweepSchedule(const NodePartition &partition, const NodePhases &phases,
                  const std::vector<unsigned int> &rows);

    /// An item that is visited in a phase.
    struct Item
    {
      /// Its number, its phase, and whether it changes nodes that other ranks see.
      unsigned int number, phase;
      bool         is_border;
    };

    /// Not collective. Any items, in this order within a phase.
    /// @param phases_of_node for each local node the phases in which it may change: bit c for phase c
    SweepSchedule(const NodePartition &partition, const unsigned int n_phases, const std::vector<Item> &items,
                  const std::vector<unsigned char> &phases_of_node);

    /// All items in the order in which they are visited forward.
    const std::vector<unsigned int> &order() const
    {
      return items;
    }

    /// The same number on all ranks.
    const std::vector<Phase> &phases() const
    {
      return ranges;
    }

    /// Collective. Calls visit(begin, end) for ranges of positions of order() (to be visited from the last on
    /// if it goes backward), and follow(ghost, change) when a ghost, counted from 0, has been changed by its
    /// owner. Ghost values of v must be up to date, and are so in the end.
    template <typename Visit, typename Follow>
    void visit(Vector &v, const Direction direction, const Visit &visit, const Follow &follow) const;

    /// Collective. Calls action(item) for one after the other in the order of the sweep, for those who need
    /// not follow changes of ghosts.
    template <typename Action>
    void visit_each(Vector &v, const Direction direction, const Action &action) const
    {
      const auto of_range = [&](const std::size_t begin, const std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
          action(items[direction == Direction::forward ? k : begin + end - 1 - k]);
      };
      visit(v, direction, of_range, [](const unsigned int, const double *) {});
    }

    /// Messages that this rank sends in a sweep.
    std::size_t n_messages() const;

  private:
    std::vector<unsigned int> items;
    std::vector<Phase>        ranges = {{0, 0, 0}};
    /// Of each phase; empty on one rank.
    std::vector<std::shared_ptr<NodeExchange>> exchanges;
  };



  template <typename Visit, typename Follow>
  void SweepSchedule::visit(Vector &v, const Direction direction, const Visit &visit,
                            const Follow &follow) const
  {
    const bool has_others = !exchanges.empty();
    if (direction == Direction::forward)
      for (std::size_t c = 0; c < ranges.size(); ++c)
        {
          visit(ranges[c].begin, ranges[c].border_end);
          if (has_others)
            exchanges[c]->start(v);
          visit(ranges[c].border_end, ranges[c].end);
          if (has_others)
            exchanges[c]->finish(v, follow);
        }
    else
      {
        for (std::size_t c = ranges.size(); c-- > 0;)
          {
            visit(ranges[c].border_end, ranges[c].end);
            if (has_others && c + 1 < ranges.size())
              exchanges[c + 1]->finish(v, follow);
            visit(ranges[c].begin, ranges[c].border_end);
            if (has_others)
              exchanges[c]->start(v);
          }
        if (has_others)
          exchanges[0]->finish(v, follow);
      }
  }
} // namespace Signorini

#endif
