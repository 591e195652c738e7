// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/output/field_output.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <fstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Points of a piece as they are met, each once.
    class PointNumbers
    {
    public:
      /// @param n number of the items that points are of
      explicit PointNumbers(const std::size_t n)
        : number(n, -1)
      {
      }

      /// The number of an item's point in a piece, which gets it if it is new.
      std::int32_t operator()(VtuPiece &piece, const std::size_t item, const Point<3> &position)
      {
        if (number[item] < 0)
          {
            number[item] = static_cast<std::int32_t>(piece.points.size());
            piece.points.push_back(position);
            piece.point_items.push_back(item);
          }
        return number[item];
      }

      /// As at the beginning, for the next piece.
      void forget(const VtuPiece &piece)
      {
        for (const std::size_t item : piece.point_items)
          number[item] = -1;
      }

    private:
      std::vector<std::int32_t> number;
    };

    /// VTK runs around quadrilaterals, deal.II goes row by row.
    constexpr unsigned int around[8] = {0, 1, 3, 2, 4, 5, 7, 6};

    VtuPiece piece_of_body(const NodalSpace &space, const BodyFiles &bodies, const unsigned int body,
                           PointNumbers &numbers)
    {
      VtuPiece piece;
      for (std::size_t c = 0; c < space.cells().size(); ++c)
        if (const NodalSpace::Cell &cell = space.cells()[c];
            cell.is_owned && bodies.body(cell.material) == body)
          {
            const auto                  nodes   = space.nodes(cell);
            std::array<std::int32_t, 8> corners = {};
            for (unsigned int v = 0; v < nodes.size(); ++v)
              {
                const NodeIndex node = nodes[nodes.size() == CellShape::hexahedron ? around[v] : v];
                corners[v] = numbers(piece, space.relevant().index_within_set(node), space.position(node));
              }
            piece.add_cell(corners, cell.n_vertices, false, c);
          }
      numbers.forget(piece);
      return piece;
    }

    std::vector<std::string> piece_names(const std::string &name, const unsigned int first,
                                         const unsigned int n)
    {
      std::vector<std::string> names;
      for (unsigned int i = first; i < first + n; ++i)
        names.push_back(name + "." + std::to_string(i) + ".vtu");
      return names;
    }

    /// On rank 0; returns whether that could be done.
    bool write_record(const std::string &folder, const std::string &name,
                      const std::vector<std::string> &pieces, const VtuFields &fields,
                      const FileFormat &format)
    {
      std::ofstream out(folder + name + ".pvtu");
      write_pvtu(out, pieces, fields, format);
      out.close();
      return static_cast<bool>(out);
    }

    bool write_short_collection(const std::string &folder, const std::string &name)
    {
      std::ofstream out(folder + name + ".pvd");
      write_collection(out, {{0., "", name + ".pvtu"}});
      out.close();
      return static_cast<bool>(out);
    }

    void check_written(const bool good, const std::string &folder, const MPI_Comm communicator)
    {
      if (Utilities::MPI::min(static_cast<int>(good), communicator) == 0)
        throw InputError("the results cannot be written to \"" + folder + "\": is the disk full?");
    }
  } // namespace



  void write_bodies(const std::string &folder, const std::string &name, const NodalSpace &space,
                    const VtuFields &fields, const BodyFiles &bodies, const FileFormat &format)
  {
    const MPI_Comm     comm = space.communicator();
    const unsigned int n    = n_files(format, Utilities::MPI::n_mpi_processes(comm),
                                      static_cast<unsigned int>(bodies.names.size()));
    PointNumbers       numbers(space.relevant().n_elements());
    bool               good    = true;
    const bool         is_root = Utilities::MPI::this_mpi_process(comm) == 0;
    for (unsigned int b = 0; b < bodies.names.size(); ++b)
      {
        good = write_vtu(folder + name, {b * n, n}, piece_of_body(space, bodies, b, numbers), fields, format,
                         comm) &&
               good;
        if (is_root)
          good = write_record(folder, bodies.names[b], piece_names(name, b * n, n), fields, format) && good;
      }
    if (is_root)
      good =
          write_record(folder, name, piece_names(name, 0, static_cast<unsigned int>(bodies.names.size()) * n),
                       fields, format) &&
          write_short_collection(folder, name) && good;
    check_written(good, folder, comm);
  }



  void write_surface(const std::string &folder, const std::string &name, const ContactSurface &surface,
                     const std::vector<OutputField> &fields, const MPI_Comm communicator,
                     const FileFormat &format)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    PointNumbers       numbers(surface.mesh.vertices.size());
    VtuPiece           piece;
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      if (const ContactSurface::Face &face = surface.faces[f]; face.worker == rank)
        {
          std::array<std::int32_t, 8> corners = {};
          for (unsigned int v = 0; v < face.n_corners; ++v)
            corners[v] = numbers(piece, face.corners[v], surface.mesh.vertices[face.corners[v]]);
          piece.add_cell(corners, face.n_corners, true, f);
        }
    const std::vector<OutputField> none;
    const VtuFields                all{fields, none};
    const unsigned int             n    = n_files(format, Utilities::MPI::n_mpi_processes(communicator));
    bool                           good = write_vtu(folder + name, {0, n}, piece, all, format, communicator);
    if (rank == 0)
      good = write_record(folder, name, piece_names(name, 0, n), all, format) &&
             write_short_collection(folder, name) && good;
    check_written(good, folder, communicator);
  }



  void write_overlay(std::ostream &out, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                     const std::vector<OverlayTriangle>                    &overlay,
                     const std::function<unsigned int(const unsigned int)> &nonmortar_number,
                     const std::function<unsigned int(const unsigned int)> &mortar_number)
  {
    const auto number_of = [](const unsigned int triangle, const auto &number) {
      return number ? number(triangle) : triangle;
    };
    std::vector<DataOutBase::Patch<2, 3>> patches;
    patches.reserve(overlay.size());
    for (const OverlayTriangle &cell : overlay)
      {
        patches.emplace_back();
        auto &patch          = patches.back();
        patch.patch_index    = static_cast<unsigned int>(patches.size() - 1);
        patch.n_subdivisions = 1;
        patch.reference_cell = ReferenceCells::Triangle;
        patch.data.reinit(6, 3);
        const auto        &t      = nonmortar.triangles[cell.nonmortar_triangle];
        const Tensor<1, 3> normal = cross_product_3d(nonmortar.vertices[t[1]] - nonmortar.vertices[t[0]],
                                                     nonmortar.vertices[t[2]] - nonmortar.vertices[t[0]]);
        for (unsigned int c = 0; c < 3; ++c)
          {
            patch.vertices[c] = evaluate(nonmortar, cell.nonmortar_triangle, cell.nonmortar[c]);
            const Tensor<1, 3> way =
                evaluate(mortar, cell.mortar_triangle, cell.mortar[c]) - patch.vertices[c];
            for (unsigned int k = 0; k < 3; ++k)
              patch.data(k, c) = way[k];
            patch.data(3, c) = (way * normal) / normal.norm();
            patch.data(4, c) = number_of(cell.nonmortar_triangle, nonmortar_number);
            patch.data(5, c) = number_of(cell.mortar_triangle, mortar_number);
          }
      }
    using Range = std::tuple<unsigned int, unsigned int, std::string,
                             DataComponentInterpretation::DataComponentInterpretation>;
    DataOutBase::write_vtu(
        patches, {"image_x", "image_y", "image_z", "gap", "nonmortar_triangle", "mortar_triangle"},
        std::vector<Range>{{0, 2, "image", DataComponentInterpretation::component_is_part_of_vector}},
        DataOutBase::VtkFlags(), out);
  }



  namespace
  {
    std::array<double, 3> principal(const StressComponents &s)
    {
      SymmetricTensor<2, 3> tensor;
      for (unsigned int c = 0; c < 3; ++c)
        tensor[c][c] = s[c];
      tensor[0][1] = s[3];
      tensor[1][2] = s[4];
      tensor[2][0] = s[5];
      return eigenvalues(tensor);
    }
  } // namespace



  std::vector<OutputField> stress_fields(const std::vector<StressComponents> &stress)
  {
    const std::size_t        n      = stress.size();
    std::vector<OutputField> fields = {
        {"stress", 6, std::vector<double>(6 * n, 0.)},
        {"von_Mises", 1, std::vector<double>(n, 0.)},
        {"principal_stress", 3, std::vector<double>(3 * n, 0.), false, {"largest", "middle", "smallest"}}};
    for (std::size_t r = 0; r < n; ++r)
      {
        const StressComponents &s = stress[r];
        std::copy(s.begin(), s.end(), fields[0].values.begin() + 6 * r);
        fields[1].values[r] = von_mises(s);
        const auto values   = principal(s);
        std::copy(values.begin(), values.end(), fields[2].values.begin() + 3 * r);
      }
    return fields;
  }
} // namespace Signorini
