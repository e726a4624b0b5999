#include "abut/contact/law/pair_potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "abut/base/parallel.hpp"
#include "abut/contact/law/finite_forces.hpp"

namespace abut::contact {
namespace {

using geometry::PairPlace;
using geometry::PairRest;

constexpr std::ptrdiff_t grain = 64;                 // pairs that are worth a task, and that go through lanes together
constexpr double far_tilted = -0.76604444311897803;  // n_1 . n_2 of faces that are 20 degrees away from n: -cos(40 degrees)

/// visit(value) for all that a mean gradient has.
template <class MeanGradient, class Visit>
void for_each_value(MeanGradient& found, const Visit& visit) {
    auto& [energy_0, energy_1, gap_0, gap_1, gradient, area, active_share, pressure, correction, events, facing, normal] =
        found;
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
    visit(facing);
    visit(normal);
}

template <int Dim>
Vector<Dim> force_on_second(const geometry::PairCorners<Dim>& gradient) {
    Vector<Dim> force = Vector<Dim>::Zero();
    for (int v = Dim; v < 2 * Dim; ++v) force -= gradient[v];
    return force;
}

/// Whether W of an end is above all that rounding makes of it, so that a glance sees neither apart nor beside nor turned
/// away.
template <int Dim>
bool is_surely_pressed_in(const NodalPair<Dim>& pair, const geometry::PairEnd<Dim>& end) {
    const double energy = end[0], gap = end[1], area = end[2], facing = end[3], depth = pair.admission_depth;
    return energy > 0.0 && gap < -1e-6 * depth && area > 1e-9 * std::pow(depth, Dim - 1) &&
           facing < pair.law.facing.none - 1e-9;
}

template <int Dim>
FacetPair facets_of(const NodalPair<Dim>& pair) {
    return {Facet{pair.facet_1}, Facet{pair.facet_2}};
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
typename PairPotential<Dim>::Glance PairPotential<Dim>::glance_at_step(const NodalPair<Dim>& pair, bool admitted,
                                                                       bool is_pressed_in, PointsView<Dim> x_0,
                                                                       PointsView<Dim> x_1) {
    if (is_pressed_in) return {.admitted = admitted, .may_act = true, .may_be_pressed_in = admitted};
    Glance glance{.admitted = admitted};
    const geometry::PairCorners<Dim> start = pair.at(x_0), end = pair.at(x_1);
    // Where nothing can act before the next step it is enough to decide then.
    const PairRest rest = geometry::rests<Dim>(pair.outlook, start);
    if (rest == PairRest::apart) glance.admitted = true;
    if (rest != PairRest::no && geometry::rests<Dim>(pair.outlook, end) == rest) return glance;
    const auto at_start = geometry::pair_placement<Dim>(start, pair.law);
    const auto at_end = geometry::pair_placement<Dim>(end, pair.law);
    if (at_start.place == PairPlace::apart) glance.admitted = true;
    if (geometry::stays_inactive<Dim>(at_start, at_end, end)) return glance;

    glance.may_act = true;
    glance.is_decided = at_start.place == PairPlace::apart;
    glance.may_be_pressed_in = admitted && at_start.place == PairPlace::unclear;
    return glance;
}

template <int Dim>
void PairPotential<Dim>::find_resting_nodes(std::span<const std::int32_t> nodes, PointsView<Dim> x) {
    rests_.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto node = static_cast<std::size_t>(nodes[i]);
        const Vector<Dim> at = x[nodes[i]];
        rests_[i] = node < left_at_.size() && std::memcmp(&left_at_[node], &at, sizeof(at)) == 0 ? 1 : 0;
    }
}

template <int Dim>
void PairPotential<Dim>::leave_nodes(std::span<const std::int32_t> nodes, PointsView<Dim> x) {
    if (nodes.empty()) return;
    if (const auto n = static_cast<std::size_t>(nodes.back()) + 1; left_at_.size() < n)
        left_at_.resize(n, Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (const std::int32_t node : nodes) left_at_[static_cast<std::size_t>(node)] = x[node];
}

template <int Dim>
std::int32_t PairPotential<Dim>::find_start(const NodalPair<Dim>& pair, std::size_t& from) const {
    const FacetPair facets = facets_of(pair);
    while (from < kept_.size() && kept_[from].facets < facets) ++from;
    if (from == kept_.size() || kept_[from].facets != facets || kept_[from].offset != pair.law.offset) return -1;
    const auto rests = [&](std::int32_t i) { return rests_[static_cast<std::size_t>(i)] != 0; };
    return std::ranges::all_of(pair.listed, rests) ? static_cast<std::int32_t>(from) : -1;
}

template <int Dim>
void PairPotential<Dim>::take_forces(const IndexRange& range, Pairs pairs, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                     TakenForce take) {
    constexpr std::size_t most = grain;
    std::array<geometry::PairCorners<Dim>, most> starts, ends;
    std::array<geometry::PairStep<Dim>, most> steps;
    for (std::size_t first = range.begin; first < range.end; first += most) {
        const std::size_t n = std::min(most, range.end - first);
        for (std::size_t i = 0; i < n; ++i) {
            Outcome& outcome = outcomes_[first + i];
            Kept& ending = ending_[first + i];
            const NodalPair<Dim>& pair = pairs[outcome.pair];
            const std::int32_t start = glances_[outcome.pair].start;
            starts[i] = pair.at(x_0);
            ends[i] = pair.at(x_1);
            ending.facets = facets_of(pair);
            ending.offset = pair.law.offset;
            steps[i] = {.x_0 = &starts[i],
                        .x_1 = &ends[i],
                        .law = &pair.law,
                        .start = start >= 0 ? &kept_[static_cast<std::size_t>(start)].end : nullptr,
                        .end = &ending.end,
                        .mean = &outcome.found};
        }
        const std::span<const geometry::PairStep<Dim>> of_steps(steps.data(), n);
        take == TakenForce::mean ? geometry::integrate_pairs<Dim>(of_steps, path_) : geometry::evaluate_pairs<Dim>(of_steps);
    }
}

/// Admission where W = 0 at the start; where it is not, the flag counts.
template <int Dim>
void PairPotential<Dim>::decide(const NodalPair<Dim>& pair, const SideOutlines<Dim>& sides, PointsView<Dim> x_0,
                                Glance& glance, Outcome& outcome) {
    if (outcome.found.energy_0 > 0.0) {
        glance.inadmissible = !glance.may_be_pressed_in;
        glance.admitted = glance.may_be_pressed_in;
    } else {
        const geometry::PairCorners<Dim> start = pair.at(x_0);
        glance.admitted = may_touch<Dim>(pair, start, geometry::pair_state<Dim>(start, pair.law), sides);
    }
    outcome.active = outcome.active && glance.admitted;
}

template <int Dim>
void PairPotential<Dim>::conclude(const NodalPair<Dim>& pair, const SideOutlines<Dim>* sides, PointsView<Dim> x_0,
                                  PointsView<Dim> x_1, TakenForce take, Outcome& outcome) {
    const auto& found = outcome.found;
    const auto is_none = [](double energy) { return energy <= 0.0; };  // false for what is no number
    outcome.active = found.active_share > 0.0 || !is_none(found.energy_0) || !is_none(found.energy_1);
    // A contact without force waits for its next decision until it has one. Interference can press it in before a step.
    Glance& glance = glances_[outcome.pair];
    const bool must_be_decided = outcome.active || !glance.admitted || pair.interference >= 0;
    if (!glance.is_decided && must_be_decided) decide(pair, *sides, x_0, glance, outcome);
    outcome.interference_work =
        outcome.active && pair.interference >= 0 ? interference_work(pair, pair.at(x_0), pair.at(x_1), take) : 0.0;
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
template <class GlanceAt>
void PairPotential<Dim>::find_part(const IndexRange& range, Pairs pairs, const SideOutlines<Dim>* sides, PointsView<Dim> x_0,
                                   PointsView<Dim> x_1, TakenForce take, const GlanceAt& glance) {
    parallel_ranges(
        static_cast<std::ptrdiff_t>(range.size()),
        [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            if (begin == end) return;
            const std::size_t first = range.begin + static_cast<std::size_t>(begin);
            const auto before = std::ranges::lower_bound(kept_, facets_of(pairs[first]), {}, &Kept::facets);
            auto from = static_cast<std::size_t>(before - kept_.begin());
            for (std::size_t p = first; p < range.begin + static_cast<std::size_t>(end); ++p) {
                const std::int32_t start = find_start(pairs[p], from);
                const bool is_pressed_in =
                    start >= 0 && is_surely_pressed_in(pairs[p], kept_[static_cast<std::size_t>(start)].end);
                glances_[p] = glance(p, is_pressed_in);
                glances_[p].start = start;
            }
        },
        grain);
    outcomes_.clear();
    for (std::size_t p = range.begin; p < range.end; ++p)
        if (glances_[p].may_act) outcomes_.push_back({.pair = p});
    ending_.resize(outcomes_.size());
    parallel_ranges(
        std::ssize(outcomes_),
        [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            const IndexRange some{static_cast<std::size_t>(begin), static_cast<std::size_t>(end)};
            take_forces(some, pairs, x_0, x_1, take);
            for (std::size_t i = some.begin; i < some.end; ++i)
                conclude(pairs[outcomes_[i].pair], sides, x_0, x_1, take, outcomes_[i]);
        },
        grain);
}

template <int Dim>
template <class GlanceAt>
void PairPotential<Dim>::find_outcomes(Pairs pairs, const SideOutlines<Dim>* sides, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                       TakenForce take, const GlanceAt& glance) {
    glances_.resize(pairs.size());
    if (!shared_.is_worth(pairs.size())) return find_part({0, pairs.size()}, pairs, sides, x_0, x_1, take, glance);
    std::vector<Outcome> all;
    shared_.run(
        pairs.size(),
        [&](const IndexRange& mine, ShareWriter& out) {
            find_part(mine, pairs, sides, x_0, x_1, take, glance);
            write(mine, out);
        },
        [&](const IndexRange& range, ShareReader& in) { read(range, in, all); });
    outcomes_ = std::move(all);
}

template <int Dim>
void PairPotential<Dim>::write(const IndexRange& range, ShareWriter& out) const {
    for (std::size_t p = range.begin; p < range.end; ++p) {
        out.put(glances_[p].admitted);
        out.put(glances_[p].inadmissible);
    }
    out.put(static_cast<std::size_t>(std::ranges::count_if(outcomes_, &Outcome::active)));
    for (const Outcome& outcome : outcomes_) {
        if (!outcome.active) continue;
        out.put(outcome.pair);
        out.put(outcome.interference_work);
        for_each_value(outcome.found, [&](const auto& value) { out.put(value); });
    }
}

template <int Dim>
void PairPotential<Dim>::read(const IndexRange& range, ShareReader& in, std::vector<Outcome>& outcomes) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
        glances_[p].admitted = in.get<bool>();
        glances_[p].inadmissible = in.get<bool>();
    }
    const auto n_active = in.get<std::size_t>();
    for (std::size_t i = 0; i < n_active; ++i) {
        Outcome& outcome = outcomes.emplace_back();
        outcome.pair = in.get<std::size_t>();
        outcome.active = true;
        outcome.interference_work = in.get<double>();
        for_each_value(outcome.found, [&](auto& value) { value = in.get<std::remove_reference_t<decltype(value)>>(); });
    }
}

template <int Dim>
std::int64_t PairPotential<Dim>::apply(const NodalSurface<Dim>& surface, const SideOutlines<Dim>& sides,
                                       NodalPairs<Dim>& listed, std::span<PairMemory> memory, FacetStore& facets, double dt,
                                       PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take, NodalStep<Dim>& step) {
    const auto pairs = listed.in_reach(x_0, x_1, memory);
    find_resting_nodes(listed.nodes(), x_0);
    find_outcomes(pairs, &sides, x_0, x_1, take, [&](std::size_t p, bool is_pressed_in) {
        return glance_at_step(pairs[p], memory[pairs[p].memory].admitted, is_pressed_in, x_0, x_1);
    });
    std::swap(kept_, ending_);
    leave_nodes(listed.nodes(), x_1);
    for (std::size_t p = 0; p < pairs.size(); ++p) memory[pairs[p].memory].admitted = glances_[p].admitted;
    add_up(surface, listed, pairs, x_0, x_1, step);
    if (friction_.any()) add_friction(surface, pairs, facets, dt, x_0, x_1, take, step);
    finish(surface, step);
    return std::ranges::count_if(glances_, &Glance::inadmissible);
}

template <int Dim>
void PairPotential<Dim>::evaluate(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed,
                                  std::span<const PairMemory> memory, const FacetStore& facets, PointsView<Dim> x,
                                  NodalStep<Dim>& step) {
    const auto pairs = listed.in_reach(x);
    find_resting_nodes(listed.nodes(), x);
    find_outcomes(pairs, nullptr, x, x, TakenForce::end, [&](std::size_t p, bool is_pressed_in) {
        const bool admitted = memory[pairs[p].memory].admitted;
        const auto is_unclear = [&] {
            return geometry::pair_placement<Dim>(pairs[p].at(x), pairs[p].law).place == PairPlace::unclear;
        };
        return Glance{.admitted = admitted, .may_act = admitted && (is_pressed_in || is_unclear()), .is_decided = true};
    });
    add_up(surface, listed, pairs, x, x, step);
    if (friction_.any()) {
        friction_.begin(0.0, x, x, TakenForce::end);
        add_pairs(surface, pairs);
        friction_.evaluate(surface, facets, step);
    }
    finish(surface, step);
}

template <int Dim>
void PairPotential<Dim>::add_up(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed, Pairs pairs,
                                PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step) const {
    clear_step(listed, step);
    double forces = 0.0;
    for (const Outcome& outcome : outcomes_) {
        if (!outcome.active) continue;
        const NodalPair<Dim>& pair = pairs[outcome.pair];
        const auto& found = outcome.found;
        if (!is_usable(magnitudes<Dim>(found))) refuse_pair<Dim>(surface, pair, found, x_0, x_1);
        for (std::size_t v = 0; v < pair.listed.size(); ++v) step.gradient[pair.listed[v]] += found.gradient[v];
        step.energy_0 += found.energy_0;
        step.energy += found.energy_1;
        step.interference_work += outcome.interference_work;
        add_to_body(pair, 0, found.gradient, x_0, x_1, step.bodies[pair.body_1]);
        add_to_body(pair, Dim, found.gradient, x_0, x_1, step.bodies[pair.body_2]);
        add_pair(surface, pair, outcome, step);
        forces += step.pairs.back().force.norm();
    }
    if (forces > 0.0) step.report.correction /= forces;
}

template <int Dim>
void PairPotential<Dim>::add_friction(const NodalSurface<Dim>& surface, Pairs pairs, FacetStore& facets, double dt,
                                      PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take, NodalStep<Dim>& step) {
    friction_.begin(dt, x_0, x_1, take);
    add_pairs(surface, pairs);
    friction_.apply(surface, facets, step);
}

template <int Dim>
void PairPotential<Dim>::add_pairs(const NodalSurface<Dim>& surface, Pairs pairs) {
    for (const Outcome& outcome : outcomes_)
        if (const auto& found = outcome.found; outcome.active)
            friction_.add(surface, pairs[outcome.pair], found.pressure, found.area, found.active_share);
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
    const Vector<Dim> force = force_on_second<Dim>(found.gradient), normal = found.normal.normalized();
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
    if (found.facing > far_tilted) ++report.tilted_pairs;
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
