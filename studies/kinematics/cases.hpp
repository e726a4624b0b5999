#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/run/scene.hpp"

namespace abut::studies::kinematics {

using solid::Kinematics;

/// "small"
[[nodiscard]] std::string name_of(Kinematics kinematics);

/// Of a body at the start: v + spin × (X - centre of mass).
template <int Dim>
struct Motion {
    Vector<Dim> velocity = Vector<Dim>::Zero();        ///< [m/s]
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();  ///< [rad/s]
};

/// Bodies in motion.
template <int Dim>
struct Case {
    std::string name;
    run::Scene<Dim> scene{};  ///< less the motion at its start
    run::RunOptions run{.cfl = 0.8};
    std::vector<Motion<Dim>> motion{};  ///< one per body
    double noise = 0.0;                 ///< velocity of each component of each cell, at random to both sides [m/s]
    bool is_free = true;                ///< nothing holds the bodies: momentum and, where they turn, J~ have to stay
};

/// Bodies of E = rho = 1 and nu = 0.3 that move alike.
template <int Dim>
[[nodiscard]] Case<Dim> case_of(const std::string& name, const std::vector<mesh::Mesh<Dim>>& meshes, Kinematics kinematics);
/// g along the last axis, downwards, on all bodies; they are not free any more.
template <int Dim>
void let_fall(Case<Dim>& one, double gravity);

/// What is asked of a run, over the scales that their names give.
struct Figures {
    std::int64_t steps = 0;
    double dt = 0.0;              ///< [s]
    double largest_energy = 0.0;  ///< of H, kinetic energy and |V| [J]
    double drift = 0.0;           ///< max |H~ - H~0 - work| over it
    double excess = 0.0;          ///< max (H - H~) over it, of all steps
    double parasitic = 0.0;       ///< max |e|/m [m/s]
    double momentum = 0.0;        ///< drift over sum |p| at the start
    double pseudo_angular = 0.0;  ///< of J~, over sum |x × p| at the start
    std::int64_t events = 0;
    std::int64_t missed_contacts = 0;  ///< must stay 0
    std::int64_t pair_steps = 0;       ///< of the pair potential alone
    double compression = 0.0;          ///< largest |g|/D
    double correction = 0.0;           ///< sum of corrections over sum of forces; a filter looks at contact again: not known
    double correction_max = 0.0;       ///< the largest of a step
    bool is_complete = false;
    std::string ending;  ///< why it is not
    double seconds = 0.0;
    double seconds_of_steps = 0.0;  ///< without set-up, energies and files
};

template <int Dim>
struct CaseResult {
    Figures figures;
    std::vector<Vector<Dim>> velocity;  ///< of each body at the end [m/s]
};

/// What a run is asked at its start and after each step.
template <int Dim>
using Watch = std::function<void(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid)>;

/// Runs it under MEMM; an exception of the library ends it, and its message says why. Leaves the files of run::ResultFiles
/// in `folder`; an empty one: none.
template <int Dim>
[[nodiscard]] CaseResult<Dim> run_case(const Case<Dim>& one, const std::filesystem::path& folder,
                                       const Watch<Dim>& watch = {});

}  // namespace abut::studies::kinematics
