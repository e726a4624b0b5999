#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "studies/nodal/p1_bodies.hpp"

namespace abut::studies::nodal {

/// Of a body at the start: v + spin × (X - centre).
template <int Dim>
struct RigidMotion {
    Vector<Dim> velocity = Vector<Dim>::Zero();        ///< [m/s]
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();  ///< [rad/s]
    Vector<Dim> centre = Vector<Dim>::Zero();          ///< [m]

    [[nodiscard]] Vector<Dim> at(const Vector<Dim>& x) const;
};

/// Bodies in motion.
template <int Dim>
struct Impact {
    std::string name;
    P1Scene<Dim> scene;
    std::vector<RigidMotion<Dim>> motion;  ///< of each body
    double time;                           ///< [s]
    bool is_free = true;                   ///< nothing holds the bodies: momenta have to stay
};

enum class Scheme { memm, leapfrog };

struct ImpactOptions {
    Scheme scheme = Scheme::memm;
    bool filter = false;         ///< the neutral one
    int restart = 0;             ///< steps from one neutral restart to the next; 0: none
    double cfl = 1.0;            ///< dt over the advised step
    std::int64_t steps = 0;      ///< at most so many; 0: until the end of the scene
    int records = 1500;          ///< of energies, equally far apart
    int frames = 0;              ///< for ParaView
    std::filesystem::path out;   ///< folder of the files of this run; empty: none
    double excess_limit = 10.0;  ///< the run is over where H - H~ exceeds this part of the largest energy
};

/// What is asked of a run, over the scales that their names give.
struct ImpactFigures {
    std::int64_t steps = 0;
    double dt = 0.0;
    double largest_energy = 0.0;       ///< of H, kinetic energy and |V| [J]
    double drift = 0.0;                ///< max |H~ - H~0 - work| over the largest energy
    double energy_drift = 0.0;         ///< max |H - H0 - work| over it
    double excess = 0.0;               ///< max (H - H~) over it, of all steps
    double parasitic = 0.0;            ///< max |e|/m [m/s]
    double momentum = 0.0;             ///< drift over sum m |v| at the start
    double angular = 0.0;              ///< drift of sum x × p over sum |x × p| at the start
    double pseudo_angular = 0.0;       ///< that of J~, over the same
    double rest_angular = 0.0;         ///< that of sum X × p about positions at rest, over the same
    double compression = 0.0;          ///< largest |g|/D
    double correction = 0.0;           ///< sum of corrections over sum of forces
    std::int64_t missed_contacts = 0;  ///< must stay 0
    std::int64_t events = 0;
    std::int64_t pair_steps = 0;
    bool is_complete = false;
    std::string ending;        ///< why it is not
    std::string unseen_edges;  ///< of bodies that may go through each other; empty: none
    double seconds = 0.0;
    double seconds_of_steps = 0.0;  ///< without set-up, energies and files

    [[nodiscard]] bool held() const { return is_complete && excess < 1.0; }
};

template <int Dim>
struct ImpactResult {
    ImpactFigures figures;
    std::vector<Vector<Dim>> velocity;  ///< mean of each body at the end [m/s]
    std::vector<double> q;              ///< at the end
};

/// What a run is asked at some of its steps.
template <int Dim>
using Watch = std::function<void(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies)>;

/// Runs it; an exception of the library ends it, and its message says why. Leaves energy.csv, its picture and the series for
/// ParaView in a folder, if one is given.
template <int Dim>
[[nodiscard]] ImpactResult<Dim> run_impact(const Impact<Dim>& impact, const ImpactOptions& options,
                                           const Watch<Dim>& watch = {});

}  // namespace abut::studies::nodal
