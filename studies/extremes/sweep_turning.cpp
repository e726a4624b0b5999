#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/dynamics/point_system.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/extremes/families.hpp"
#include "studies/extremes/scenes.hpp"

namespace abut::studies::extremes {
namespace {

using solid::Kinematics;

constexpr double largest_faster = 1e-3;  // H is kept to H - H~ alone
constexpr int block_cells = 7;           // along 1
constexpr std::array turning{Kinematics::floating, Kinematics::rigid};

std::string name_of(Kinematics kinematics) { return kinematics == Kinematics::rigid ? "rigid" : "floating"; }

/// J~ is kept where nothing holds the bodies; over what it is at the start.
template <int Dim>
std::string ask_of_spin(const run::RunResult<Dim>& result, Row& row) {
    const double scale = result.ledger.entries().front().pseudo_angular_momentum.norm();
    const double drift = result.ledger.pseudo_angular_momentum_drift() / scale;
    row.numbers.push_back({"J~ drift", drift});
    if (drift <= largest_momentum_drift) return "";
    return fmt::format("J~ drifts by {:.2g}, {:g} is allowed", drift, largest_momentum_drift);
}

/// Two discs of radius 1 that meet, the left one spinning.
run::Scene<2> spinning_discs(double rim, double speed, Kinematics kinematics) {
    const Meeting<2> meeting{.speed = speed, .aside = 0.3, .time = 30.0};
    run::Scene<2> scene = discs(meeting);
    scene.solid.kinematics.assign(2, kinematics);
    const Vector<2> centre(-0.5 * (std::sqrt(4.0 - meeting.aside * meeting.aside) + meeting.gap), -0.5 * meeting.aside);
    scene.added_velocity = [=](const Vector<2>& x) -> Vector<2> {
        if (x.x() > 0.0) return Vector<2>::Zero();
        return dynamics::turning_velocity<2>(AxialVector<2>(rim), x - centre);
    };
    return scene;
}

/// How far cells are from being undeformed in the frame of their body.
struct Strain {
    double largest = 0.0;  ///< of |G| of a cell
};

template <int Dim>
run::Scene<Dim> spinning_block(double spin, double turns, Kinematics kinematics, Strain& strain) {
    Vector<Dim> half = Vector<Dim>::Constant(0.4);
    half[0] = 0.5;
    half[Dim - 1] = 0.3;
    std::array<int, Dim> cells;
    cells.fill(3);
    run::Scene<Dim> scene;
    scene.mesh = mesh::structured_box<Dim>(Vector<Dim>(-half), half, cells,
                                           Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.solid.kinematics = {kinematics};
    scene.velocity = {Vector<Dim>::Zero()};
    AxialVector<Dim> about = AxialVector<Dim>::Constant(spin);
    if constexpr (Dim == 3) about = spin * Vector<3>(0.3, -0.5, 0.8).normalized();
    scene.added_velocity = [about](const Vector<Dim>& x) { return dynamics::turning_velocity<Dim>(about, x); };
    scene.time = turns * 2.0 * std::numbers::pi / spin;
    scene.remedy_if_overlapping = "The block is one body.";
    if (kinematics == Kinematics::floating)
        scene.after_step = [&strain](const solid::Solid<Dim>& solid, double) {
            strain.largest = std::max(strain.largest, solid.ccg().displacement_gradient(0).norm());
        };
    return scene;
}

template <int Dim>
Row spin_freely(double turns, Kinematics kinematics, const SweepOptions& options) {
    constexpr double spin = 0.1;
    Strain strain;
    run::RunOptions run = options.run;
    run.interval = 100;
    const auto ask = [&](const run::RunResult<Dim>& result, Row& row) {
        row.numbers.push_back({"largest |G|", strain.largest});
        const double allowed = 2.0 * spin * spin;  // at rest rho spin^2 L^2/8 for a bar, and twice that on the way there
        if (!(strain.largest <= allowed))
            return fmt::format("a cell is strained by {:.2g}, the spin explains {:.2g}", strain.largest, allowed);
        return ask_of_spin<Dim>(result, row);
    };
    return attempt<Dim>({.family = "turns",
                         .value = fmt::format("{}D, {}, {:g} turns", Dim, name_of(kinematics), turns),
                         .speed = spin,
                         .keeps_momentum = false,
                         .meets = false,
                         .make = [&] { return spinning_block<Dim>(spin, turns, kinematics, strain); },
                         .run = run,
                         .ask_more = ask});
}

/// A disc that comes down with a speed on the upper side of a free elastic block of side 1, a little off its middle.
struct Landing {
    double radius = 0.3;
    double density = 1.0;  ///< of the disc, over that of the block
    double speed = 0.02;
    double gap = 0.02;                             ///< over the radius
    double time = 12.0;                            ///< times the radius
    Kinematics kinematics = Kinematics::floating;  ///< of the disc
};

run::Scene<2> landing(const Landing& of) {
    const auto block =
        mesh::structured_box<2>({-0.5, -1.0}, {0.5, 0.0}, {block_cells, block_cells}, mesh::CellShape::quadrangle, "block");
    // Its lowest corner, or side, is above the circle, by more than a small gap.
    const auto disc_over = [&](double height) {
        return mesh::disc({.centre = {0.03, height}, .radius = of.radius, .size = 0.3 * of.radius, .name = "disc"});
    };
    double lowest = 0.0;
    for (const Vector<2>& x : disc_over(0.0).vertices) lowest = std::min(lowest, x.y());
    const auto disc = disc_over(of.gap * of.radius - lowest);
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(std::vector{block, disc});
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0},
                             {.young = 1.0, .poisson = 0.3, .density = of.density}};
    scene.solid.kinematics = {Kinematics::floating, of.kinematics};
    scene.velocity = {Vector<2>::Zero(), -of.speed * Vector<2>::UnitY()};
    scene.time = of.time * of.radius;
    scene.remedy_if_overlapping = "Raise the gap.";
    return scene;
}

/// They part, and no faster than they met.
std::string ask_of_rebound(const run::RunResult<2>& result, double speed, Row& row) {
    const double parting = (result.bodies.end[1].velocity.y() - result.bodies.end[0].velocity.y()) / speed;
    row.numbers.push_back({"speed of parting", parting});
    if (parting > 0.0 && parting <= 1.0 + largest_faster) return "";
    return fmt::format("they part with {:.4g} of the speed with which they met", parting);
}

Row land(const char* family, const std::string& value, const Landing& of, const run::RunOptions& run) {
    return attempt<2>({.family = family,
                       .value = value,
                       .speed = of.speed,
                       .make = [of] { return landing(of); },
                       .run = run,
                       .ask_more = [of](const auto& result, Row& row) { return ask_of_rebound(result, of.speed, row); }});
}

}  // namespace

void sweep_rim(const SweepOptions& options, const Sink& sink) {
    constexpr double speed = 0.02;
    for (const Kinematics kinematics : turning)
        for (const double rim : thinned({0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 3.0, 10.0}, options.quick))
            sink(attempt<2>({.family = "rim",
                             .value = fmt::format("{}, rim at {:g} c", name_of(kinematics), rim),
                             .speed = speed,
                             .make = [=] { return spinning_discs(rim, speed, kinematics); },
                             .run = options.run,
                             .ask_more = ask_of_spin<2>}));
}

void sweep_turns(const SweepOptions& options, const Sink& sink) {
    for (const Kinematics kinematics : turning)
        for (const double turns : {1.0, 10.0, 100.0, 1000.0}) {
            if (options.quick && turns > 10.0) continue;
            sink(spin_freely<2>(turns, kinematics, options));
            sink(spin_freely<3>(turns, kinematics, options));
        }
}

void sweep_sizes(const SweepOptions& options, const Sink& sink) {
    for (const Kinematics kinematics : turning)
        for (const double ratio : thinned({1.0, 3.0, 10.0, 30.0, 100.0, 1000.0}, options.quick)) {
            const Landing of{.radius = 0.5 / ratio, .time = 12.0 * std::sqrt(ratio), .kinematics = kinematics};
            Row row = land("sizes", fmt::format("{} disc, 1:{:g}", name_of(kinematics), ratio), of, options.run);
            const double pressed_in = row.compression / block_cells / of.radius;  // of both skins that of the block alone
            row.numbers.push_back({"pressed in, over the radius", pressed_in});
            if (row.message.empty()) row.message = fmt::format("pressed in by {:.2g} of its radius", pressed_in);
            sink(row);
        }
}

void sweep_masses(const SweepOptions& options, const Sink& sink) {
    for (const double ratio : thinned({1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}, options.quick)) {
        Landing of{.density = ratio, .kinematics = Kinematics::rigid};
        if (ratio < 1.0) {  // the step is that of the disc, and so is the time that it touches for
            of.gap *= std::sqrt(ratio);
            of.time = 80.0 * std::sqrt(ratio);
        }
        sink(land("masses", fmt::format("rho_rigid/rho = {:g}", ratio), of, options.run));
    }
}

}  // namespace abut::studies::extremes
