#pragma once
#include <string>
#include <vector>

#include "abut/run/scene.hpp"
#include "apps/support/choices.hpp"

namespace abut::apps {

/// Offset of the centres of slipping_cylinders over the mean radius [-].
inline constexpr double slipping_offset = 0.8;

/// Two discs in plane strain (2D) or cylinders with axes along z (3D) that fly towards each other along x.
struct CylinderOptions {
    int dim = 2;
    BodyValues radius{1.0, 1.0};  ///< [m]
    BodyValues length{1.0, 1.0};  ///< along z, 3D only [m]
    BodyValues young{1.0, 1.0};   ///< [Pa]
    BodyValues poisson{0.3, 0.3};
    BodyValues density{1.0, 1.0};                     ///< [kg/m^3]
    BodyValues speed{0.05, 0.05};                     ///< towards the other [m/s]
    BodyValues size{run::not_given, run::not_given};  ///< edge length of the cells [m]; not given: R/10 in 2D, R/12 in 3D
    double refine = 1.0;                              ///< how many times smaller cells are where the bodies meet first
    double refine_over = 0.5;         ///< over which part of the radius cells grow to their own size from there
    BodyValues eta{0.0, 0.0};         ///< stabilisation of jumps [Pa]; 0: Young's modulus
    double offset = run::not_given;   ///< of the centres along y [m]
    double gap = 0.02;                ///< between the surfaces at the start [m]
    std::vector<std::string> meshes;  ///< files of the two bodies, instead of radius, length, size, offset and gap
    mesh::NonPlanarFaces non_planar = mesh::NonPlanarFaces::fail;  ///< in those files
};

/// Fills in what was not given: size, eta, and the offset as `offset_over_radius` times the mean radius.
void fill_defaults(CylinderOptions& options, double offset_over_radius);

/// Throws MeshError for a file that cannot be used.
template <int Dim>
[[nodiscard]] run::Scene<Dim> two_cylinders(const CylinderOptions& options);

/// Main function of slipping_cylinders. Returns the exit code.
int run_slipping_cylinders(int argc, char** argv);

}  // namespace abut::apps
