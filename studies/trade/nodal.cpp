#include "studies/trade/nodal.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

namespace abut::studies::trade {

std::vector<NodalSetting> nodal_ladder(Motion motion) {
    constexpr Kinematics small = Kinematics::small, finite = Kinematics::finite;
    const bool turns = motion == Motion::turning;
    const Kinematics strain = turns ? finite : small;
    const std::string name = turns ? "nodes --strain finite" : "nodes";
    return {{name, {strain}},
            turns ? NodalSetting{"nodes", {small}} : NodalSetting{"nodes --strain finite", {finite}},
            {name + " --cfl 0.5", {strain, {.cfl = 0.5}}},
            {name + " --filter", {strain, {.cfl = 1.0, .filter = true}}},
            {name + " --filter --restart 50", {strain, {.cfl = 1.0, .filter = true, .restart = 50}}},
            {name + " --scheme leapfrog", {strain, {.cfl = 1.0, .integrator = dynamics::Scheme::leapfrog}}}};
}

template <int Dim>
NodalOutcome<Dim> solve_on_nodes(const run::Scene<Dim>& scene, const std::vector<AxialVector<Dim>>& spin,
                                 const NodalRun& run, double speed, double limit) {
    Case<Dim> one{.name = "trade", .scene = scene, .run = run.options};
    one.scene.solid.kinematics.assign(scene.velocity.size(), run.strain);
    for (std::size_t body = 0; body < spin.size(); ++body)
        one.motion.push_back({.velocity = scene.velocity[body], .spin = spin[body]});
    const auto begin = std::chrono::steady_clock::now();
    const nodal::Watch<Dim> watch = [&](const dynamics::RunView<Dim>& view, const nodal::P1Bodies<Dim>&) {
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
        if (waited.count() > limit)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 view.steps, view.time, limit));
    };
    CaseResult<Dim> result = nodal::run_case<Dim>(one, {}, watch, 200);
    if (!result.figures.is_complete) throw std::runtime_error(result.figures.ending);
    Outcome outcome{std::move(result.figures)};
    outcome.cells = scene.mesh.n_cells();
    outcome.parasitic /= speed;
    return {.outcome = std::move(outcome), .velocity = std::move(result.velocity)};
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template NodalOutcome<Dim> solve_on_nodes<Dim>(const run::Scene<Dim>&, const std::vector<AxialVector<Dim>>&, \
                                                   const NodalRun&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::trade
