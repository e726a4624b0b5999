// What a solid and its parts remember from one step to the next, as bytes.
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/load/frame_loads.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/load/point_loads.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr std::uint32_t version = 12;

template <int Dim>
std::string kind() {
    return "solid " + std::to_string(Dim) + "D";
}

/// Fingerprint of positions and masses of the points, whatever ranks they are on: the arrays inside are checked where
/// they are read.
template <int Dim>
std::uint64_t fingerprint(std::span<const Vector<Dim>> rest, std::span<const double> masses, const dynamics::Ranks& ranks) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
        Checksum checksum;
        const std::int32_t number = ranks.number_of(i);
        checksum.add_values(std::span(&number, 1));
        checksum.add_values(std::span<const double>(rest[i].data(), Dim));
        checksum.add_values(masses.subspan(i, 1));
        sum += checksum.value();
    }
    constexpr int half = 32;  // of the bits: so many fit into a double
    const std::vector<double> halves = ranks.gather(
        std::vector{static_cast<double>(sum >> half), static_cast<double>(sum & ((std::uint64_t{1} << half) - 1))});
    sum = 0;
    for (std::size_t i = 0; i < halves.size(); i += 2)
        sum += (static_cast<std::uint64_t>(halves[i]) << half) + static_cast<std::uint64_t>(halves[i + 1]);
    return sum;
}

}  // namespace

template <int Dim>
std::vector<std::byte> Solid<Dim>::state() const {
    StateWriter state(kind<Dim>(), version);
    state.put(fingerprint<Dim>(rest_positions(), masses(), ranks()));
    state.put(time_);
    state.put(work_);
    state.put(evaluations_);
    put_value(state, finite_extremes_);
    loads_->save(state);
    point_loads_->save(state);
    outside_->save(state);
    bodies_->rigid().save(state, *part_);
    save_memory(state);
    if (bonds_->any()) {
        state.put(dissipated_.in_bonds);
        state.put(dissipated_.at_splits);
        bonds_->save(state);
    }
    state.put(static_cast<std::uint8_t>(contact_ != nullptr));
    if (!contact_) return std::move(state).finish();
    state.put_all(std::span<const std::byte>(contact_->state()));
    const auto impulses = contact_->impulses();
    put_value(state, std::vector(impulses.begin(), impulses.end()));
    return std::move(state).finish();
}

template <int Dim>
void Solid<Dim>::restore(std::span<const std::byte> bytes, std::span<const double> q) {
    StateReader state(bytes, kind<Dim>(), version);
    if (state.get<std::uint64_t>() != fingerprint<Dim>(rest_positions(), masses(), ranks()))
        throw BadInput(mesh_.name +
                       ": the saved state is of bodies of another mesh or of other masses. Restore it where mesh, "
                       "materials and kinematics are the same.");
    time_ = state.get<double>();
    work_ = state.get<double>();
    evaluations_ = state.get<std::int64_t>();
    get_value(state, finite_extremes_);
    loads_->restore(state);
    if (frame_loads_->any()) frame_loads_->take(loads_->end());
    point_loads_->restore(state);
    outside_->restore(state);
    bodies_->rigid().restore(state);
    restore_memory(state);
    if (bonds_->any()) {
        dissipated_.in_bonds = state.get<double>();
        dissipated_.at_splits = state.get<double>();
        bonds_->restore(state);
        unite_frames();
    }
    if ((state.get<std::uint8_t>() != 0) != (contact_ != nullptr))
        throw BadInput(mesh_.name + ": the saved state is of a solid " + (contact_ ? "without" : "with") +
                       " contact, and this one is not.");
    if (contact_) {
        const auto u = state_here(q);
        frames_->stand_at(of_cells(u));
        contact_->restore(state.get_all<std::byte>(), u, time_);
        std::vector<BodyImpulse<Dim>> impulses;
        get_value(state, impulses);
        contact_->restore_impulses(std::move(impulses));
    }
    state.finish();
}

template <int Dim>
void Solid<Dim>::begin_run() {
    time_ = work_ = 0.0;
    dissipated_ = {};
    evaluations_ = 0;
    finite_extremes_ = {};
    outside_->clear_work();
    if (!contact_) return;
    contact_->clear_report();
    contact_->restore_impulses({});
}

/// Writes how many numbers each cell remembers, and all of them, in the order of the cells of all ranks.
template <int Dim>
void Solid<Dim>::save_memory(StateWriter& state) const {
    for (double dynamics::Losses::*of : losses_of_cells) state.put(dissipated_.*of);
    const auto n_cells = static_cast<std::size_t>(part_->n_all_cells());
    if (!any_memory()) {
        state.put_all(std::span<const std::int32_t>());
        state.put_all(std::span<const double>());
        return;
    }
    const std::vector<std::int32_t> sizes = ccg_.memory_sizes();
    const std::vector<double> memory = ccg_.memory();
    if (part_->is_whole()) {
        state.put_all(std::span<const std::int32_t>(sizes));
        state.put_all(std::span<const double>(memory));
        return;
    }
    std::vector<double> rows;  // of own cells: number, size, values
    std::size_t at = 0, own = 0;
    for (std::size_t c = 0; c < sizes.size(); ++c) {
        const auto size = static_cast<std::size_t>(sizes[c]);
        if (own < part_->own_cells().size() && static_cast<std::size_t>(part_->own_cells()[own]) == c) {
            ++own;
            rows.push_back(part_->cell_numbers()[c]);
            rows.push_back(sizes[c]);
            rows.insert(rows.end(), memory.begin() + at, memory.begin() + at + size);
        }
        at += size;
    }
    const std::vector<double> all = ranks().gather(rows);
    std::vector<std::int32_t> all_sizes(n_cells);
    std::vector<std::size_t> row_of(n_cells);
    for (std::size_t row = 0; row < all.size(); row += 2 + static_cast<std::size_t>(all[row + 1])) {
        all_sizes[static_cast<std::size_t>(all[row])] = static_cast<std::int32_t>(all[row + 1]);
        row_of[static_cast<std::size_t>(all[row])] = row;
    }
    std::vector<double> values;
    for (std::size_t c = 0; c < n_cells; ++c)
        values.insert(values.end(), all.begin() + row_of[c] + 2, all.begin() + row_of[c] + 2 + all_sizes[c]);
    state.put_all(std::span<const std::int32_t>(all_sizes));
    state.put_all(std::span<const double>(values));
}

template <int Dim>
void Solid<Dim>::restore_memory(StateReader& state) {
    for (double dynamics::Losses::*of : losses_of_cells) dissipated_.*of = state.get<double>();
    const auto sizes = state.get_all<std::int32_t>();
    const auto values = state.get_all<double>();
    const std::vector<std::int32_t> here = any_memory() ? ccg_.memory_sizes() : std::vector<std::int32_t>();
    const auto number = [&](std::size_t c) {
        return part_->is_whole() ? c : static_cast<std::size_t>(part_->cell_numbers()[c]);
    };
    bool fits = sizes.empty() == here.empty();
    for (std::size_t c = 0; fits && c < here.size(); ++c) fits = number(c) < sizes.size() && sizes[number(c)] == here[c];
    if (!fits)
        throw BadInput(mesh_.name +
                       ": the saved state is of materials that remember other things. Restore it where laws of materials "
                       "are the same.");
    if (here.empty()) return;
    std::vector<std::size_t> begin(sizes.size() + 1, 0);
    for (std::size_t c = 0; c < sizes.size(); ++c) begin[c + 1] = begin[c] + static_cast<std::size_t>(sizes[c]);
    std::vector<double> memory;
    for (std::size_t c = 0; c < here.size(); ++c)
        memory.insert(memory.end(), values.begin() + begin[number(c)], values.begin() + begin[number(c)] + here[c]);
    ccg_.set_memory(memory);
}

#define ABUT_INSTANTIATE(Dim)                                                               \
    template std::vector<std::byte> Solid<Dim>::state() const;                              \
    template void Solid<Dim>::restore(std::span<const std::byte>, std::span<const double>); \
    template void Solid<Dim>::save_memory(StateWriter&) const;                              \
    template void Solid<Dim>::restore_memory(StateReader&);                                 \
    template void Solid<Dim>::begin_run();
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
