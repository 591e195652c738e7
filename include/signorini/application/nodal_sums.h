// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_nodal_sums_h
#define signorini_application_nodal_sums_h

#include <signorini/application/discretization.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  /// Collective. Of the vectors of all ranks.
  inline Vector3 sum(const Vector3 &v, const MPI_Comm communicator)
  {
    Vector3 result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = dealii::Utilities::MPI::sum(v[c], communicator);
    return result;
  }

  /// The value of a field at a local node.
  inline Vector3 nodal_value(const Vector &field, const unsigned int i)
  {
    return Vector3(
        {field.local_element(dim * i), field.local_element(dim * i + 1), field.local_element(dim * i + 2)});
  }

  /// Nodal values in the order of NodalSpace::relevant(), three each.
  inline std::vector<double> relevant_values(const Discretization &d, const Vector &field)
  {
    std::vector<double> values;
    values.reserve(dim * d.nodal().relevant().n_elements());
    for (const NodeIndex node : d.nodal().relevant())
      for (unsigned int c = 0; c < dim; ++c)
        values.push_back(field.local_element(dim * d.partition().to_local(node) + c));
    return values;
  }

  /// The body of each owned node; invalid_unsigned_int for nodes without cells.
  inline std::vector<unsigned int> bodies_of_nodes(const Discretization &d, const Bodies &bodies)
  {
    std::vector<unsigned int> body(d.partition().n_owned(), dealii::numbers::invalid_unsigned_int);
    for (const NodalSpace::Cell &cell : d.nodal().cells())
      for (const NodeIndex node : d.nodal().nodes(cell))
        if (d.partition().owns(node))
          body[d.partition().to_local(node)] = bodies.body_of_material(cell.material);
    return body;
  }
} // namespace Signorini

#endif
