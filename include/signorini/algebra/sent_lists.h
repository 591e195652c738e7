// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_sent_lists_h
#define signorini_algebra_sent_lists_h

#include <signorini/algebra/checked_count.h>
#include <signorini/algebra/collectives.h>

#include <deal.II/base/mpi.h>

#include <cstring>
#include <functional>
#include <map>
#include <vector>

namespace Signorini
{
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
    for (const auto &[rank, bytes] : send_bytes(parcels, communicator))
      {
        std::vector<T> &list = result[rank];
        list.resize(bytes.size() / sizeof(T));
        std::memcpy(static_cast<void *>(list.data()), bytes.data(), bytes.size());
      }
    return result;
  }



  /// Collective over the ranks concerned. The same where everybody knows who sends: one list to each rank in
  /// `lists` (it may be empty), one from each of `senders`.
  template <typename T>
  ListsByRank<T> answer_lists(const ListsByRank<T> &lists, const std::vector<unsigned int> &senders,
                              const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    constexpr int            tag = 7316;
    std::vector<MPI_Request> requests(lists.size());
    std::size_t              n = 0;
    for (const auto &[rank, list] : lists)
      MPI_Isend(list.data(), checked_count(list.size() * sizeof(T), "bytes of a message"), MPI_BYTE,
                static_cast<int>(rank), tag, communicator, &requests[n++]);
    ListsByRank<T> result;
    for (const unsigned int rank : senders)
      {
        MPI_Status status;
        int        n_bytes;
        MPI_Probe(static_cast<int>(rank), tag, communicator, &status);
        MPI_Get_count(&status, MPI_BYTE, &n_bytes);
        std::vector<T> &list = result[rank];
        list.resize(static_cast<std::size_t>(n_bytes) / sizeof(T));
        MPI_Recv(list.data(), n_bytes, MPI_BYTE, static_cast<int>(rank), tag, communicator,
                 MPI_STATUS_IGNORE);
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return result;
  }



  /// Several lists of any kind as one message: read in the order in which they were written.
  class Parcel
  {
  public:
    Parcel() = default;

    /// What has arrived.
    explicit Parcel(std::vector<char> bytes)
      : content(std::move(bytes))
    {
    }

    /// Appends a list.
    template <typename T>
    void write(const std::vector<T> &list)
    {
      static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
      const std::size_t n = list.size(), begin = content.size();
      content.resize(begin + sizeof(n) + n * sizeof(T));
      std::memcpy(content.data() + begin, &n, sizeof(n));
      if (n > 0)
        std::memcpy(content.data() + begin + sizeof(n), static_cast<const void *>(list.data()),
                    n * sizeof(T));
    }

    /// The next list.
    template <typename T>
    std::vector<T> read()
    {
      std::size_t n;
      std::memcpy(&n, content.data() + place, sizeof(n));
      std::vector<T> list(n);
      if (n > 0)
        std::memcpy(static_cast<void *>(list.data()), content.data() + place + sizeof(n), n * sizeof(T));
      place += sizeof(n) + n * sizeof(T);
      return list;
    }

    /// All of it.
    const std::vector<char> &bytes() const
    {
      return content;
    }

  private:
    std::vector<char> content;
    std::size_t       place = 0;
  };



  /// The ranks of some lists.
  template <typename T>
  std::vector<unsigned int> ranks_of(const ListsByRank<T> &lists)
  {
    std::vector<unsigned int> ranks;
    for (const auto &entry : lists)
      ranks.push_back(entry.first);
    return ranks;
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

    /// The same items under the new numbers that this rank gives them; other ranks have numbers of their own.
    /// @param number by old number
    ItemExchange(const ItemExchange &other, const std::function<unsigned int(const unsigned int)> &number)
      : wanted(other.wanted)
      , asked(other.asked)
      , communicator(other.communicator)
    {
      for (ListsByRank<unsigned int> *const lists : {&wanted, &asked})
        for (auto &entry : *lists)
          for (unsigned int &item : entry.second)
            item = number(item);
    }

    /// Items that others want of this rank, by the rank that wants them.
    const ListsByRank<unsigned int> &asked_items() const
    {
      return asked;
    }

    /// Bytes of the lists.
    std::size_t memory_consumption() const
    {
      std::size_t bytes = 0;
      for (const auto *const lists : {&wanted, &asked})
        for (const auto &entry : *lists)
          bytes += entry.second.capacity() * sizeof(unsigned int);
      return bytes;
    }

    /// Items that this rank wants, by the rank that owns them.
    const ListsByRank<unsigned int> &wanted_items() const
    {
      return wanted;
    }

    /// Collective. Fetches the values of the wanted items into a list of the values of all items, of which
    /// those are given that this rank owns.
    template <typename T>
    void update(std::vector<T> &values) const
    {
      ListsByRank<T> answers;
      for (const auto &[rank, items] : asked)
        for (const unsigned int i : items)
          answers[rank].push_back(values[i]);
      for (const auto &[rank, list] : answer_lists(answers, ranks_of(wanted), communicator))
        for (std::size_t k = 0; k < list.size(); ++k)
          values[wanted.at(rank)[k]] = list[k];
    }

  private:
    ListsByRank<unsigned int> wanted, asked;
    MPI_Comm                  communicator;
  };
} // namespace Signorini

#endif
