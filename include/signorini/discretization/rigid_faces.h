// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_rigid_faces_h
#define signorini_discretization_rigid_faces_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/mesh/nodal_space.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  struct DirichletData;
  struct Loads;

  /// A rigid motion t + w x (x - centre) / length.
  struct RigidMotion
  {
    /// Both lengths.
    Vector3 translation, rotation;

    /// The scalar product of the six numbers.
    double operator*(const RigidMotion &other) const
    {
      return translation * other.translation + rotation * other.rotation;
    }
  };

  /// How a boundary that stays rigid may move; the same on all levels and ranks. With the coefficients z of
  /// the free motions: u(x) = lift(x) + sum of z_j free[j](x).
  struct RigidFace
  {
    /// Index into Loads::rigid_faces; number of the body.
    unsigned int index, body;
    /// The point that rotations are about, and the half diagonal of the boundary (length).
    dealii::Point<3> centre;
    double           length;
    /// Orthonormal; six at most. What the conditions of the face prescribe is in the lift.
    std::vector<RigidMotion> free;
    RigidMotion              lift;
    /// What acts on it; the moment about the centre (force, force times length).
    Vector3 force, moment;

    /// Their work on a motion, over the size of the motion (force).
    double load_on(const RigidMotion &motion) const
    {
      return motion.translation * force + motion.rotation * moment / length;
    }

    /// The displacement of a motion at a point.
    Vector3 displacement(const RigidMotion &motion, const dealii::Point<3> &x) const
    {
      return motion.translation + cross_product_3d(motion.rotation, (x - centre) / length);
    }
  };

  /// The rigid faces on the nodes of one level. The coefficients z of a face are the unknowns of two nodes,
  /// its carriers, three of each; the other nodes of the face have none. On a mesh the carriers are nodes of
  /// the face, under a mesh nodes without a place.
  class RigidFaces
  {
  public:
    /// The unknowns of a node of a face: u = sum over the two carriers of block * z.
    struct Dependence
    {
      /// Index of the face.
      unsigned int face;
      /// Where it is (length).
      dealii::Point<3> position;
      /// Of the first and the second carrier.
      std::array<Block, 2> blocks;
    };

    /// None.
    RigidFaces() = default;

    /// Collective. On a mesh: finds the nodes of the faces and chooses the carriers.
    RigidFaces(std::vector<RigidFace> faces, const NodalSpace &space, const Loads &loads);

    /// Under a mesh: no nodes but the carriers, two for each face.
    RigidFaces(std::vector<RigidFace> faces, std::vector<NodeIndex> carriers);

    /// In the order of Loads::rigid_faces.
    const std::vector<RigidFace> &faces() const
    {
      return the_faces;
    }

    /// Whether there are none.
    bool empty() const
    {
      return the_faces.empty();
    }

    /// Carrier k (0 or 1) of a face.
    NodeIndex carrier(const unsigned int face, const unsigned int k) const
    {
      return carrier_nodes[2 * face + k];
    }

    /// Those of all faces.
    const std::vector<NodeIndex> &carriers() const
    {
      return carrier_nodes;
    }

    /// The number of a carrier in carriers(), or -1.
    int find_carrier(const NodeIndex node) const;

    /// What a node depends on; null for nodes of no face. All ranks know all nodes of the faces.
    const Dependence *find(const NodeIndex node) const;

    /// Nodes of the faces, ascending.
    const std::map<NodeIndex, Dependence> &nodes() const
    {
      return dependences;
    }

    /// Those components of a carrier that are no free motion.
    FixedDirections fixed_of_carrier(const int number) const;

    /// Sets the unknowns of the carriers that this rank owns to a rigid motion of the body.
    /// @param translation_at the translation of a point of the face
    /// @param rotation of the face (1)
    template <typename Motion>
    void set_motion(Vector &v, const NodePartition &partition, const unsigned int face,
                    const Motion &translation_at, const Vector3 &rotation) const;

    /// Adds the given numbers, one per free motion, to the unknowns of the carriers that this rank owns.
    void add(Vector &v, const NodePartition &partition, const unsigned int face,
             const std::vector<double> &numbers) const;

  private:
    std::vector<RigidFace>          the_faces;
    std::vector<NodeIndex>          carrier_nodes;
    std::map<NodeIndex, Dependence> dependences;
  };



  /// Collective. How the faces may move: what the other conditions prescribe at their nodes holds them too.
  /// Errors: InputError for conditions that contradict each other.
  /// @param data the conditions without the faces
  std::vector<RigidFace> find_rigid_faces(const NodalSpace &space, const Loads &loads,
                                          const DirichletData &data);

  /// Collective. Takes the rigid faces into the conditions: their nodes have no unknowns of their own.
  void add_rigid_faces(DirichletData &data, const NodalSpace &space, const Loads &loads,
                       const std::vector<RigidFace> &faces);



  template <typename Motion>
  void RigidFaces::set_motion(Vector &v, const NodePartition &partition, const unsigned int face,
                              const Motion &translation_at, const Vector3 &rotation) const
  {
    const RigidFace    &f = the_faces[face];
    const RigidMotion   motion{translation_at(f.centre), f.length * rotation};
    std::vector<double> numbers;
    for (unsigned int k = 0; k < 2; ++k)
      if (partition.owns(carrier(face, k)))
        for (unsigned int c = 0; c < dim; ++c)
          v.local_element(dim * partition.to_local(carrier(face, k)) + c) = 0.;
    for (const RigidMotion &one : f.free)
      numbers.push_back(one * motion);
    add(v, partition, face, numbers);
  }
} // namespace Signorini

#endif
