#include "abut/geometry/found_pairs.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "abut/geometry/sort_unique.hpp"

namespace abut::geometry {
namespace {

// The first chunk is small: most searches of a small scene find next to nothing.
constexpr std::size_t size_of_chunk(std::size_t chunk) { return std::size_t{64} << std::min<std::size_t>(chunk, 8); }

// Below this many pairs a row, counting rows costs more than a general sort.
constexpr std::size_t pairs_worth_counting = 8;

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
    const auto n = static_cast<std::size_t>(count());
    std::vector<IndexPair> pairs(n);
    const auto for_each = [&](const auto& use) {
        for (const Local& local : locals_)
            for (const auto& chunk : local.chunks_)
                for (const IndexPair& pair : chunk) use(pair);
    };
    if (n * pairs_worth_counting < n_first) {
        std::size_t i = 0;
        for_each([&](const IndexPair& pair) { pairs[i++] = pair; });
        locals_.clear();
        sort_unique(pairs);
        return pairs;
    }
    std::vector<std::uint32_t> end(n_first + 1, 0);  // of each row, once its pairs are in place
    for_each([&](const IndexPair& pair) { ++end[static_cast<std::size_t>(pair.first) + 1]; });
    for (std::size_t row = 0; row < n_first; ++row) end[row + 1] += end[row];
    for_each([&](const IndexPair& pair) { pairs[end[static_cast<std::size_t>(pair.first)]++] = pair; });
    locals_.clear();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n_first, 4096), [&](const auto& rows) {
        for (std::size_t row = rows.begin(); row < rows.end(); ++row)
            std::sort(pairs.begin() + (row == 0 ? 0 : end[row - 1]), pairs.begin() + end[row]);
    });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace abut::geometry
