#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace free_part {
namespace {

constexpr double spin = 0.1;

/// How far the distance of two cells is from that at rest, at most: over that.
template <int Dim>
double stretch_of(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    const auto q = as_vectors<Dim>(run.q);
    double stretch = 0.0;
    for (std::size_t i = 1; i < q.size(); ++i) {
        const Vector<Dim> rest = solid.rest_positions()[i] - solid.rest_positions()[0];
        stretch = std::max(stretch, std::abs((rest + q[i] - q[0]).norm() / rest.norm() - 1.0));
    }
    return stretch;
}

template <int Dim>
void spin_block(Kinematics kinematics, double noise, const Options& options, const Sink& sink, int restart = 0) {
    std::array<int, Dim> cells;
    cells.fill(options.quick ? 3 : Dim == 2 ? 8 : 4);
    Case<Dim> one = case_of<Dim>(Dim == 2 ? "square" : "cube", {turned_box<Dim>({.cells = cells})}, kinematics);
    one.scene.contact = false;
    one.motion[0].velocity = Vector<Dim>::Constant(0.02);
    if constexpr (Dim == 2)
        one.motion[0].spin = AxialVector<2>(spin);
    else
        one.motion[0].spin = spin * Vector<3>(0.3, -0.5, 0.8).normalized();
    one.noise = noise;
    one.run.restart = restart;
    const double turns = options.quick ? 2.0 : 20.0;
    one.scene.time = turns * 2.0 * std::numbers::pi / spin;
    double stretch = 0.0;
    const Watch<Dim> watch = [&](const auto& run, const auto& solid) {
        stretch = std::max(stretch, stretch_of<Dim>(run, solid));
    };
    const std::string setting = run::name_of(kinematics) + (noise > 0.0 ? fmt::format(", noise {:g}", noise) : "") +
                                (restart > 0 ? fmt::format(", restart {}", restart) : "");
    Row row = row_of<Dim>(one, setting, options, nullptr, watch);
    const std::string name = "largest change of a distance, over that at rest";
    if (kinematics == Kinematics::small) {
        // Each point flies straight on: in the plane by spin t |X|.
        const double flight = one.scene.time * spin;
        row.quantities.near(name, stretch, std::sqrt(1.0 + flight * flight) - 1.0, Dim == 2 ? 0.02 : no_target);
    } else {
        const double centrifugal = 2.0 * spin * spin;  // of E = rho = 1, and of noise nothing is known
        row.quantities.at_most(name, stretch, noise > 0.0 ? no_target : centrifugal);
        row.quantities.at_most("H - H~", row.run->excess, noise > 0.0 ? 1.0 : 1e-3);
    }
    sink(row);
}

}  // namespace
}  // namespace free_part

void run_free(const Options& options, const Sink& sink) {
    using namespace free_part;
    for (const double noise : {0.0, 1e-3}) {
        spin_block<2>(Kinematics::floating, noise, options, sink);
        spin_block<3>(Kinematics::floating, noise, options, sink);
    }
    for (const double noise : {0.0, 1e-3, 1e-2, 3e-2}) spin_block<2>(Kinematics::finite, noise, options, sink);
    for (const double noise : {0.0, 1e-3, 1e-2}) spin_block<3>(Kinematics::finite, noise, options, sink);
    spin_block<2>(Kinematics::finite, 3e-2, options, sink, 50);
    spin_block<2>(Kinematics::small, 0.0, options, sink);
    spin_block<3>(Kinematics::small, 0.0, options, sink);
}

}  // namespace abut::studies::kinematics
