#pragma once
#include <array>
#include <string>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/statics.hpp"

/// Two elastic bodies pressed onto each other at rest: a cylinder (disc, plane strain) or a sphere onto a block, onto its
/// equal, or onto a rigid plane. The contact point is the origin; the weight of the upper body presses along the last axis.
namespace abut::studies {

/// Support under the round body.
enum class HertzSupport { block, equal, rigid_plane };

struct HertzOptions {
    HertzSupport support = HertzSupport::block;
    double radius = 8.0;                    ///< of each round body [m]
    double load = 10.0;                     ///< P [N/m] in 2D, F [N] in 3D
    std::array<double, 2> young{200, 200};  ///< of the upper and the lower body [Pa]
    std::array<double, 2> poisson{0.3, 0.3};
    double faces = 5.0;    ///< a over the size of a face of the upper body in the contact [-]
    double ratio = 0.8;    ///< size of the lower body's faces over that of the upper ones [-]
    double coarse = 0.15;  ///< cells far from the contact over the radius [-]
    contact::ContactOptions contact;
    solid::FreeFaceRule free_faces = solid::FreeFaceRule::local_equilibrium;
    solid::CornerRule corners = solid::CornerRule::relaxed;
    solid::StaticOptions statics{.tolerance = 1e-7};
};

/// The solution of Hertz for the contact of these bodies, small against their radii.
struct HertzSolution {
    double contact_radius;  ///< a, half the width in 2D [m]
    double peak_pressure;   ///< p0 [Pa]

    /// At a distance from the middle [Pa].
    [[nodiscard]] double pressure(double distance) const;
    /// Mean over distances from `begin` to `end`, of a strip in 2D [Pa].
    [[nodiscard]] double mean_pressure(double begin, double end) const;
};
template <int Dim>
[[nodiscard]] HertzSolution hertz_solution(const HertzOptions& options);

/// Contact radii around the contact point with cells of one size.
inline constexpr double hertz_uniform = 1.4;
/// A disc or sphere whose centre is at this height [m], with cells of `size` [m] at the contact point.
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> round_body(const HertzOptions& options, double height, double size, int variant,
                                         const std::string& name);

/// Pressure and traction that a boundary face of the upper body carries.
template <int Dim>
struct HertzFace {
    Vector<Dim> position;  ///< of its centroid [m]
    double measure;
    double pressure;  ///< from the pair forces [Pa]
    double traction;  ///< -n . sigma n of its cell [Pa]
    double exact;     ///< mean of the exact pressure over the face [Pa]
};

template <int Dim>
struct HertzResult {
    HertzSolution exact;
    std::vector<HertzFace<Dim>> faces;  ///< of the upper body, within 1.5 contact radii
    double load = 0.0;                  ///< that the contact carries: P in 2D, F in 3D
    double peak_pressure = 0.0;         ///< largest of all faces [Pa]
    double pressure_error = 0.0;        ///< of the pressure, relative in L2 [-]
    double traction_error = 0.0;        ///< of the traction of the boundary cells, relative in L2 [-]
    double contact_radius = 0.0;        ///< of a disc (strip) of the area under pressure [m]
    double face_size = 0.0;             ///< mean size of the faces in the contact [m]
    std::int32_t n_cells = 0;
    solid::StaticReport report;
    double seconds = 0.0;  ///< of the static solver
};

/// Throws what `solve_statics` and the meshes throw, and std::runtime_error if the forces do not come into balance.
template <int Dim>
[[nodiscard]] HertzResult<Dim> solve_hertz(const HertzOptions& options);

}  // namespace abut::studies
