// A momentum trap: a pulse runs to the free end of a bar, and the cells that it fills there leave the run, with all of it.
//
// A pulse of compression in a bar that cannot widen (nu = 0) has the velocity v(x) and the strain -v/c. Where it meets its
// own reflection, v doubles and the stress of a symmetric pulse is nowhere: half its length from the end moves with 2v and
// is not strained, and all else is at rest. What is cut off there takes along the whole momentum P = rho A int v dx and
// the whole energy rho A int v^2 dx, and what is left does not move any more. Hopkinson's trap is a second piece that
// only touches the bar; here its cells leave the mesh, and the run goes on with the others (solid::SteppedRun::change).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/without_cells.hpp"
#include "abut/solid/stepped_run.hpp"

using namespace abut;

namespace {

constexpr double length = 10.0, height = 0.1, pulse = 4.0, speed = 1e-3;  // E = rho = c = 1
constexpr int cells = 400;

/// Of the pulse, at `s` from its end [m/s], and the integral of it from there back.
double velocity(double s) {
    return s <= 0.0 || s >= pulse ? 0.0 : speed * std::pow(std::sin(std::numbers::pi * s / pulse), 2);
}
double displacement(double s) {
    if (s <= 0.0) return speed * 0.5 * pulse;
    if (s >= pulse) return 0.0;
    return speed * 0.5 * (pulse - s + pulse / (2.0 * std::numbers::pi) * std::sin(2.0 * std::numbers::pi * s / pulse));
}

double momentum(const solid::SteppedRun<2>& run) {
    double sum = 0.0;
    for (std::size_t i = 0; i < run.memm().q().size(); i += 2)
        sum += 0.5 * (run.memm().p_before()[i] + run.memm().p_after()[i]);
    return sum;
}

}  // namespace

int main() {
    const mesh::Mesh<2> bar = mesh::structured_box<2>({0.0, 0.0}, {length, height}, {cells, 4}, mesh::CellShape::quadrangle);
    solid::SolidOptions<2> options;
    options.materials.resize(1);
    options.materials[0].young = options.materials[0].density = 1.0;
    options.materials[0].poisson = 0.0;
    auto solid = std::make_unique<solid::Solid<2>>(bar, options);
    const double dt = 0.5 * dynamics::stable_step(*solid).dt;
    std::vector<double> q(solid->size(), 0.0), p(solid->size(), 0.0);
    for (std::size_t c = 0; c < bar.cell_centroid.size(); ++c) {
        q[2 * c] = displacement(bar.cell_centroid[c].x());
        p[2 * c] = bar.cell_measure[c] * velocity(bar.cell_centroid[c].x());
    }
    solid::SteppedRun<2> run(std::move(solid), q, p, dt, {});

    const double of_pulse = momentum(run), energy = run.memm().pseudo_energy();
    while (run.memm().time() < length - 0.5 * pulse) run.step();  // the middle of the pulse is at the end

    std::vector<std::int32_t> trap;
    for (std::int32_t c = 0; c < bar.n_cells(); ++c)
        if (bar.cell_centroid[static_cast<std::size_t>(c)].x() > length - 0.5 * pulse) trap.push_back(c);
    const mesh::MeshLeft<2> rest = mesh::without_cells<2>(bar, trap);
    const solid::Left<2> left = run.change(std::make_unique<solid::Solid<2>>(rest.mesh, options), rest.old_cells);
    const double kept = run.memm().pseudo_energy();
    double drift = 0.0;
    while (run.memm().time() < 3.0 * length) {
        run.step();
        drift = std::max(drift, std::abs(run.memm().pseudo_energy() - kept));
    }

    std::printf("of %d cells %d leave, with %.4f of the momentum and %.4f of the energy (exact: 1, 1)\n", bar.n_cells(),
                left.cells, left.momentum.x() / of_pulse, left.energy() / energy);
    std::printf(
        "what is left has %.1e of the momentum and %.1e of the energy (exact: 0, 0), which changes by %.1e until t = %.0f\n",
        momentum(run) / of_pulse, kept / energy, drift / energy, run.memm().time());
    const bool is_right =
        std::abs(left.momentum.x() / of_pulse - 1.0) < 2e-3 && std::abs(kept / energy) < 1e-4 && drift < 1e-13 * energy;
    return is_right ? 0 : 1;
}
