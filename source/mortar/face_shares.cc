// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/face_shares.h>
#include <signorini/surface/box_tree.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Point<3> centre_of(const ContactSurface &surface, const ContactSurface::Face &face)
    {
      Point<3> centre;
      for (unsigned int a = 0; a < face.n_corners; ++a)
        centre += Tensor<1, 3>(surface.mesh.vertices[face.corners[a]]) / face.n_corners;
      return centre;
    }

    BoxTree::Box box_around(const std::vector<Point<3>> &points)
    {
      BoxTree::Box box{points.at(0), points[0]};
      for (const Point<3> &x : points)
        box.include(x);
      return box;
    }

    /// Whether a point lies beside a box, as seen from another one: at most as far off along each axis as
    /// the boxes are apart. Moves it to the border of the box then.
    bool move_beside(Point<3> &x, const BoxTree::Box &box, const BoxTree::Box &other)
    {
      bool result = true;
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double gap = std::max({0., other.low[c] - box.high[c], box.low[c] - other.high[c]}) +
                             1e-6 * (box.high[c] - box.low[c]);
          result = result && x[c] >= box.low[c] - gap && x[c] <= box.high[c] + gap;
          x[c]   = std::min(std::max(x[c], box.low[c]), box.high[c]);
        }
      return result;
    }

    struct WorkRule
    {
      /// Of a triangle that has no partner, to that of one that is mapped and integrated over.
      double alone = .1;
    };

    std::vector<double> triangles_of_faces(const ContactSurface &surface)
    {
      std::vector<double> n(surface.faces.size(), 0.);
      for (const unsigned int face : surface.triangle_face)
        n[face] += 1.;
      return n;
    }
  } // namespace



  void share_faces(ContactSurface &nonmortar, const ContactSurface &mortar, const unsigned int n_ranks)
  {
    if (n_ranks == 1 || nonmortar.faces.empty())
      {
        for (ContactSurface::Face &face : nonmortar.faces)
          face.worker = 0;
        return;
      }
    std::vector<double>       weights = triangles_of_faces(nonmortar);
    const std::vector<double> other   = triangles_of_faces(mortar);
    std::vector<Point<3>>     centres;
    for (const ContactSurface::Face &face : nonmortar.faces)
      centres.push_back(centre_of(nonmortar, face));
    if (!mortar.faces.empty())
      {
        const BoxTree::Box box      = box_around(nonmortar.mesh.vertices),
                           opposite = box_around(mortar.mesh.vertices);
        for (std::size_t f = 0; f < nonmortar.faces.size(); ++f)
          if (Point<3> centre = centres[f]; !move_beside(centre, opposite, box))
            weights[f] *= WorkRule().alone;
        for (std::size_t f = 0; f < mortar.faces.size(); ++f)
          if (Point<3> centre = centre_of(mortar, mortar.faces[f]); move_beside(centre, box, opposite))
            {
              centres.push_back(centre);
              weights.push_back(other[f]);
            }
      }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.);
    double       place = 0.;
    for (const unsigned int i : spatial_order(centres))
      {
        if (i < nonmortar.faces.size())
          nonmortar.faces[i].worker =
              std::min(n_ranks - 1, static_cast<unsigned int>((place + .5 * weights[i]) / total * n_ranks));
        place += weights[i];
      }
  }
} // namespace Signorini
