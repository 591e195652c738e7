// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "multiplier_nodes.h"

#include <signorini/algebra/sent_lists.h>
#include <signorini/mortar/face_claims.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Mean distance of the surfaces over the covered part of a face (length).
    double distance(const FaceMoments &m)
    {
      Vector3 gap;
      for (const Vector3 &part : m.gap)
        gap += part;
      return gap.norm() / m.covered;
    }

    /// That a pair covers a face.
    struct Claim
    {
      FaceName     face;
      unsigned int pair;
      bool         may_lose;
      double       distance;

      bool operator<(const Claim &other) const
      {
        return std::tie(face, distance, pair) < std::tie(other.face, other.distance, other.pair);
      }
    };

    /// Whether a claim is another pair's, among those of all ranks.
    bool is_lost(const std::vector<Claim> &claims, const Claim &claim)
    {
      if (!claim.may_lose)
        return false;
      const auto first = std::lower_bound(claims.begin(), claims.end(), claim.face,
                                          [](const Claim &a, const FaceName &face) { return a.face < face; });
      return first->pair != claim.pair;
    }

    void lose(FaceMoments &m)
    {
      FaceMoments left;
      left.face = m.face;
      left.full = m.full;
      left.area = m.area;
      m         = std::move(left);
    }
  } // namespace



  FaceName name_of(const ContactSurface &surface, const unsigned int face)
  {
    FaceName name;
    for (unsigned int a = 0; a < 4; ++a)
      name[a] = surface.vertex_node[surface.faces[face].corners[a]];
    std::sort(name.begin(), name.end());
    return name;
  }



  bool is_far(const FaceMoments &moments)
  {
    return distance(moments) > std::sqrt(moments.area);
  }



  // Faces meet on some rank, whichever it is.
  std::size_t leave_faces_to_nearest(const std::vector<ClaimedFaces> &pairs, const MPI_Comm communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    ListsByRank<Claim> sent;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (const FaceMoments &m : pairs[p].moments)
        if (!is_empty(m))
          {
            const FaceName name = name_of(pairs[p].nonmortar, m.face);
            sent[static_cast<unsigned int>(name[0] % n_ranks)].push_back(
                {name, p, !pairs[p].is_tied && is_far(m), pairs[p].is_tied ? 0. : distance(m)});
          }
    const auto         arrived = send_lists(sent, communicator);
    std::vector<Claim> claims;
    for (const auto &[sender, list] : arrived)
      claims.insert(claims.end(), list.begin(), list.end());
    std::sort(claims.begin(), claims.end());
    // By rank and pair, sorted.
    ListsByRank<Claim> answers;
    for (const auto &[sender, list] : arrived)
      for (const Claim &claim : list)
        if (is_lost(claims, claim))
          answers[sender].push_back(claim);
    std::vector<std::set<FaceName>> lost(pairs.size());
    for (const auto &[sender, list] : send_lists(answers, communicator))
      for (const Claim &claim : list)
        lost[claim.pair].insert(claim.face);
    std::size_t        n_lost = 0;
    const unsigned int rank   = Utilities::MPI::this_mpi_process(communicator);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const bool keeps_any =
            std::any_of(pairs[p].moments.begin(), pairs[p].moments.end(), [&](const FaceMoments &m) {
              return !is_empty(m) && lost[p].count(name_of(pairs[p].nonmortar, m.face)) == 0;
            });
        if (Utilities::MPI::max(static_cast<int>(keeps_any), communicator) == 0)
          continue;
        for (FaceMoments &m : pairs[p].moments)
          if (lost[p].count(name_of(pairs[p].nonmortar, m.face)) > 0)
            {
              n_lost += pairs[p].nonmortar.faces[m.face].worker == rank;
              lose(m);
            }
      }
    return Utilities::MPI::sum(n_lost, communicator);
  }
} // namespace Signorini
