#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/contact/surface.hpp"

namespace abut::contact {

/// What a pair of faces remembers from step to step. Laws with a history (friction: stick) get their fields here.
struct PairMemory {
    /// Whether A > 0 and g < 0 means contact; decided only where A min(g, 0) = 0. docs/method.md, Contact.
    bool admitted = false;

    friend bool operator==(const PairMemory&, const PairMemory&) = default;
};

/// Two faces of a surface, face_1 < face_2.
struct FacePair {
    SurfaceFace face_1;
    SurfaceFace face_2;

    friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// What the pairs of a surface remember, by (face_1, face_2). It outlives candidate lists: a pair that stays in the list from
/// one search to the next keeps its memory, one that leaves the list loses it (else it would come back active from the
/// side). It can be saved and restored.
class PairStore {
public:
    [[nodiscard]] std::span<const FacePair> pairs() const { return pairs_; }  ///< increasing, each once
    [[nodiscard]] std::span<PairMemory> memory() { return memory_; }          ///< in the order of `pairs`
    [[nodiscard]] std::span<const PairMemory> memory() const { return memory_; }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(pairs_.size()); }
    /// The memory of a pair; null if it has none.
    [[nodiscard]] const PairMemory* find(FacePair pair) const;

    /// Replaces the pairs of the store by these, increasing and each once: known ones keep their memory, new ones get
    /// `of_new(i)`. After an exception the store is as it was.
    void follow(std::span<const FacePair> pairs, const std::function<PairMemory(std::size_t i)>& of_new);

    /// Appends the store to a state, and reads it from there; `n_faces` is the size of the surface. Throws BadInput for pairs
    /// out of order or range.
    void save(StateWriter& state) const;
    [[nodiscard]] static PairStore restored(StateReader& state, std::int32_t n_faces);

    friend bool operator==(const PairStore&, const PairStore&) = default;

private:
    std::vector<FacePair> pairs_;
    std::vector<PairMemory> memory_;
};

}  // namespace abut::contact
