#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/cell_view.hpp"
#include "studies/kinematics/closed_forms.hpp"
#include "studies/kinematics/rows.hpp"

namespace abut::studies::kinematics {
namespace tops_part {
namespace {

using std::numbers::pi;

Case<3> top(const std::string& name, const Vector<3>& sides, const Vector<3>& spin, int steps_per_turn) {
    const auto box =
        mesh::structured_box<3>(Vector<3>(-0.5 * sides), Vector<3>(0.5 * sides), {2, 3, 2}, mesh::CellShape::hexahedron);
    Case<3> one = case_of<3>(name, {box}, Kinematics::rigid);
    one.motion[0].spin = spin;
    one.run.dt = 2.0 * pi / (steps_per_turn * spin.norm());
    one.run.allow_unstable = true;
    return one;
}

/// How the body has turned, fitted to its cells.
Matrix<3> turn_of(const dynamics::RunView<3>& run, const solid::Solid<3>& solid) {
    const auto u = solid.cells().displacement(run.q);
    const auto& rest = solid.mesh().cell_centroid;
    Vector<3> mean = Vector<3>::Zero(), moved = Vector<3>::Zero();
    for (std::size_t c = 0; c < u.size(); ++c) mean += rest[c], moved += rest[c] + u[c];
    mean /= static_cast<double>(u.size()), moved /= static_cast<double>(u.size());
    Matrix<3> at_rest = Matrix<3>::Zero(), now = Matrix<3>::Zero();
    for (std::size_t c = 0; c < u.size(); ++c) {
        const Vector<3> arm = rest[c] - mean;
        at_rest += arm * arm.transpose();
        now += (rest[c] + u[c] - moved) * arm.transpose();
    }
    return now * at_rest.inverse();
}

/// Returns the angle by which it is off at the end [rad].
double spin_symmetric(int steps_per_turn, double coarser, const Options& options, const Sink& sink) {
    const double turns = options.quick ? 1.0 : 5.0;
    const Vector<3> sides(1.0, 1.0, 0.5), spin(0.6, 0.0, 0.8);
    Case<3> one = top("symmetric top", sides, spin, steps_per_turn);
    one.run.steps = static_cast<int>(turns) * steps_per_turn;
    double error = 0.0;
    const Watch<3> watch = [&](const auto& run, const auto& solid) {
        if (run.steps == one.run.steps)
            error = angle_between(turn_of(run, solid), symmetric_top(inertia_of_box(sides), spin, run.time));
    };
    Row row = row_of<3>(one, fmt::format("{} steps per turn", steps_per_turn), options, nullptr, watch);
    row.quantities.at_most(fmt::format("off from the closed form after {:g} turns [rad]", turns), error);
    if (coarser > 0.0) row.quantities.near("order of that", std::log10(coarser / error), 2.0, 0.025);
    sink(row);
    return error;
}

void flip(int steps_per_turn, double allowed, const Options& options, const Sink& sink) {
    const Vector<3> sides(1.0, 0.7, 0.35), spin(1e-3, 1.0, 0.0);
    const Vector<3> inertia = inertia_of_box(sides), axis = inertia.cwiseProduct(spin).normalized();
    const double period = flip_period(inertia, spin);
    const int flips = 4;
    Case<3> one = top("flipping box", sides, spin, steps_per_turn);
    one.run.steps = static_cast<int>((flips + 1.2) * period / one.run.dt);
    double before = 1.0, first = 0.0, last = 0.0;
    int n = 0;
    const Watch<3> watch = [&](const auto& run, const auto& solid) {
        const double along = axis.dot(turn_of(run, solid).col(1));
        if (along * before < 0.0 && n <= flips) {
            last = run.time - one.run.dt * std::abs(along) / (std::abs(along) + std::abs(before));
            if (n++ == 0) first = last;
        }
        before = along;
    };
    Row row = row_of<3>(one, fmt::format("{} steps per turn", steps_per_turn), options, nullptr, watch);
    row.quantities.near("from flip to flip [s]", (last - first) / flips, period, allowed);
    sink(row);
}

}  // namespace
}  // namespace tops_part

void run_tops(const Options& options, const Sink& sink) {
    using namespace tops_part;
    double error = 0.0;
    for (const int steps : {100, 1000, 10000})
        if (!options.quick || steps <= 1000) error = spin_symmetric(steps, error, options, sink);
    flip(100, 5e-3, options, sink);
    if (!options.quick) flip(1000, 5e-5, options, sink);
}

}  // namespace abut::studies::kinematics
