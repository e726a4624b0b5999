#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/run/options.hpp"
#include "abut/run/values/energy_scale.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/run/values/outputs.hpp"
#include "abut/run/values/value.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

template <int Dim>
struct RunResult;

/// A scene to run: bodies, their materials, loads and obstacles, and their motion at the start.
template <int Dim>
struct Scene {
    std::string title{};    ///< heads a report; empty: the name of the program does
    std::string comment{};  ///< in words, for the report
    mesh::Mesh<Dim> mesh{};
    solid::SolidOptions<Dim> solid{};      ///< all except the choices of RunOptions: contact and the rule of free faces
    std::vector<Vector<Dim>> velocity{};   ///< at the start, one per body [m/s]
    std::vector<AxialVector<Dim>> spin{};  ///< at the start about the centroid, one per body [rad/s]; empty: none
    /// Added to that of the body at the start [m/s]; empty: none
    std::function<Vector<Dim>(const Vector<Dim>& position)> added_velocity{};
    std::function<Vector<Dim>(const Vector<Dim>& position)> displacement{};  ///< at the start [m]; empty: none
    bool contact = true;                  ///< false: bodies pass through each other, at no cost
    double time = 0.0;                    ///< end of the run where no option says it [s]
    EnergyScale energy_scale{};           ///< what the figures of a run are quoted on
    Outputs<Dim> outputs{};               ///< what ResultFiles leaves of it beside the energies
    std::string remedy_if_overlapping{};  ///< ends the message if bodies overlap at the start
    NamedValues options{};                ///< the scene's own, as they were used; for the summary
    std::function<void(const solid::Solid<Dim>&, double dt)> after_step{};  ///< looks on; may be empty
    /// Cells of the solid that leave after a step, beside those beyond SolidOptions::erosion; may be empty
    std::function<std::vector<std::int32_t>(const dynamics::RunView<Dim>&, solid::Solid<Dim>&)> leaving{};
    std::function<std::vector<Finding>(const RunResult<Dim>&)> findings{};  ///< at the end; may be empty
};

/// Options of the solid of a scene. Throws BadInput for BodyKinematics::automatic, which choose_kinematics resolves.
template <int Dim>
[[nodiscard]] solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options);
/// Whether some bodies or obstacles of a run rub.
template <int Dim>
[[nodiscard]] bool has_friction(const Scene<Dim>& scene, const RunOptions& options);
/// Whether limits or a function may let cells leave.
template <int Dim>
[[nodiscard]] bool may_lose_cells(const Scene<Dim>& scene);
/// Features of a run beside those of its solid, whose options these are.
template <int Dim>
[[nodiscard]] solid::FeatureSet features_of(const Scene<Dim>& scene, const RunOptions& options,
                                            const solid::SolidOptions<Dim>& solid, const dynamics::Ranks& ranks);
/// Throws BadInput for features of scene, options and ranks that do not go together (solid/combinations). Kinematics that a
/// pilot run chooses are not known yet.
template <int Dim>
void check_features(const Scene<Dim>& scene, const RunOptions& options, const dynamics::Ranks& ranks);
/// With `restart` filled in, by friction and the kinematics that the bodies are run with; with friction the filter, too.
template <int Dim>
[[nodiscard]] RunOptions with_restart(RunOptions options, const Scene<Dim>& scene);
/// Displacements of the points of the scene's solid, on several ranks of those of this one, (n_points, Dim) [m].
template <int Dim>
[[nodiscard]] std::vector<double> displacement_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid);
/// Kinematics of a body of a run.
template <int Dim>
[[nodiscard]] solid::Kinematics kinematics_of(const Scene<Dim>& scene, const RunResult<Dim>& result, std::size_t body);
/// Momenta of the points of the scene's solid, (n_points, Dim) [kg m/s]. Throws BadInput for another number of velocities or
/// spins than bodies.
template <int Dim>
[[nodiscard]] std::vector<double> momentum_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid);

}  // namespace abut::run
