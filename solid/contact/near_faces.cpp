#include "abut/solid/contact/near_faces.hpp"

#include <algorithm>
#include <cstddef>

namespace abut::solid {
namespace {

constexpr std::ptrdiff_t group_size = 32;

template <int Dim>
using Boxes = std::span<const geometry::Box<Dim>>;

template <int Dim>
geometry::Box<Dim> box_of(Boxes<Dim> boxes, std::span<const std::int32_t> which) {
    geometry::Box<Dim> box;
    for (const std::int32_t i : which) box.extend(boxes[i]);
    return box;
}

/// Appends the boxes of groups of neighbours: `which` is halved across its longest side again and again.
template <int Dim>
void append_groups(Boxes<Dim> boxes, std::span<std::int32_t> which, std::vector<geometry::Box<Dim>>& groups) {
    const geometry::Box<Dim> all = box_of<Dim>(boxes, which);
    if (std::ssize(which) <= group_size) {
        groups.push_back(all);
        return;
    }
    const Vector<Dim> size = all.upper - all.lower;
    int axis = 0;
    for (int k = 1; k < Dim; ++k)
        if (size[k] > size[axis]) axis = k;
    const auto middle = [&](std::int32_t i) { return boxes[i].lower[axis] + boxes[i].upper[axis]; };
    const std::size_t half = which.size() / 2;
    std::ranges::nth_element(which, which.begin() + static_cast<std::ptrdiff_t>(half), {}, middle);
    append_groups<Dim>(boxes, which.first(half), groups);
    append_groups<Dim>(boxes, which.subspan(half), groups);
}

/// The boxes of one body.
template <int Dim>
struct BodyBoxes {
    std::vector<std::int32_t> which;
    geometry::Box<Dim> all;
    std::vector<geometry::Box<Dim>> groups;  // grown
};

template <int Dim>
std::vector<BodyBoxes<Dim>> by_body(Boxes<Dim> boxes, std::span<const std::int32_t> body, double margin) {
    std::vector<BodyBoxes<Dim>> bodies;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto of = static_cast<std::size_t>(body[i]);
        if (of >= bodies.size()) bodies.resize(of + 1);
        bodies[of].which.push_back(static_cast<std::int32_t>(i));
    }
    for (BodyBoxes<Dim>& of_body : bodies) {
        if (of_body.which.empty()) continue;
        of_body.all = box_of<Dim>(boxes, of_body.which);
        append_groups<Dim>(boxes, of_body.which, of_body.groups);
        for (geometry::Box<Dim>& group : of_body.groups) group = group.grown(margin);
    }
    return bodies;
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> near_others(Boxes<Dim> boxes, std::span<const std::int32_t> body, double margin) {
    const std::vector<BodyBoxes<Dim>> bodies = by_body<Dim>(boxes, body, margin);
    std::vector<std::int32_t> near;
    for (std::size_t a = 0; a < bodies.size(); ++a) {
        if (bodies[a].which.empty()) continue;
        std::vector<geometry::Box<Dim>> others;  // groups that reach this body
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (b == a || bodies[b].which.empty() || !bodies[b].all.grown(margin).overlaps(bodies[a].all)) continue;
            std::ranges::copy_if(bodies[b].groups, std::back_inserter(others),
                                 [&](const geometry::Box<Dim>& group) { return group.overlaps(bodies[a].all); });
        }
        for (const std::int32_t i : bodies[a].which)
            if (std::ranges::any_of(others, [&](const geometry::Box<Dim>& group) { return group.overlaps(boxes[i]); }))
                near.push_back(i);
    }
    std::ranges::sort(near);
    return near;
}

template std::vector<std::int32_t> near_others(Boxes<2>, std::span<const std::int32_t>, double);
template std::vector<std::int32_t> near_others(Boxes<3>, std::span<const std::int32_t>, double);

}  // namespace abut::solid
