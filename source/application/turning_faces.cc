// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/turning_faces.h>
#include <signorini/discretization/face_conditions.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct TurningRule
    {
      /// Sine of the angle up to which two normals are one, and part of a motion that is no rotation:
      /// rounding of meshes with five digits.
      double same = 1e-3;
    };

    /// A normal of a plane, whichever of the two is given.
    std::string text_of_normal(const Vector3 &normal)
    {
      const double *const largest =
          std::max_element(&normal[0], &normal[0] + dim,
                           [](const double a, const double b) { return std::abs(a) < std::abs(b); });
      std::ostringstream text;
      text << std::setprecision(4);
      for (unsigned int c = 0; c < dim; ++c)
        text << (c == 0 ? "(" : ", ")
             << (std::abs(normal[c]) > TurningRule().same ? normal[c] / (*largest < 0. ? -1. : 1.) : 0.);
      return text.str() + ")";
    }

    /// A rigid face that ends at a plane.
    struct Ending
    {
      unsigned int face;
      Vector3      normal;
    };

    /// Collective. Those with an edge in a boundary face that is held along its normal and nowhere else.
    std::vector<Ending> find_endings(const NodalSpace &space, const Loads &loads, const RigidFaces &rigid)
    {
      std::vector<Ending> mine;
      const auto          add = [](std::vector<Ending> &list, const Ending &ending) {
        if (std::none_of(list.begin(), list.end(), [&](const Ending &other) {
              return other.face == ending.face &&
                     cross_product_3d(other.normal, ending.normal).norm() <= TurningRule().same;
            }))
          list.push_back(ending);
      };
      for (const NodalSpace::BoundaryFace &boundary : space.boundary_faces())
        if (const NodalSpace::Cell &cell = space.cells()[boundary.cell]; cell.is_owned)
          {
            std::map<unsigned int, unsigned int> n_common;
            for (const unsigned int v : CellShape::face(cell.n_vertices, boundary.face))
              if (const RigidFaces::Dependence *const node = rigid.find(space.nodes(cell)[v]))
                ++n_common[node->face];
            if (n_common.empty())
              continue;
            const FaceConditions conditions(space, loads, boundary,
                                            ElementFace(Element(space, cell), boundary.face));
            if (conditions.held.basis().size() == 1 && conditions.held.contains(conditions.normal))
              for (const auto &[face, n] : n_common)
                if (n >= 2)
                  add(mine, {face, conditions.normal});
          }
      std::vector<Ending> result;
      for (const Ending &ending : gather_lists(std::move(mine), space.communicator(), Receivers::all))
        add(result, ending);
      // In an order that no rank changes.
      std::sort(result.begin(), result.end(), [](const Ending &one, const Ending &other) {
        return text_of_normal(one.normal) < text_of_normal(other.normal);
      });
      return result;
    }

    /// What to add to the condition of a face.
    std::string advice(const Vector3 &normal)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (std::abs(std::abs(normal[c]) - 1.) <= TurningRule().same)
          return c == 0   ? "\"rotation (*, 0, 0)\""
                 : c == 1 ? "\"rotation (0, *, 0)\""
                          : "\"rotation (0, 0, *)\"";
      return "a rotation of zero about the other axes";
    }
  } // namespace



  void note_turning_faces(const ContactModel &model, const ConstrainedSpace &space, Journal &journal)
  {
    if (space.dirichlet.rigid == nullptr)
      return;
    std::map<unsigned int, std::vector<Vector3>> planes;
    for (const Ending &ending : find_endings(space.nodal(), model.loads(), *space.dirichlet.rigid))
      planes[ending.face].push_back(ending.normal);
    for (const auto &planes_of_face : planes)
      {
        const std::vector<Vector3> &of_face = planes_of_face.second;
        const RigidFace            &face    = space.dirichlet.rigid->faces()[planes_of_face.first];
        const bool turns = std::any_of(face.free.begin(), face.free.end(), [&](const RigidMotion &m) {
          return of_face.size() > 1 ? m.rotation.norm() > TurningRule().same
                                    : cross_product_3d(m.rotation, of_face[0]).norm() > TurningRule().same;
        });
        // Guided along a curved boundary.
        if (!turns || of_face.size() > dim)
          continue;
        std::string text;
        for (const Vector3 &normal : of_face)
          text += (text.empty() ? "" : " and ") + text_of_normal(normal);
        journal.note("the rigid boundary " + model.loads().rigid_faces[face.index].boundary + " of body " +
                     model.bodies().body_name(face.body) + " ends at a plane across " + text +
                     ", in which the body slides, and may turn about its edge there. If that is a plane of "
                     "symmetry, the whole would not: add " +
                     (of_face.size() > 1 ? "\"rotation (0, 0, 0)\"" : advice(of_face[0])) +
                     " to Rigid (in a deck: hold these rotations of its reference node).");
      }
  }
} // namespace Signorini
