#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <span>

#include "abut/contact/sharing.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::solid {

/// The ranks of a solid as parts that share the work of its contact.
class RankSharing final : public contact::Sharing {
public:
    /// The ranks must outlive it.
    explicit RankSharing(const dynamics::Ranks& ranks) : ranks_(ranks) {}

    [[nodiscard]] int part() const override { return ranks_.rank(); }
    [[nodiscard]] int n_parts() const override { return ranks_.n_ranks(); }
    [[nodiscard]] std::span<const std::byte> gather(std::span<const std::byte> mine) override {
        return ranks_.gather_bytes(mine);
    }

private:
    const dynamics::Ranks& ranks_;
};

}  // namespace abut::solid
