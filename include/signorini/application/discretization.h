// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_discretization_h
#define signorini_application_discretization_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/application/constrained_space.h>
#include <signorini/discretization/basis_transformation.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/pair_conflicts.h>
#include <signorini/mortar/pair_coupling.h>
#include <signorini/surface/contact_mapping.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  class Journal;

  /// One side of a pair on a mesh. The partner of a surface is empty where that is an obstacle.
  struct ContactSide
  {
    /// Number of the body.
    unsigned int body = dealii::numbers::invalid_unsigned_int;
    /// "body: boundary"; the numbers of that boundary on the mesh.
    std::string                          name;
    std::set<dealii::types::boundary_id> ids;
    /// Its triangles and faces: the whole surface until the pair is mapped and coupled, then the piece of
    /// this rank (keep_piece()).
    ContactSurface surface;
    /// Until the pair is mapped, where parts of the surface are left out: the mesh that it had before.
    std::shared_ptr<const SurfaceMesh> whole;
    /// The boundary of the body as far as it was given.
    const SurfaceMesh &boundary() const
    {
      return whole ? *whole : surface.mesh;
    }
    /// Of the cells behind the surface, the mean over its area.
    IsotropicMaterial material;
  };

  /// One contact pair on a mesh.
  struct ContactPair
  {
    /// As in the definition.
    std::string name;
    /// Whether its surfaces are glued together.
    bool is_tied = false;
    /// The side that carries the multipliers, and its partner.
    ContactSide nonmortar, mortar;
    /// How many faces of the nonmortar side, on all ranks, were left out because their images lie behind its
    /// body.
    std::size_t n_images_behind = 0;
    /// In place of the mortar side.
    std::optional<RigidObstacle> obstacle;
    /// Null with an obstacle.
    std::shared_ptr<const ContactMapping> mapping;
    /// Seconds it took.
    double mapping_time = 0.;
    /// A nonmortar triangle, or torn edge, where it has errors.
    struct WrongPlace
    {
      /// The same on all ranks.
      std::size_t number;
      /// Vertices of the nonmortar surface, as far as they are known here.
      std::vector<unsigned int> vertices;
      /// Of the triangle; of an edge half its square.
      double area;
    };
    /// Those of all ranks of which a vertex is known here.
    std::vector<WrongPlace> wrong_places;
    /// A mortar edge whose image could not be followed.
    struct LostEdge
    {
      /// Where it is, and how long (lengths).
      dealii::Point<3> middle;
      double           length;
    };
    /// Those of all ranks.
    std::vector<LostEdge> lost_edges;
    /// How the ranks share the nonmortar side.
    std::shared_ptr<const SurfaceHalo> halo;
    /// Integrals over own and ghost faces of the nonmortar side, sorted by face.
    std::vector<FaceMoments> moments;
    /// Gap (length) at points of the nonmortar surface; empty for that of the geometry.
    GapFunction prescribed_gap;
  };

  /// What has been decided about a pair on one mesh, for the next ones.
  struct PairChoice
  {
    /// Whether the second side, in the order of the definition, is the nonmortar one.
    bool is_second = false;
    /// Whether that is not the automatic choice, because less of the contact is lost this way round, or the
    /// mapping has no errors.
    bool is_turned = false;
    /// Pairs whose mortar bodies part from that of this one; each two are in one of them (parting_bodies.h).
    std::vector<PartingPair> partings;
  };

  /// The discrete contact problem on one mesh. Constant.
  struct Discretization
  {
    /// Collective. Joins the couplings of the pairs. Errors: those of join_couplings().
    Discretization(std::shared_ptr<const ConstrainedSpace> constrained, std::vector<ContactPair> pairs,
                   std::vector<PairCoupling> couplings, std::vector<PairChoice> choices);
    /// Collective. The same surfaces and couplings on the same space with other values of its conditions.
    Discretization(const Discretization &other, std::shared_ptr<const ConstrainedSpace> constrained);
    Discretization(const Discretization &) = delete;

    /// The space of the displacements.
    const NodalSpace &nodal() const
    {
      return *constrained->space;
    }

    /// The layout of displacements.
    const NodePartition &partition() const
    {
      return constrained->partition;
    }

    /// Rigid motions that only contact holds.
    const std::vector<FreeMotion> &free_motions() const
    {
      return constrained->free_parts.motions;
    }

    /// Those of the space, but with a lift that has no jump at tied nodes.
    const DirichletData &dirichlet() const
    {
      return lifted ? *lifted : constrained->dirichlet;
    }

    /// Whether there are tied nodes, on any rank.
    bool has_ties() const
    {
      return has_tied_rows;
    }

    /// Whether this rank owns the node of a row.
    bool owns_row(const std::size_t row) const
    {
      return partition().owns(coupling.rows[row]);
    }

    /// T = I + A times this: the joined coupling S, and the links of chains of pairs.
    const InterfaceCoupling &expansion() const
    {
      return chained ? *chained : coupling;
    }

    /// Errors: InputError for nodes of the mortar sides that belong to rigid faces.
    void refuse_rigid_mortar_nodes() const;

    /// Space and conditions.
    std::shared_ptr<const ConstrainedSpace> constrained;
    /// By pair: its surfaces, its own coupling.
    std::vector<ContactPair>  pairs;
    std::vector<PairCoupling> couplings;
    /// By pair. The next mesh begins with it: what is finer there does not count any more.
    std::vector<PairChoice> choices;

    /// Of all pairs, joined: rows by contact node, sorted, of the nodes that are relevant to this rank.
    InterfaceCoupling coupling;
    /// JoinedCouplings::chained of these rows.
    std::optional<InterfaceCoupling> chained;
    /// Number of contact nodes of all ranks.
    std::size_t n_contact_nodes = 0;
    /// See has_ties().
    bool has_tied_rows = false;
    /// Per row of the joined coupling: A_p with the normal, gap, whether the pair is tied (û_p = 0) instead
    /// of in contact.
    std::vector<RowProjection> projections;
    std::vector<double>        gaps;
    std::vector<unsigned char> tied;
    /// Null without ties; see dirichlet().
    std::unique_ptr<const DirichletData>       lifted;
    std::unique_ptr<const BasisTransformation> transformation;
  };

  /// Collective. Maps and couples all pairs of a model on its mesh.
  /// @param choices Discretization::choices of the mesh before; empty on the first one
  /// @param cycle number of the mesh, for notes; on the first one initial overlaps are noted
  /// Errors: InputError for pairs that cannot do what they are there for (contact_checks.h).
  std::unique_ptr<const Discretization> discretize(const ContactModel                     &model,
                                                   std::shared_ptr<const ConstrainedSpace> constrained,
                                                   const std::vector<PairChoice>          &choices,
                                                   const unsigned int cycle, Journal &journal);
} // namespace Signorini

#endif
