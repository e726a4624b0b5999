#include "abut/geometry/broad_phase/broad_phase.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/broad_phase/backends.hpp"
#include "abut/geometry/broad_phase/search_part.hpp"

namespace abut::geometry {
namespace {

// Boxes that take part, lifted to 3D, and where each stands in the caller's list.
struct Selection {
    std::vector<Box<3>> boxes;
    std::vector<std::int32_t> indices;  // empty: all take part

    [[nodiscard]] std::int32_t number(std::int32_t i) const {
        return indices.empty() ? i : indices[static_cast<std::size_t>(i)];
    }
};

template <int Dim>
Box<3> lifted(const Box<Dim>& box) {
    return {in_3d<Dim>(box.lower), in_3d<Dim>(box.upper)};
}

[[noreturn]] void reject(std::size_t index, double bound) {
    throw BadInput("box " + std::to_string(index) + " has the bound " + number(bound) +
                   "; every bound of a box that is not empty must be finite. Has the motion behind it blown up?");
}

template <int Dim>
void check(const Box<Dim>& box, std::size_t index) {
    for (int axis = 0; axis < Dim; ++axis)
        for (const double bound : {box.lower[axis], box.upper[axis]})
            if (!std::isfinite(bound) && (std::isnan(bound) || !box.empty())) reject(index, bound);
}

template <int Dim>
void check(std::span<const Box<Dim>> boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) check(boxes[i], i);
}

// The part of a box inside a region: it overlaps boxes inside the region exactly if the box does, and cutting keeps a
// large box from spoiling the resolution that single precision leaves to small ones.
template <int Dim>
Box<Dim> part_inside(const Box<Dim>& region, const Box<Dim>& box) {
    return {box.lower.cwiseMax(region.lower), box.upper.cwiseMin(region.upper)};
}

template <int Dim>
bool takes_part(const Box<Dim>& region, const Box<Dim>& box) {
    return box.overlaps(region) && !box.empty();
}

template <int Dim>
Box<Dim> bounds_of_parts(const Box<Dim>& region, std::span<const Box<Dim>> boxes) {
    Box<Dim> bounds;
    for (const Box<Dim>& box : boxes)
        if (takes_part(region, box)) {
            const Box<Dim> part = part_inside(region, box);
            bounds.lower = bounds.lower.cwiseMin(part.lower);
            bounds.upper = bounds.upper.cwiseMax(part.upper);
        }
    return bounds;
}

template <int Dim>
std::size_t count_inside(const Box<Dim>& region, std::span<const Box<Dim>> boxes) {
    return static_cast<std::size_t>(std::ranges::count_if(boxes, [&](const auto& box) { return takes_part(region, box); }));
}

// `n` of them.
template <int Dim>
Selection parts_inside(const Box<Dim>& region, std::span<const Box<Dim>> boxes, std::size_t n) {
    Selection parts;
    parts.boxes.reserve(n);
    if (n < boxes.size()) parts.indices.reserve(n);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (takes_part(region, boxes[i])) {
            parts.boxes.push_back(lifted(part_inside(region, boxes[i])));
            if (n < boxes.size()) parts.indices.push_back(static_cast<std::int32_t>(i));
        }
    return parts;
}

template <int Dim>
Box<Dim> everywhere() {
    return {Vector<Dim>::Constant(std::numeric_limits<double>::lowest()),
            Vector<Dim>::Constant(std::numeric_limits<double>::max())};
}

// Where the boxes of two sets must reach for to take part. When contact is local most do not: dropping them costs far less
// than a tree of them.
template <int Dim>
struct Regions {
    Box<Dim> of_1 = everywhere<Dim>();
    Box<Dim> of_2 = everywhere<Dim>();
};

template <int Dim>
Regions<Dim> common_regions(std::span<const Box<Dim>> boxes_1, std::span<const Box<Dim>> boxes_2) {
    const Box<Dim> all_2 = bounds_of_parts(everywhere<Dim>(), boxes_2), near_2 = bounds_of_parts(all_2, boxes_1);
    return {bounds_of_parts(near_2, boxes_2), near_2};
}

// A handful of boxes against a handful: no tree pays.
constexpr std::size_t tests_worth_a_tree = 1000;

BroadPhase chosen(BroadPhase method, std::size_t n_tests) {
    if (method != BroadPhase::automatic) return method;
    return n_tests < tests_worth_a_tree ? BroadPhase::brute_force : BroadPhase::packed_tree;
}

/// A broad phase by its name, cost and functions. `between` and `within` find the pairs of two sets and of one; they may
/// take the boxes of the selections with them, to have room for the pairs.
struct Method {
    BroadPhase method;
    std::string_view name;
    const bool* is_built;  ///< null: always
    double bytes_per_box;  ///< allocated for each box that takes part, its copy included: measured, docs/detection.md
    void (*between)(Selection&, Selection&, bool in_spatial_order, FoundPairs&);
    void (*within)(Selection&, bool in_spatial_order, FoundPairs&);
};

void between_by_packed_tree(Selection& selection_1, Selection& selection_2, bool in_spatial_order, FoundPairs& found) {
    backend::find_by_packed_tree(std::move(selection_1.boxes), std::move(selection_2.boxes), in_spatial_order, found);
}

void within_by_packed_tree(Selection& selection, bool in_spatial_order, FoundPairs& found) {
    backend::find_by_packed_tree(std::move(selection.boxes), in_spatial_order, found);
}

template <auto Find>
void between_by(Selection& selection_1, Selection& selection_2, bool, FoundPairs& found) {
    Find(selection_1.boxes, selection_2.boxes, found);
}

template <auto Find>
void within_by(Selection& selection, bool, FoundPairs& found) {
    Find(selection.boxes, found);
}

using FindBetween = void (*)(backend::Boxes, backend::Boxes, FoundPairs&);
using FindWithin = void (*)(backend::Boxes, FoundPairs&);

/// In the order of BroadPhase; the first is never asked to find, `chosen` takes another in its place.
constexpr std::array methods{
    Method{BroadPhase::automatic, "automatic", nullptr, 0.0, nullptr, nullptr},
    Method{BroadPhase::packed_tree, "packed_tree", nullptr, 120.0, between_by_packed_tree, within_by_packed_tree},
    Method{BroadPhase::embree, "embree", &backend::has_embree, 130.0, between_by<FindBetween{backend::find_by_embree}>,
           within_by<FindWithin{backend::find_by_embree}>},
    Method{BroadPhase::fcl, "fcl", &backend::has_fcl, 200.0, between_by<FindBetween{backend::find_by_fcl}>,
           within_by<FindWithin{backend::find_by_fcl}>},
    Method{BroadPhase::brute_force, "brute_force", nullptr, 56.0, between_by<FindBetween{backend::find_by_brute_force}>,
           within_by<FindWithin{backend::find_by_brute_force}>}};
constexpr bool is_in_its_place(const Method& row) { return &row == &methods[static_cast<std::size_t>(row.method)]; }
static_assert(std::ranges::all_of(methods, is_in_its_place));

const Method& row_of(BroadPhase method) { return methods.at(static_cast<std::size_t>(method)); }

[[noreturn]] void refuse_bytes(const std::string& what, double needed, double allowed) {
    throw SearchLimitError("broad phase: " + what + " " + number(needed) + " bytes or more, " + number(allowed) +
                               " are allowed. Raise SearchLimits::bytes, or search smaller sets of boxes.",
                           needed, allowed);
}

constexpr double bytes_per_pair = 2 * sizeof(IndexPair);  // as found, and sorted

/// Pairs that may be found, and which of the limits says so.
struct PairLimit {
    std::int64_t pairs;
    double bytes_of_trees;
    bool is_of_memory;
};

PairLimit pair_limit(const SearchLimits& limits, BroadPhase method, std::size_t n_boxes) {
    const double trees = row_of(method).bytes_per_box * static_cast<double>(n_boxes),
                 allowed = static_cast<double>(limits.bytes);
    if (trees > allowed) refuse_bytes("the trees of " + std::to_string(n_boxes) + " boxes take", trees, allowed);
    const double fitting = std::floor((allowed - trees) / bytes_per_pair);
    const double most = std::min(static_cast<double>(limits.pairs), double{std::numeric_limits<std::uint32_t>::max()});
    return {static_cast<std::int64_t>(std::min(fitting, most)), trees, fitting < most};
}

void check_number(const FoundPairs& found, const SearchLimits& limits, const PairLimit& limit) {
    const std::int64_t n = found.count();
    if (n <= limit.pairs) return;
    const std::string pairs = std::to_string(n) + " pairs of boxes or more overlap, ";
    if (limit.is_of_memory)
        refuse_bytes(pairs + "with the trees they take", limit.bytes_of_trees + bytes_per_pair * static_cast<double>(n),
                     static_cast<double>(limits.bytes));
    throw SearchLimitError("broad phase: " + pairs + std::to_string(limit.pairs) +
                               " are allowed. Make the boxes smaller (skin, distance), or raise SearchLimits::pairs.",
                           static_cast<double>(n), static_cast<double>(limit.pairs));
}

// Both selections must outlive it.
PairFilter in_numbers_of_selections(const PairFilter& wanted, const Selection& selection_1, const Selection& selection_2) {
    if (!wanted) return {};
    return [&](std::int32_t i, std::int32_t j) { return wanted(selection_1.number(i), selection_2.number(j)); };
}

std::vector<IndexPair> in_numbers_of_caller(std::vector<IndexPair> pairs, const Selection& selection_1,
                                            const Selection& selection_2) {
    for (IndexPair& pair : pairs) pair = {selection_1.number(pair.first), selection_2.number(pair.second)};
    return pairs;
}

}  // namespace

void check_options(const SearchOptions& options) {
    const auto method = static_cast<int>(options.method), last = static_cast<int>(methods.back().method);
    if (method < 0 || method > last)
        throw BadInput("search options: the broad phase is " + std::to_string(method) + "; 0 (automatic) to " +
                           std::to_string(last) + " (brute force) are allowed.",
                       {.value = static_cast<double>(method), .allowed = static_cast<double>(last)});
    if (options.limits.pairs < 0)
        throw BadInput("search options: limits.pairs is " + std::to_string(options.limits.pairs) +
                           "; 0 and more are allowed, 250,000,000 is the default.",
                       {.value = static_cast<double>(options.limits.pairs), .allowed = 0.0});
}

template <int Dim>
std::vector<IndexPair> overlapping_pairs(const SearchOptions& options, std::span<const Box<Dim>> boxes_1,
                                         std::span<const Box<Dim>> boxes_2, const PairFilter& wanted) {
    check_options(options);
    check(boxes_1);
    check(boxes_2);
    Regions<Dim> regions;
    if (options.method != BroadPhase::brute_force) regions = common_regions(boxes_1, boxes_2);
    const std::size_t n_1 = count_inside(regions.of_1, boxes_1), n_2 = count_inside(regions.of_2, boxes_2);
    if (n_1 == 0 || n_2 == 0) return {};
    const BroadPhase method = chosen(options.method, n_1 * n_2);
    const PairLimit limit = pair_limit(options.limits, method, n_1 + n_2);
    Selection selection_1 = parts_inside(regions.of_1, boxes_1, n_1);
    Selection selection_2 = parts_inside(regions.of_2, boxes_2, n_2);
    FoundPairs found(limit.pairs, in_numbers_of_selections(wanted, selection_1, selection_2));
    row_of(method).between(selection_1, selection_2, options.in_spatial_order, found);
    check_number(found, options.limits, limit);
    return in_numbers_of_caller(found.sorted(n_1), selection_1, selection_2);
}

template <int Dim>
std::vector<IndexPair> overlapping_pairs(const SearchOptions& options, std::span<const Box<Dim>> boxes,
                                         const PairFilter& wanted) {
    check_options(options);
    check(boxes);
    const std::size_t n = count_inside(everywhere<Dim>(), boxes);
    if (n < 2) return {};
    const BroadPhase method = chosen(options.method, n * (n - 1) / 2);
    const PairLimit limit = pair_limit(options.limits, method, n);
    Selection selection = parts_inside(everywhere<Dim>(), boxes, n);
    FoundPairs found(limit.pairs, in_numbers_of_selections(wanted, selection, selection));
    row_of(method).within(selection, options.in_spatial_order, found);
    check_number(found, options.limits, limit);
    return in_numbers_of_caller(found.sorted(n), selection, selection);
}

std::span<const BroadPhase> broad_phases() {
    static const std::vector<BroadPhase> built = [] {
        std::vector<BroadPhase> all;
        for (const Method& row : methods)
            if (!row.is_built || *row.is_built) all.push_back(row.method);
        return all;
    }();
    return built;
}

std::string_view name(BroadPhase method) { return row_of(method).name; }

#define ABUT_INSTANTIATE(Dim)                                                                               \
    template std::vector<IndexPair> overlapping_pairs<Dim>(const SearchOptions&, std::span<const Box<Dim>>, \
                                                           std::span<const Box<Dim>>, const PairFilter&);   \
    template std::vector<IndexPair> overlapping_pairs<Dim>(const SearchOptions&, std::span<const Box<Dim>>, \
                                                           const PairFilter&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::geometry
