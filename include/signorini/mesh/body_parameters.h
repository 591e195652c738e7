// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_body_parameters_h
#define signorini_mesh_body_parameters_h

#include <signorini/mesh/body_definition.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// Shape, place and material of a body as the subsection of a parameter file has them: the front end of
  /// BodyDefinition.
  struct BodyParameters
  {
    /// As the parameters of the same names say (add_parameters()): lengths in the unit of the problem,
    /// Young's modulus as force per area.
    std::string name;
    /// A kind of generated mesh, or a file.
    std::string               mesh   = "block";
    double                    radius = 1., inner_radius = .5, height = 1.;
    dealii::Point<3>          lower_corner, upper_corner = dealii::Point<3>(1., 1., 1.);
    std::vector<unsigned int> divisions = {1, 1, 1}, round_divisions = {0, 0, 0};
    std::string               corners, grading;
    dealii::Tensor<1, 3>      translation, rotation_axis = dealii::Tensor<1, 3>({0., 0., 1.});
    /// Degrees.
    double                   rotation_angle = 0.;
    double                   young = 1., poisson = .3;
    std::string              shapes, sharp_edges;
    bool                     snap                 = false;
    bool                     convert_to_hexahedra = false, convert_to_tetrahedra = false;
    ElementChoice            element = ElementChoice::automatic;
    std::vector<std::string> volumes;
    std::string              volume_materials;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Collective. Reads the mesh or generates it. File names are relative to base_folder. Errors: InputError
    /// naming the parameter for unknown or senseless values and bad mesh files.
    BodyDefinition definition(const MPI_Comm communicator, const std::string &base_folder) const;
  };

  /// Collective. BodyParameters::definition() of all.
  std::vector<BodyDefinition> define_bodies(const MPI_Comm                     communicator,
                                            const std::vector<BodyParameters> &parameters,
                                            const std::string                 &base_folder);
} // namespace Signorini

#endif
