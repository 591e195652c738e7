// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_vtu_file_h
#define signorini_output_vtu_file_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace Signorini
{
  /// Values at nodes, vertices or cells: n_components numbers each, in the order of the list they belong to.
  struct OutputField
  {
    /// As ParaView shows it, and 1, 3 or 6 (a symmetric tensor: xx, yy, zz, xy, yz, zx).
    std::string  name;
    unsigned int n_components;
    /// Fields of three components are vectors for ParaView, those of six symmetric tensors.
    std::vector<double> values;
    /// Whether they are whole numbers, and are written as such.
    bool is_integer = false;
    /// What ParaView calls the components; empty for x, y, z or xx, yy, ...
    std::vector<std::string> components = {};
  };

  /// How files for ParaView are written.
  struct FileFormat
  {
    /// Whether fields and positions have 16 digits instead of 7.
    bool double_precision = false;
    /// Of which neighbouring ranks share one where there are more ranks; 0 for one a rank.
    unsigned int most_files = 64;
  };

  /// What one rank has of a mesh. Cells share points.
  struct VtuPiece
  {
    /// Positions (length), and for each point and cell its place in the fields.
    std::vector<dealii::Point<3>> points;
    std::vector<std::size_t>      point_items, cell_items;
    /// Numbers of points at the corners of the cells, in VTK's order; where those of each cell end; VTK's
    /// numbers of their shapes.
    std::vector<std::int32_t> corners, ends;
    std::vector<std::uint8_t> shapes;

    /// Adds a cell, of the boundary (is_face) or of the volume, with 3, 4 or 8 corners in VTK's order.
    void add_cell(const std::array<std::int32_t, 8> &cell_corners, const unsigned int n_corners,
                  const bool is_face, const std::size_t item);
  };

  /// Fields at points and cells; they must outlive the object.
  struct VtuFields
  {
    /// Indexed by VtuPiece::point_items and VtuPiece::cell_items.
    const std::vector<OutputField> &points, &cells;
  };

  /// One file of a collection.
  struct CollectionEntry
  {
    /// Pseudo-time, what ParaView calls the block (empty for no name), and the file.
    double      time;
    std::string name, file;
  };

  /// In how many files so many ranks write one mesh, of which there are n_meshes.
  unsigned int n_files(const FileFormat &format, const unsigned int n_ranks, const unsigned int n_meshes = 1);

  /// Numbers of files: n from the first one on.
  struct FileNumbers
  {
    /// As above.
    unsigned int first, n;
  };

  /// Collective. Writes PATH.NUMBER.vtu, compressed; ranks that share a file write a piece of it each.
  /// Returns whether this rank could.
  bool write_vtu(const std::string &path, const FileNumbers &files, const VtuPiece &piece,
                 const VtuFields &fields, const FileFormat &format, const MPI_Comm communicator);

  /// Writes a .pvtu file for pieces with such fields.
  void write_pvtu(std::ostream &out, const std::vector<std::string> &pieces, const VtuFields &fields,
                  const FileFormat &format);

  /// Writes a .pvd file: entries with the same time are blocks of one state.
  void write_collection(std::ostream &out, const std::vector<CollectionEntry> &entries);
} // namespace Signorini

#endif
