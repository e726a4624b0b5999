#include "studies/trade/nodal.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

namespace abut::studies::trade {

const std::vector<NodalSetting>& nodal_ladder() {
    static const std::vector<NodalSetting> all = {{"nodes", {}},
                                                  {"nodes --cfl 0.5", {.cfl = 0.5}},
                                                  {"nodes --filter", {.filter = true}},
                                                  {"nodes --filter --restart 50", {.filter = true, .restart = 50}},
                                                  {"nodes --scheme leapfrog", {.scheme = nodal::Scheme::leapfrog}}};
    return all;
}

template <int Dim>
Outcome solve_on_nodes(const run::Scene<Dim>& scene, const nodal::ImpactOptions& options, double speed, double limit,
                       std::vector<Vector<Dim>>& velocity_at_end) {
    nodal::Impact<Dim> impact{.name = "trade", .scene = {.mesh = scene.mesh}, .time = scene.time};
    for (std::size_t body = 0; body < scene.velocity.size(); ++body) {
        const auto& material = scene.solid.materials[body];
        impact.scene.materials.push_back({material.young, material.poisson, material.density});
        impact.motion.push_back({.velocity = scene.velocity[body]});
    }
    nodal::ImpactOptions run = options;
    run.records = 200;
    const auto begin = std::chrono::steady_clock::now();
    const nodal::Watch<Dim> watch = [&](const dynamics::RunView<Dim>& view, const nodal::P1Bodies<Dim>&) {
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
        if (waited.count() > limit)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 view.steps, view.time, limit));
    };
    nodal::ImpactResult<Dim> result = nodal::run_impact<Dim>(impact, run, watch);
    const nodal::ImpactFigures& figures = result.figures;
    if (!figures.is_complete) throw std::runtime_error(figures.ending);
    velocity_at_end = std::move(result.velocity);
    return {.errors = {.drift = figures.drift, .energy = figures.energy_drift},
            .excess = figures.excess,
            .parasitic = figures.parasitic / speed,
            .events = figures.events,
            .lost_contacts = figures.missed_contacts,
            .cells = scene.mesh.n_cells(),
            .steps = figures.steps,
            .seconds = figures.seconds_of_steps};
}

template Outcome solve_on_nodes<2>(const run::Scene<2>&, const nodal::ImpactOptions&, double, double,
                                   std::vector<Vector<2>>&);
template Outcome solve_on_nodes<3>(const run::Scene<3>&, const nodal::ImpactOptions&, double, double,
                                   std::vector<Vector<3>>&);

}  // namespace abut::studies::trade
