#include "abut/contact/law/pair_potential.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "abut/base/parallel.hpp"
#include "abut/contact/finite_forces.hpp"

namespace abut::contact {
namespace {

using geometry::PairPlace;
using geometry::PairRest;

constexpr std::ptrdiff_t grain = 64;                 // pairs that are worth a task
constexpr double far_tilted = -0.76604444311897803;  // n_1 . n_2 of faces that are 20 degrees away from n: -cos(40 degrees)

/// visit(value) for all that a mean gradient has.
template <class MeanGradient, class Visit>
void for_each_value(MeanGradient& found, const Visit& visit) {
    auto& [energy_0, energy_1, gap_0, gap_1, gradient, area, active_share, pressure, correction, events] = found;
    visit(energy_0);
    visit(energy_1);
    visit(gap_0);
    visit(gap_1);
    visit(gradient);
    visit(area);
    visit(active_share);
    visit(pressure);
    visit(correction);
    visit(events);
}

template <int Dim>
Vector<Dim> force_on_second(const geometry::PairCorners<Dim>& gradient) {
    Vector<Dim> force = Vector<Dim>::Zero();
    for (int v = Dim; v < 2 * Dim; ++v) force -= gradient[v];
    return force;
}

/// Adds what the corners of one facet of a pair, from `first` on, do to its body.
template <int Dim>
void add_to_body(const NodalPair<Dim>& pair, int first, const geometry::PairCorners<Dim>& gradient, PointsView<Dim> x_0,
                 PointsView<Dim> x_1, BodyStep<Dim>& body) {
    for (int v = first; v < first + Dim; ++v) {
        const Vector<Dim> start = x_0[pair.node[v]], end = x_1[pair.node[v]], middle = 0.5 * (start + end);
        body.force -= gradient[v];
        body.moment -= moment<Dim>(middle, gradient[v]);
        body.work += gradient[v].dot(end - start);
    }
}

}  // namespace

template <int Dim>
void clear_step(const NodalPairs<Dim>& listed, NodalStep<Dim>& step) {
    step.pairs.clear();
    step.gradient.assign(step.nodes.size(), Vector<Dim>::Zero());
    step.bodies.clear();
    for (const std::int32_t body : listed.bodies())
        step.bodies.push_back({body, Vector<Dim>::Zero(), AxialVector<Dim>::Zero(), 0.0});
    step.body_pairs.clear();
    for (const auto& [body_1, body_2] : listed.body_pairs())
        step.body_pairs.push_back({body_1, body_2, 0, Vector<Dim>::Zero(), 0.0});
    step.energy_0 = step.energy = step.work = step.interference_work = 0.0;
    step.report = {};
}

template <int Dim>
void PairPotential<Dim>::follow(const NodalPair<Dim>& pair, const SideOutlines<Dim>& sides, bool admitted,
                                PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take, Outcome& outcome) const {
    outcome.admitted = admitted;
    outcome.inadmissible = outcome.active = false;
    const geometry::PairCorners<Dim> start = pair.at(x_0), end = pair.at(x_1);
    // Where nothing can act before the next step it is enough to decide then.
    const PairRest rest = geometry::rests<Dim>(pair.outlook, start);
    if (rest == PairRest::apart) outcome.admitted = true;
    if (rest != PairRest::no && geometry::rests<Dim>(pair.outlook, end) == rest) return;
    const auto at_start = geometry::pair_placement<Dim>(start, pair.law);
    const auto at_end = geometry::pair_placement<Dim>(end, pair.law);
    if (at_start.place == PairPlace::apart) outcome.admitted = true;
    if (geometry::stays_inactive<Dim>(at_start, at_end, end)) return;

    outcome.facing = std::max(at_start.facing, at_end.facing);
    outcome.normal = at_start.normal + at_end.normal;
    const bool may_rest_on_flag = admitted && at_start.place == PairPlace::unclear;
    if (at_start.place != PairPlace::apart && !may_rest_on_flag) {
        const auto state = geometry::pair_state<Dim>(start, pair.law);
        outcome.admitted = state.energy == 0.0 && may_touch<Dim>(pair, start, state, sides);
        outcome.inadmissible = state.energy > 0.0;
    }
    if (!outcome.admitted) return;
    take_force(pair, start, end, take, outcome);
    if (may_rest_on_flag && outcome.found.energy_0 == 0.0 &&
        !may_touch<Dim>(pair, start, geometry::pair_state<Dim>(start, pair.law), sides))
        outcome.admitted = outcome.active = false;
}

template <int Dim>
void PairPotential<Dim>::take_force(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& start,
                                    const geometry::PairCorners<Dim>& end, TakenForce take, Outcome& outcome) const {
    auto& found = outcome.found;
    if (take == TakenForce::mean) {
        found = geometry::pair_mean_gradient<Dim>(start, end, pair.law, {.events = events_});
    } else {
        const auto at_end = geometry::pair_gradient<Dim>(end, pair.law);
        const auto at_start = geometry::pair_state<Dim>(start, pair.law);
        found = {};
        found.energy_0 = at_start.energy;
        found.energy_1 = at_end.energy;
        found.gap_0 = at_start.energy > 0.0 ? at_start.gap : 0.0;
        found.gap_1 = at_end.gap;
        found.gradient = at_end.gradient;
        found.area = at_end.area;
        found.active_share = at_end.energy > 0.0 ? 1.0 : 0.0;
        found.pressure = at_end.pressure;
    }
    const auto is_none = [](double energy) { return energy <= 0.0; };  // false for what is no number
    outcome.active = found.active_share > 0.0 || !is_none(found.energy_0) || !is_none(found.energy_1);
    outcome.interference_work = pair.interference < 0 ? 0.0 : interference_work(pair, start, end, take);
}

/// The interference grows before the step, while nothing moves.
template <int Dim>
double PairPotential<Dim>::interference_work(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& start,
                                             const geometry::PairCorners<Dim>& end, TakenForce take) {
    if (pair.offset_before == pair.law.offset) return 0.0;
    geometry::PairLaw<Dim> before = pair.law;
    before.offset = pair.offset_before;
    const auto growth_at = [&](const geometry::PairCorners<Dim>& corners) {
        return geometry::pair_state<Dim>(corners, pair.law).energy - geometry::pair_state<Dim>(corners, before).energy;
    };
    return take == TakenForce::mean ? growth_at(start) : 0.5 * (growth_at(start) + growth_at(end));
}

template <int Dim>
template <class Find, class Keep>
void PairPotential<Dim>::find_outcomes(std::size_t n, const Find& find, const Keep& keep) {
    outcomes_.resize(n);
    const auto for_each = [](const IndexRange& range, const auto& body) {
        parallel_each(
            static_cast<std::ptrdiff_t>(range.size()),
            [&](std::ptrdiff_t i) { body(range.begin + static_cast<std::size_t>(i)); }, grain);
    };
    if (!shared_.is_worth(n))
        return for_each({0, n}, [&](std::size_t p) {
            find(p);
            keep(p);
        });
    shared_.run(
        n,
        [&](const IndexRange& mine, ShareWriter& out) {
            for_each(mine, find);
            for (std::size_t p = mine.begin; p < mine.end; ++p) write(outcomes_[p], out);
        },
        [&](const IndexRange& range, ShareReader& in) {
            for (std::size_t p = range.begin; p < range.end; ++p) {
                read(in, outcomes_[p]);
                keep(p);
            }
        });
}

template <int Dim>
void PairPotential<Dim>::write(const Outcome& outcome, ShareWriter& out) {
    out.put(outcome.admitted);
    out.put(outcome.inadmissible);
    out.put(outcome.active);
    if (!outcome.active) return;
    out.put(outcome.normal);
    out.put(outcome.facing);
    out.put(outcome.interference_work);
    for_each_value(outcome.found, [&](const auto& value) { out.put(value); });
}

template <int Dim>
void PairPotential<Dim>::read(ShareReader& in, Outcome& outcome) {
    outcome.admitted = in.get<bool>();
    outcome.inadmissible = in.get<bool>();
    outcome.active = in.get<bool>();
    if (!outcome.active) return;
    outcome.normal = in.get<Vector<Dim>>();
    outcome.facing = in.get<double>();
    outcome.interference_work = in.get<double>();
    for_each_value(outcome.found, [&](auto& value) { value = in.get<std::remove_reference_t<decltype(value)>>(); });
}

template <int Dim>
std::int64_t PairPotential<Dim>::apply(const NodalSurface<Dim>& surface, const SideOutlines<Dim>& sides,
                                       NodalPairs<Dim>& listed, std::span<PairMemory> memory, FacetStore& facets, double dt,
                                       PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take, NodalStep<Dim>& step) {
    const auto pairs = listed.in_reach(x_0, x_1, memory);
    const auto admitted = [&](std::size_t p) -> bool& { return memory[pairs[p].memory].admitted; };
    find_outcomes(
        pairs.size(), [&](std::size_t p) { follow(pairs[p], sides, admitted(p), x_0, x_1, take, outcomes_[p]); },
        [&](std::size_t p) { admitted(p) = outcomes_[p].admitted; });
    add_up(surface, listed, pairs, x_0, x_1, step);
    if (friction_.any()) add_friction(surface, pairs, facets, dt, x_0, x_1, take, step);
    finish(surface, step);
    return std::ranges::count_if(outcomes_, [](const Outcome& outcome) { return outcome.inadmissible; });
}

template <int Dim>
void PairPotential<Dim>::evaluate(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed,
                                  std::span<const PairMemory> memory, const FacetStore& facets, PointsView<Dim> x,
                                  NodalStep<Dim>& step) {
    const auto pairs = listed.in_reach(x);
    find_outcomes(
        pairs.size(),
        [&](std::size_t p) {
            outcomes_[p].inadmissible = outcomes_[p].active = false;
            if (!memory[pairs[p].memory].admitted) return;
            const geometry::PairCorners<Dim> corners = pairs[p].at(x);
            const auto place = geometry::pair_placement<Dim>(corners, pairs[p].law);
            if (place.place != PairPlace::unclear) return;
            outcomes_[p].facing = place.facing;
            outcomes_[p].normal = place.normal;
            take_force(pairs[p], corners, corners, TakenForce::end, outcomes_[p]);
        },
        [](std::size_t) {});
    add_up(surface, listed, pairs, x, x, step);
    if (friction_.any()) {
        friction_.begin(0.0, x, x, TakenForce::end);
        add_pairs(surface, pairs);
        friction_.evaluate(surface, facets, step);
    }
    finish(surface, step);
}

template <int Dim>
void PairPotential<Dim>::add_up(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed,
                                std::span<const NodalPair<Dim>> pairs, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                NodalStep<Dim>& step) const {
    clear_step(listed, step);
    double forces = 0.0;
    for (std::size_t p = 0; p < outcomes_.size(); ++p) {
        if (!outcomes_[p].active) continue;
        const NodalPair<Dim>& pair = pairs[p];
        const auto& found = outcomes_[p].found;
        if (!is_usable(magnitudes<Dim>(found))) refuse_pair<Dim>(surface, pair, found, x_0, x_1);
        for (std::size_t v = 0; v < pair.listed.size(); ++v) step.gradient[pair.listed[v]] += found.gradient[v];
        step.energy_0 += found.energy_0;
        step.energy += found.energy_1;
        step.interference_work += outcomes_[p].interference_work;
        add_to_body(pair, 0, found.gradient, x_0, x_1, step.bodies[pair.body_1]);
        add_to_body(pair, Dim, found.gradient, x_0, x_1, step.bodies[pair.body_2]);
        add_pair(surface, pair, outcomes_[p], step);
        forces += step.pairs.back().force.norm();
    }
    if (forces > 0.0) step.report.correction /= forces;
}

template <int Dim>
void PairPotential<Dim>::add_friction(const NodalSurface<Dim>& surface, std::span<const NodalPair<Dim>> pairs,
                                      FacetStore& facets, double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                      TakenForce take, NodalStep<Dim>& step) {
    friction_.begin(dt, x_0, x_1, take);
    add_pairs(surface, pairs);
    friction_.apply(surface, facets, step);
}

template <int Dim>
void PairPotential<Dim>::add_pairs(const NodalSurface<Dim>& surface, std::span<const NodalPair<Dim>> pairs) {
    for (std::size_t p = 0; p < outcomes_.size(); ++p)
        if (const auto& found = outcomes_[p].found; outcomes_[p].active)
            friction_.add(surface, pairs[p], found.pressure, found.area, found.active_share);
}

template <int Dim>
void PairPotential<Dim>::finish(const NodalSurface<Dim>& surface, NodalStep<Dim>& step) {
    check_bodies(step);
    for (const BodyStep<Dim>& body : step.bodies)
        if (surface.is_rigid(body.body)) step.work += body.work;
}

template <int Dim>
void PairPotential<Dim>::add_pair(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair, const Outcome& outcome,
                                  NodalStep<Dim>& step) {
    const auto& found = outcome.found;
    const Vector<Dim> force = force_on_second<Dim>(found.gradient), normal = outcome.normal.normalized();
    const double compression = -std::min(found.gap_0, found.gap_1) / pair.admission_depth;
    step.pairs.push_back({.face_1 = surface.face_of(Facet{pair.facet_1}),
                          .face_2 = surface.face_of(Facet{pair.facet_2}),
                          .normal = normal,
                          .gap_0 = found.gap_0,
                          .gap_1 = found.gap_1,
                          .area = found.area,
                          .normal_force = force.dot(normal),
                          .force = force,
                          .events = found.events,
                          .active_share = found.active_share,
                          .compression = compression});
    StepReport& report = step.report;
    report.events += found.events;
    report.correction += found.correction;
    if (outcome.facing > far_tilted) ++report.tilted_pairs;
    if (compression > report.compression) {
        report.compression = compression;
        report.most_compressed = static_cast<std::int32_t>(step.pairs.size()) - 1;
    }
    BodyPairStep<Dim>& bodies = step.body_pairs[pair.body_pair];
    ++bodies.active_pairs;
    if (pair.body_1 != pair.body_2) bodies.force += pair.body_1 < pair.body_2 ? force : Vector<Dim>(-force);
    bodies.normal_force += force.dot(normal);
}

template void clear_step(const NodalPairs<2>&, NodalStep<2>&);
template void clear_step(const NodalPairs<3>&, NodalStep<3>&);
template class PairPotential<2>;
template class PairPotential<3>;

}  // namespace abut::contact
