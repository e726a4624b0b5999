#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "abut/contact/friction.hpp"
#include "abut/contact/options.hpp"
#include "abut/dynamics/scheme.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/ccg/step_device.hpp"
#include "abut/solid/combinations/features.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/operator/precision.hpp"

namespace abut::run {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
inline constexpr int restart_not_given = std::numeric_limits<int>::min();

/// A solid with contact runs under those of integrator_words (run/option_table.hpp); `simulate` refuses others.
/// docs/integrators.md says which to choose.
using SolidIntegrator = dynamics::Scheme;

/// How bodies may move (solid::Kinematics): one choice for all of them, that of the scene, or `automatic`: for each body the
/// cheapest one that a pilot run allows (run/steps/pilot.hpp).
enum class BodyKinematics { scene, automatic, small, floating, finite, rigid };

/// Files of frames for ParaView: a .vtu and a .vtp file for each, or one .h5 file for all with XDMF beside it.
enum class FrameFormat : std::uint8_t { vtu, xdmf };

/// How a scene is run. Where a message of an error or a warning names an option, it does so in the words of the programs'
/// command lines: --contact-margin is `contact_margin`.
struct RunOptions {
    double time = not_given;      ///< end of the run [s]; not given: as many steps as `steps`, or the scene's own time
    int steps = 0;                ///< of the run where no time is given; 0: not given
    bool settle = false;          ///< bodies are brought to rest under the loads of t = 0 first (run/steps/settling.hpp)
    double cfl = 0.9;             ///< time step over the stable step [-]
    double dt = not_given;        ///< time step [s], instead of `cfl`
    bool allow_unstable = false;  ///< takes `dt` even above the stable step
    BodyKinematics kinematics = BodyKinematics::scene;
    solid::MeanForce mean_force = solid::MeanForce::automatic;  ///< inside bodies of Kinematics::finite
    solid::ContactLaw law = solid::ContactLaw::automatic;
    contact::ContactOptions contact;
    contact::Friction friction;   ///< between all bodies and obstacles for which the scene has no law
    geometry::FacingFade facing;  ///< of the pair potential: how pairs fade out as faces turn away from each other
    bool gauss = false;           ///< of the pair potential: Gauss's rule for the force of every pair over a step
    solid::FreeFaceRule free_faces = solid::FreeFaceRule::local_equilibrium;
    solid::CornerRule corners = solid::CornerRule::relaxed;
    SolidIntegrator integrator = SolidIntegrator::memm;
    solid::Precision precision = solid::Precision::double_precision;  ///< of the bulk in steps
    solid::StepDevice device = solid::StepDevice::host;  ///< of the bulk in steps; the results do not depend on it
    int levels = 0;                                      ///< of memm_async, at most; 0: 8
    int contact_margin = 1;    ///< of memm_async: levels that cells in contact are finer than they need to be alone
    int contact_levels = 0;    ///< of memm_async: levels that cells in contact are finer than all others
    double gauge = not_given;  ///< c of the Bilbao scheme [J]; not given: the energy at the start
    bool filter = false;       ///< energy-neutral filter of the parasitic mode, near the contact
    /// Steps between neutral restarts, which clear that mode everywhere; 0: none. Not given, with memm: 10, and the
    /// filter whatever `filter` is, where there is friction, which is lost without; whoever gives `restart` chooses
    /// both; 50 where a body is finite, whose forces feed the mode; else none
    int restart = restart_not_given;
    int threads = 0;    ///< at most; 0: all. The results do not depend on it
    int ranks = 0;      ///< that the programs start; 0: none but those of mpirun. The results do not depend on it
    int rebalance = 0;  ///< steps from one look at what cells cost each rank to the next; 0: parts stay as they are
    double rebalance_above = 1.05;  ///< cells are shared out again where the costliest rank costs so many times the mean
    std::filesystem::path out;      ///< folder of ResultFiles; a simulation alone writes nothing
    int interval = 0;               ///< steps between ledger records; 0: see records_interval
    int frames = 21;                ///< of the series of ResultFiles, the first and the last included; 0: none
    /// Times of frames, in place of `frames`, increasing, from 0 to the end of the run [s]; empty: none. Inside a step
    /// bodies are on the straight path of that step; the steps of the run are bitwise those without.
    std::vector<double> times{};
    FrameFormat format = FrameFormat::vtu;
    int animation = 0;                  ///< frames of animation.html of ResultFiles, first and last included; 0: none
    bool pieces = false;                ///< each rank writes its own cells of these frames
    bool keep_last_checkpoint = false;  ///< of a run that comes to its end, too: another one may go on from there
    bool other_end = false;             ///< a run that goes on may end at another time than the one it goes on from
    double checkpoint = 10.0;  ///< minutes from one checkpoint of ResultFiles to the next; 0: none, not even at a signal
    int checkpoint_steps = 0;  ///< the same in steps, beside it; 0: by minutes alone
    bool resume = false;       ///< goes on from the last checkpoint in `out`
};

using dynamics::name_of;  ///< "memm"
/// "floating"
[[nodiscard]] std::string name_of(solid::Kinematics kinematics);
/// Features that these alone tell of a run: its scheme, the start and its files.
[[nodiscard]] solid::FeatureSet features_of(const RunOptions& options);
/// Kinematics of all bodies; nothing where the scene or a pilot run decides.
[[nodiscard]] std::optional<solid::Kinematics> kinematics_of_all(BodyKinematics kinematics);

/// The steps between two records of a run of so many steps, where none are given: so many that there are about 2,000
/// records, in 3D at least 10. A record costs two or three steps, so that in 2D it is up to 10 where 200 records are
/// left. It shares no factor with `restart`, so that not all records come right after a restart.
template <int Dim>
[[nodiscard]] int records_interval(std::int64_t steps, int restart);

/// With what depends on the dimension, and on nothing else, filled in: the quadrature of contact.
template <int Dim>
[[nodiscard]] RunOptions with_defaults(RunOptions options);

/// The number of steps of dt [s] that reach `time` [s]; a last step of less than 1e-12 of the whole is not made. Throws
/// BadInput if there are none, or too many to count.
[[nodiscard]] std::int64_t steps_until(double time, double dt);

/// The time step [s] where the stable one is `stable_dt`. Throws BadInput for one above it, unless that is allowed.
[[nodiscard]] double choose_step(const RunOptions& options, double stable_dt);

/// Throws BadInput if options do not go together: a filter, restarts, levels or a gauge for a scheme that has none; and for
/// a number of steps, a bound or a fade that there cannot be. Choices that the law of contact does not read are refused
/// where a Solid is made: the bodies decide which law acts.
void check(const RunOptions& options);

}  // namespace abut::run
