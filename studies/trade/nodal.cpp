#include "studies/trade/nodal.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

namespace abut::studies::trade {

std::vector<NodalSetting> nodal_ladder(Motion motion) {
    using nodal::Strain;
    const bool turns = motion == Motion::turning;
    const Strain strain = turns ? Strain::finite : Strain::small;
    const std::string name = turns ? "nodes --strain finite" : "nodes";
    return {{name, {strain, {}}},
            turns ? NodalSetting{"nodes", {Strain::small, {}}} : NodalSetting{"nodes --strain finite", {Strain::finite, {}}},
            {name + " --cfl 0.5", {strain, {.cfl = 0.5}}},
            {name + " --filter", {strain, {.filter = true}}},
            {name + " --filter --restart 50", {strain, {.filter = true, .restart = 50}}},
            {name + " --scheme leapfrog", {strain, {.scheme = nodal::Scheme::leapfrog}}}};
}

template <int Dim>
NodalOutcome<Dim> solve_on_nodes(const run::Scene<Dim>& scene, const std::vector<AxialVector<Dim>>& spin,
                                 const std::vector<Vector<Dim>>& centre, const NodalRun& run, double speed, double limit) {
    nodal::Impact<Dim> impact{.name = "trade", .scene = {.mesh = scene.mesh}, .time = scene.time};
    impact.scene.strain = run.strain;
    for (std::size_t body = 0; body < scene.velocity.size(); ++body) {
        const auto& material = scene.solid.materials[body];
        impact.scene.materials.push_back({material.young, material.poisson, material.density});
        impact.motion.push_back({.velocity = scene.velocity[body], .spin = spin[body], .centre = centre[body]});
    }
    nodal::ImpactOptions options = run.options;
    options.records = 200;
    const auto begin = std::chrono::steady_clock::now();
    const nodal::Watch<Dim> watch = [&](const dynamics::RunView<Dim>& view, const nodal::P1Bodies<Dim>&) {
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
        if (waited.count() > limit)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 view.steps, view.time, limit));
    };
    nodal::ImpactResult<Dim> result = nodal::run_impact<Dim>(impact, options, watch);
    const nodal::ImpactFigures& figures = result.figures;
    if (!figures.is_complete) throw std::runtime_error(figures.ending);
    return {.outcome = {.errors = {.drift = figures.drift, .energy = figures.energy_drift},
                        .excess = figures.excess,
                        .parasitic = figures.parasitic / speed,
                        .momentum = figures.momentum,
                        .pseudo_angular = figures.pseudo_angular,
                        .events = figures.events,
                        .missed_contacts = figures.missed_contacts,
                        .cells = scene.mesh.n_cells(),
                        .steps = figures.steps,
                        .seconds = figures.seconds_of_steps},
            .velocity = std::move(result.velocity)};
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template NodalOutcome<Dim> solve_on_nodes<Dim>(const run::Scene<Dim>&, const std::vector<AxialVector<Dim>>&, \
                                                   const std::vector<Vector<Dim>>&, const NodalRun&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::trade
