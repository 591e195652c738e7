// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_bodies_h
#define signorini_mesh_bodies_h

#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/generated_mesh.h>
#include <signorini/mesh/node_movement.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>
#include <signorini/surface/surface_mesh.h>

#include <deal.II/base/parameter_handler.h>
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
  class NodalSpace;

  /// Shape, place and material of a body, as a user writes them.
  struct BodyParameters
  {
    /// As the parameters of the same names say (add_parameters()): lengths in the unit of the problem,
    /// Young's modulus as force per area, angles in degrees.
    std::string name;
    std::string mesh   = "block";
    double      radius = 1., inner_radius = .5, height = 1.;
    std::string lower_corner = "0, 0, 0", upper_corner = "1, 1, 1", divisions = "1, 1, 1";
    std::string translation = "0, 0, 0", rotation_axis = "0, 0, 1";
    double      rotation_angle = 0.;
    double      young = 1., poisson = .3;
    std::string shapes, sharp_edges;
    bool        snap                 = false;
    bool        convert_to_hexahedra = false, convert_to_tetrahedra = false;
    std::string element = "automatic";
    std::string volumes, volume_materials;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Isotropic linear elastic material of a part of a body.
  struct Material
  {
    /// Number of the body.
    unsigned int body;
    /// Young's modulus (force per area) and Poisson's ratio.
    double young, poisson;
    /// Whether hexahedra have the mean change of volume of the cell everywhere in it (B-bar).
    bool mean_dilatation = false;
    /// The part of the body (Bodies::part()).
    unsigned int part = 0;
  };

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
    /// Collective. Mesh file names are relative to base_folder.
    /// Errors: InputError naming the parameter for unknown or senseless values and bad mesh files.
    Bodies(const MPI_Comm communicator, const std::vector<BodyParameters> &parameters,
           const std::string &base_folder);

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

    /// The material of a body where its volumes have none of their own.
    const Material &material_of_body(const unsigned int body) const
    {
      return *std::find_if(materials.begin(), materials.end(),
                           [body](const Material &m) { return m.body == body; });
    }

    /// The body that cells with an id belong to.
    unsigned int body_of_material(const dealii::types::material_id id) const
    {
      return materials[id].body;
    }

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

    /// Boundary ids of a named boundary. Errors: InputError listing the names the body has, for the parameter
    /// `where`.
    std::set<dealii::types::boundary_id> boundary_ids(const unsigned int body, const std::string &name,
                                                      const std::string &where = "") const;

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
    /// Reads a body, takes it into the lists of bodies, boundaries, materials and parts, and puts it in its
    /// place.
    Placed place(const BodyParameters &parameters, const std::string &base_folder);
    /// One for the body, and one for each volume with its own.
    void add_materials(Placed &placed, const BodyParameters &parameters);

    void choose_elements(const BodyParameters &parameters, const Placed &placed);
    void read_shapes(const BodyParameters &parameters, Placed &placed, const std::string &base_folder);
    /// Connected parts, and the materials of cells, which are those of their volumes for the first part.
    void find_parts(Placed &placed, const unsigned int body);
    /// Refuses shapes of the parameters that lie elsewhere than their boundaries, notes those that are off.
    void check_shapes(const Placed &placed, const std::string &where, const bool snaps);
    void snap_vertices(Placed &placed);
    /// Moves vertices on the given boundaries to their shapes; returns those that are not there yet.
    std::vector<unsigned int>
         move_to_shapes(std::vector<dealii::Point<3>>                                      &positions,
                        const std::map<unsigned int, std::set<dealii::types::boundary_id>> &ids,
                        const std::vector<dealii::ArrayView<const unsigned int>>           &cells,
                        const std::vector<bool>                                            &is_fixed);
    void follow_shapes();
    void assess_hexahedra();
    void set_manifolds();
    bool is_sharp(const std::set<dealii::types::boundary_id> &ids) const;
    /// The shapes that a point on the given boundaries has to lie on; none on sharp edges.
    std::vector<BoundaryShapePointer> shapes_of(const std::set<dealii::types::boundary_id> &ids) const;
    void                              create(const std::vector<Placed> &placed);
    void                              create_hexahedra(const std::vector<Placed> &placed);
    void                              create_tetrahedra(const std::vector<Placed> &placed);

    /// The boundary of a start mesh, in its place.
    struct StartSurface
    {
      SurfaceMesh mesh;
      /// Boundary id of each triangle.
      std::vector<dealii::types::boundary_id> boundary;
    };

    static StartSurface  start_surface(const Placed &placed);
    BoundaryShapePointer plane_shape(const unsigned int body, const dealii::types::boundary_id id) const;

    const MPI_Comm                                                   comm;
    std::unique_ptr<dealii::parallel::distributed::Triangulation<3>> tria;
    std::unique_ptr<TetrahedralForest>                               forest;
    std::vector<std::string>                                         names;
    std::vector<Material>                                            materials;
    std::vector<BodyPart>                                            parts;
    std::vector<std::vector<std::string>>                            boundaries;
    std::vector<dealii::types::boundary_id>                          first_boundary;
    std::vector<std::string>                                         remarks;
    /// By boundary id; null where a boundary has no shape of its own.
    std::vector<BoundaryShapePointer> shapes;
    std::vector<StartSurface>         start_surfaces;
    /// By boundary id: whether the shape is not that of a generated mesh.
    std::vector<bool> is_user_shape;
    /// Pairs of boundary ids whose common edges stay as they are, the smaller id first.
    std::set<std::pair<dealii::types::boundary_id, dealii::types::boundary_id>> sharp;
    /// Vertices of the forest that are not yet where their shapes want them.
    std::map<unsigned int, std::set<dealii::types::boundary_id>> late_vertices;
    MovementReport                                               last_movement;
    dealii::types::manifold_id                                   next_manifold = 1;
  };
} // namespace Signorini

#endif
