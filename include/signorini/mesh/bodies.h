// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// One class, and longer than a header should be: bodies, parts, materials, boundaries and sets of nodes get
// their numbers in one go, with the meshes that have them. To be split: names and numbers from meshes and
// shapes.

#ifndef signorini_mesh_bodies_h
#define signorini_mesh_bodies_h

#include <signorini/mesh/body_definition.h>
#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/material.h>
#include <signorini/mesh/node_movement.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>
#include <signorini/surface/surface_mesh.h>

#include <deal.II/distributed/tria.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  struct MeshView;
  struct StartNodes;
  class NodalSpace;

  /// A connected part of a body: most bodies have one.
  struct BodyPart
  {
    /// Number of the body.
    unsigned int body;
    /// Of its box, on the start mesh.
    dealii::Point<3> centre;
    /// The boundaries on which it has faces.
    std::set<dealii::types::boundary_id> boundaries;
  };

  /// All bodies: those of hexahedra in one distributed triangulation (one p4est forest), those of tetrahedra
  /// in one TetrahedralForest. Bodies never share vertices, also where they touch. Boundary ids and material
  /// ids are unique over all bodies.
  class Bodies
  {
  public:
    /// Collective. Errors: InputError naming body and parameter for unknown or senseless values and meshes
    /// that cannot be used.
    Bodies(const MPI_Comm communicator, const std::vector<BodyDefinition> &definitions);

    /// The ranks among which the meshes are distributed.
    MPI_Comm communicator() const
    {
      return comm;
    }

    /// The current mesh.
    MeshView mesh() const;

    /// The hexahedra; only if there are any.
    dealii::parallel::distributed::Triangulation<3> &triangulation()
    {
      AssertThrow(tria, dealii::ExcMessage("There are no hexahedra."));
      return *tria;
    }

    /// The same, to look at.
    const dealii::parallel::distributed::Triangulation<3> &triangulation() const
    {
      AssertThrow(tria, dealii::ExcMessage("There are no hexahedra."));
      return *tria;
    }

    /// The tetrahedra, or null.
    const TetrahedralForest *tetrahedra() const
    {
      return forest.get();
    }

    /// Collective. Refines marked cells of the space of the current mesh (marks of ghost cells do not count),
    /// and others as the two kinds of meshes need it. False if nothing is marked on any rank.
    bool refine(const NodalSpace &space, const std::vector<bool> &marked);

    /// Number of bodies.
    unsigned int n_bodies() const
    {
      return static_cast<unsigned int>(names.size());
    }

    /// The name that the user gave to a body.
    const std::string &body_name(const unsigned int body) const
    {
      return names[body];
    }

    /// Errors: InputError listing the bodies; `where` names the parameter.
    unsigned int body_index(const std::string &name, const std::string &where) const;

    /// The material of cells with an id.
    const Material &material(const dealii::types::material_id id) const
    {
      return materials[id];
    }

    /// Young's modulus of the stiffest material of all cells.
    double largest_modulus() const
    {
      return stiffest;
    }

    /// The body that cells with an id belong to.
    unsigned int body_of_material(const dealii::types::material_id id) const
    {
      return materials[id].body;
    }

    /// Number of materials: their ids are 0 ... n_materials() - 1.
    unsigned int n_materials() const
    {
      return static_cast<unsigned int>(materials.size());
    }

    /// Ids of the materials of the cells of a body, or of one of the volumes that its mesh names. Errors:
    /// InputError listing the volumes, for the parameter `where`.
    std::set<dealii::types::material_id> material_ids(const unsigned int body, const std::string &volume = "",
                                                      const std::string &where = "") const;

    /// What to do where the mesh of a body may be that of several, as a sentence after a space; else empty.
    std::string hint_at_volumes(const unsigned int body) const;

    /// Connected parts, those of the first body first. Cells of different parts have different materials.
    unsigned int n_parts() const
    {
      return static_cast<unsigned int>(parts.size());
    }

    /// The i-th connected part.
    const BodyPart &part(const unsigned int i) const
    {
      return parts[i];
    }

    /// The part that cells with an id belong to.
    unsigned int part_of_material(const dealii::types::material_id id) const
    {
      return materials[id].part;
    }

    /// "body NAME", and where the part is if the body has several.
    std::string part_name(const unsigned int part) const;

    /// "body NAME, boundary NAME".
    std::string boundary_name(const dealii::types::boundary_id id) const;

    /// Names of the boundaries of a body.
    const std::vector<std::string> &boundary_names(const unsigned int body) const
    {
      return boundaries[body];
    }

    /// The id of the i-th boundary of a body.
    dealii::types::boundary_id boundary_id(const unsigned int body, const unsigned int i) const
    {
      return first_boundary[body] + i;
    }

    /// Boundary ids of a named boundary, or of several of them, "one + another". Errors: InputError listing
    /// the names the body has, for the parameter `where`.
    std::set<dealii::types::boundary_id> boundary_ids(const unsigned int body, const std::string &name,
                                                      const std::string &where = "") const;

    /// Whether a body has a boundary (or a group of boundaries) with a name.
    bool has_boundary(const unsigned int body, const std::string &name) const;

    /// The number (NodalSpace::node_sets()) of a named set of nodes of a body; StartNodes::none if it has
    /// none.
    unsigned int node_set(const unsigned int body, const std::string &name) const;

    /// The number (NodalSpace::start_vertices()) of a vertex of the start mesh of a body.
    unsigned int start_vertex(const unsigned int body, const unsigned int vertex) const
    {
      return first_vertex[body] + vertex;
    }

    /// Whether the mesh of a body is from a file, which has numbers of nodes.
    bool has_node_numbers() const
    {
      return !node_numbers.empty();
    }

    /// The number in its file of a vertex of the start meshes (NodalSpace::start_vertices(), which may be
    /// StartNodes::none), or VolumeMesh::no_number.
    long node_number(const unsigned int start_vertex) const
    {
      return start_vertex < node_numbers.size() ? node_numbers[start_vertex] : VolumeMesh::no_number;
    }

    /// The true shapes of boundaries: those that a user gave or that belong to a generated mesh; for the
    /// others what the start mesh shows (SmoothShape), or null where that is flat.
    /// @param everywhere whether the start mesh stands for a smooth surface whatever it looks like
    std::map<dealii::types::boundary_id, BoundaryShapePointer>
    true_shapes(const unsigned int body, const std::set<dealii::types::boundary_id> &ids,
                const bool everywhere) const;

    /// Makes new nodes of boundaries without a shape follow what the start mesh shows, and those of plane
    /// boundaries beside them stay in their planes. To be called before the first refinement.
    void follow_start_mesh(const unsigned int body, const std::set<dealii::types::boundary_id> &ids,
                           const bool everywhere);

    /// What the last refinement (or the start, where vertices are snapped) did to the cells at boundaries
    /// with shapes.
    const MovementReport &movement() const
    {
      return last_movement;
    }

    /// Remarks from reading the meshes.
    const std::vector<std::string> &notes() const
    {
      return remarks;
    }

  private:
    struct Placed;
    /// Takes a body into the lists of bodies, boundaries, materials and parts, and puts it in its place.
    Placed add_body(const BodyDefinition &definition);
    void   add_materials(const BodyDefinition &definition, Placed &placed);
    void   add_node_sets(const VolumeMesh &mesh);
    void   choose_elements(const BodyDefinition &definition, const Placed &placed);
    void   add_shapes(const BodyDefinition &definition, Placed &placed);
    /// Connected parts, and the materials of cells, which are those of their volumes for the first part.
    void find_parts(Placed &placed, const unsigned int body);
    /// Refuses shapes of the parameters that lie elsewhere than their boundaries, notes those that are off.
    void check_shapes(const Placed &placed, const std::string &where, const bool snaps);
    void snap_vertices(Placed &placed);
    /// A boundary and the piece of its shape (BoundaryShape::piece_at()).
    using BoundaryPlace = std::pair<dealii::types::boundary_id, unsigned int>;
    /// That of a face with its centre and its outward normal (any length).
    BoundaryPlace place(const dealii::types::boundary_id id, const dealii::Point<3> &centre,
                        const dealii::Tensor<1, 3> &outward) const;
    /// Moves vertices in the given places to their shapes; returns those that are not there yet.
    std::vector<unsigned int> move_to_shapes(std::vector<dealii::Point<3>>                         &positions,
                                             const std::map<unsigned int, std::set<BoundaryPlace>> &places,
                                             const std::vector<dealii::ArrayView<const unsigned int>> &cells,
                                             const std::vector<bool> &is_fixed,
                                             const SharedVertices    &shared = SharedVertices());
    /// The distances of late vertices of a movement from their shapes.
    void report_late(MovementReport &report, const std::map<dealii::types::boundary_id, double> &distances,
                     const std::map<dealii::types::boundary_id, double> &numbers,
                     const SharedVertices                               &shared) const;
    void follow_shapes();
    void assess_hexahedra();
    void set_manifolds();
    bool is_sharp(const std::set<dealii::types::boundary_id> &ids) const;
    /// As boundary_ids(), without "+".
    std::set<dealii::types::boundary_id> ids_of_one_boundary(const unsigned int body, const std::string &name,
                                                             const std::string &where) const;
    /// The shapes that a point in the given places has to lie on; none on sharp edges.
    std::vector<BoundaryShapePointer> shapes_of(const std::set<BoundaryPlace> &places) const;
    void                              create(const std::vector<Placed> &placed);
    void                              create_hexahedra(const std::vector<Placed> &placed);
    void                              create_tetrahedra(const std::vector<Placed> &placed);
    void                              set_given_manifolds(const std::vector<Placed> &placed);

    /// The boundary of a start mesh, in its place.
    struct StartSurface
    {
      SurfaceMesh mesh;
      /// Boundary id of each triangle.
      std::vector<dealii::types::boundary_id> boundary;
    };

    static StartSurface start_surface(const Placed &placed);

    const MPI_Comm                                                   comm;
    std::unique_ptr<dealii::parallel::distributed::Triangulation<3>> tria;
    std::unique_ptr<TetrahedralForest>                               forest;
    std::vector<std::string>                                         names;
    std::vector<Material>                                            materials;
    std::vector<BodyPart>                                            parts;
    std::vector<std::vector<std::string>>                            boundaries;
    /// By body: names of its volumes.
    std::vector<std::vector<std::string>>   volumes;
    std::vector<dealii::types::boundary_id> first_boundary;
    /// By body: groups of boundaries by name, as numbers of its boundaries.
    std::vector<std::vector<std::pair<std::string, std::vector<unsigned int>>>> groups;
    /// By body: number of its first vertex among those of all, and numbers of its sets of nodes.
    std::vector<unsigned int>                                      first_vertex;
    std::vector<std::vector<std::pair<std::string, unsigned int>>> node_sets;
    std::shared_ptr<StartNodes>                                    start;
    unsigned int                                                   n_vertices_of_all = 0;
    /// By vertex of the start meshes; may be shorter, or empty.
    std::vector<long>        node_numbers;
    std::vector<std::string> remarks;
    /// By boundary id; null where a boundary has no shape of its own.
    std::vector<BoundaryShapePointer> shapes;
    std::vector<StartSurface>         start_surfaces;
    /// By boundary id: whether it is the shape that places new vertices of hexahedra.
    std::vector<bool> is_user_shape;
    /// Boundaries with manifolds of their own.
    std::set<dealii::types::boundary_id> has_manifold;
    /// Pairs of boundary ids whose common edges stay as they are, the smaller id first.
    std::set<std::pair<dealii::types::boundary_id, dealii::types::boundary_id>> sharp;
    MovementReport                                                              last_movement;
    dealii::types::manifold_id                                                  next_manifold = 1;
    double                                                                      stiffest      = 0.;
  };
} // namespace Signorini

#endif
