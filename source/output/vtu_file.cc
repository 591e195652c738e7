// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// deal.II's writer gives every cell points of its own, and fields of single precision at points only.

#include <signorini/output/vtu_file.h>

#include <deal.II/base/mpi_large_count.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <type_traits>
#include <zlib.h>

namespace Signorini
{
  using namespace dealii;

  void VtuPiece::add_cell(const std::array<std::int32_t, 8> &cell_corners, const unsigned int n_corners,
                          const bool is_face, const std::size_t item)
  {
    corners.insert(corners.end(), cell_corners.begin(), cell_corners.begin() + n_corners);
    ends.push_back(static_cast<std::int32_t>(corners.size()));
    // VTK_TRIANGLE, VTK_QUAD, VTK_TETRA, VTK_HEXAHEDRON.
    shapes.push_back(is_face ? (n_corners == 3 ? 5 : 9) : (n_corners == 4 ? 10 : 12));
    cell_items.push_back(item);
  }



  namespace
  {
    std::string escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        if (c == '&')
          result += "&amp;";
        else if (c == '<')
          result += "&lt;";
        else if (c == '>')
          result += "&gt;";
        else if (c == '"')
          result += "&quot;";
        else
          result += c;
      return result;
    }

    template <typename T>
    std::string type_name()
    {
      const std::string kind = std::is_floating_point<T>::value ? "Float"
                               : std::is_signed<T>::value       ? "Int"
                                                                : "UInt";
      return kind + std::to_string(8 * sizeof(T));
    }

    const char *order_of_bytes()
    {
      const std::uint16_t one = 1;
      return *reinterpret_cast<const unsigned char *>(&one) == 1 ? "LittleEndian" : "BigEndian";
    }

    /// Name, number and names of components of a field.
    std::string description(const OutputField &field)
    {
      static const std::vector<std::string> tensor = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
      std::string text = "Name=\"" + escaped(field.name) + "\" NumberOfComponents=\"" +
                         std::to_string(field.n_components) + "\"";
      const std::vector<std::string> &names =
          field.components.empty() && field.n_components == 6 ? tensor : field.components;
      for (std::size_t c = 0; c < names.size(); ++c)
        text += " ComponentName" + std::to_string(c) + "=\"" + escaped(names[c]) + "\"";
      return text;
    }

    std::string type_of(const OutputField &field, const FileFormat &format)
    {
      return field.is_integer          ? type_name<std::int64_t>()
             : format.double_precision ? type_name<double>()
                                       : type_name<float>();
    }

    /// The first vector and the first tensor are those that ParaView's filters begin with.
    std::string attributes(const std::vector<OutputField> &fields)
    {
      std::string text;
      for (const auto &[n, kind] : {std::pair<unsigned int, const char *>{3, " Vectors"}, {6, " Tensors"}})
        for (const OutputField &field : fields)
          if (field.n_components == n)
            {
              text += kind + std::string("=\"") + escaped(field.name) + "\"";
              break;
            }
      return text;
    }

    std::vector<unsigned char> compressed(const std::vector<unsigned char> &bytes)
    {
      uLongf                     size = compressBound(bytes.size());
      std::vector<unsigned char> result(size);
      const int code = compress2(result.data(), &size, bytes.data(), bytes.size(), Z_BEST_SPEED);
      AssertThrow(code == Z_OK, ExcInternalError());
      result.resize(size);
      return result;
    }

    /// Writes n numbers as blocks of zlib in base64, with VTK's header: number of blocks, size of a block,
    /// size of a last one that is smaller, compressed sizes.
    template <typename T, typename Value>
    void write_numbers(std::ostream &out, const std::size_t n, const Value &value)
    {
      constexpr std::size_t      most = (1 << 20) / sizeof(T);
      std::vector<std::uint32_t> head = {0, static_cast<std::uint32_t>(most * sizeof(T)),
                                         static_cast<std::uint32_t>(n % most * sizeof(T))};
      std::vector<unsigned char> all;
      for (std::size_t begin = 0; begin < n; begin += most)
        {
          const std::size_t          end = std::min(n, begin + most);
          std::vector<unsigned char> bytes((end - begin) * sizeof(T));
          for (std::size_t i = begin; i < end; ++i)
            {
              const T number = value(i);
              std::copy_n(reinterpret_cast<const unsigned char *>(&number), sizeof(T),
                          bytes.begin() + (i - begin) * sizeof(T));
            }
          const auto block = compressed(bytes);
          all.insert(all.end(), block.begin(), block.end());
          head.push_back(static_cast<std::uint32_t>(block.size()));
          ++head[0];
        }
      const auto *const first = reinterpret_cast<const unsigned char *>(head.data());
      out << Utilities::encode_base64({first, first + head.size() * sizeof(head[0])})
          << Utilities::encode_base64(all);
    }

    template <typename T, typename Value>
    void write_array(std::ostream &out, const std::string &attributes, const std::size_t n,
                     const Value &value)
    {
      out << "<DataArray type=\"" << type_name<T>() << "\" " << attributes << " format=\"binary\">\n";
      write_numbers<T>(out, n, value);
      out << "\n</DataArray>\n";
    }

    template <typename T>
    void write_field(std::ostream &out, const OutputField &field, const std::vector<std::size_t> &items)
    {
      const std::size_t n = field.n_components;
      write_array<T>(out, description(field), n * items.size(), [&](const std::size_t i) {
        return static_cast<T>(field.values[n * items[i / n] + i % n]);
      });
    }

    void write_fields(std::ostream &out, const char *const tag, const std::vector<OutputField> &fields,
                      const std::vector<std::size_t> &items, const FileFormat &format)
    {
      out << '<' << tag << attributes(fields) << ">\n";
      for (const OutputField &field : fields)
        if (field.is_integer)
          write_field<std::int64_t>(out, field, items);
        else if (format.double_precision)
          write_field<double>(out, field, items);
        else
          write_field<float>(out, field, items);
      out << "</" << tag << ">\n";
    }

    void write_points(std::ostream &out, const VtuPiece &piece, const FileFormat &format)
    {
      const auto        coordinate = [&](const std::size_t i) { return piece.points[i / 3][i % 3]; };
      const std::size_t n          = 3 * piece.points.size();
      out << "<Points>\n";
      if (format.double_precision)
        write_array<double>(out, "NumberOfComponents=\"3\"", n, coordinate);
      else
        write_array<float>(out, "NumberOfComponents=\"3\"", n,
                           [&](const std::size_t i) { return static_cast<float>(coordinate(i)); });
      out << "</Points>\n";
    }

    void write_piece(std::ostream &out, const VtuPiece &piece, const VtuFields &fields,
                     const FileFormat &format)
    {
      out << "<Piece NumberOfPoints=\"" << piece.points.size() << "\" NumberOfCells=\"" << piece.shapes.size()
          << "\">\n";
      write_points(out, piece, format);
      out << "<Cells>\n";
      write_array<std::int32_t>(out, "Name=\"connectivity\"", piece.corners.size(),
                                [&](const std::size_t i) { return piece.corners[i]; });
      write_array<std::int32_t>(out, "Name=\"offsets\"", piece.ends.size(),
                                [&](const std::size_t i) { return piece.ends[i]; });
      write_array<std::uint8_t>(out, "Name=\"types\"", piece.shapes.size(),
                                [&](const std::size_t i) { return piece.shapes[i]; });
      out << "</Cells>\n";
      write_fields(out, "PointData", fields.points, piece.point_items, format);
      write_fields(out, "CellData", fields.cells, piece.cell_items, format);
      out << "</Piece>\n";
    }

    void write_head(std::ostream &out, const char *const type, const bool has_data)
    {
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type << "\" version=\"1.0\" byte_order=\""
          << order_of_bytes() << "\" header_type=\"UInt32\""
          << (has_data ? " compressor=\"vtkZLibDataCompressor\"" : "") << ">\n";
    }

    /// Collective among the ranks of one file: the texts of all, one after the other.
    bool write_together(const std::string &file, const std::string &text, const MPI_Comm group)
    {
      MPI_File handle;
      if (MPI_File_open(group, file.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &handle) !=
          MPI_SUCCESS)
        return false;
      const std::uint64_t size  = text.size();
      std::uint64_t       begin = 0;
      MPI_Exscan(&size, &begin, 1, MPI_UINT64_T, MPI_SUM, group);
      if (Utilities::MPI::this_mpi_process(group) == 0)
        begin = 0;
      bool good = MPI_File_set_size(handle, 0) == MPI_SUCCESS;
      good      = Utilities::MPI::LargeCount::File_write_at_all_c(handle, static_cast<MPI_Offset>(begin),
                                                                  text.data(), static_cast<MPI_Count>(size),
                                                                  MPI_CHAR, MPI_STATUS_IGNORE) == MPI_SUCCESS &&
             good;
      return MPI_File_close(&handle) == MPI_SUCCESS && good;
    }
  } // namespace



  unsigned int n_files(const FileFormat &format, const unsigned int n_ranks, const unsigned int n_meshes)
  {
    if (format.most_files == 0)
      return n_ranks;
    return std::min(n_ranks, std::max(1u, format.most_files / n_meshes));
  }



  bool write_vtu(const std::string &path, const FileNumbers &files, const VtuPiece &piece,
                 const VtuFields &fields, const FileFormat &format, const MPI_Comm communicator)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator),
                       n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const auto number       = static_cast<unsigned int>(static_cast<std::uint64_t>(rank) * files.n / n_ranks);
    const std::string file  = path + "." + std::to_string(files.first + number) + ".vtu";
    MPI_Comm          group = MPI_COMM_SELF;
    if (files.n < n_ranks)
      MPI_Comm_split(communicator, static_cast<int>(number), 0, &group);
    const auto write = [&](std::ostream &out, const bool is_first, const bool is_last) {
      if (is_first)
        {
          write_head(out, "UnstructuredGrid", true);
          out << "<UnstructuredGrid>\n";
        }
      write_piece(out, piece, fields, format);
      if (is_last)
        out << "</UnstructuredGrid>\n</VTKFile>\n";
    };
    if (files.n == n_ranks)
      {
        std::ofstream out(file);
        write(out, true, true);
        out.close();
        return static_cast<bool>(out);
      }
    const unsigned int place = Utilities::MPI::this_mpi_process(group);
    std::ostringstream text;
    write(text, place == 0, place + 1 == Utilities::MPI::n_mpi_processes(group));
    const bool good = write_together(file, text.str(), group);
    MPI_Comm_free(&group);
    return good;
  }



  void write_pvtu(std::ostream &out, const std::vector<std::string> &pieces, const VtuFields &fields,
                  const FileFormat &format)
  {
    write_head(out, "PUnstructuredGrid", false);
    out << "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n<PDataArray type=\""
        << (format.double_precision ? type_name<double>() : type_name<float>())
        << "\" NumberOfComponents=\"3\"/>\n</PPoints>\n";
    const std::pair<const char *, const std::vector<OutputField> *> lists[] = {{"PPointData", &fields.points},
                                                                               {"PCellData", &fields.cells}};
    for (const auto &[tag, list] : lists)
      {
        out << '<' << tag << attributes(*list) << ">\n";
        for (const OutputField &field : *list)
          out << "<PDataArray type=\"" << type_of(field, format) << "\" " << description(field) << "/>\n";
        out << "</" << tag << ">\n";
      }
    for (const std::string &piece : pieces)
      out << "<Piece Source=\"" << escaped(piece) << "\"/>\n";
    out << "</PUnstructuredGrid>\n</VTKFile>\n";
  }



  void write_collection(std::ostream &out, const std::vector<CollectionEntry> &entries)
  {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\""
        << order_of_bytes() << "\">\n<Collection>\n"
        << std::setprecision(12);
    unsigned int part = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
      {
        part = i > 0 && entries[i].time == entries[i - 1].time ? part + 1 : 0;
        out << "<DataSet timestep=\"" << entries[i].time << "\" group=\"\" part=\"" << part << '"';
        if (!entries[i].name.empty())
          out << " name=\"" << escaped(entries[i].name) << '"';
        out << " file=\"" << escaped(entries[i].file) << "\"/>\n";
      }
    out << "</Collection>\n</VTKFile>\n";
  }
} // namespace Signorini
