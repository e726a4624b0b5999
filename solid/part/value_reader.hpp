#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <span>

namespace abut::solid {

/// Reads numbers one after the other, such as those of arrays that ranks have gathered.
class ValueReader {
public:
    explicit ValueReader(std::span<const double> values) : values_(values) {}
    [[nodiscard]] bool is_done() const { return values_.empty(); }
    double next() {
        const double value = values_.front();
        values_ = values_.subspan(1);
        return value;
    }
    template <class Integer>
    Integer next_as() {
        return static_cast<Integer>(next());
    }
    template <class Array>
    Array next_array() {
        Array array;
        for (double& value : array) value = next();
        return array;
    }

private:
    std::span<const double> values_;
};

}  // namespace abut::solid
