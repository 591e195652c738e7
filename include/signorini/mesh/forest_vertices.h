// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_forest_vertices_h
#define signorini_mesh_forest_vertices_h

#include <signorini/mesh/forest_mesh.h>
#include <signorini/mesh/node_movement.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <vector>

namespace Signorini
{
  /// The vertices of a distributed mesh of tetrahedra, for what moves them: owners decide.
  class ForestVertices : public SharedVertices
  {
  public:
    /// Collective. The mesh must outlive the object.
    ForestVertices(const ForestMesh &mesh, const MPI_Comm communicator);

    bool owns(const unsigned int vertex) const override
    {
      return mesh.owns_vertex(rank, vertex);
    }

    void   update(std::vector<double> &values) const override;
    double minimum(const double value) const override;
    double sum(const double value) const override;

    /// The surroundings of the first vertices of all ranks, as many as are tried at all, come together on one
    /// rank.
    void try_again(std::vector<unsigned int> &late, const std::vector<dealii::Point<3>> &targets,
                   std::vector<dealii::Point<3>>                            &positions,
                   const std::vector<dealii::ArrayView<const unsigned int>> &cells,
                   const std::vector<bool> &is_free, std::vector<double> &reference) const override;

  private:
    using Name = ForestMesh::Name;

    std::vector<Name> chosen_vertices(const std::vector<unsigned int> &late) const;
    std::vector<bool> near(const std::vector<Name> &chosen) const;

    const ForestMesh  &mesh;
    const MPI_Comm     comm;
    const unsigned int rank;
    /// Vertices by the rank that they are sent to, and by the rank that they come from.
    std::map<unsigned int, std::vector<unsigned int>> sent, received;
  };
} // namespace Signorini

#endif
