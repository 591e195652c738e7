// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Two surfaces without finite elements: reads them, builds the contact mapping, prints for each triangle of
// the first one how much of it the second one covers, and writes the overlay as an image file for ParaView.
//
//   surface_overlay NONMORTAR MORTAR IMAGE.vtu

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/output/field_output.h>
#include <signorini/surface/contact_mapping.h>

#include <fstream>
#include <iostream>

using namespace Signorini;

int
main(int argc, char **argv)
{
  if (argc != 4)
    {
      std::cerr << "usage: surface_overlay NONMORTAR MORTAR IMAGE.vtu\n";
      return 1;
    }
  try
    {
      // Vertices, triangles and vertex normals. Normals point out of the bodies: towards each other.
      const SurfaceMesh nonmortar = read_surface(argv[1]), mortar = read_surface(argv[2]);

      // Phi, from the nonmortar to the mortar surface.
      const ContactMapping mapping(nonmortar, mortar);

      // Each cell of the overlay lies in one triangle of either surface and knows the barycentric coordinates
      // of its corners in both; share() is its part of the nonmortar triangle.
      std::vector<double> covered(nonmortar.triangles.size(), 0.);
      for (const OverlayTriangle &cell : mapping.overlay())
        covered[cell.nonmortar_triangle] += cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle);
      for (unsigned int t = 0; t < covered.size(); ++t)
        if (covered[t] > 0.)
          std::cout << "triangle " << t << ": " << covered[t] << " of " << triangle_area(nonmortar, t)
                    << '\n';

      // Phi at a single point: the middle of the first covered triangle.
      for (unsigned int t = 0; t < covered.size(); ++t)
        if (const SurfacePoint image = mapping.image(t, {{1. / 3., 1. / 3., 1. / 3.}});
            image.on != SurfacePoint::On::nothing)
          {
            const auto weights = image.weights_in(mapping.mortar_topology(), image.index);
            std::cout << "the middle of triangle " << t << " is mapped to "
                      << evaluate(mortar, image.index, weights) << '\n';
            break;
          }

      std::ofstream out(argv[3]);
      write_overlay(out, nonmortar, mortar, mapping.overlay());
    }
  catch (const InputError &e)
    {
      std::cerr << e.what() << '\n';
      return 1;
    }
  return 0;
}
