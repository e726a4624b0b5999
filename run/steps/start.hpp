#pragma once
// Private to the layer.
#include <memory>
#include <optional>
#include <vector>

#include "abut/dynamics/memm_async.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/options.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/steps/share.hpp"

namespace abut::run {

/// With the value that it has so far where the scene gives none and anything has moved, and then with the name E unless
/// that is K0. Throws BadInput for one without a name.
template <int Dim>
[[nodiscard]] EnergyScale known_scale(EnergyScale scale, const RunResult<Dim>& result);
/// sum + a - b
[[nodiscard]] solid::SolidTimes added(const solid::SolidTimes& sum, const solid::SolidTimes& a, const solid::SolidTimes& b);

/// State from which a run begins, whatever its integrator.
template <int Dim>
struct Start {
    /// All arguments but `pilot` and `observer`, who is told how bodies come to rest, must outlive it.
    Start(const Scene<Dim>& scene, const RunOptions& options, std::optional<PilotReport> pilot, const Share<Dim>& share,
          Observer<Dim>& observer);

    /// The solid, q and momentum of another part, at the start of the run again.
    void take_part(const Share<Dim>& share);
    /// Puts the rest of the scene in the place of what was there: its solid, and displacements and momenta of the points.
    void take_rest(std::unique_ptr<const Scene<Dim>> of, std::unique_ptr<solid::Solid<Dim>> its_solid,
                   const dynamics::IntegratorState& motion);
    /// The scene with the cells that are left.
    [[nodiscard]] const Scene<Dim>& present() const { return rest ? *rest : scene; }

    const Scene<Dim>& scene;
    const RunOptions& options;
    const Share<Dim>& first_share;
    std::unique_ptr<const Scene<Dim>> rest;    // null: no cell has left
    std::unique_ptr<solid::Solid<Dim>> solid;  // always there
    RunResult<Dim> result;
    std::vector<double> q;
    std::vector<double> momentum;
    dynamics::LocalSteps local_steps;  // of memm_async

private:
    void set_state();
    void settle(Observer<Dim>& observer);
    void set_outside();
    void set_local_steps();
};

/// c of the Bilbao scheme [J].
template <int Dim>
[[nodiscard]] double gauge(const Start<Dim>& start);

}  // namespace abut::run
