#include "abut/input/patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/input/values.hpp"

namespace abut::input {
namespace {

constexpr double most_copies = 100000.0;  // of one pattern

/// Motion of one copy from where its body is.
struct Copy {
    std::string number;                    ///< "_0_3", which ends its name
    Vector<3> offset = Vector<3>::Zero();  ///< [m]
    Vector<3> turn = Vector<3>::Zero();    ///< axis times angle [rad]
    std::optional<Vector<3>> centre;       ///< about which it is turned with its velocity; nothing: about its own origin
};

/// A turn after another one, in space or about z.
Vector<3> turned(const Vector<3>& first, const Vector<3>& then, int dimension) {
    if (dimension == 2 || first.isZero(0.0) || then.isZero(0.0)) return first + then;
    return rotation_vector(rotation<3>(then) * rotation<3>(first));
}

std::vector<Copy> in_a_row(const PatternSettings& pattern) {
    std::vector<Copy> copies;
    for (int i = 0; i < pattern.count[0]; ++i) {
        copies.push_back({.number = fmt::format("_{}", i), .offset = i * *pattern.step, .centre = {}});
        if (i % 2 == 1 && pattern.shift) copies.back().offset += *pattern.shift;
    }
    return copies;
}

/// The last direction is that of courses, every second of which is shifted.
std::vector<Copy> in_a_grid(const PatternSettings& pattern) {
    const std::size_t last = pattern.count.size() - 1;
    std::vector<Copy> copies;
    std::vector<int> at(pattern.count.size(), 0);
    while (at[last] < pattern.count[last]) {
        Copy copy;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const auto along = static_cast<std::ptrdiff_t>(i);
            copy.number += fmt::format("_{}", at[i]);
            copy.offset[along] = at[i] * (*pattern.step)[along];
        }
        if (at[last] % 2 == 1 && pattern.shift) copy.offset += *pattern.shift;
        copies.push_back(std::move(copy));
        ++at[0];
        for (std::size_t i = 0; i < last && at[i] == pattern.count[i]; ++i) {
            at[i] = 0;
            ++at[i + 1];
        }
    }
    return copies;
}

std::vector<Copy> in_a_ring(const PatternSettings& pattern) {
    const int n = pattern.count[0];
    const Vector<3> angle = pattern.angle.value_or(Vector<3>(0.0, 0.0, 2.0 * std::numbers::pi / n));
    std::vector<Copy> copies;
    for (int i = 0; i < n; ++i)
        copies.push_back({.number = fmt::format("_{}", i), .turn = i * angle, .centre = pattern.centre});
    return copies;
}

std::vector<Copy> at_places(const PatternSettings& pattern) {
    std::vector<Copy> copies;
    for (std::size_t i = 0; i < pattern.places.size(); ++i) {
        copies.push_back({.number = fmt::format("_{}", i), .offset = pattern.places[i], .centre = {}});
        if (!pattern.turns.empty()) copies.back().turn = pattern.turns[i];
    }
    return copies;
}

std::vector<Copy> copies_of(const PatternSettings& pattern) {
    if (!pattern.places.empty()) return at_places(pattern);
    if (pattern.centre) return in_a_ring(pattern);
    return pattern.count.size() == 1 ? in_a_row(pattern) : in_a_grid(pattern);
}

double number_of_copies(const PatternSettings& pattern) {
    if (!pattern.places.empty()) return static_cast<double>(pattern.places.size());
    double n = 1.0;
    for (const int count : pattern.count) n *= count;
    return n;
}

void turn_about(BodySettings& body, const Vector<3>& centre, const Vector<3>& turn) {
    if (turn.isZero(0.0)) return;
    const Matrix<3> by = rotation<3>(turn);
    body.place = centre + by * (body.place - centre);
    const auto turn_motion = [&](BodySettings& moving) {
        moving.velocity = by * moving.velocity;
        moving.spin = by * moving.spin;
    };
    turn_motion(body);
    std::ranges::for_each(body.parts, turn_motion);
}

BodySettings placed(const BodySettings& body, const Copy& copy, int index, const PatternSettings& pattern, int dimension) {
    BodySettings made = body;
    made.name += copy.number;
    made.pattern = pattern.path;
    made.pattern_where = pattern.where;
    made.n_copies = number_of_copies(pattern);
    made.variant += index;
    made.turn = turned(body.turn, copy.turn, dimension);
    made.place += copy.offset;
    if (copy.centre) turn_about(made, *copy.centre, copy.turn);
    return made;
}

/// Names of bodies and the copies that stand for them.
using Copies = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// A name as those of all copies; `name` may go on behind that of the body, "brick.ymin".
std::vector<std::string> names_of_copies(const std::string& name, const Copies& copies) {
    for (const auto& [body, names] : copies)
        if (name == body || name.starts_with(body + ".")) {
            std::vector<std::string> all;
            for (const std::string& copy : names) all.push_back(copy + name.substr(body.size()));
            return all;
        }
    return {name};
}

/// Each load on a group of a body that is copied becomes one on each copy.
template <class Load>
void spread(std::vector<Load>& loads, const Copies& copies) {
    std::vector<Load> all;
    for (const Load& load : loads)
        for (std::string& group : names_of_copies(load.group, copies)) {
            all.push_back(load);
            all.back().group = std::move(group);
        }
    loads = std::move(all);
}

void spread(std::vector<IgnoredPair>& pairs, const Copies& copies) {
    std::vector<IgnoredPair> all;
    for (const IgnoredPair& pair : pairs)
        for (const std::string& first : names_of_copies(pair.names[0], copies))
            for (const std::string& second : names_of_copies(pair.names[1], copies))
                if (pair.names[0] != pair.names[1] || first < second || first == pair.names[0])
                    all.push_back({{first, second}, pair.where});
    pairs = std::move(all);
}

bool has_copies(const std::string& name, const Copies& copies) {
    return std::ranges::any_of(copies, [&](const auto& of) { return name == of.first || name.starts_with(of.first + "."); });
}

void mark_if_of_copies(PairSettings&, const std::vector<std::string>&, const Copies&) {}
void mark_if_of_copies(BondSettings& bond, const std::vector<std::string>& sides, const Copies& copies) {
    bond.is_of_copies = std::ranges::any_of(sides, [&](const std::string& side) { return has_copies(side, copies); });
}

/// Two sides, of which the first ones are bodies or obstacles.
template <class Pair>
void spread_pairs(std::vector<Pair>& pairs, const Copies& copies) {
    std::vector<Pair> all;
    for (const Pair& pair : pairs) {
        std::vector<std::string> sides = pair.bodies;
        sides.insert(sides.end(), pair.groups.begin(), pair.groups.end());
        const auto n_bodies = static_cast<std::ptrdiff_t>(pair.bodies.size());
        for (const std::string& first : names_of_copies(sides[0], copies))
            for (const std::string& second : names_of_copies(sides[1], copies)) {
                if (sides[0] == sides[1] && first >= second && first != sides[0]) continue;
                const std::array both{first, second};
                Pair one = pair;
                mark_if_of_copies(one, sides, copies);
                one.bodies.assign(both.begin(), both.begin() + n_bodies);
                one.groups.assign(both.begin() + n_bodies, both.end());
                all.push_back(std::move(one));
            }
    }
    pairs = std::move(all);
}

class Layout {
public:
    Layout(Settings& settings, Reader& reader) : settings_(settings), reader_(reader) {}

    void lay_out(const PatternSettings& pattern) {
        const auto body = std::ranges::find(settings_.bodies, pattern.body, &BodySettings::name);
        if (body == settings_.bodies.end()) return fault(pattern, no_body(pattern.body));
        const double n = number_of_copies(pattern);
        if (n > most_copies)
            return fault(pattern,
                         fmt::format("makes {:g} bodies, at most {:g} are made. Give smaller counts.", n, most_copies));
        std::vector<BodySettings> made;
        std::vector<std::string> names;
        for (const Copy& copy : copies_of(pattern)) {
            made.push_back(placed(*body, copy, static_cast<int>(made.size()), pattern, settings_.dim));
            names.push_back(made.back().name);
            if (std::ranges::find(settings_.bodies, names.back(), &BodySettings::name) != settings_.bodies.end())
                return fault(
                    pattern,
                    fmt::format("makes a body '{}', and there is a table of this name. Rename one of them.", names.back()));
        }
        copies_.emplace_back(pattern.body, std::move(names));
        const auto at = settings_.bodies.erase(body);
        settings_.bodies.insert(at, made.begin(), made.end());
    }

    void spread_all() {
        if (copies_.empty()) return;
        spread(settings_.ignored_pairs, copies_);
        spread_pairs(settings_.pairs, copies_);
        spread_pairs(settings_.bonds, copies_);
        spread(settings_.supports, copies_);
        spread(settings_.tractions, copies_);
    }

private:
    void fault(const PatternSettings& pattern, const std::string& text) {
        reader_.faults().push_back({pattern.where, pattern.path + " " + text});
    }
    [[nodiscard]] std::string no_body(const std::string& name) const {
        if (std::ranges::find(copies_, name, &Copies::value_type::first) != copies_.end())
            return fmt::format("copies body '{}', as another pattern does. Give each a body of its own.", name);
        std::vector<std::string> known;
        for (const BodySettings& body : settings_.bodies) known.push_back(body.name);
        return fmt::format("copies '{}', which is no table of [bodies].{}", name, hint(name, known));
    }

    Settings& settings_;
    Reader& reader_;
    Copies copies_;
};

}  // namespace

void lay_out_patterns(Settings& settings, Reader& reader) {
    Layout layout(settings, reader);
    for (const PatternSettings& pattern : settings.patterns) layout.lay_out(pattern);
    layout.spread_all();
}

}  // namespace abut::input
