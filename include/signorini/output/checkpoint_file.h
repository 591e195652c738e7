// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_checkpoint_file_h
#define signorini_output_checkpoint_file_h

#include <signorini/output/termination.h>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Signorini
{
  /// How a checkpoint begins: what it is, and where its sections are. Then come the sections, each a list of
  /// items of one size, at multiples of eight bytes. Sections know nothing of ranks.
  struct CheckpointHeader
  {
    /// Of the layout of files and of all that stands in them. Files with another one are refused.
    static constexpr std::uint32_t present_format = 13;

    /// A list of `n` items of `item` bytes, `offset` bytes behind the begin of the file.
    struct Section
    {
      /// What it is called, its sizes and place as above, and the sum over its bytes.
      std::string   name;
      std::uint64_t item = 1, n = 0, offset = 0, checksum = 0;
    };

    /// The program that wrote it, with its version.
    std::string          program;
    std::vector<Section> sections;
    /// Bytes of the whole file.
    std::uint64_t size = 0;
  };



  /// Collects the sections of a checkpoint and writes them: first to another name, which takes the place of
  /// an earlier checkpoint at once when all is on the disk. All ranks write their pieces; none has more.
  class CheckpointWriter
  {
  public:
    /// @param program with its version
    CheckpointWriter(const std::string &program, const MPI_Comm communicator);

    /// A section that is the same on all ranks.
    void add(const std::string &name, const std::string &bytes);

    /// A section of which this rank has a piece, those of lower ranks before it.
    template <typename T>
    void add(const std::string &name, const std::vector<T> &mine)
    {
      static_assert(std::is_trivially_copyable<T>::value, "written as bytes");
      static_assert(sizeof(T) == 1 || sizeof(T) % 8 == 0, "see checksum()");
      const char *const data = reinterpret_cast<const char *>(mine.data());
      pieces.push_back({name, sizeof(T), std::vector<char>(data, data + sizeof(T) * mine.size())});
    }

    /// What is to be done while signals wait.
    using WhenNamed = std::function<void(const TerminationWatch::Delay &)>;

    /// Collective. Errors: InputError where the file cannot be written; an earlier one is as it was.
    /// @param when_named called on rank 0 when the file has its name, before a signal can end the run
    /// @return bytes of the file
    std::uint64_t write(const std::string &file, const WhenNamed &when_named = {}) const;

  private:
    struct Piece
    {
      std::string       name;
      std::size_t       item;
      std::vector<char> bytes;
    };

    CheckpointHeader make_header(std::vector<std::uint64_t> &place_of_piece) const;

    const std::string  program;
    const MPI_Comm     comm;
    std::vector<Piece> pieces;
  };



  /// A checkpoint to be read, on any number of ranks.
  class CheckpointReader
  {
  public:
    /// Collective. Reads the header and checks all sections. Errors: InputError, a sentence without subject,
    /// for what is no checkpoint, has another format, is torn or changed.
    CheckpointReader(const std::string &file, const MPI_Comm communicator);

    /// What wrote it.
    const std::string &program() const
    {
      return header.program;
    }

    /// Whether it has a section.
    bool has(const std::string &name) const;

    /// Number of items of a section, over all ranks. Errors: InputError where it is missing.
    std::uint64_t size(const std::string &name) const
    {
      return section(name).n;
    }

    /// A section that is the same on all ranks. Errors: InputError where it is missing.
    std::string text(const std::string &name) const;

    /// Items of a section. Not collective. Errors: InputError where there are none such.
    template <typename T>
    std::vector<T> read(const std::string &name, const std::uint64_t first, const std::size_t n) const
    {
      static_assert(std::is_trivially_copyable<T>::value, "written as bytes");
      std::vector<T> items(n);
      read_bytes(section(name), sizeof(T), first, n, reinterpret_cast<char *>(items.data()));
      return items;
    }

    /// Collective. The piece of a section that this rank has when it has `n` items and lower ranks those
    /// before it. Errors: InputError unless all pieces together are the section.
    template <typename T>
    std::vector<T> read_piece(const std::string &name, const std::size_t n) const
    {
      return read<T>(name, begin_of_piece(section(name), n), n);
    }

  private:
    using Section = CheckpointHeader::Section;
    const Section &section(const std::string &name) const;
    void           read_bytes(const Section &section, const std::size_t item, const std::uint64_t first,
                              const std::size_t n, char *const to) const;
    std::uint64_t  begin_of_piece(const Section &section, const std::size_t n) const;
    void           check(const Section &section) const;

    const std::string file;
    const MPI_Comm    comm;
    CheckpointHeader  header;
  };
} // namespace Signorini

#endif
