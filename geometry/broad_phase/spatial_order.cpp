#include "abut/geometry/broad_phase/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/box.hpp"

namespace abut::geometry {
namespace {

// Cells of the curve along an axis, as a power of two: a million faces of a closed surface are some 600 along each.
template <int Dim>
constexpr int bits_per_axis = Dim == 2 ? 16 : 11;

// More points than this in one cell are put in order by a curve of their own.
constexpr std::ptrdiff_t most_in_a_cell = 32;

struct Key {
    std::uint64_t cell;
    std::int32_t point;
};

// Bit i of x goes to bit Dim i.
template <int Dim>
std::uint64_t spread(std::uint64_t x) {
    if constexpr (Dim == 2) {
        x = (x | x << 8) & 0x00ff00ff;
        x = (x | x << 4) & 0x0f0f0f0f;
        x = (x | x << 2) & 0x33333333;
        x = (x | x << 1) & 0x55555555;
    } else {
        x = (x | x << 16) & 0x0000ff0000ffull;
        x = (x | x << 8) & 0x00f00f00f00full;
        x = (x | x << 4) & 0x0c30c30c30c3ull;
        x = (x | x << 2) & 0x249249249249ull;
    }
    return x;
}

// Sorts by cell, stable, digit by digit.
class RadixSort {
public:
    void operator()(std::span<Key> keys, int bits) {
        other_.resize(std::max(other_.size(), keys.size()));
        std::span<Key> from = keys, to(other_.data(), keys.size());
        for (int shift = 0; shift < bits; shift += digit_bits)
            if (scatter(from, to, shift)) std::swap(from, to);
        if (from.data() != keys.data()) std::copy(from.begin(), from.end(), keys.begin());
    }

private:
    static constexpr int digit_bits = 11;
    using Counts = std::array<std::uint32_t, std::size_t{1} << digit_bits>;

    // Whether there was anything to do: nothing if all have the same digit.
    static bool scatter(std::span<const Key> from, std::span<Key> to, int shift) {
        Counts position{};
        const auto digit = [shift](const Key& key) { return key.cell >> shift & (std::tuple_size_v<Counts> - 1); };
        for (const Key& key : from) ++position[digit(key)];
        if (position[digit(from.front())] == from.size()) return false;
        std::uint32_t sum = 0;
        for (std::uint32_t& p : position) sum += std::exchange(p, sum);
        for (const Key& key : from) to[position[digit(key)]++] = key;
        return true;
    }

    std::vector<Key> other_;
};

template <int Dim>
class MortonCurve {
public:
    explicit MortonCurve(std::span<const Vector<Dim>> points) : points_(points) {}

    void sort(std::span<Key> keys) {
        if (!number_cells(keys)) return;
        constexpr int bits = Dim * bits_per_axis<Dim>;
        if (static_cast<std::ptrdiff_t>(keys.size()) > most_in_a_cell)
            radix_sort_(keys, bits);
        else
            std::ranges::stable_sort(keys, {}, &Key::cell);
        for (auto begin = keys.begin(); begin != keys.end();) {
            const auto end =
                std::find_if(begin, keys.end(), [cell = begin->cell](const Key& key) { return key.cell != cell; });
            if (end - begin > most_in_a_cell) sort({begin, end});
            begin = end;
        }
    }

private:
    // False if the points all are at one position, as far as doubles can tell.
    bool number_cells(std::span<Key> keys) const {
        Box<Dim> box;
        for (const Key& key : keys) box.extend(points_[key.point]);
        // Halves: the extent of a box of the largest doubles would overflow.
        const Vector<Dim> lower = 0.5 * box.lower;
        constexpr double last_cell = (1 << bits_per_axis<Dim>)-1;
        const double cells_per_metre = last_cell / (0.5 * box.upper - lower).maxCoeff();
        if (!std::isfinite(cells_per_metre)) return false;
        for (Key& key : keys) {
            key.cell = 0;
            for (int axis = 0; axis < Dim; ++axis) {
                const double position = (0.5 * points_[key.point][axis] - lower[axis]) * cells_per_metre;
                key.cell |= spread<Dim>(static_cast<std::uint64_t>(std::min(position, last_cell))) << axis;
            }
        }
        return true;
    }

    std::span<const Vector<Dim>> points_;
    RadixSort radix_sort_;
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> spatial_order(std::span<const Vector<Dim>> points) {
    std::vector<Key> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const double x : points[i])
            if (!std::isfinite(x))
                throw BadInput("spatial order: point " + std::to_string(i) + " has the coordinate " + number(x) +
                               "; all must be finite. Leave it out.");
        keys[i].point = static_cast<std::int32_t>(i);
    }
    if (!keys.empty()) MortonCurve<Dim>(points).sort(keys);
    std::vector<std::int32_t> order;
    order.reserve(keys.size());
    for (const Key& key : keys) order.push_back(key.point);
    return order;
}

template std::vector<std::int32_t> spatial_order<2>(std::span<const Vector<2>>);
template std::vector<std::int32_t> spatial_order<3>(std::span<const Vector<3>>);

}  // namespace abut::geometry
