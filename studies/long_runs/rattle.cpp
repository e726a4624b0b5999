#include "studies/long_runs/rattle.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "abut/base/disjoint_sets.hpp"

namespace abut::studies::long_runs {
namespace {

constexpr double stiffness = 100.0;         // of all springs [N/m]; the masses are 1 kg
constexpr double interaction_radius = 0.6;  // of a contact, more than the points of the ring are apart [m]
constexpr int n_ring = 24;                  // points on each of two circles
constexpr double inner_radius = 2.0, outer_radius = 2.4;

Vector<2> on_circle(double radius, double turns) {
    const double angle = 2.0 * std::numbers::pi * turns;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A hexagon of triangles of side 0.5, two rings around a point.
std::vector<Vector<2>> net_points() {
    std::vector<Vector<2>> points;
    for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j)
            if (std::abs(i + j) <= 2) points.emplace_back(0.5 * (i + 0.5 * j), 0.5 * std::sqrt(0.75) * j);
    return points;
}

std::vector<Vector<2>> ring_points() {
    std::vector<Vector<2>> points;
    for (int i = 0; i < n_ring; ++i) points.push_back(on_circle(inner_radius, i / double{n_ring}));
    for (int i = 0; i < n_ring; ++i) points.push_back(on_circle(outer_radius, (i + 0.5) / double{n_ring}));
    return points;
}

/// Whether two points of a body at rest are neighbours: those of the net by a side, those of the ring in its truss.
bool are_joined(const Vector<2>& a, const Vector<2>& b) { return (b - a).norm() < 0.7; }

}  // namespace

Rattle::Parts Rattle::make() {
    Parts parts;
    for (const Vector<2>& x : net_points()) parts.rest.push_back(x), parts.bodies.push_back(0);
    for (const Vector<2>& x : ring_points()) parts.rest.push_back(x), parts.bodies.push_back(1);
    const auto n = static_cast<std::int32_t>(parts.rest.size());
    for (std::int32_t a = 0; a < n; ++a)
        for (std::int32_t b = a + 1; b < n; ++b) {
            const Vector<2> r = parts.rest[static_cast<std::size_t>(b)] - parts.rest[static_cast<std::size_t>(a)];
            const bool same = parts.bodies[static_cast<std::size_t>(a)] == parts.bodies[static_cast<std::size_t>(b)];
            if (same && are_joined(Vector<2>::Zero(), r))
                parts.bonds.push_back({a, b, {.stiffness = stiffness, .length = r.norm()}, r});
            else if (!same && parts.rest[static_cast<std::size_t>(a)].norm() > 0.8 &&
                     parts.rest[static_cast<std::size_t>(b)].norm() < 0.5 * (inner_radius + outer_radius))
                parts.contacts.push_back(
                    {a, b, {.stiffness = stiffness, .length = interaction_radius, .one_sided = true}, r});
        }
    return parts;
}

Rattle::Rattle() : Rattle(make()) {}

Rattle::Rattle(Parts parts)
    : Particles(std::vector<double>(2 * parts.rest.size(), 1.0),
                [&] {
                    std::vector<dynamics::Bond<Strut>> all = parts.bonds;
                    all.insert(all.end(), parts.contacts.begin(), parts.contacts.end());
                    return all;
                }()),
      rest_(std::move(parts.rest)),
      bodies_(std::move(parts.bodies)),
      bonds_of_bodies_(std::move(parts.bonds)),
      contacts_(std::move(parts.contacts)),
      neighbours_(rest_.size()),
      masses_(rest_.size(), 1.0) {
    for (std::size_t i = 0; i < rest_.size(); ++i) neighbours_[i].push_back(static_cast<std::int32_t>(i));
    for (const auto& bond : bonds_of_bodies_) {
        neighbours_[static_cast<std::size_t>(bond.first)].push_back(bond.second);
        neighbours_[static_cast<std::size_t>(bond.second)].push_back(bond.first);
    }
}

std::vector<double> Rattle::momenta(const Vector<2>& velocity, double omega) const {
    const auto in_net = static_cast<double>(std::ranges::count(bodies_, 0));
    std::vector<double> p;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const Vector<2> spin(-omega * rest_[i].y(), omega * rest_[i].x());
        const Vector<2> back = -in_net / (static_cast<double>(rest_.size()) - in_net) * velocity;
        const Vector<2> v = bodies_[i] == 0 ? Vector<2>(velocity + spin) : back;
        p.insert(p.end(), {v.x(), v.y()});
    }
    return p;
}

double Rattle::highest_frequency() const {
    std::size_t most = 0;
    for (const auto& joined : neighbours_) most = std::max(most, joined.size() - 1);
    return std::sqrt(2.0 * stiffness * static_cast<double>(most));
}

bool Rattle::is_closed(const dynamics::Bond<Strut>& contact, std::span<const double> q) const {
    const auto u = as_vectors<2>(q);
    return (u[static_cast<std::size_t>(contact.second)] - u[static_cast<std::size_t>(contact.first)] + contact.offset)
               .norm() < interaction_radius;
}

void Rattle::mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                        std::span<double> force) {
    touching_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const bool at_start = is_closed(contacts_[i], q_0), at_end = is_closed(contacts_[i], q_1);
        if (at_start || at_end) touching_.push_back(static_cast<std::int32_t>(i));
        events_ += at_start != at_end ? 1 : 0;
    }
    Particles::mean_force(q_0, q_1, time, dt, force);
}

std::vector<dynamics::ContactPatch<2>> Rattle::contact_patches() const {
    DisjointSets joined(rest_.size());
    for (const std::int32_t index : touching_) {
        const auto& contact = contacts_[static_cast<std::size_t>(index)];
        for (const std::int32_t end : {contact.first, contact.second})
            for (const std::int32_t point : neighbours_[static_cast<std::size_t>(end)]) joined.join(contact.first, point);
    }
    std::map<std::int32_t, dynamics::ContactPatch<2>> patches;  // by their first point
    for (const std::int32_t index : touching_) patches[joined.find(contacts_[static_cast<std::size_t>(index)].first)];
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(rest_.size()); ++i)
        if (const auto patch = patches.find(joined.find(i)); patch != patches.end()) patch->second.points.push_back(i);
    std::vector<dynamics::ContactPatch<2>> result;
    for (auto& [first, patch] : patches) result.push_back(std::move(patch));
    return result;
}

void Rattle::end_force_on(std::span<const std::int32_t> points, std::span<const double> q, std::span<Vector<2>> on_points) {
    force_.resize(size());
    force(q, force_);
    for (std::size_t k = 0; k < points.size(); ++k)
        on_points[k] = as_vectors<2>(std::span<const double>(force_))[static_cast<std::size_t>(points[k])];
}

}  // namespace abut::studies::long_runs
