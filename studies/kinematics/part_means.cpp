#include <fmt/format.h>

#include "abut/solid/options/option_words.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace {

using solid::MeanForce;

struct Setting {
    double noise;      // of each component of a velocity [m/s]
    double of_stable;  // time step over 2/omega
    int steps;
    int restart;
};

/// A block that spins fast, with noise: how long does the mean force of its steps hold?
template <int Dim>
void spin_with(MeanForce mean, const Setting& setting, const Options& options, const Sink& sink) {
    std::array<int, Dim> cells;
    cells.fill(Dim == 2 ? 12 : 5);
    Case<Dim> one = case_of<Dim>(Dim == 2 ? "square" : "cube", {turned_box<Dim>({.cells = cells})}, Kinematics::finite);
    one.scene.contact = false;
    constexpr double spin = 0.3;
    if constexpr (Dim == 2)
        one.motion[0].spin = AxialVector<2>(spin);
    else
        one.motion[0].spin = spin * Vector<3>(1.0, 2.0, 2.0).normalized();
    one.noise = setting.noise;
    one.run.mean_force = mean;
    one.run.steps = options.quick ? setting.steps / 20 : setting.steps;
    one.run.restart = setting.restart;
    // The default step is a part of 2/omega that is a margin for noise; here it is what is looked at.
    Case<Dim> first_step = one;
    first_step.run.steps = 1;
    first_step.run.cfl = 1.0;
    first_step.run.frames = 0;
    const double longest = run_case<Dim>(first_step, {}).figures.dt;
    solid::Solid<Dim> solid(one.scene.mesh, run::solid_options(one.scene, one.run));
    one.run.dt = setting.of_stable / solid.step_margin() * longest;
    one.run.allow_unstable = true;
    sink(row_of<Dim>(
        one,
        fmt::format("{}, noise {:g}, {:g} of 2/omega, {}", word_of(solid::mean_force_words, mean), setting.noise,
                    setting.of_stable, setting.restart > 0 ? fmt::format("restart {}", setting.restart) : "no restart"),
        options));
}

}  // namespace

void run_means(const Options& options, const Sink& sink) {
    const auto each_mean = [&](const auto& run) {
        for (const MeanForce mean : {MeanForce::discrete_gradient, MeanForce::trapezoid, MeanForce::closed_trapezoid})
            run(mean);
    };
    for (const Setting& setting :
         {Setting{0.01, 0.6, 2'800, 0}, Setting{0.03, 0.6, 56'500, 0}, Setting{0.03, 0.6, 56'500, 50},
          Setting{0.03, 0.8, 42'000, 0}, Setting{0.03, 0.8, 42'000, 50}})
        each_mean([&](MeanForce mean) { spin_with<2>(mean, setting, options, sink); });
    for (const Setting& setting :
         {Setting{0.01, 0.6, 2'800, 0}, Setting{0.03, 0.6, 20'000, 0}, Setting{0.03, 0.6, 20'000, 50},
          Setting{0.03, 0.8, 20'000, 0}, Setting{0.03, 0.8, 20'000, 50}})
        each_mean([&](MeanForce mean) { spin_with<3>(mean, setting, options, sink); });
}

}  // namespace abut::studies::kinematics
