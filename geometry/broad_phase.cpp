#include "abut/geometry/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "abut/geometry/broad_phase_backends.hpp"
#include "abut/geometry/sort_unique.hpp"

namespace abut::geometry {
namespace {

// Boxes that take part, lifted to 3D, and where each stands in the caller's list.
struct Selection {
    std::vector<Box<3>> boxes;
    std::vector<std::int32_t> indices;

    void add(const Box<3>& box, std::int32_t index) {
        boxes.push_back(box);
        indices.push_back(index);
    }
};

template <int Dim>
Box<3> lifted(const Box<Dim>& box) {
    Box<3> result{Vector<3>::Zero(), Vector<3>::Zero()};
    result.lower.template head<Dim>() = box.lower;
    result.upper.template head<Dim>() = box.upper;
    return result;
}

[[noreturn]] void reject(std::size_t index, double bound) {
    throw std::invalid_argument(
        "box " + std::to_string(index) + " has the bound " + std::to_string(bound) +
        "; every bound of a box that is not empty must be finite. Has the motion behind it blown up?");
}

template <int Dim>
void check(const Box<Dim>& box, std::size_t index) {
    for (const Vector<Dim>& corner : {box.lower, box.upper})
        for (const double bound : corner)
            if (std::isnan(bound) || (std::isinf(bound) && !box.empty())) reject(index, bound);
}

template <int Dim>
Selection select(std::span<const Box<Dim>> boxes) {
    Selection selection;
    selection.boxes.reserve(boxes.size());
    selection.indices.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        check(boxes[i], i);
        if (!boxes[i].empty()) selection.add(lifted(boxes[i]), static_cast<std::int32_t>(i));
    }
    return selection;
}

Box<3> bounding_box_of(const Selection& selection) { return bounding_box(std::span<const Box<3>>(selection.boxes)); }

// The parts of the boxes inside `region`. When contact is local most boxes have none; dropping them costs far less than
// putting them into a tree. A box overlaps boxes inside the region exactly if its part does, and cutting keeps a large box
// from spoiling the resolution that single precision leaves to small ones.
Selection parts_inside(const Box<3>& region, const Selection& selection) {
    Selection parts;
    for (std::size_t i = 0; i < selection.boxes.size(); ++i) {
        const Box<3>& box = selection.boxes[i];
        if (box.overlaps(region))
            parts.add({box.lower.cwiseMax(region.lower), box.upper.cwiseMin(region.upper)}, selection.indices[i]);
    }
    return parts;
}

void cull_to_common_region(Selection& selection_1, Selection& selection_2) {
    selection_1 = parts_inside(bounding_box_of(selection_2), selection_1);
    selection_2 = parts_inside(bounding_box_of(selection_1), selection_2);
    selection_1 = parts_inside(bounding_box_of(selection_2), selection_1);
}

std::vector<IndexPair> pairs_between(BroadPhase method, const Selection& selection_1, const Selection& selection_2) {
    if (selection_1.boxes.empty() || selection_2.boxes.empty()) return {};
    switch (method) {
        case BroadPhase::embree:
            return backend::embree_pairs(selection_1.boxes, selection_2.boxes);
        case BroadPhase::fcl:
            return backend::fcl_pairs(selection_1.boxes, selection_2.boxes);
        case BroadPhase::brute_force:
            return backend::brute_force_pairs(selection_1.boxes, selection_2.boxes);
    }
    throw std::invalid_argument("not a BroadPhase");
}

std::vector<IndexPair> pairs_within(BroadPhase method, const Selection& selection) {
    if (selection.boxes.size() < 2) return {};
    switch (method) {
        case BroadPhase::embree:
            return backend::embree_pairs(selection.boxes);
        case BroadPhase::fcl:
            return backend::fcl_pairs(selection.boxes);
        case BroadPhase::brute_force:
            return backend::brute_force_pairs(selection.boxes);
    }
    throw std::invalid_argument("not a BroadPhase");
}

}  // namespace

template <int Dim>
std::vector<IndexPair> overlapping_pairs(BroadPhase method, std::span<const Box<Dim>> boxes_1,
                                         std::span<const Box<Dim>> boxes_2) {
    Selection selection_1 = select(boxes_1), selection_2 = select(boxes_2);
    if (method != BroadPhase::brute_force) cull_to_common_region(selection_1, selection_2);
    std::vector<IndexPair> pairs = pairs_between(method, selection_1, selection_2);
    for (IndexPair& pair : pairs) pair = {selection_1.indices[pair.first], selection_2.indices[pair.second]};
    sort_unique(pairs);
    return pairs;
}

template <int Dim>
std::vector<IndexPair> overlapping_pairs(BroadPhase method, std::span<const Box<Dim>> boxes) {
    const Selection selection = select(boxes);
    std::vector<IndexPair> pairs = pairs_within(method, selection);
    for (IndexPair& pair : pairs) pair = {selection.indices[pair.first], selection.indices[pair.second]};
    sort_unique(pairs);
    return pairs;
}

std::string_view name(BroadPhase method) {
    switch (method) {
        case BroadPhase::embree:
            return "embree";
        case BroadPhase::fcl:
            return "fcl";
        case BroadPhase::brute_force:
            return "brute_force";
    }
    return "unknown";
}

template std::vector<IndexPair> overlapping_pairs<2>(BroadPhase, std::span<const Box<2>>, std::span<const Box<2>>);
template std::vector<IndexPair> overlapping_pairs<3>(BroadPhase, std::span<const Box<3>>, std::span<const Box<3>>);
template std::vector<IndexPair> overlapping_pairs<2>(BroadPhase, std::span<const Box<2>>);
template std::vector<IndexPair> overlapping_pairs<3>(BroadPhase, std::span<const Box<3>>);

}  // namespace abut::geometry
