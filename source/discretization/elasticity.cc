// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "elasticity_pattern.h"
#include "expanded_cell.h"

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Cell = NodalSpace::Cell;

    /// Forces of a traction on one face.
    void add_traction(CellData &data, const unsigned int face, const SurfaceForces &forces,
                      const std::size_t traction)
    {
      const ElementFace shape(data.element, face);
      for (unsigned int q = 0; q < shape.n_points(); ++q)
        {
          const ElementFace::PointData point = shape.point(q);
          const Vector3                force = forces.force(traction, point.position, point.area);
          for (unsigned int v = 0; v < shape.n_corners(); ++v)
            data.load[shape.vertex(v)] += point.shape[v] * force;
        }
    }



    /// Forces and energy of the strain without stress, in the strains that the stiffness is made of.
    void add_eigenstrain(CellData &data, const Material &material, const CellEigenstrain &eigenstrain)
    {
      data.initial_energy = 0.;
      if (eigenstrain.is_zero)
        return;
      const CellDisplacement free(data.element, material, {}, eigenstrain);
      std::array<Vector3, 8> gradients;
      for (unsigned int q = 0; q < data.element.n_points(); ++q)
        {
          const Point<3> reference = data.element.reference_point(q);
          if (!data.element.shape_gradients(gradients, reference))
            continue;
          const double weight  = data.element.volume_element(q).first;
          const Block  elastic = free.elastic_gradient(reference), sigma = stress(elastic, material);
          data.initial_energy += .5 * weight * scalar_product(sigma, elastic);
          for (unsigned int v = 0; v < data.n(); ++v)
            data.load[v] -= weight * (sigma * gradients[v]);
        }
    }



    class CellAssembler
    {
    public:
      /// Collective.
      CellAssembler(const Bodies &bodies, const NodalSpace &space, const Loads &loads)
        : bodies(bodies)
        , space(space)
        , loads(loads)
        , forces(loads, space)
      {
        for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
          for (const std::size_t traction : forces.on(face.id))
            loaded.push_back({face.cell, face.face, traction});
        std::stable_sort(loaded.begin(), loaded.end(),
                         [](const auto &a, const auto &b) { return a.cell < b.cell; });
        find_nodal_forces();
      }

      /// The element and its load.
      void compute_load(CellData &data, const unsigned int index) const
      {
        const Cell &cell = space.cells()[index];
        data.element     = Element(space, cell);
        data.vertices.reinit(space.nodes(cell).data(), cell.n_vertices);
        data.load.fill(Vector3());
        add_load(data, index);
      }

      /// The stiffness of what compute_load() was called for.
      void compute_stiffness(CellData &data, const unsigned int index) const
      {
        const auto &material = bodies.material(space.cells()[index].material);
        if (!data.element.stiffness(data.stiffness, material))
          {
            std::ostringstream message;
            message << "Body " << bodies.body_name(material.body) << ": inverted cell near ("
                    << data.element.corner(0) << "). Mend the mesh.";
            throw InputError(message.str());
          }
      }

    private:
      void add_load(CellData &data, const unsigned int index) const
      {
        const auto &material = bodies.material(space.cells()[index].material);
        if (loads.has_eigenstrains())
          add_eigenstrain(data, material, loads.eigenstrain(space, space.cells()[index]));
        if (const VectorField &force = loads.volume_forces[material.body])
          for (unsigned int q = 0; q < data.element.n_points(); ++q)
            {
              const auto [weight, point] = data.element.volume_element(q);
              const auto    values       = data.element.shape_at_point(q);
              const Vector3 value        = force(point, loads.time);
              for (unsigned int v = 0; v < data.n(); ++v)
                for (unsigned int c = 0; c < dim; ++c)
                  data.load[v][c] += weight * values[v] * value[c];
            }
        auto face = std::lower_bound(loaded.begin(), loaded.end(), index,
                                     [](const LoadedFace &f, const unsigned int i) { return f.cell < i; });
        for (; face != loaded.end() && face->cell == index; ++face)
          add_traction(data, face->face, forces, face->traction);
        for (auto node = std::lower_bound(
                 nodal_forces.begin(), nodal_forces.end(), index,
                 [](const NodalForce &force, const unsigned int i) { return force.cell < i; });
             node != nodal_forces.end() && node->cell == index; ++node)
          data.load[node->vertex] += node->force;
      }

      /// Gives each force to one of the cells of this rank at its node, if the node belongs to this rank.
      void find_nodal_forces()
      {
        if (loads.nodal_forces.empty())
          return;
        std::vector<bool> is_done(space.relevant().n_elements(), false);
        for (unsigned int c = 0; c < space.cells().size(); ++c)
          if (const Cell &cell = space.cells()[c]; cell.is_owned)
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              {
                const NodeIndex node = space.nodes(cell)[v];
                if (!space.owned().is_element(node))
                  continue;
                const std::size_t i = space.relevant().index_within_set(node);
                if (is_done[i])
                  continue;
                is_done[i] = true;
                if (const auto it = loads.nodal_forces.find(space.start_vertices()[i]);
                    it != loads.nodal_forces.end())
                  for (const VectorField &force : it->second)
                    nodal_forces.push_back({c, v, force(space.position(node), loads.time)});
              }
      }

      /// The force at the node of a vertex of a cell.
      struct NodalForce
      {
        unsigned int cell, vertex;
        Vector3      force;
      };

      struct LoadedFace
      {
        unsigned int cell, face;
        std::size_t  traction;
      };

      const Bodies           &bodies;
      const NodalSpace       &space;
      const Loads            &loads;
      const SurfaceForces     forces;
      std::vector<LoadedFace> loaded;
      std::vector<NodalForce> nodal_forces;
    };



    /// Subtracts K times a cell displacement from the load.
    void subtract_stiffness(CellData &data, const std::array<Vector3, 8> &u)
    {
      for (unsigned int a = 0; a < data.n(); ++a)
        for (unsigned int b = 0; b < data.n(); ++b)
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              data.load[a][c] -= data.block(a, b)[3 * c + d] * u[b][d];
    }



    /// The Dirichlet lift at a vertex, hanging ones interpolated.
    Vector3 lift_at(const NodalSpace &space, const DirichletData &dirichlet, const NodeIndex node)
    {
      if (const auto *parents = space.hanging_nodes().get_constraint_entries(node))
        {
          Vector3 value;
          for (const auto &[parent, weight] : *parents)
            value += weight * dirichlet.value[space.relevant().index_within_set(parent)];
          return value;
        }
      return dirichlet.value[space.relevant().index_within_set(node)];
    }



    /// Values of a nodal field at the vertices of a cell.
    std::array<Vector3, 8> cell_values(const CellData &data, const NodePartition &partition, const Vector &u)
    {
      std::array<Vector3, 8> values;
      for (unsigned int v = 0; v < data.n(); ++v)
        for (unsigned int c = 0; c < dim; ++c)
          values[v][c] = u.local_element(dim * partition.to_local(data.vertices[v]) + c);
      return values;
    }



    inline void add_block(double *target, const double *source)
    {
      for (unsigned int c = 0; c < 9; ++c)
        target[c] += source[c];
    }



    void scatter_plain(LinearSystem &system, const CellData &data)
    {
      const NodePartition        &partition = system.matrix.partition();
      std::array<unsigned int, 8> local;
      for (unsigned int v = 0; v < data.n(); ++v)
        local[v] = partition.to_local(data.vertices[v]);
      for (unsigned int a = 0; a < data.n(); ++a)
        {
          const unsigned int row = system.matrix.row_of(local[a]);
          for (unsigned int b = 0; b < data.n(); ++b)
            if (system.matrix.stores(row, local[b]))
              add_block(system.matrix.block(system.matrix.find(row, local[b])), data.block(a, b));
          for (unsigned int c = 0; c < dim; ++c)
            system.rhs.local_element(dim * local[a] + c) += data.load[a][c];
        }
    }



    /// Adds the owned cells.
    void assemble_cells(LinearSystem &system, const CellAssembler &assembler, const NodalSpace &space,
                        const DirichletData &dirichlet, const VertexExpansion &expansion)
    {
      CellData     data;
      ExpandedCell expanded;
      for (unsigned int cell = 0; cell < space.cells().size(); ++cell)
        if (space.cells()[cell].is_owned)
          {
            assembler.compute_load(data, cell);
            assembler.compute_stiffness(data, cell);
            bool                   plain = true, lifted = false;
            std::array<Vector3, 8> lift;
            for (unsigned int v = 0; v < data.n(); ++v)
              {
                plain   = plain && expansion.is_plain(data.vertices[v]);
                lift[v] = lift_at(space, dirichlet, data.vertices[v]);
                lifted  = lifted || lift[v].norm_square() > 0.;
              }
            if (lifted)
              subtract_stiffness(data, lift);
            if (plain)
              scatter_plain(system, data);
            else
              expanded.scatter(system, data, expansion);
          }
    }
  } // namespace



  void add_rigid_forces(Vector &rhs, const NodePartition &partition, const DirichletData &dirichlet)
  {
    if (dirichlet.rigid != nullptr)
      for (unsigned int f = 0; f < dirichlet.rigid->faces().size(); ++f)
        {
          const RigidFace    &face = dirichlet.rigid->faces()[f];
          std::vector<double> loads;
          for (const RigidMotion &motion : face.free)
            loads.push_back(face.load_on(motion));
          dirichlet.rigid->add(rhs, partition, f, loads);
        }
  }



  LinearSystem assemble_elasticity(const Bodies &bodies, const NodalSpace &space, const Loads &loads,
                                   const DirichletData &dirichlet, const InterfaceCoupling &coupling,
                                   const std::vector<RowProjection> &projections)
  {
    const VertexExpansion expansion(space, coupling, projections, dirichlet.rigid.get());
    LinearSystem          system;
    system.matrix.reinit(space.owned(), make_pattern(space, expansion), IndexSet(space.n_nodes()),
                         space.communicator());
    system.matrix.partition().reinit(system.rhs);
    system.fixed = import_ghost_masks(system.matrix.partition(), fixed_of_owned(space, dirichlet));

    const CellAssembler assembler(bodies, space, loads);
    std::string         error;
    try
      {
        assemble_cells(system, assembler, space, dirichlet, expansion);
      }
    catch (const InputError &e)
      {
        error = e.what();
      }
    throw_everywhere(error, space.communicator());
    system.matrix.compress();
    system.rhs.compress(VectorOperation::add);
    add_rigid_forces(system.rhs, system.matrix.partition(), dirichlet);
    for (unsigned int i = 0; i < system.matrix.n_rows(); ++i)
      project_free(system.fixed[i], system.rhs, i);
    return system;
  }



  Vector physical_residual(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                           const Loads &loads, const Vector &u)
  {
    Vector residual;
    partition.reinit(residual);
    const CellAssembler assembler(bodies, space, loads);
    CellData            data;
    for (unsigned int cell = 0; cell < space.cells().size(); ++cell)
      if (space.cells()[cell].is_owned)
        {
          assembler.compute_load(data, cell);
          const auto values = cell_values(data, partition, u);
          // A lift is zero in most cells.
          if (std::any_of(values.begin(), values.begin() + data.n(),
                          [](const Vector3 &value) { return value.norm_square() > 0.; }))
            {
              assembler.compute_stiffness(data, cell);
              subtract_stiffness(data, values);
            }
          for (unsigned int v = 0; v < data.n(); ++v)
            {
              const auto add = [&](const NodeIndex node, const double weight) {
                for (unsigned int c = 0; c < dim; ++c)
                  residual.local_element(dim * partition.to_local(node) + c) -= weight * data.load[v][c];
              };
              if (const auto *parents = space.hanging_nodes().get_constraint_entries(data.vertices[v]))
                for (const auto &[parent, weight] : *parents)
                  add(parent, weight);
              else
                add(data.vertices[v], 1.);
            }
        }
    residual.compress(VectorOperation::add);
    return residual;
  }



  double potential_energy(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                          const Loads &loads, const Vector &u)
  {
    const CellAssembler assembler(bodies, space, loads);
    CellData            data;
    double              energy = 0.;
    for (unsigned int cell = 0; cell < space.cells().size(); ++cell)
      if (space.cells()[cell].is_owned)
        {
          assembler.compute_load(data, cell);
          assembler.compute_stiffness(data, cell);
          const std::array<Vector3, 8> load   = data.load;
          const std::array<Vector3, 8> cell_u = cell_values(data, partition, u);
          subtract_stiffness(data, cell_u);
          energy += data.initial_energy;
          // The load is now f - K u.
          for (unsigned int v = 0; v < data.n(); ++v)
            energy -= .5 * cell_u[v] * (load[v] + data.load[v]);
        }
    return Utilities::MPI::sum(energy, space.communicator());
  }



  double strain_energy(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                       const Vector &u)
  {
    Loads none;
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      none.volume_forces.emplace_back();
    return potential_energy(bodies, space, partition, none, u);
  }
} // namespace Signorini
