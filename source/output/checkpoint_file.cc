// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/byte_archive.h>
#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/output/checkpoint_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

namespace Signorini
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /// The first bytes of a file.
    struct Start
    {
      char          magic[16];
      std::uint32_t format, byte_order;
      std::uint64_t header_size, header_checksum;
    };

    constexpr char          magic[16]  = {'s', 'i', 'g', 'n', 'o', 'r', 'i', 'n',
                                          'i', ' ', 's', 't', 'a', 't', 'e', '\n'};
    constexpr std::uint32_t byte_order = 0x01020304;
    /// Bytes that are read and written at once.
    constexpr std::size_t portion = std::size_t(1) << 24;

    std::uint64_t mixed(std::uint64_t h)
    {
      h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ull;
      h = (h ^ h >> 27) * 0x94d049bb133111ebull;
      return h ^ h >> 31;
    }

    /// A sum over the words (of eight bytes; or the bytes, where items are such) of hashes of value and
    /// place: the sums of pieces add up, and no single change goes unnoticed.
    /// @param first number of the first item in its section
    std::uint64_t checksum(const char *const bytes, const std::size_t n, const std::size_t item,
                           const std::uint64_t first)
    {
      std::uint64_t     sum   = 0;
      const std::size_t step  = item == 1 ? 1 : 8;
      std::uint64_t     place = first * (item / step);
      for (std::size_t i = 0; i + step <= n; i += step)
        {
          std::uint64_t word = 0;
          std::memcpy(&word, bytes + i, step);
          sum += mixed(word + ++place * 0x9e3779b97f4a7c15ull);
        }
      return sum;
    }
  } // namespace



  template <typename Archive>
  void transfer(Archive &archive, CheckpointHeader::Section &section)
  {
    archive(section.name, section.item, section.n, section.offset, section.checksum);
  }



  template <typename Archive>
  void transfer(Archive &archive, CheckpointHeader &header)
  {
    archive(header.program, header.sections, header.size);
  }



  CheckpointWriter::CheckpointWriter(const std::string &program, const MPI_Comm communicator)
    : program(program)
    , comm(communicator)
  {
  }



  void CheckpointWriter::add(const std::string &name, const std::string &bytes)
  {
    const bool is_root = Utilities::MPI::this_mpi_process(comm) == 0;
    pieces.push_back(
        {name, 1, is_root ? std::vector<char>(bytes.begin(), bytes.end()) : std::vector<char>()});
  }



  namespace
  {
    std::string start_and_header(const CheckpointHeader &header)
    {
      ByteWriter writer;
      writer(header);
      Start start{{},
                  CheckpointHeader::present_format,
                  byte_order,
                  writer.bytes().size(),
                  checksum(writer.bytes().data(), writer.bytes().size(), 1, 0)};
      std::copy(std::begin(magic), std::end(magic), start.magic);
      return std::string(reinterpret_cast<const char *>(&start), sizeof(Start)) + writer.bytes();
    }

    std::uint64_t rounded_up(const std::uint64_t n)
    {
      return (n + 7) / 8 * 8;
    }
  } // namespace



  CheckpointHeader CheckpointWriter::make_header(std::vector<std::uint64_t> &place_of_piece) const
  {
    CheckpointHeader           header;
    const std::size_t          n = pieces.size();
    std::vector<std::uint64_t> counts(n), before(n, 0), all(n), sums(n), all_sums(n);
    for (std::size_t i = 0; i < n; ++i)
      counts[i] = pieces[i].bytes.size() / pieces[i].item;
    const int length = static_cast<int>(n);
    MPI_Exscan(counts.data(), before.data(), length, MPI_UINT64_T, MPI_SUM, comm);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      std::fill(before.begin(), before.end(), 0);
    MPI_Allreduce(counts.data(), all.data(), length, MPI_UINT64_T, MPI_SUM, comm);
    for (std::size_t i = 0; i < n; ++i)
      sums[i] = checksum(pieces[i].bytes.data(), pieces[i].bytes.size(), pieces[i].item, before[i]);
    MPI_Allreduce(sums.data(), all_sums.data(), length, MPI_UINT64_T, MPI_SUM, comm);
    header.program = program;
    for (std::size_t i = 0; i < n; ++i)
      header.sections.push_back({pieces[i].name, pieces[i].item, all[i], 0, all_sums[i]});
    // Its length does not depend on the numbers in it.
    header.size = rounded_up(start_and_header(header).size());
    for (std::size_t i = 0; i < n; ++i)
      {
        header.sections[i].offset = header.size;
        place_of_piece.push_back(header.size + pieces[i].item * before[i]);
        header.size += rounded_up(pieces[i].item * all[i]);
      }
    return header;
  }



  namespace
  {
    /// A file that all ranks write.
    class SharedFile
    {
    public:
      SharedFile(const std::string &name, const MPI_Comm comm)
        : is_open(MPI_File_open(comm, name.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL,
                                &file) == MPI_SUCCESS)
        , good(is_open)
      {
      }

      ~SharedFile()
      {
        close();
      }

      /// The size that it is to have: bytes that nobody writes are zero.
      void resize(const std::uint64_t n)
      {
        good = is_open && MPI_File_set_size(file, static_cast<MPI_Offset>(n)) == MPI_SUCCESS && good;
      }

      void write(const std::uint64_t place, const char *const bytes, const std::size_t n)
      {
        for (std::size_t i = 0; i < n && good; i += portion)
          {
            const int  m = static_cast<int>(std::min(portion, n - i));
            MPI_Status status;
            int        written = 0;
            good = MPI_File_write_at(file, static_cast<MPI_Offset>(place + i), bytes + i, m, MPI_BYTE,
                                     &status) == MPI_SUCCESS;
            MPI_Get_count(&status, MPI_BYTE, &written);
            good = good && written == m;
          }
      }

      /// Collective. Whether this rank's bytes are on the disk.
      bool close()
      {
        if (is_open)
          {
            good    = MPI_File_sync(file) == MPI_SUCCESS && good;
            good    = MPI_File_close(&file) == MPI_SUCCESS && good;
            is_open = false;
          }
        return good;
      }

    private:
      MPI_File file = MPI_FILE_NULL;
      bool     is_open, good;
    };

    /// Makes sure that a name that was given to a file outlives a power failure. Some systems do not do that
    /// with folders.
    void sync_folder(const std::string &folder)
    {
      if (const int descriptor = open(folder.c_str(), O_RDONLY); descriptor >= 0)
        {
          fsync(descriptor);
          ::close(descriptor);
        }
    }
  } // namespace



  std::uint64_t CheckpointWriter::write(const std::string &file, const WhenNamed &when_named) const
  {
    const bool        is_root = Utilities::MPI::this_mpi_process(comm) == 0;
    const std::string part =
        file + ".part-" + std::to_string(Utilities::MPI::broadcast(comm, static_cast<long>(getpid()), 0));
    std::vector<std::uint64_t> places;
    const CheckpointHeader     header = make_header(places);
    std::error_code            ignored;
    if (is_root)
      fs::remove(part, ignored);
    MPI_Barrier(comm);
    SharedFile out(part, comm);
    out.resize(header.size);
    if (is_root)
      {
        const std::string begin = start_and_header(header);
        out.write(0, begin.data(), begin.size());
      }
    for (std::size_t i = 0; i < pieces.size(); ++i)
      out.write(places[i], pieces[i].bytes.data(), pieces[i].bytes.size());
    bool good = Utilities::MPI::min(static_cast<int>(out.close()), comm) != 0;
    if (is_root && good)
      {
        std::error_code error;
        good = fs::file_size(part, error) == header.size && !error;
        if (good)
          {
            const TerminationWatch::Delay delay;
            fs::rename(part, file, error);
            good = !error;
            if (good && when_named)
              when_named(delay);
          }
        if (good)
          sync_folder(fs::path(file).parent_path().string());
      }
    if (is_root && !good)
      fs::remove(part, ignored);
    if (Utilities::MPI::broadcast(comm, static_cast<int>(good), 0) == 0)
      throw InputError("\"" + file + "\" cannot be written: is the disk full?");
    return header.size;
  }



  namespace
  {
    /// On one rank.
    std::string read_header(CheckpointHeader &header, const std::string &file)
    {
      std::ifstream in(file, std::ios::binary);
      Start         start;
      if (!in)
        return "cannot be opened.";
      if (!in.read(reinterpret_cast<char *>(&start), sizeof(Start)))
        return "is torn: it has not even a header.";
      if (!std::equal(std::begin(magic), std::end(magic), start.magic))
        return "is no checkpoint of signorini.";
      if (start.byte_order != byte_order)
        return "was written by a computer with another order of bytes.";
      if (start.format != CheckpointHeader::present_format)
        return "has the format " + std::to_string(start.format) + " of " +
               (start.format < CheckpointHeader::present_format ? "an older" : "a newer") +
               " version of the program; this one reads the format " +
               std::to_string(CheckpointHeader::present_format) + ".";
      std::error_code     error;
      const std::uint64_t size = fs::file_size(file, error);
      if (error || start.header_size > size - sizeof(Start))
        return "is torn: it ends in its header.";
      std::string bytes(start.header_size, '\0');
      if (!in.read(&bytes[0], static_cast<std::streamsize>(bytes.size())) ||
          checksum(bytes.data(), bytes.size(), 1, 0) != start.header_checksum)
        return "is damaged: the checksum of its header is wrong.";
      ByteReader{bytes}(header);
      if (size != header.size)
        return "is torn: it has " + std::to_string(size) + " of " + std::to_string(header.size) + " bytes.";
      return "";
    }
  } // namespace



  CheckpointReader::CheckpointReader(const std::string &file, const MPI_Comm communicator)
    : file(file)
    , comm(communicator)
  {
    std::string error;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      error = read_header(header, file);
    error = broadcast_value(error, comm);
    if (!error.empty())
      throw InputError(error);
    ByteWriter writer;
    writer(header);
    ByteReader(broadcast_bytes(writer.bytes(), comm))(header);
    for (const Section &s : header.sections)
      check(s);
  }



  const CheckpointReader::Section &CheckpointReader::section(const std::string &name) const
  {
    for (const Section &s : header.sections)
      if (s.name == name)
        return s;
    throw InputError("has no section \"" + name + "\".");
  }



  bool CheckpointReader::has(const std::string &name) const
  {
    return std::any_of(header.sections.begin(), header.sections.end(),
                       [&](const Section &s) { return s.name == name; });
  }



  std::string CheckpointReader::text(const std::string &name) const
  {
    const auto bytes = read<char>(name, 0, static_cast<std::size_t>(section(name).n));
    return std::string(bytes.begin(), bytes.end());
  }



  void CheckpointReader::read_bytes(const Section &s, const std::size_t item, const std::uint64_t first,
                                    const std::size_t n, char *const to) const
  {
    if (item != s.item || first > s.n || n > s.n - first)
      throw InputError("has another section \"" + s.name + "\" than there should be.");
    if (n == 0)
      return;
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(s.offset + item * first));
    if (!in.read(to, static_cast<std::streamsize>(item * n)))
      throw InputError("cannot be read any more.");
  }



  std::uint64_t CheckpointReader::begin_of_piece(const Section &s, const std::size_t n) const
  {
    const std::uint64_t mine  = n;
    std::uint64_t       begin = 0;
    MPI_Exscan(&mine, &begin, 1, MPI_UINT64_T, MPI_SUM, comm);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      begin = 0;
    if (Utilities::MPI::sum(mine, comm) != s.n)
      throw InputError("has another number of items in \"" + s.name + "\" than the meshes.");
    return begin;
  }



  void CheckpointReader::check(const Section &s) const
  {
    const std::uint64_t rank = Utilities::MPI::this_mpi_process(comm),
                        n    = Utilities::MPI::n_mpi_processes(comm);
    // Equal shares, in portions.
    const std::uint64_t at_once = std::max<std::uint64_t>(1, portion / s.item);
    std::uint64_t       sum = 0, all = 0;
    const std::uint64_t end     = s.n / n * (rank + 1) + s.n % n * (rank + 1) / n;
    bool                is_read = true;
    for (std::uint64_t i = s.n / n * rank + s.n % n * rank / n; i < end && is_read; i += at_once)
      {
        const std::size_t m = static_cast<std::size_t>(std::min(at_once, end - i));
        std::vector<char> bytes(m * s.item);
        try
          {
            read_bytes(s, s.item, i, m, bytes.data());
          }
        catch (const InputError &)
          {
            is_read = false;
          }
        sum += checksum(bytes.data(), bytes.size(), s.item, i);
      }
    MPI_Allreduce(&sum, &all, 1, MPI_UINT64_T, MPI_SUM, comm);
    if (Utilities::MPI::min(static_cast<int>(is_read), comm) == 0 || all != s.checksum)
      throw InputError("is damaged: the checksum of its section \"" + s.name + "\" is wrong.");
  }
} // namespace Signorini
