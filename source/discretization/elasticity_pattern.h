// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_discretization_elasticity_pattern_h
#define signorini_source_discretization_elasticity_pattern_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/discretization/vertex_expansion.h>

namespace Signorini
{
  /// Couples all nodes of an owned cell, after expansion, with each other.
  NodePattern make_pattern(const NodalSpace &space, const VertexExpansion &expansion);
} // namespace Signorini

#endif
