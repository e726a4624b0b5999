#pragma once
// Private to the sources of run.
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "abut/run/values/run_comparison.hpp"

namespace abut::run {

/// Values of a column or a field in two runs, added in the order of time.
///
/// A value differs where its difference is above `tolerance` times the largest value of either run; with a tolerance of 0
/// where any bit differs. NaN equals NaN. The largest value is known at the end alone: until then the differences are kept
/// that are larger than all before them, for these alone can be the first above a limit.
class ComparedValues {
public:
    explicit ComparedValues(double tolerance) : tolerance_(tolerance) {}

    struct Place {
        std::int64_t row = 0;                                    ///< of a table, or frame
        std::int64_t index = 0;                                  ///< in the row
        std::int64_t step = -1;                                  ///< -1: unknown
        double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN: unknown
    };
    struct Difference {
        Place place;
        double first = 0.0, second = 0.0;
        double size = 0.0;  ///< |first - second|; infinite where one is no finite number
    };

    void add(double first, double second, const Place& place);
    [[nodiscard]] bool differ() const { return !records_.empty(); }
    /// Only where they differ.
    [[nodiscard]] const Difference& first() const { return records_.front(); }
    [[nodiscard]] const Difference& largest() const { return records_.back(); }
    [[nodiscard]] ValueDifference described(const Difference& difference, const std::string& name) const;

private:
    double tolerance_;
    double largest_value_ = 0.0;
    std::deque<Difference> records_;  ///< sizes increase
};

/// The largest three.
[[nodiscard]] std::vector<ValueDifference> largest_of(std::vector<ValueDifference> differences);

/// The shortest text that brings every bit back.
[[nodiscard]] std::string shortest(double value);

}  // namespace abut::run
