// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_contact_indicator_h
#define signorini_mortar_contact_indicator_h

#include <signorini/discretization/error_indicator.h>
#include <signorini/mortar/face_moments.h>
#include <signorini/mortar/surface_values.h>

#include <map>
#include <vector>

namespace Signorini
{
  /// The faces of a contact surface and the boundary faces of the space they are.
  class ContactFaces
  {
  public:
    /// Space and surface must outlive the object.
    /// @param ids the boundaries that the surface was extracted from
    ContactFaces(const NodalSpace &space, const ContactSurface &surface,
                 const std::set<dealii::types::boundary_id> &ids);

    /// Adds a traction of a face of the surface, corners in the order of the surface, if this rank owns it.
    void add(std::map<unsigned int, FaceTraction> &tractions, const unsigned int face,
             const FaceTraction &traction) const;

    /// The cell of a face of the surface, or -1 if this rank does not own it.
    int cell(const unsigned int face) const
    {
      return boundary_face[face] < 0 ? -1
                                     : static_cast<int>(space.boundary_faces()[boundary_face[face]].cell);
    }

  private:
    const NodalSpace     &space;
    const ContactSurface &surface;
    std::vector<int>      boundary_face;
  };

  /// Tractions -lambda n on the faces of the nonmortar surface, zero outside of the covered part.
  /// @param stress contact stress lambda n (force per area); at corners without a multiplier as the
  /// neighbours give it
  std::vector<FaceTraction> nonmortar_tractions(const ContactSurface           &nonmortar,
                                                const std::vector<FaceMoments> &moments,
                                                const CornerValues             &stress);

  /// Collective. The tractions lambda n dA_non / dA_mor that the mapping brings to the faces of the mortar
  /// surface: known on the ranks that own the cells of these faces.
  /// @param overlay of this rank's own nonmortar faces
  std::vector<FaceTraction> mortar_tractions(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                             const std::vector<OverlayTriangle> &overlay,
                                             const CornerValues &stress, const MPI_Comm communicator);

  /// For each face of the nonmortar surface (those of this rank's overlay): the penetration
  /// mu / h_F |(n.(u - u_mor o Phi) - g)_+|^2 and the failure of complementarity |int lambda (g - n.[u])|
  /// (energy). Gaps are geometric, or prescribed.
  std::vector<double> contact_violation(const FacingSurfaces &pair, const CornerValues &stress,
                                        const std::vector<Vector3> &displacement_nonmortar,
                                        const std::vector<Vector3> &displacement_mortar,
                                        const GapFunction &prescribed_gap, const double shear_modulus);

  /// The jump of a tied pair, mu / h_F |u - u_mor o Phi|^2, face by face.
  std::vector<double> tie_violation(const FacingSurfaces       &pair,
                                    const std::vector<Vector3> &displacement_nonmortar,
                                    const std::vector<Vector3> &displacement_mortar,
                                    const double                shear_modulus);

  /// contact_violation() for a rigid partner, given by the images of points (see compute_face_moments()).
  /// @param faces those of this rank to look at
  std::vector<double> contact_violation(const ContactSurface &nonmortar, const ImageFunction &image,
                                        const CornerValues &stress, const std::vector<Vector3> &displacement,
                                        const double shear_modulus, const std::vector<bool> &faces);
} // namespace Signorini

#endif
