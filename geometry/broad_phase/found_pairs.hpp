#pragma once
// Private to the broad-phase sources; not installed.
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::geometry {

/// Pairs as several threads find them, in chunks. Once there are more than allowed, the rest is not kept.
class FoundPairs {
public:
    FoundPairs(std::int64_t most, PairFilter wanted) : most_(most), wanted_(std::move(wanted)) {}

    /// Pairs that one thread finds.
    class Local {
    public:
        void add(std::int32_t first, std::int32_t second) {
            if (all_->wanted_ && !all_->wanted_(first, second)) return;
            if (left_ == 0 && !begin_chunk()) return;
            chunks_.back().push_back({first, second});
            --left_;
        }
        /// More than allowed have been found: the search may end.
        [[nodiscard]] bool too_many() const { return all_->too_many(); }

    private:
        friend class FoundPairs;
        bool begin_chunk();

        FoundPairs* all_ = nullptr;
        std::size_t left_ = 0;  // room in the last chunk
        std::vector<std::vector<IndexPair>> chunks_;
    };

    /// Pairs of the calling thread.
    [[nodiscard]] Local& local();
    [[nodiscard]] bool too_many() const { return in_full_chunks_.load(std::memory_order_relaxed) > most_; }
    /// All that were added, duplicates included; at least that many if there are too many.
    [[nodiscard]] std::int64_t count() const;
    /// Moves the pairs out, sorted, each once; `first` lies in [0, n_first).
    [[nodiscard]] std::vector<IndexPair> sorted(std::size_t n_first);

private:
    std::int64_t most_;
    PairFilter wanted_;
    std::atomic<std::int64_t> in_full_chunks_ = 0;
    oneapi::tbb::enumerable_thread_specific<Local> locals_;
};

}  // namespace abut::geometry
