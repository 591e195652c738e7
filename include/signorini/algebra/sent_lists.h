// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_sent_lists_h
#define signorini_algebra_sent_lists_h

#include <deal.II/base/mpi.h>

#include <cstring>
#include <map>
#include <vector>

namespace Signorini
{
  /// Lists by rank: of the one that they are for, or that they come from.
  template <typename T>
  using ListsByRank = std::map<unsigned int, std::vector<T>>;

  /// Collective. Sends a list to each of some ranks and returns those that come, by sender. Ranks without a
  /// list for each other do not talk.
  template <typename T>
  ListsByRank<T> send_lists(const ListsByRank<T> &lists, const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return lists;
    ListsByRank<char> parcels;
    for (const auto &[rank, list] : lists)
      if (!list.empty())
        {
          std::vector<char> &bytes = parcels[rank];
          bytes.resize(list.size() * sizeof(T));
          std::memcpy(bytes.data(), static_cast<const void *>(list.data()), bytes.size());
        }
    ListsByRank<T> result;
    for (const auto &[rank, bytes] : dealii::Utilities::MPI::some_to_some(communicator, parcels))
      {
        std::vector<T> &list = result[rank];
        list.resize(bytes.size() / sizeof(T));
        std::memcpy(static_cast<void *>(list.data()), bytes.data(), bytes.size());
      }
    return result;
  }



  /// Values of numbered items that ranks own, for others that want them: the lists are exchanged once.
  class ItemExchange
  {
  public:
    /// Collective.
    /// @param wanted items by the rank that owns them
    ItemExchange(ListsByRank<unsigned int> wanted, const MPI_Comm communicator)
      : wanted(std::move(wanted))
      , asked(send_lists(this->wanted, communicator))
      , communicator(communicator)
    {
    }

    /// Items that others want of this rank, by the rank that wants them.
    const ListsByRank<unsigned int> &asked_items() const
    {
      return asked;
    }

    /// Collective. Fetches the values of the wanted items into a list of the values of all items, of which
    /// those are given that this rank owns.
    template <typename T>
    void update(std::vector<T> &values) const
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
        return;
      ListsByRank<T> answers;
      for (const auto &[rank, items] : asked)
        for (const unsigned int i : items)
          answers[rank].push_back(values[i]);
      for (const auto &[rank, list] : send_lists(answers, communicator))
        for (std::size_t k = 0; k < list.size(); ++k)
          values[wanted.at(rank)[k]] = list[k];
    }

  private:
    ListsByRank<unsigned int> wanted, asked;
    MPI_Comm                  communicator;
  };
} // namespace Signorini

#endif
