#include "abut/contact/pair_store.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"

namespace abut::contact {

const PairMemory* PairStore::find(FacetPair pair) const {
    const auto at = std::ranges::lower_bound(pairs_, pair);
    return at != pairs_.end() && *at == pair ? &memory_[static_cast<std::size_t>(at - pairs_.begin())] : nullptr;
}

void PairStore::follow(std::span<const FacetPair> pairs, const std::function<PairMemory(std::size_t)>& of_new) {
    std::vector<FacetPair> followed(pairs.begin(), pairs.end());
    std::vector<PairMemory> memory;
    memory.reserve(pairs.size());
    std::size_t known = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        assert(i == 0 || pairs[i - 1] < pairs[i]);
        while (known < pairs_.size() && pairs_[known] < pairs[i]) ++known;
        const bool is_known = known < pairs_.size() && pairs_[known] == pairs[i];
        memory.push_back(is_known ? memory_[known] : of_new(i));
    }
    pairs_ = std::move(followed);
    memory_ = std::move(memory);
}

PairStore PairStore::carried_over(std::span<const std::int32_t> old_of_new,
                                  const std::function<bool(FacetPair)>& is_kept) const {
    constexpr std::int32_t gone = -1;
    std::vector<std::int32_t> new_of_old;
    for (std::size_t facet = 0; facet < old_of_new.size(); ++facet) {
        if (old_of_new[facet] < 0) continue;
        const auto old = static_cast<std::size_t>(old_of_new[facet]);
        if (old >= new_of_old.size()) new_of_old.resize(old + 1, gone);
        new_of_old[old] = static_cast<std::int32_t>(facet);
    }
    const auto new_number = [&](Facet old) {
        const auto i = static_cast<std::size_t>(old);
        return i < new_of_old.size() ? new_of_old[i] : gone;
    };
    std::vector<std::pair<FacetPair, PairMemory>> known;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const auto [facet_1, facet_2] = std::minmax({new_number(pairs_[p].facet_1), new_number(pairs_[p].facet_2)});
        if (const FacetPair pair{Facet{facet_1}, Facet{facet_2}}; facet_1 != gone && is_kept(pair))
            known.emplace_back(pair, memory_[p]);
    }
    std::ranges::sort(known, {}, &std::pair<FacetPair, PairMemory>::first);
    PairStore carried;
    for (const auto& [pair, memory] : known) {
        carried.pairs_.push_back(pair);
        carried.memory_.push_back(memory);
    }
    return carried;
}

void PairStore::save(StateWriter& state) const {
    state.put(static_cast<std::uint64_t>(pairs_.size()));
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        state.put(number_of(pairs_[i].facet_1));
        state.put(number_of(pairs_[i].facet_2));
        state.put(static_cast<std::uint8_t>(memory_[i].admitted));
        state.put(memory_[i].offset);
    }
}

PairStore PairStore::restored(StateReader& state, std::int32_t n_facets) {
    PairStore store;
    const auto n = state.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < n; ++i) {  // `get` refuses to read past the end, whatever n claims
        const FacetPair pair{Facet{state.get<std::int32_t>()}, Facet{state.get<std::int32_t>()}};
        const auto admitted = state.get<std::uint8_t>();
        const auto offset = state.get<double>();
        const bool is_in_range =
            number_of(pair.facet_1) >= 0 && pair.facet_1 < pair.facet_2 && number_of(pair.facet_2) < n_facets;
        if (!is_in_range || admitted > 1 || !(offset >= 0.0) || (!store.pairs_.empty() && !(store.pairs_.back() < pair)))
            throw BadInput("pair store: pair " + std::to_string(i) + " of a saved state, facets " +
                               std::to_string(number_of(pair.facet_1)) + " and " + std::to_string(number_of(pair.facet_2)) +
                               " of " + std::to_string(n_facets) + ", is out of range or out of order.",
                           {.face_1 = number_of(pair.facet_1), .face_2 = number_of(pair.facet_2)});
        store.pairs_.push_back(pair);
        store.memory_.push_back({.admitted = admitted == 1, .offset = offset});
    }
    return store;
}

}  // namespace abut::contact
