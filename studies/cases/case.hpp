#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "abut/run/scene.hpp"
#include "studies/table/figures.hpp"

/// Bodies in motion, for whichever host runs them: the solid of this library (`run_case`) or one of linear finite elements
/// with contact on its nodes (studies/nodal/run_case.hpp).
namespace abut::studies {

using solid::Kinematics;

/// Velocity of a body at the start: v + spin × (X - centre).
template <int Dim>
struct Motion {
    Vector<Dim> velocity = Vector<Dim>::Zero();        ///< [m/s]
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();  ///< [rad/s]
    std::optional<Vector<Dim>> centre = {};            ///< [m]; by default the centroid of its mesh

    [[nodiscard]] Vector<Dim> at(const Vector<Dim>& x) const;  ///< `centre` is given
};

/// Holds the mean position of some nodes by a spring: an axle about which a body turns as it likes, or a soft suspension.
template <int Dim>
struct Pin {
    std::vector<std::int32_t> nodes;
    double stiffness;  ///< [N/m]
};

/// Parts that the host of linear finite elements knows alone.
template <int Dim>
struct NodalParts {
    std::vector<Pin<Dim>> pins = {};
    /// Faces whose depths make the k of their body, by their centroids; empty: all. To be given where cells are graded: the
    /// mean over large faces that never touch makes a skin too soft
    std::function<bool(const Vector<Dim>&)> touches = {};
};

template <int Dim>
struct Case {
    std::string name;
    run::Scene<Dim> scene{};  ///< less the motion at its start
    run::RunOptions run{.cfl = 0.8};
    std::vector<Motion<Dim>> motion{};  ///< one per body
    double noise = 0.0;                 ///< velocity of each component of each cell, at random to both sides [m/s]
    bool is_free = true;                ///< nothing holds the bodies: momentum and, where they turn, J~ have to stay
    NodalParts<Dim> on_nodes{};
};

/// Bodies of E = rho = 1 and nu = 0.3 that move alike.
template <int Dim>
[[nodiscard]] Case<Dim> case_of(const std::string& name, const std::vector<mesh::Mesh<Dim>>& meshes, Kinematics kinematics);
/// g along the last axis, downwards, on all bodies; they are not free any more.
template <int Dim>
void let_fall(Case<Dim>& one, double gravity);
/// The motion of each body, with its centre.
template <int Dim>
[[nodiscard]] std::vector<Motion<Dim>> motion_of(const Case<Dim>& one);

template <int Dim>
struct CaseResult {
    Figures figures;
    std::vector<Vector<Dim>> velocity;  ///< of each body at the end [m/s]
};

/// Looks on at the start and after each step.
template <int Dim, class Host>
using WatchOf = std::function<void(const dynamics::RunView<Dim>& run, Host& host)>;
template <int Dim>
using Watch = WatchOf<Dim, solid::Solid<Dim>>;

/// Runs it under MEMM; an exception of the library ends it, and its message says why. Leaves the files of run::ResultFiles
/// in `folder`; an empty one: none. Corrections are not known under a filter, which looks at contact again.
template <int Dim>
[[nodiscard]] CaseResult<Dim> run_case(const Case<Dim>& one, const std::filesystem::path& folder,
                                       const Watch<Dim>& watch = {});

}  // namespace abut::studies
