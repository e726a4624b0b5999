#include "abut/ranks/same_values.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "abut/base/messages.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

[[noreturn]] void refuse(const NamedValue& mine, int rank, double of_first) {
    throw BadInput("ranks: " + mine.name + " is " + exact_number(mine.value) + " on rank " + std::to_string(rank) + " and " +
                       exact_number(of_first) + " on rank 0. Give all ranks the same.",
                   {.value = mine.value, .allowed = of_first});
}

}  // namespace

void require_same(const Communicator& communicator, std::span<const NamedValue> values) {
    std::array<std::int64_t, 1> n{std::ssize(values)};
    broadcast<std::int64_t>(communicator, n);
    std::vector<double> of_first(static_cast<std::size_t>(n[0]));
    if (communicator.rank() == 0) std::ranges::transform(values, of_first.begin(), &NamedValue::value);
    broadcast<double>(communicator, of_first);
    agreed(communicator, [&] {
        for (std::size_t i = 0; i < std::min(values.size(), of_first.size()); ++i)
            if (std::bit_cast<std::uint64_t>(values[i].value) != std::bit_cast<std::uint64_t>(of_first[i]))
                refuse(values[i], communicator.rank(), of_first[i]);
    });
}

std::vector<NamedValue> named_values(const contact::NodalOptions& options) {
    const contact::CandidateOptions& search = options.search;
    std::vector<NamedValue> values{
        {"the option search.broad_phase", static_cast<double>(search.broad_phase)},
        {"the option search.facing_cosine", search.facing_cosine},
        {"the option search.distance", search.distance},
        {"the option search.skin", search.skin},
        {"the option search.self_contact", search.self_contact ? 1.0 : 0.0},
        {"the option search.self_contact_rings", static_cast<double>(search.self_contact_rings)},
        {"the option search.largest_motion", search.largest_motion},
        {"the option search.limits.pairs", static_cast<double>(search.limits.pairs)},
        {"the option search.limits.bytes", static_cast<double>(search.limits.bytes)},
        {"the option facing.full", options.facing.full},
        {"the option facing.none", options.facing.none},
        {"the option events", options.events ? 1.0 : 0.0},
        {"the option gauss", options.gauss ? 1.0 : 0.0},
        {"the option compression_warning", options.compression_warning},
        {"the option compression_limit", options.compression_limit},
        {"the number of functions `wanted`", options.wanted ? 1.0 : 0.0},
        {"the number of functions friction.law_of", options.friction.law_of ? 1.0 : 0.0},
        {"the number of functions interference.of", options.interference.of ? 1.0 : 0.0},
        {"the number of times in interference.times", static_cast<double>(options.interference.times.size())},
        {"the number of laws in friction.laws", static_cast<double>(options.friction.laws.size())},
        {"the number of pairs in search.ignored_bodies", static_cast<double>(search.ignored_bodies.size())}};
    for (const auto& [body_1, body_2] : search.ignored_bodies) {
        values.push_back({"a body in search.ignored_bodies", static_cast<double>(body_1)});
        values.push_back({"a body in search.ignored_bodies", static_cast<double>(body_2)});
    }
    for (const double time : options.interference.times) values.push_back({"a time in interference.times", time});
    for (const contact::Friction& law : options.friction.laws) {
        for (const Option<contact::Friction>& option : contact::friction_options())
            values.push_back({"the option " + option.name + " of a law of friction", std::get<double>(option.get(law))});
        values.push_back({"the number of functions own_coefficient of a law", law.own_coefficient ? 1.0 : 0.0});
    }
    return values;
}

bool is_same(const Communicator& communicator, std::uint64_t checksum) {
    const auto mine = static_cast<double>(checksum >> 11);  // exact: a double has 53 bits
    std::array<double, 2> range{mine, -mine};
    take_largest(communicator, range);
    return range[0] == -range[1];
}

}  // namespace abut::ranks
