// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_imported_field_h
#define signorini_source_application_imported_field_h

#include <signorini/algebra/replicated_data.h>

#include <algorithm>
#include <vector>

namespace Signorini
{
  /// The values of a nodal field at some nodes.
  class ImportedField
  {
  public:
    /// Collective. Every rank has nodes of its own, in any order.
    ImportedField(const NodePartition &partition, const Vector &field, std::vector<NodeIndex> some_nodes)
      : nodes(std::move(some_nodes))
    {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      values = import_values(partition, field, nodes);
    }

    const Vector3 &operator()(const NodeIndex node) const
    {
      return values[std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()];
    }

  private:
    std::vector<NodeIndex> nodes;
    std::vector<Vector3>   values;
  };
} // namespace Signorini

#endif
