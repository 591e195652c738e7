// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_turning_faces_h
#define signorini_application_turning_faces_h

#include <signorini/application/constrained_space.h>
#include <signorini/application/journal.h>

namespace Signorini
{
  /// Collective. Notes rigid faces that end at a plane in which their body slides, and may turn about their
  /// edge there: of half a model the whole would not.
  void note_turning_faces(const ContactModel &model, const ConstrainedSpace &space, Journal &journal);
} // namespace Signorini

#endif
