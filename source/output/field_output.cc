// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/element.h>
#include <signorini/output/field_output.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    const char *const component_names[] = {"x", "y", "z", "xy", "yz", "zx"};

    /// Patches of one cell each, with their data, as deal.II's writers want them.
    template <int patch_dim>
    class PatchOutput : public DataOutInterface<patch_dim, 3>
    {
    public:
      using Patch = DataOutBase::Patch<patch_dim, 3>;

      explicit PatchOutput(const std::vector<OutputField> &fields)
      {
        for (const OutputField &field : fields)
          {
            if (field.n_components == 3)
              ranges.emplace_back(names.size(), names.size() + 2, field.name,
                                  DataComponentInterpretation::component_is_part_of_vector);
            for (unsigned int c = 0; c < field.n_components; ++c)
              names.push_back(field.n_components == 1   ? field.name
                              : field.n_components == 3 ? field.name
                                                        : field.name + "_" + component_names[c]);
          }
      }

      std::vector<Patch>       patches;
      std::vector<std::string> names;

      Patch &add_patch(const ReferenceCell &shape)
      {
        patches.emplace_back();
        Patch &patch         = patches.back();
        patch.patch_index    = static_cast<unsigned int>(patches.size() - 1);
        patch.n_subdivisions = 1;
        patch.reference_cell = shape;
        patch.data.reinit(names.size(), shape.n_vertices());
        return patch;
      }

      /// Neighbouring ranks write one file where there are more ranks than files.
      void write(const std::string &folder, const std::string &name, const MPI_Comm comm,
                 const unsigned int most_files)
      {
        DataOutBase::VtkFlags flags;
        flags.compression_level = DataOutBase::VtkFlags::best_speed;
        this->set_flags(flags);
        const unsigned int rank = Utilities::MPI::this_mpi_process(comm),
                           n    = Utilities::MPI::n_mpi_processes(comm);
        const auto piece = [&](const unsigned int r) { return name + "." + std::to_string(r) + ".vtu"; };
        const unsigned int       n_files = most_files == 0 ? n : std::min(n, most_files);
        std::vector<std::string> pieces;
        for (unsigned int f = 0; f < n_files; ++f)
          pieces.push_back(piece(f));
        bool good = true;
        try
          {
            good = write_piece(
                folder, piece(static_cast<unsigned int>(static_cast<std::uint64_t>(rank) * n_files / n)),
                n_files < n, comm);
            if (rank == 0)
              {
                std::ofstream record(folder + name + ".pvtu"), pvd(folder + name + ".pvd");
                this->write_pvtu_record(record, pieces);
                DataOutBase::write_pvd_record(pvd, {{0., name + ".pvtu"}});
                record.close();
                pvd.close();
                good = good && record && pvd;
              }
          }
        catch (const ExceptionBase &)
          {
            // deal.II looks at the streams, too.
            good = false;
          }
        if (Utilities::MPI::min(static_cast<int>(good), comm) == 0)
          throw InputError("the results cannot be written to \"" + folder + "\": is the disk full?");
      }

    private:
      /// Collective.
      bool write_piece(const std::string &folder, const std::string &piece, const bool is_shared,
                       const MPI_Comm comm)
      {
        if (!is_shared)
          {
            std::ofstream out(folder + piece);
            this->write_vtu(out);
            out.close();
            return static_cast<bool>(out);
          }
        // Ranks with the same file have the same piece.
        const int number = std::stoi(piece.substr(piece.find_last_of('.', piece.size() - 5) + 1));
        MPI_Comm  group;
        MPI_Comm_split(comm, number, 0, &group);
        this->write_vtu_in_parallel(folder + piece, group);
        MPI_Comm_free(&group);
        return true;
      }

    protected:
      const std::vector<Patch> &get_patches() const override
      {
        return patches;
      }

      std::vector<std::string> get_dataset_names() const override
      {
        return names;
      }

      std::vector<std::tuple<unsigned int, unsigned int, std::string,
                             DataComponentInterpretation::DataComponentInterpretation>>
      get_nonscalar_data_ranges() const override
      {
        return ranges;
      }

    private:
      std::vector<std::tuple<unsigned int, unsigned int, std::string,
                             DataComponentInterpretation::DataComponentInterpretation>>
          ranges;
    };

    /// Writes the values of one vertex into a column of a patch.
    template <typename P>
    void fill(P &patch, const unsigned int column, const std::vector<OutputField> &fields,
              const std::size_t index)
    {
      unsigned int row = 0;
      for (const OutputField &field : fields)
        for (unsigned int c = 0; c < field.n_components; ++c)
          patch.data(row++, column) = static_cast<float>(field.values[field.n_components * index + c]);
    }
  } // namespace



  void write_bodies(const std::string &folder, const std::string &name, const NodalSpace &space,
                    const std::vector<OutputField>                                 &fields,
                    const std::function<double(const types::material_id material)> &body,
                    const unsigned int                                              most_files)
  {
    PatchOutput<3> output(fields);
    output.names.push_back("body");
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        {
          const auto nodes = space.nodes(cell);
          auto      &patch =
              output.add_patch(cell.n_vertices == CellShape::hexahedron ? ReferenceCells::Hexahedron
                                                                        : ReferenceCells::Tetrahedron);
          for (unsigned int v = 0; v < nodes.size(); ++v)
            {
              patch.vertices[v] = space.position(nodes[v]);
              fill(patch, v, fields, space.relevant().index_within_set(nodes[v]));
              patch.data(output.names.size() - 1, v) = static_cast<float>(body(cell.material));
            }
        }
    output.write(folder, name, space.communicator(), most_files);
  }



  void write_surface(const std::string &folder, const std::string &name, const ContactSurface &surface,
                     const std::vector<OutputField> &fields, const MPI_Comm communicator,
                     const unsigned int most_files)
  {
    const unsigned int        rank = Utilities::MPI::this_mpi_process(communicator);
    PatchOutput<2>            output(fields);
    static const unsigned int lexicographic[4] = {0, 1, 3, 2};
    for (const auto &face : surface.faces)
      if (face.worker == rank)
        {
          auto &patch = output.add_patch(face.n_corners == 4 ? ReferenceCells::Quadrilateral
                                                             : ReferenceCells::Triangle);
          for (unsigned int v = 0; v < face.n_corners; ++v)
            {
              const unsigned int vertex = face.corners[face.n_corners == 4 ? lexicographic[v] : v];
              patch.vertices[v]         = surface.mesh.vertices[vertex];
              fill(patch, v, fields, vertex);
            }
        }
    output.write(folder, name, communicator, most_files);
  }



  void write_overlay(std::ostream &out, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                     const std::vector<OverlayTriangle> &overlay)
  {
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
            patch.data(4, c) = cell.nonmortar_triangle;
            patch.data(5, c) = cell.mortar_triangle;
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
    /// The components of the stress in the order of the output: xx, yy, zz, xy, yz, zx.
    using Stress = std::array<double, 6>;

    /// Collective. Means of the stress over the cells around each relevant node, by volume.
    class NodalMeans
    {
    public:
      explicit NodalMeans(const NodalSpace &space)
        : space(space)
        , partition(space.owned(), space.relevant(), space.communicator())
      {
        for (Vector *v : {&normal, &shear, &weight})
          partition.reinit(*v);
      }

      void add(const NodalSpace::Cell &cell, const Block &sigma, const double volume)
      {
        for (const NodeIndex node : space.nodes(cell))
          {
            const unsigned int i = partition.to_local(node);
            for (unsigned int c = 0; c < 3; ++c)
              {
                normal.local_element(3 * i + c) += volume * sigma[c][c];
                shear.local_element(3 * i + c) += volume * sigma[c][(c + 1) % 3];
              }
            weight.local_element(3 * i) += volume;
          }
      }

      void finish()
      {
        for (Vector *v : {&normal, &shear, &weight})
          {
            v->compress(VectorOperation::add);
            v->update_ghost_values();
          }
      }

      /// Of the r-th relevant node; false if there is no cell around it.
      bool get(Stress &s, const std::size_t r) const
      {
        const unsigned int i = partition.to_local(space.relevant().nth_index_in_set(r));
        const double       w = weight.local_element(3 * i);
        for (unsigned int c = 0; c < 3 && w > 0.; ++c)
          {
            s[c]     = normal.local_element(3 * i + c) / w;
            s[3 + c] = shear.local_element(3 * i + c) / w;
          }
        return w > 0.;
      }

    private:
      const NodalSpace   &space;
      const NodePartition partition;
      Vector              normal, shear, weight;
    };

    double von_mises(const Stress &s)
    {
      return std::sqrt(.5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) +
                             (s[2] - s[0]) * (s[2] - s[0])) +
                       3. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    }

    std::array<double, 3> principal(const Stress &s)
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



  std::vector<OutputField> nodal_stress(const NodalSpace &space, const std::vector<double> &displacement,
                                        const Bodies &bodies, const Loads &loads)
  {
    NodalMeans means(space);
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        {
          const auto                                   nodes = space.nodes(cell);
          const Element                                element(space, cell);
          std::array<Vector3, CellShape::max_vertices> u;
          for (unsigned int v = 0; v < nodes.size(); ++v)
            for (unsigned int c = 0; c < 3; ++c)
              u[v][c] = displacement[3 * space.relevant().index_within_set(nodes[v]) + c];
          // The centre is the most accurate point of a hexahedron.
          const double           c = nodes.size() == CellShape::hexahedron ? .5 : .25;
          const CellDisplacement cell_displacement(element, bodies.material(cell.material), u,
                                                   loads.eigenstrain(space, cell));
          means.add(cell, cell_displacement.stress(Point<3>(c, c, c)), element.volume());
        }
    means.finish();

    const std::size_t        n      = space.relevant().n_elements();
    std::vector<OutputField> fields = {{"stress", 6, std::vector<double>(6 * n, 0.)},
                                       {"von_Mises", 1, std::vector<double>(n, 0.)},
                                       {"principal_stress", 3, std::vector<double>(3 * n, 0.)}};
    Stress                   s;
    for (std::size_t r = 0; r < n; ++r)
      if (means.get(s, r))
        {
          std::copy(s.begin(), s.end(), fields[0].values.begin() + 6 * r);
          fields[1].values[r] = von_mises(s);
          const auto values   = principal(s);
          std::copy(values.begin(), values.end(), fields[2].values.begin() + 3 * r);
        }
    return fields;
  }
} // namespace Signorini
