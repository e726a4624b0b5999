#include "abut/contact/pair_store.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"

namespace abut::contact {

const PairMemory* PairStore::find(FacePair pair) const {
    const auto at = std::ranges::lower_bound(pairs_, pair);
    return at != pairs_.end() && *at == pair ? &memory_[static_cast<std::size_t>(at - pairs_.begin())] : nullptr;
}

void PairStore::follow(std::span<const FacePair> pairs, const std::function<PairMemory(std::size_t)>& of_new) {
    std::vector<FacePair> followed(pairs.begin(), pairs.end());
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

void PairStore::save(StateWriter& state) const {
    state.put(static_cast<std::uint64_t>(pairs_.size()));
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        state.put(number_of(pairs_[i].face_1));
        state.put(number_of(pairs_[i].face_2));
        state.put(static_cast<std::uint8_t>(memory_[i].admitted));
    }
}

PairStore PairStore::restored(StateReader& state, std::int32_t n_faces) {
    PairStore store;
    const auto n = state.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < n; ++i) {  // `get` refuses to read past the end, whatever n claims
        const FacePair pair{SurfaceFace{state.get<std::int32_t>()}, SurfaceFace{state.get<std::int32_t>()}};
        const auto admitted = state.get<std::uint8_t>();
        const bool is_in_range =
            number_of(pair.face_1) >= 0 && pair.face_1 < pair.face_2 && number_of(pair.face_2) < n_faces;
        if (!is_in_range || admitted > 1 || (!store.pairs_.empty() && !(store.pairs_.back() < pair)))
            throw BadInput("pair store: pair " + std::to_string(i) + " of a saved state, faces " +
                               std::to_string(number_of(pair.face_1)) + " and " + std::to_string(number_of(pair.face_2)) +
                               " of " + std::to_string(n_faces) + ", is out of range or out of order.",
                           {.face_1 = number_of(pair.face_1), .face_2 = number_of(pair.face_2)});
        store.pairs_.push_back(pair);
        store.memory_.push_back({.admitted = admitted == 1});
    }
    return store;
}

}  // namespace abut::contact
