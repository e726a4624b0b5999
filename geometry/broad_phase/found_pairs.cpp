#include "abut/geometry/broad_phase/found_pairs.hpp"

#include <algorithm>

#include "abut/geometry/broad_phase/sort_pairs.hpp"

namespace abut::geometry {
namespace {

// The first chunk is small: most searches of a small scene find next to nothing.
constexpr std::size_t size_of_chunk(std::size_t chunk) { return std::size_t{64} << std::min<std::size_t>(chunk, 8); }

}  // namespace

bool FoundPairs::Local::begin_chunk() {
    if (!chunks_.empty()) all_->in_full_chunks_ += static_cast<std::int64_t>(chunks_.back().size());
    if (too_many()) {
        // what comes is dropped; the count stays above the limit
        chunks_.clear();
        return false;
    }
    left_ = size_of_chunk(chunks_.size());
    chunks_.emplace_back().reserve(left_);
    return true;
}

FoundPairs::Local& FoundPairs::local() {
    Local& mine = locals_.local();
    mine.all_ = this;
    return mine;
}

std::int64_t FoundPairs::count() const {
    if (too_many()) return in_full_chunks_;
    std::int64_t n = 0;
    for (const Local& local : locals_)
        for (const auto& chunk : local.chunks_) n += static_cast<std::int64_t>(chunk.size());
    return n;
}

std::vector<IndexPair> FoundPairs::sorted(std::size_t n_first) {
    std::vector<IndexPair> pairs = sorted_pairs(static_cast<std::size_t>(count()), n_first, [this](const auto& use) {
        for (const Local& local : locals_)
            for (const auto& chunk : local.chunks_)
                for (const IndexPair& pair : chunk) use(pair);
    });
    locals_.clear();
    return pairs;
}

}  // namespace abut::geometry
