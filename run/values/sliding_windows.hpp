#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "abut/contact/report.hpp"

namespace abut::run {

/// Force of sliding faces over the limit at which they slide, by parts of a run: a slip that alternates for a while is
/// seen even where the whole run has slid well.
class SlidingWindows {
public:
    /// An eightieth of a run with as many records as there are by default: one of them lies within any bad fortieth.
    static constexpr std::int64_t records_per_window = 25;
    /// Part of the limit of the window with most of it that a part of the run has at least [-]: windows with less are
    /// joined with those after them, as faces that stick slip a little now and then.
    static constexpr double least_part = 0.1;

    /// A record of a run: what happened until then.
    void record(const contact::ContactReport& report) {
        if (report.sliding_limit == 0.0) return;  // nothing has slid yet
        if (n_records_++ % records_per_window == 0) {
            force_.push_back(0.0);
            limit_.push_back(0.0);
        }
        force_.back() += report.sliding_force - last_force_;
        limit_.back() += report.sliding_limit - last_limit_;
        last_force_ = report.sliding_force;
        last_limit_ = report.sliding_limit;
    }

    /// The least of a part of the run [-]; infinity where nothing has slid.
    [[nodiscard]] double least_share() const {
        double most = 0.0, least = std::numeric_limits<double>::infinity(), force = 0.0, limit = 0.0;
        for (const double one : limit_) most = std::max(most, one);
        for (std::size_t i = 0; i < limit_.size(); ++i) {
            force += force_[i];
            limit += limit_[i];
            if (limit < least_part * most) continue;
            if (limit > 0.0) least = std::min(least, force / limit);
            force = limit = 0.0;
        }
        return least;
    }

    /// Memory of a checkpoint.
    static auto fields(auto& self) {
        return std::tie(self.force_, self.limit_, self.n_records_, self.last_force_, self.last_limit_);
    }

private:
    std::vector<double> force_, limit_;  // of each window [N s]
    std::int64_t n_records_ = 0;
    double last_force_ = 0.0, last_limit_ = 0.0;  // of the record before
};

}  // namespace abut::run
