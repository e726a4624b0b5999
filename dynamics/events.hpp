#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace abut::dynamics {

/// Functions of q that change their sign at events, where a contact opens or closes, say. Each has a side, +1 or -1, the
/// sign that it last had; it is kept, since the value at an event is 0 up to rounding and may have either sign.
class Events {
public:
    using Function = std::function<double(std::span<const double> q)>;

    /// With the sides that the functions have at q. Throws BadInput where one is 0 or not a number.
    Events(std::vector<Function> functions, std::span<const double> q);
    /// With sides that are known: where a function is 0 at the start, or a run goes on. Throws BadInput unless there are as
    /// many as functions, each +1 or -1.
    Events(std::vector<Function> functions, std::vector<int> sides);

    [[nodiscard]] std::span<const int> sides() const { return sides_; }
    /// All functions times their sides: < 0 beyond an event. Throws Diverged where one is not a number.
    [[nodiscard]] std::vector<double> values(std::span<const double> q) const;
    /// Least of these over the scales of the functions, which are > 0; infinite without functions. Throws as `values`.
    [[nodiscard]] double least(std::span<const double> q, std::span<const double> scales) const;
    /// Turns the sides of those that, times their side, are at most `tolerance` times their own scale. Returns how many.
    std::size_t turn(std::span<const double> q, std::span<const double> scales, double tolerance);

private:
    [[nodiscard]] double signed_value(std::size_t i, std::span<const double> q) const;

    std::vector<Function> functions_;
    std::vector<int> sides_;
};

namespace detail {
/// Scale of each function: the largest size of its finite values at both ends of a step; 1 where these are 0 or none.
[[nodiscard]] std::vector<double> event_scales(std::span<const double> at_start, std::span<const double> at_end);
}  // namespace detail

}  // namespace abut::dynamics
