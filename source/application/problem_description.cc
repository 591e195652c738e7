// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/body_evaluation.h>
#include <signorini/application/contact_checks.h>
#include <signorini/application/problem_description.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/motion_description.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Of a boundary, as far as this rank has it.
    struct Extent
    {
      double   area = 0.;
      Point<3> low = Point<3>(1e300, 1e300, 1e300), high = Point<3>(-1e300, -1e300, -1e300);

      /// Over all ranks.
      void gather(const MPI_Comm comm)
      {
        area = Utilities::MPI::sum(area, comm);
        for (unsigned int c = 0; c < dim; ++c)
          {
            low[c]  = Utilities::MPI::min(low[c], comm);
            high[c] = Utilities::MPI::max(high[c], comm);
          }
      }
    };

    std::map<types::boundary_id, Extent> measure_boundaries(const NodalSpace &space)
    {
      std::map<types::boundary_id, Extent> extents;
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (const NodalSpace::Cell &cell = space.cells()[face.cell]; cell.is_owned)
          {
            const ElementFace shape(Element(space, cell), face.face);
            Extent           &extent = extents[face.id];
            for (unsigned int v = 0; v < shape.n_corners(); ++v)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  const double x = space.position(space.nodes(cell)[shape.vertex(v)])[c];
                  extent.low[c]  = std::min(extent.low[c], x);
                  extent.high[c] = std::max(extent.high[c], x);
                }
            for (unsigned int q = 0; q < shape.n_points(); ++q)
              extent.area += shape.point(q).area.norm();
          }
      return extents;
    }

    /// Collective.
    void describe_pair(std::ostream &out, const ContactPair &pair, const PairCoupling &coupling,
                       const MPI_Comm comm)
    {
      const SmallestGap smallest = smallest_initial_gap(pair, comm);
      if (coupling.n_rows_of_all == 0)
        return;
      double least = std::numeric_limits<double>::max(), largest = -least;
      for (std::size_t row = 0; row < coupling.gaps.size(); ++row)
        {
          least   = std::min(least, coupling.mean_gap(row, coupling.gaps[row]));
          largest = std::max(largest, coupling.mean_gap(row, coupling.gaps[row]));
        }
      least             = Utilities::MPI::min(least, comm);
      largest           = Utilities::MPI::max(largest, comm);
      const auto length = [&](const double x) { return std::abs(x) > smallest.rounding ? x : 0.; };
      out << "pair " << pair.name << ": nonmortar " << pair.nonmortar.name << ", mortar " << pair.mortar.name
          << ", " << coupling.n_rows_of_all << " contact nodes, gap " << length(least) << " to "
          << length(largest) << ", coverage " << coupling.covered_area / coupling.area << std::endl;
      if (smallest.value < std::numeric_limits<double>::max())
        out << "  smallest distance of the true surfaces: " << length(smallest.value)
            << (length(smallest.value) >= 0. ? ""
                : smallest.overlaps          ? " (they overlap)"
                                             : " (less than their facets leave open)")
            << ", at (" << smallest.place << ")" << std::endl;
    }

    std::string text(const Vector3 &v)
    {
      std::ostringstream out;
      out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
      return out.str();
    }

    void describe_body(std::ostream &out, const std::string &name,
                       const std::vector<std::pair<IsotropicMaterial, std::size_t>> &materials)
    {
      std::size_t n_cells = 0;
      for (const auto &[material, n] : materials)
        n_cells += n;
      out << name << ": " << n_cells << " cells";
      const char *separator = ", ";
      for (const auto &[material, n] : materials)
        {
          out << separator << "E = " << material.young << ", nu = " << material.poisson;
          if (materials.size() > 1)
            out << " (" << n << " cells)";
          separator = "; ";
        }
      out << std::endl;
    }

    /// "body NAME, boundary NAME + NAME".
    std::string names_of(const Bodies &bodies, const std::set<types::boundary_id> &ids)
    {
      std::string names;
      for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
        for (unsigned int i = 0; i < bodies.boundary_names(b).size(); ++i)
          if (const auto id = bodies.boundary_id(b, i); ids.count(id) > 0)
            names += names.empty() ? bodies.boundary_name(id) : " + \"" + bodies.boundary_names(b)[i] + "\"";
      return names;
    }

    /// Collective. One line for each load that acts on a body.
    void describe_load(std::ostream &out, const ContactModel &model, const Discretization &d,
                       const Loads &loads, const std::string &what)
    {
      const auto resultants = load_resultants(model, d, loads);
      for (const Resultant &r : resultants)
        if (r.force.norm() > 0. || r.moment.norm() > 0.)
          out << "load on " << what << ": force " << text(r.force) << ", moment about the origin "
              << text(r.moment) << std::endl;
    }

    void describe_loads_of_rigid_faces(std::ostream &out, const ContactModel &model, const Discretization &d)
    {
      if (d.dirichlet().rigid != nullptr)
        for (const RigidFace &face : d.dirichlet().rigid->faces())
          out << "load on " << model.loads().rigid_faces[face.index].boundary << ", a rigid face: force "
              << text(face.force) << ", moment about (" << face.centre << ") " << text(face.moment)
              << std::endl;
    }

    /// Collective.
    void describe_loads(std::ostream &out, const ContactModel &model, const Discretization &d)
    {
      const Bodies &bodies = model.bodies();
      Loads         one;
      one.time = model.loads().time;
      one.volume_forces.resize(bodies.n_bodies());
      for (const Traction &traction : model.loads().tractions)
        {
          one.tractions = {traction};
          describe_load(out, model, d, one, names_of(bodies, traction.ids));
        }
      one.tractions.clear();
      for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
        if (model.loads().volume_forces[b])
          {
            one.volume_forces[b] = model.loads().volume_forces[b];
            describe_load(out, model, d, one, "body " + bodies.body_name(b) + ", volume");
            one.volume_forces[b] = {};
          }
      describe_loads_of_rigid_faces(out, model, d);
      for (const Pretension &bolt : model.loads().pretensions)
        out << "pretension of body " << bodies.body_name(bolt.body) << ", " << bolt.name << ": section force "
            << bolt.wanted(model.loads().time) << " along " << text(bolt.axis)
            << (bolt.is_locked(model.loads().time)
                    ? ", locked after t = " + Patterns::Tools::to_string(bolt.locked_after)
                    : "")
            << std::endl;
      if (!model.loads().eigenstrains.empty())
        out << "temperatures or initial strains, which have no resultant" << std::endl;
      const auto all = all_loads(model, d);
      for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
        out << "all loads on body " << bodies.body_name(b) << ": force " << text(all[b].force)
            << ", moment about the origin " << text(all[b].moment) << std::endl;
    }

    /// Prescribed displacements of a condition at its nodes, as far as this rank has them.
    struct Prescribed
    {
      double                n_nodes = 0., n_directions = 0.;
      std::array<double, 3> low = {{1e300, 1e300, 1e300}}, high = {{-1e300, -1e300, -1e300}};
    };

    /// By condition.
    std::vector<Prescribed> find_prescribed(const ContactModel &model, const Discretization &d)
    {
      std::vector<Prescribed> conditions(model.loads().dirichlet.size());
      for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
        {
          const auto r = d.nodal().relevant().index_within_set(d.partition().to_global(i));
          for (unsigned int c = 0; c < dim; ++c)
            if (const int k = d.dirichlet().condition[r][c]; k >= 0)
              {
                conditions[k].n_nodes += 1.;
                conditions[k].low[c]  = std::min(conditions[k].low[c], d.dirichlet().value[r][c]);
                conditions[k].high[c] = std::max(conditions[k].high[c], d.dirichlet().value[r][c]);
              }
          if (const auto node = d.dirichlet().held.find(r); node != d.dirichlet().held.end())
            for (const HeldNode::Hold &hold : node->second.holds)
              conditions[hold.condition].n_directions += 1.;
        }
      return conditions;
    }

    /// Collective.
    void describe_constraints(std::ostream &out, const ContactModel &model, const Discretization &d)
    {
      const MPI_Comm                comm       = model.communicator();
      const std::vector<Prescribed> conditions = find_prescribed(model, d);
      for (std::size_t k = 0; k < conditions.size(); ++k)
        {
          const DirichletCondition &condition = model.loads().dirichlet[k];
          out << "constraint on body " << model.bodies().body_name(condition.body) << ", boundary "
              << condition.boundary << ":";
          const double n = Utilities::MPI::sum(conditions[k].n_nodes, comm);
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double low  = Utilities::MPI::min(conditions[k].low[c], comm),
                           high = Utilities::MPI::max(conditions[k].high[c], comm);
              if (low <= high)
                {
                  out << " u_"
                      << "xyz"[c] << " = " << low;
                  if (high > low)
                    out << " to " << high;
                  out << ",";
                }
            }
          if (n > 0.)
            out << ' ' << n << " components of nodes";
          if (const double m = Utilities::MPI::sum(conditions[k].n_directions, comm); m > 0.)
            out << ' ' << m << " directions of nodes";
          out << std::endl;
        }
    }

    void describe_rigid_faces(std::ostream &out, const ContactModel &model, const Discretization &d)
    {
      if (d.dirichlet().rigid != nullptr)
        for (const RigidFace &face : d.dirichlet().rigid->faces())
          out << "constraint on body " << model.bodies().body_name(face.body) << ", boundary "
              << model.loads().rigid_faces[face.index].boundary << ": moves as a rigid body, with "
              << face.free.size() << " motion(s) free" << std::endl;
    }

    void describe_free_motions(std::ostream &out, const ContactModel &model, const Discretization &d)
    {
      std::map<std::string, unsigned int> n_free;
      for (const FreeMotion &motion : d.free_motions())
        ++n_free[name_of_moving(motion, model.bodies())];
      for (const auto &[moving, n] : n_free)
        out << moving << ": the constraints leave " << n << " rigid motion(s) free, which contact must hold"
            << std::endl;
      if (n_free.empty())
        out << "free motions: none, the constraints hold all bodies" << std::endl;
    }
  } // namespace



  std::vector<std::vector<std::pair<IsotropicMaterial, std::size_t>>> used_materials(const Bodies     &bodies,
                                                                                     const NodalSpace &space)
  {
    std::vector<std::uint64_t> cells(bodies.n_materials(), 0);
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        ++cells[cell.material];
    Utilities::MPI::sum(cells, space.communicator(), cells);
    std::vector<std::vector<std::pair<IsotropicMaterial, std::size_t>>> result(bodies.n_bodies());
    for (types::material_id id = 0; id < cells.size(); ++id)
      {
        const Material &material = bodies.material(id);
        auto           &own      = result[material.body];
        const auto      same     = std::find_if(own.begin(), own.end(), [&](const auto &other) {
          return other.first.young == material.young && other.first.poisson == material.poisson;
        });
        if (same != own.end())
          same->second += cells[id];
        else if (cells[id] > 0)
          own.emplace_back(material, cells[id]);
      }
    return result;
  }



  void describe(std::ostream &out, const ContactModel &model, const Discretization &d)
  {
    const MPI_Comm comm      = model.communicator();
    const Bodies  &bodies    = model.bodies();
    auto           extents   = measure_boundaries(d.nodal());
    const auto     materials = used_materials(bodies, d.nodal());
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      {
        describe_body(out, "body " + bodies.body_name(b), materials[b]);
        for (unsigned int i = 0; i < bodies.boundary_names(b).size(); ++i)
          {
            Extent &extent = extents[bodies.boundary_id(b, i)];
            extent.gather(comm);
            out << "  boundary " << bodies.boundary_names(b)[i] << ": area " << extent.area << ", box ("
                << extent.low << ") to (" << extent.high << ")" << std::endl;
          }
      }
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      describe_pair(out, d.pairs[p], d.couplings[p], comm);
    describe_loads(out, model, d);
    describe_constraints(out, model, d);
    describe_rigid_faces(out, model, d);
    describe_free_motions(out, model, d);
  }
} // namespace Signorini
