#pragma once
#include <cmath>
#include <limits>
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Closed axis-aligned box. A default box is empty: it overlaps nothing, and `extend` makes it hold a point.
template <int Dim>
struct Box {
    Vector<Dim> lower = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
    Vector<Dim> upper = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity());

    /// A NaN stays: whoever checks the bounds sees that a point was none.
    void extend(const Vector<Dim>& point) { extend(Box{point, point}); }
    void extend(const Box& other) {
        for (int i = 0; i < Dim; ++i) {
            lower[i] = lower[i] < other.lower[i] || std::isnan(lower[i]) ? lower[i] : other.lower[i];
            upper[i] = upper[i] > other.upper[i] || std::isnan(upper[i]) ? upper[i] : other.upper[i];
        }
    }
    /// The box with every side moved outwards by `margin` [m]; < 0 moves them inwards, and may leave an empty box.
    [[nodiscard]] Box grown(double margin) const {
        return {lower - Vector<Dim>::Constant(margin), upper + Vector<Dim>::Constant(margin)};
    }
    [[nodiscard]] bool empty() const {
        for (int i = 0; i < Dim; ++i)
            if (lower[i] > upper[i]) return true;
        return false;
    }
    /// Closed test: boxes that share only a face, an edge or a point do overlap.
    [[nodiscard]] bool overlaps(const Box& other) const {
        return all_at_most<Dim>(lower, other.upper) && all_at_most<Dim>(other.lower, upper);
    }
};

/// The smallest box around all of `boxes`; empty for an empty range.
template <int Dim>
[[nodiscard]] Box<Dim> bounding_box(std::span<const Box<Dim>> boxes) {
    Box<Dim> all;
    for (const Box<Dim>& box : boxes) all.extend(box);
    return all;
}

}  // namespace abut::geometry
