// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/element.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <Eigen/LU>

namespace Signorini
{
  using namespace dealii;

  void LoadParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
        "Dirichlet", dirichlet,
        "Prescribed displacements, \"boundary: (ux, uy, uz); boundary: ...\". Each entry is an "
        "expression in x, y, z (length), or * for a free component: a symmetry plane x = 0 is "
        "\"symmetry x: (0, *, *)\". Rollers in other directions: \"boundary: (normal: 0)\" along "
        "the outward normal, \"boundary: (along (1, 1, 0): 0)\" along a direction, \"boundary: "
        "(radial: 0, tangential: 0, axial: *) about (0, 0, 0), (0, 0, 1)\" about an axis, given "
        "by a point and a direction. Where conditions overlap, the later one counts.");
    prm.add_parameter("Tractions", tractions,
                      "Forces per area, \"boundary: (tx, ty, tz); ...\", expressions in x, y, z.");
    prm.add_parameter("Pressures", pressures,
                      "Pressures against the outward normal (force per area), \"boundary: p; ...\".");
    prm.add_parameter("Forces", forces,
                      "Total forces, spread evenly over the area of a boundary, \"boundary: (Fx, Fy, Fz); "
                      "...\".");
    prm.add_parameter(
        "Rigid", rigid,
        "Boundaries that move as rigid bodies, as if glued to a stamp: \"boundary: force (Fx, Fy, Fz), "
        "moment (Mx, "
        "My, Mz), about (x, y, z), displacement (ux, uy, uz), rotation (rx, ry, rz), along (dx, dy, dz); "
        "...\", "
        "of which each may be left out. Force and moment act at the point behind about (the middle of the "
        "boundary); displacement and rotation (radian) of it have * for free components; with along it moves "
        "in "
        "that direction only and does not turn. Conditions at its edges (symmetry planes) hold it, too, but "
        "for tilts about these "
        "edges: rotation (0, 0, 0) excludes them.");
    prm.add_parameter("Volume force", volume_force, "Force per volume, \"(fx, fy, fz)\"; empty for none.");
  }



  namespace
  {
    /// The entries of a condition by name: "(radial: 0, axial: *)", or of one "(along (1, 1, 0): 0)".
    std::map<std::string, ScalarField> named_components(const std::string &text, const std::string &where)
    {
      std::map<std::string, ScalarField> result;
      for (const std::string &entry : split_list(text.substr(1, text.size() - 2), ',', where))
        {
          const auto pieces = split_list(entry, ':', where);
          if (pieces.size() != 2 || pieces[0].empty() || pieces[1].empty())
            throw InputError(where + ": \"" + entry + "\" should read \"direction: displacement\".");
          if (!result.insert({pieces[0], pieces[1] == "*" ? ScalarField() : Expression(pieces[1], where)})
                   .second)
            throw InputError(where + ": \"" + pieces[0] + "\" is there twice.");
        }
      return result;
    }

    void set_along(LoadDefinition::Displacement &condition, const std::string &direction,
                   const std::string &where)
    {
      const Vector3 v = parse_point(direction, where);
      if (!(v.norm() > 0.))
        throw InputError(where + ": the direction \"" + direction + "\" must not be zero.");
      condition.frame = ConditionFrame::rotated(v);
    }

    /// The axis behind "about".
    ConditionFrame parse_axis(const std::string &text, const std::string &where)
    {
      const auto pieces = split_list(text, ',', where);
      if (pieces.size() != 2)
        throw InputError(where + ": \"" + text +
                         "\" should be a point and a direction, like (0, 0, 0), (0, 0, 1).");
      const Vector3 axis = parse_point(pieces[1], where);
      if (!(axis.norm() > 0.))
        throw InputError(where + ": the axis \"" + pieces[1] + "\" must not be zero.");
      return ConditionFrame::cylindrical(parse_point(pieces[0], where), axis);
    }

    /// "(normal: 0)", "(along (1, 1, 0): 0)", "(radial: 0, tangential: *, axial: 0) about point, axis".
    void parse_named(LoadDefinition::Displacement &condition, const std::string &text,
                     const std::string &where)
    {
      // The parenthesis that closes the components.
      std::size_t end   = 0;
      int         depth = 0;
      do
        depth += text[end] == '(' ? 1 : (text[end] == ')' ? -1 : 0);
      while (++end < text.size() && depth > 0);
      const auto        components = named_components(text.substr(0, end), where);
      const std::string tail       = Utilities::trim(text.substr(end));
      const bool        has_axis   = tail.compare(0, 6, "about ") == 0 || tail.compare(0, 6, "about(") == 0;
      if (!tail.empty() && !has_axis)
        throw InputError(where + ": \"" + tail + "\" should be \"about point, axis\".");
      if (has_axis)
        {
          static const std::array<std::string, 3> names = {{"radial", "tangential", "axial"}};
          condition.frame                               = parse_axis(tail.substr(5), where);
          for (const auto &[name, value] : components)
            {
              const auto c = std::find(names.begin(), names.end(), name);
              if (c == names.end())
                throw InputError(where + ": \"" + name +
                                 "\" should be radial, tangential or axial where there is an axis.");
              condition.components[c - names.begin()] = value;
            }
          return;
        }
      const auto &[name, value] = *components.begin();
      if (components.size() != 1 || (name != "normal" && name.compare(0, 5, "along") != 0))
        throw InputError(where + ": \"" + text +
                         "\" should be (normal: u), (along (dx, dy, dz): u) or, with an axis, (radial: u, "
                         "tangential: v, axial: w) about point, axis.");
      if (name == "normal")
        condition.frame = ConditionFrame::normal();
      else
        set_along(condition, name.substr(5), where);
      condition.components[0] = value;
    }

    LoadDefinition::Displacement parse_displacement(const std::string &boundary, const std::string &text,
                                                    const std::string &where)
    {
      LoadDefinition::Displacement condition{boundary, {}};
      if (!text.empty() && text.front() == '(' && text.find(':') != std::string::npos)
        {
          parse_named(condition, text, where);
          return condition;
        }
      const auto entries = split_vector(text, where);
      for (unsigned int c = 0; c < dim; ++c)
        if (entries[c] != "*")
          condition.components[c] = Expression(entries[c], where);
      return condition;
    }
  } // namespace



  namespace
  {
    std::array<ScalarField, 3> parse_components(const std::string &text, const std::string &where)
    {
      std::array<ScalarField, 3> result;
      const auto                 entries = split_vector(text, where);
      for (unsigned int c = 0; c < dim; ++c)
        if (entries[c] != "*")
          result[c] = Expression(entries[c], where);
      return result;
    }

    LoadDefinition::RigidBoundary parse_rigid(const std::string &boundary, const std::string &text,
                                              const std::string &where)
    {
      LoadDefinition::RigidBoundary result{boundary, {}, {}};
      std::set<std::string>         seen;
      for (const std::string &piece : split_list(text, ',', where))
        {
          const std::size_t bracket = piece.find('(');
          const std::string word    = Utilities::trim(piece.substr(0, bracket)),
                            value   = bracket == std::string::npos ? "" : piece.substr(bracket);
          if (!seen.insert(word).second)
            throw InputError(where + ": \"" + word + "\" is there twice.");
          if (word == "force")
            result.force = parse_vector_field(value, where);
          else if (word == "moment")
            result.moment = parse_vector_field(value, where);
          else if (word == "about")
            result.about = parse_point(value, where);
          else if (word == "displacement")
            result.displacement = parse_components(value, where);
          else if (word == "rotation")
            result.rotation = parse_components(value, where);
          else if (word == "along")
            {
              result.direction = parse_point(value, where);
              if (!(result.direction.norm() > 0.))
                throw InputError(where + ": the direction \"" + value + "\" must not be zero.");
            }
          else
            throw InputError(where + ": \"" + piece +
                             "\" should begin with force, moment, about, displacement, rotation or along.");
        }
      return result;
    }
  } // namespace



  LoadDefinition LoadParameters::definition(const std::string &section) const
  {
    LoadDefinition result;
    for (const auto &[name, text] : split_named_entries(dirichlet, section + "Dirichlet"))
      result.displacements.push_back(
          parse_displacement(name, text, section + "Dirichlet, boundary \"" + name + "\""));
    for (const auto &[name, text] : split_named_entries(tractions, section + "Tractions"))
      result.surface_forces.push_back(
          {name, parse_vector_field(text, section + "Tractions, boundary \"" + name + "\""), {}, {}});
    for (const auto &[name, text] : split_named_entries(pressures, section + "Pressures"))
      result.surface_forces.push_back(
          {name, {}, Expression(text, section + "Pressures, boundary \"" + name + "\""), {}});
    for (const auto &[name, text] : split_named_entries(forces, section + "Forces"))
      result.surface_forces.push_back(
          {name, {}, {}, parse_vector_field(text, section + "Forces, boundary \"" + name + "\"")});
    for (const auto &[name, text] : split_named_entries(rigid, section + "Rigid"))
      result.rigid_boundaries.push_back(
          parse_rigid(name, text, section + "Rigid, boundary \"" + name + "\""));
    if (!Utilities::trim(volume_force).empty())
      result.volume_force = parse_vector_field(volume_force, section + "Volume force");
    return result;
  }



  namespace
  {
    std::string parameter_of(const LoadDefinition::SurfaceForce &force)
    {
      return force.traction ? "Tractions" : (force.pressure ? "Pressures" : "Forces");
    }
  } // namespace



  void Loads::add(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition)
  {
    const std::string section = "Body " + bodies.body_name(body) + "/";
    for (const LoadDefinition::Displacement &condition : definition.displacements)
      {
        const unsigned int           node_set = bodies.has_boundary(body, condition.boundary)
                                                    ? StartNodes::none
                                                    : bodies.node_set(body, condition.boundary);
        std::set<types::boundary_id> ids;
        if (node_set == StartNodes::none)
          ids = bodies.boundary_ids(body, condition.boundary, section + "Dirichlet");
        else if (condition.frame.needs_normal())
          throw InputError(section + "Dirichlet: \"" + condition.boundary +
                           "\" is a set of nodes, which has no normals. Name a boundary or a direction.");
        if (condition.frame.needs_normal() && (condition.components[1] || condition.components[2]))
          throw InputError(
              section + "Dirichlet, boundary \"" + condition.boundary +
              "\": along a normal there is one component; tangents have no meaning of their own.");
        dirichlet.push_back(
            {body, condition.boundary, ids, condition.components, condition.frame, {}, node_set});
        if (condition.frame.needs_normal())
          dirichlet.back().shapes = bodies.true_shapes(body, ids, false);
      }
    for (const LoadDefinition::RigidBoundary &rigid : definition.rigid_boundaries)
      rigid_faces.push_back({section + "Rigid, boundary \"" + rigid.boundary + "\"", body, rigid.boundary,
                             bodies.boundary_ids(body, rigid.boundary, section + "Rigid"), rigid.force,
                             rigid.moment, rigid.about, rigid.displacement, rigid.rotation, rigid.direction});
    for (const LoadDefinition::NodalForce &force : definition.nodal_forces)
      nodal_forces[bodies.start_vertex(body, force.vertex)].push_back(force.force);
    for (const LoadDefinition::SurfaceForce &force : definition.surface_forces)
      tractions.push_back({bodies.boundary_ids(body, force.boundary, section + parameter_of(force)),
                           force.traction, force.pressure, force.total_force});
    volume_forces.resize(std::max<std::size_t>(volume_forces.size(), body + 1));
    volume_forces[body] = definition.volume_force;
  }



  namespace
  {
    /// The area vector of a face, outward.
    Vector3 face_area(const NodalSpace &space, const NodalSpace::BoundaryFace &face)
    {
      const NodalSpace::Cell &cell    = space.cells()[face.cell];
      const auto              nodes   = space.nodes(cell);
      const auto              corners = CellShape::face(cell.n_vertices, face.face);
      const auto              point = [&](const unsigned int v) { return space.position(nodes[corners[v]]); };
      return corners.size() == 3 ? .5 * cross_product_3d(point(1) - point(0), point(2) - point(0))
                                 : .5 * cross_product_3d(point(2) - point(0), point(3) - point(1));
    }

    struct NormalRule
    {
      /// Faces whose normals are nearer to each other than this (cosine: 30 degrees) are one smooth boundary
      /// at a node; else it is an edge, which is held along both normals.
      double smooth = .866;
    };

    /// Conditions at the nodes, as the faces show them that this rank can see.
    class NodeConditions
    {
    public:
      NodeConditions(const NodalSpace &space, const Loads &loads)
        : space(space)
        , loads(loads)
      {
        std::map<types::boundary_id, std::vector<int>> conditions_of;
        for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
          for (const types::boundary_id id : loads.dirichlet[i].ids)
            conditions_of[id].push_back(i);
        for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
          if (const auto it = conditions_of.find(face.id); it != conditions_of.end())
            add(face, it->second);
        for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
          if (loads.dirichlet[i].node_set != StartNodes::none)
            for (const NodeIndex node : space.node_sets()[loads.dirichlet[i].node_set])
              entry(node, i);
      }

      /// The latest condition of each component at the nodes whose conditions are all along the axes.
      std::map<std::size_t, std::array<int, 3>> plain() const
      {
        std::map<std::size_t, std::array<int, 3>> result;
        for (const auto &[i, node] : nodes)
          if (!node.is_held)
            {
              std::array<int, 3> &latest = result.insert({i, {{-1, -1, -1}}}).first->second;
              for (const auto &[condition, faces] : node.conditions)
                for (unsigned int c = 0; c < dim; ++c)
                  if (loads.dirichlet[condition].components[c])
                    latest[c] = std::max(latest[c], condition);
            }
        return result;
      }

      /// The other nodes that this rank owns.
      std::map<std::size_t, HeldNode> held() const
      {
        std::map<std::size_t, HeldNode> result;
        for (const auto &[i, node] : nodes)
          if (node.is_held && space.owned().is_element(space.relevant().nth_index_in_set(i)))
            result[i] = hold(node, space.position(space.relevant().nth_index_in_set(i)));
        return result;
      }

    private:
      /// A face at a node: its area vector and boundary.
      struct Face
      {
        Vector3            area;
        types::boundary_id id;

        bool operator<(const Face &other) const
        {
          return std::tie(id, area[0], area[1], area[2]) <
                 std::tie(other.id, other.area[0], other.area[1], other.area[2]);
        }
      };

      struct Node
      {
        bool                             is_held = false;
        std::map<int, std::vector<Face>> conditions;
      };

      void add(const NodalSpace::BoundaryFace &face, const std::vector<int> &conditions)
      {
        const NodalSpace::Cell &cell = space.cells()[face.cell];
        const Vector3           area = face_area(space, face);
        for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
          if (const NodeIndex node = space.nodes(cell)[v]; !space.hanging_nodes().is_constrained(node))
            for (const int condition : conditions)
              entry(node, condition).push_back({area, face.id});
      }

      /// The faces of a condition at a node; none where it holds a set of nodes.
      std::vector<Face> &entry(const NodeIndex node, const int condition)
      {
        Node &found   = nodes[space.relevant().index_within_set(node)];
        found.is_held = found.is_held || !loads.dirichlet[condition].frame.is_cartesian();
        return found.conditions[condition];
      }

      /// Of the conditions along normals: one direction for each smooth piece of boundary, with the latest of
      /// its conditions.
      std::vector<std::pair<int, Vector3>> normals(const Node &node, const Point<3> &x) const
      {
        constexpr NormalRule                 rule;
        std::vector<std::pair<int, Vector3>> result;
        for (const auto &[condition, faces] : node.conditions)
          {
            const DirichletCondition &c = loads.dirichlet[condition];
            if (!c.frame.needs_normal() || !c.components[0])
              continue;
            std::vector<Face> sorted = faces;
            std::sort(sorted.begin(), sorted.end());
            for (const Face &face : sorted)
              {
                const auto    shape = c.shapes.find(face.id);
                const Vector3 area  = shape == c.shapes.end() || shape->second == nullptr
                                          ? face.area
                                          : face.area.norm() * shape->second->normal(x, face.area);
                const auto    piece = std::find_if(result.begin(), result.end(), [&](const auto &other) {
                  return other.second * area > rule.smooth * other.second.norm() * area.norm();
                });
                if (piece == result.end())
                  result.emplace_back(condition, area);
                else
                  {
                    piece->first = condition;
                    piece->second += area;
                  }
              }
          }
        for (auto &[condition, sum] : result)
          sum /= sum.norm();
        return result;
      }

      HeldNode hold(const Node &node, const Point<3> &x) const
      {
        std::vector<HeldNode::Hold> all;
        for (const auto &[condition, normal] : normals(node, x))
          all.push_back({condition, 0, normal, {}});
        for (const auto &[condition, faces] : node.conditions)
          if (const DirichletCondition &c = loads.dirichlet[condition]; !c.frame.needs_normal())
            {
              const auto axes = c.frame.axes(x, Vector3());
              for (unsigned int k = 0; k < dim; ++k)
                if (c.components[k])
                  all.push_back({condition, k, axes[k], {}});
            }
        std::stable_sort(all.begin(), all.end(),
                         [](const auto &a, const auto &b) { return a.condition > b.condition; });
        HeldNode             result;
        std::vector<Vector3> kept;
        for (const HeldNode::Hold &one : all)
          if (!FixedDirections::span(kept).contains(one.direction))
            {
              result.holds.push_back(one);
              kept.push_back(one.direction);
            }
        set_duals(result);
        return result;
      }

      static void set_duals(HeldNode &node)
      {
        const Eigen::Index n = static_cast<Eigen::Index>(node.holds.size());
        Eigen::MatrixXd    gram(n, n);
        for (Eigen::Index k = 0; k < n; ++k)
          for (Eigen::Index l = 0; l < n; ++l)
            gram(k, l) = node.holds[k].direction * node.holds[l].direction;
        const Eigen::MatrixXd inverse = gram.inverse();
        for (Eigen::Index k = 0; k < n; ++k)
          for (Eigen::Index l = 0; l < n; ++l)
            node.holds[k].dual += inverse(k, l) * node.holds[l].direction;
      }

      const NodalSpace           &space;
      const Loads                &loads;
      std::map<std::size_t, Node> nodes;
    };
  } // namespace



  SurfaceForces::SurfaceForces(const Loads &loads, const NodalSpace &space)
    : loads(loads)
    , areas(loads.tractions.size(), 0.)
  {
    for (std::size_t t = 0; t < loads.tractions.size(); ++t)
      for (const types::boundary_id id : loads.tractions[t].ids)
        by_boundary[id].push_back(t);
    if (std::none_of(loads.tractions.begin(), loads.tractions.end(),
                     [](const Traction &t) { return static_cast<bool>(t.total_force); }))
      return;
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (space.cells()[face.cell].is_owned && !on(face.id).empty())
        {
          const Element     element(space, space.cells()[face.cell]);
          const ElementFace shape(element, face.face);
          double            area = 0.;
          for (unsigned int q = 0; q < shape.n_points(); ++q)
            area += shape.point(q).area.norm();
          for (const std::size_t t : on(face.id))
            areas[t] += area;
        }
    for (double &area : areas)
      area = Utilities::MPI::sum(area, space.communicator());
  }



  const std::vector<std::size_t> &SurfaceForces::on(const types::boundary_id id) const
  {
    static const std::vector<std::size_t> none;
    const auto                            it = by_boundary.find(id);
    return it == by_boundary.end() ? none : it->second;
  }



  Vector3 SurfaceForces::force(const std::size_t traction, const Point<3> &position,
                               const Vector3 &area) const
  {
    const Traction &t = loads.tractions[traction];
    Vector3         result;
    if (t.traction)
      result = area.norm() * t.traction(position, loads.time);
    if (t.pressure)
      result -= t.pressure(position, loads.time) * area;
    if (t.total_force)
      result += area.norm() / areas[traction] * t.total_force(Point<3>(), loads.time);
    return result;
  }



  namespace
  {
    /// A rank sees all faces at its own nodes, but not all at its ghost nodes: the owners tell.
    void import_conditions(DirichletData &data, const NodalSpace &space)
    {
      const NodePartition partition(space.owned(), space.relevant(), space.communicator());
      const auto          relevant = [&](const unsigned int i) {
        return space.relevant().index_within_set(partition.to_global(i));
      };
      Vector conditions;
      partition.reinit(conditions);
      std::vector<FixedDirections> own(partition.n_owned());
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        {
          own[i] = data.fixed[relevant(i)];
          for (unsigned int c = 0; c < dim; ++c)
            conditions.local_element(dim * i + c) = data.condition[relevant(i)][c];
        }
      conditions.update_ghost_values();
      const std::vector<FixedDirections> all = import_ghost_masks(partition, own);
      for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
        {
          data.fixed[relevant(i)] = all[i];
          for (unsigned int c = 0; c < dim; ++c)
            data.condition[relevant(i)][c] = static_cast<int>(conditions.local_element(dim * i + c));
        }
    }

    /// The displacements of held nodes, ghosts too.
    void set_held_values(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      if (Utilities::MPI::max(data.held.empty() ? 0 : 1, space.communicator()) == 0)
        return;
      const NodePartition partition(space.owned(), space.relevant(), space.communicator());
      Vector              values;
      partition.reinit(values);
      for (const auto &[i, node] : data.held)
        {
          const NodeIndex number = space.relevant().nth_index_in_set(i);
          for (const HeldNode::Hold &hold : node.holds)
            data.value[i] += loads.dirichlet[hold.condition].components[hold.component](
                                 space.position(number), loads.time) *
                             hold.dual;
          for (unsigned int c = 0; c < dim; ++c)
            values.local_element(dim * partition.to_local(number) + c) = data.value[i][c];
        }
      values.update_ghost_values();
      for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          data.value[space.relevant().index_within_set(partition.to_global(i))][c] +=
              values.local_element(dim * i + c);
    }

    void set_values(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      for (std::size_t i = 0; i < data.value.size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          if (data.condition[i][c] >= 0)
            data.value[i][c] = loads.dirichlet[data.condition[i][c]].components[c](
                space.position(space.relevant().nth_index_in_set(i)), loads.time);
      set_held_values(data, space, loads);
    }
  } // namespace



  DirichletData evaluate_dirichlet(const NodalSpace &space, const Loads &loads, const bool with_values,
                                   const std::vector<RigidFace> &rigid)
  {
    const std::size_t n = space.relevant().n_elements();
    DirichletData     data;
    data.fixed.assign(n, {});
    data.value.assign(n, Vector3());
    data.condition.assign(n, {{-1, -1, -1}});
    const NodeConditions conditions(space, loads);
    for (const auto &[i, latest] : conditions.plain())
      {
        FixedMask mask = 0;
        for (unsigned int c = 0; c < dim; ++c)
          if (latest[c] >= 0)
            mask = static_cast<FixedMask>(mask | 1u << c);
        data.condition[i] = latest;
        data.fixed[i]     = mask;
      }
    data.held = conditions.held();
    for (const auto &[i, node] : data.held)
      {
        std::vector<Vector3> directions;
        for (const HeldNode::Hold &hold : node.holds)
          directions.push_back(hold.direction);
        data.fixed[i] = FixedDirections::span(directions);
      }
    if (Utilities::MPI::n_mpi_processes(space.communicator()) > 1)
      import_conditions(data, space);
    if (with_values || (!loads.rigid_faces.empty() && rigid.empty()))
      set_values(data, space, loads);
    if (!loads.rigid_faces.empty())
      add_rigid_faces(data, space, loads, rigid.empty() ? find_rigid_faces(space, loads, data) : rigid);
    return data;
  }
} // namespace Signorini
