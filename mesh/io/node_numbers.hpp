#pragma once
// Private to the layer.
#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut::mesh {

/// Indices of nodes by their tags in a file.
template <class Tag>
class NodeNumbers {
public:
    NodeNumbers() = default;
    /// `tags`: of the nodes in their order, none negative. The last node of a tag counts.
    explicit NodeNumbers(const std::vector<Tag>& tags) {
        const auto largest = static_cast<std::uint64_t>(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()));
        const bool is_dense = largest <= 4 * static_cast<std::uint64_t>(tags.size()) + 1000;
        if (is_dense) dense_.assign(largest + 1, -1);
        for (std::size_t i = 0; i < tags.size(); ++i) {
            const auto index = static_cast<std::int32_t>(i);
            if (is_dense)
                dense_[static_cast<std::size_t>(tags[i])] = index;
            else
                sparse_.insert_or_assign(tags[i], index);
        }
    }
    /// -1 for a node that is not there.
    [[nodiscard]] std::int32_t operator()(Tag tag) const {
        if (std::cmp_less(tag, 0)) return -1;
        if (!dense_.empty()) return std::cmp_less(tag, dense_.size()) ? dense_[static_cast<std::size_t>(tag)] : -1;
        const auto found = sparse_.find(tag);
        return found == sparse_.end() ? -1 : found->second;
    }

private:
    std::vector<std::int32_t> dense_;               ///< by tag, -1 for none
    std::unordered_map<Tag, std::int32_t> sparse_;  ///< instead, where tags have large gaps
};

}  // namespace abut::mesh
