#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "abut/dynamics/particles.hpp"
#include "abut/run/scene.hpp"
#include "apps/support/command_parser.hpp"
#include "studies/table/study.hpp"

/// Straight elastic bars that hit a rigid wall or each other. With nu = 0 and rollers at their sides their waves are those
/// of one dimension, so that closed forms exist. All quantities are per area of the cross-section: momentum [N s/m^2],
/// energy [J/m^2]. Heights are measured from the wall, or from the middle between two bars.
namespace abut::studies {

class Flags;

/// A bar of one material; by default the one that most reference cases take.
struct Bar {
    double length = 10.0;  ///< L [m]
    double young = 900.0;  ///< E [Pa]
    double density = 1.0;  ///< rho [kg/m^3]

    [[nodiscard]] double mass() const { return density * length; }  ///< [kg/m^2]
    [[nodiscard]] double wave_speed() const { return std::sqrt(young / density); }
    [[nodiscard]] double impedance() const { return density * wave_speed(); }          ///< rho c [kg/(m^2 s)]
    [[nodiscard]] double contact_time() const { return 2.0 * length / wave_speed(); }  ///< of a wave up and down [s]
};

/// Along which a strip of cells lies.
template <int Dim>
inline constexpr int bar_axis = Dim - 1;
/// Cross section of a strip of this width [m^(Dim-1)]; in 3D it is square.
template <int Dim>
[[nodiscard]] double cross_section(double width) {
    return Dim == 2 ? width : width * width;
}

/// How a bar is made of cells: masses and springs; or the full solver, two squares or 2 x 2 cubes across.
enum class BarBody { chain, strip2d, strip3d };

/// A bar above a rigid wall.
struct BarOnWall {
    Bar bar;
    double gap = 5.0;                                     ///< of its lower end over the wall at the start [m]
    double speed = 0.0;                                   ///< towards the wall at the start [m/s]
    double gravity = 0.0;                                 ///< towards the wall [m/s^2]
    bool held = false;                                    ///< its upper end is fixed
    std::function<double(double height)> displacement{};  ///< upwards at the start, at a height of the mesh [m]; empty: none
    double energy = 0.0;                                  ///< that errors are measured with [J/m^2], > 0
    double time = 0.0;                                    ///< end of the run [s]
    double eta = 0.0;                                     ///< stabilisation of jumps in the strips [Pa]; 0: E
};

using BarChain = dynamics::Particles<dynamics::LineSpring>;

/// Masses rho h at the centres of cells, springs E/h between them; springs 2E/h, half a cell, to the wall where the lowest
/// mass is pressed, and to what holds the upper end.
[[nodiscard]] BarChain bar_chain(const BarOnWall& scene, int cells);
/// A strip of squares along y, or of cubes along z, two across, on rollers at its sides: with nu = 0 they carry nothing.
/// Energies are measured with H0 = `energy` times the area of the strip.
template <int Dim>
[[nodiscard]] run::Scene<Dim> bar_strip(const BarOnWall& scene, int cells);
/// Width of that strip, two cells [m].
[[nodiscard]] double strip_width(const Bar& bar, int cells);

/// Two equal bars, one above the other, that meet head on.
struct TwoBars {
    Bar bar;
    double gap = 1.0;                     ///< between them at the start [m]
    std::array<double, 2> speed{10, 10};  ///< towards the other, lower and upper bar [m/s]
    double time = 0.0;                    ///< end of the run [s]
};
/// As `bar_strip`, each bar with its own number of cells along it; their cells are about square.
template <int Dim>
[[nodiscard]] run::Scene<Dim> two_bar_strips(const TwoBars& scene, std::array<int, 2> cells);
[[nodiscard]] double two_strips_width(const Bar& bar, std::array<int, 2> cells);

/// The exact motion of the default bar that comes from 5 m above the wall at 10 m/s: thrown without gravity, or falling from
/// rest at 10 m/s^2. Under gravity it hits again and again: time runs backwards in every second impact.
class ExactBounce {
public:
    explicit ExactBounce(double gravity) : gravity_(gravity) {}

    static constexpr double speed = 10.0;         ///< of impact [m/s]
    static constexpr double height = 5.0;         ///< of the lower end at the start [m]
    static constexpr double period = 16.0 / 3.0;  ///< under gravity [s], two impacts

    /// Beginning of an impact, counted from 0 [s]; without gravity there is one.
    [[nodiscard]] double hit(int impact = 0) const;
    /// Pressure of the wall, at a time after the first hit [Pa].
    [[nodiscard]] double pressure(double since) const { return bar_.impedance() * (speed + gravity_ * since); }
    /// Pressure of the wall at any time.
    [[nodiscard]] double pressure_at(double time) const;
    /// Height of the lower end over the wall.
    [[nodiscard]] double height_at(double time) const;
    /// Upwards, of the centre of mass.
    [[nodiscard]] double velocity_at(double time) const;
    /// Impulse of the wall, in one impact [N s/m^2].
    [[nodiscard]] double impulse() const;

private:
    [[nodiscard]] double flight(double since) const;
    Bar bar_;
    double gravity_;  // [m/s^2]
};

/// Effect of the dispersion of the cells on an impact at constant pressure. Long waves run at c (1 - beta (k h)^2) with
/// beta = (1 - nu^2)/24 in the chain and (4 - nu^2)/24 in the strips, whose strain is a difference over 2h; nu is the
/// Courant number. A front that has run the distance s is then the integral of the Airy function over the length
/// (3 beta h^2 s)^(1/3). Here s = 2L, and the wall lets go where that integral is 1/2: late, and with a part of the speed
/// left behind as vibration. Both go like h^(2/3); what is left out here is of the next order, h.
struct DispersedImpact {
    double delay;  ///< of the release [s]
    double loss;   ///< of the speed of rebound, over the speed of impact [-]
};
[[nodiscard]] DispersedImpact dispersed_impact(const Bar& bar, BarBody body, int cells, double courant);

/// History of the contact of a run: n steps, n + 1 nodes.
struct ContactHistory {
    std::vector<double> time;                  ///< of the nodes [s]
    std::vector<double> gap;                   ///< smallest at the nodes, < 0 in contact; infinity: far apart [m]
    std::vector<std::array<double, 2>> speed;  ///< of the centres of mass at the nodes, upwards; of one bar the first [m/s]
    std::vector<double> pressure;              ///< mean of each step [Pa] (n)
};

/// A contact from its first touch to its last release. Within a step gaps are linear: both are exact roots.
struct Impact {
    double begin, end;            ///< [s]
    double impulse;               ///< [N s/m^2]
    std::array<double, 2> speed;  ///< of the centres of mass after it, upwards [m/s]
};
/// Impacts that are over: followed by `pause` without a contact [s]. Contacts less than that apart are one.
[[nodiscard]] std::vector<Impact> impacts(const ContactHistory& history, double pause);

/// Pressure in the middle 80 % of an exact contact, away from the jumps at both ends.
struct MiddlePressure {
    double mean;              ///< [Pa]
    double rms;               ///< of pressure - exact [Pa]
    double at_begin, at_end;  ///< of the contact, by the line of least squares [Pa]
};
[[nodiscard]] MiddlePressure middle_pressure(const ContactHistory& history, double begin, double duration,
                                             const std::function<double(double time)>& exact);

/// Displacements of the cells at a time.
struct BarProfile {
    double time;                               ///< [s]
    std::vector<std::array<double, 3>> cells;  ///< height in the mesh [m], displacement upwards [m], share of the volume [-]
};

/// A finished run.
struct BarRun {
    ContactHistory history;
    std::vector<BarProfile> profiles;
    Figures energies;                             ///< with their scale per area
    double energy_start = 0.0, energy_end = 0.0;  ///< H [J/m^2]
    double seconds = 0.0;                         ///< with the set-up
};

/// How bars are cut into cells and run: what all programs with bars share.
struct BarOptions {
    BarBody body = BarBody::strip2d;
    std::vector<int> cells;
    double cfl = 0.4;     ///< Courant number c dt/h [-]
    run::RunOptions run;  ///< of the strips; `out` is that of all

    [[nodiscard]] std::string body_name() const;
    /// Throws BadInput where options of the full solver were given for a chain.
    void check() const;

    std::vector<apps::Flag> of_solver;  ///< options that a chain does not know
};

/// With what an impact at a third of the wave speed needs: the foot gives way by up to twice its cell, and more when
/// vibration adds up; `length` is that of the bar [m].
[[nodiscard]] BarOptions default_bar_options(const apps::Program& program, std::vector<int> cells,
                                             double length = Bar{}.length);
/// --body, --cells, --cfl, --filter, --out and the options of contact; `bodies` are those on offer.
void add_bar_options(Flags& flags, BarOptions& options,
                     const std::vector<BarBody>& bodies = {BarBody::chain, BarBody::strip2d, BarBody::strip3d});
/// As they were used.
[[nodiscard]] run::NamedValues named_values(const BarOptions& options);

/// Runs a bar under MEMM; profiles are taken at the nodes nearest to the times. The step is `cfl` h/c, or a little less so
/// that the last node is the end of the run. Throws as `simulate`.
[[nodiscard]] BarRun run_bar(const BarOnWall& scene, const BarOptions& options, int cells,
                             const std::vector<double>& profile_times = {});
[[nodiscard]] BarRun run_two_bars(const TwoBars& scene, const BarOptions& options, std::array<int, 2> cells);

/// Commands by which gnuplot plots history.csv: a line for each number of cells, over `time` or `middle`.
[[nodiscard]] std::string history_lines(const std::vector<int>& cells, const std::string& time, const std::string& value);

/// A study of bars: a run and a level for each number of BarOptions::cells, counted from 0.
struct BarStudy {
    std::string title;  ///< this and the next as in Study
    std::string reference;
    std::function<BarRun(std::size_t level)> run;
    std::function<Level(const BarRun& run, std::size_t level)> level;
    apps::Table exact;                       ///< left as exact.csv
    Picture picture;                         ///< of history.csv and exact.csv
    std::vector<std::string> more_curves{};  ///< names of those that `complete` adds
    std::function<void(Study&)> complete{};  ///< adds what else there is, after the last run; may be empty
};
/// Runs a study and reports it. history.csv has a row a step, with the number of cells in front: time, gap, speed_1 and
/// speed_2 at its end; pressure, its mean, belongs to its middle. Throws as the runs do, and as BarOptions::check.
void run_study(const apps::Program& program, const BarOptions& options, const BarStudy& bars);

}  // namespace abut::studies
