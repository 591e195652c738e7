// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_gmsh_session_h
#define signorini_mesh_gmsh_session_h

#include <signorini/mesh/gmsh_file.h>

#include <gmsh.h>

namespace Signorini
{
  /// gmsh's library is global: a mesh is open in it for as long as this lives. gmsh throws anything.
  struct GmshSession
  {
    explicit GmshSession(const GmshAlias &file)
    {
      // Without the options that a user keeps for gmsh: they may change what is read.
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::open(file.path());
    }

    ~GmshSession()
    {
      try
        {
          gmsh::finalize();
        }
      catch (...)
        {
        }
    }

    GmshSession(const GmshSession &) = delete;
  };
} // namespace Signorini

#endif
