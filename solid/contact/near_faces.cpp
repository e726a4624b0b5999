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

/// Some neighbours.
template <int Dim>
struct Group {
    geometry::Box<Dim> box;
    std::span<const std::int32_t> which;
};

/// Appends groups of neighbours: `which` is halved across its longest side again and again.
template <int Dim>
void append_groups(Boxes<Dim> boxes, std::span<std::int32_t> which, std::vector<Group<Dim>>& groups) {
    const geometry::Box<Dim> all = box_of<Dim>(boxes, which);
    if (std::ssize(which) <= group_size) {
        groups.push_back({all, which});
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
    std::vector<Group<Dim>> groups;
};

template <int Dim>
std::vector<BodyBoxes<Dim>> by_body(Boxes<Dim> boxes, std::span<const std::int32_t> body) {
    std::vector<BodyBoxes<Dim>> bodies;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto of = static_cast<std::size_t>(body[i]);
        if (of >= bodies.size()) bodies.resize(of + 1);
        bodies[of].which.push_back(static_cast<std::int32_t>(i));
    }
    std::erase_if(bodies, [](const BodyBoxes<Dim>& of_body) { return of_body.which.empty(); });
    for (BodyBoxes<Dim>& of_body : bodies) {
        of_body.all = box_of<Dim>(boxes, of_body.which);
        append_groups<Dim>(boxes, of_body.which, of_body.groups);
    }
    return bodies;
}

template <int Dim>
double distance(const geometry::Box<Dim>& a, const geometry::Box<Dim>& b) {
    double distance = 0.0;
    for (int k = 0; k < Dim; ++k) distance = std::max({distance, a.lower[k] - b.upper[k], b.lower[k] - a.upper[k]});
    return distance;
}

/// Lowers the distances of both groups to those between them.
template <int Dim>
void approach(Boxes<Dim> boxes, const Group<Dim>& group_1, const Group<Dim>& group_2, double most,
              std::vector<double>& distances) {
    for (const std::int32_t i : group_1.which) {
        if (distance(boxes[i], group_2.box) >= most) continue;
        for (const std::int32_t j : group_2.which) {
            const double apart = distance(boxes[i], boxes[j]);
            distances[i] = std::min(distances[i], apart);
            distances[j] = std::min(distances[j], apart);
        }
    }
}

}  // namespace

template <int Dim>
std::vector<double> distances_to_others(Boxes<Dim> boxes, std::span<const std::int32_t> body, double most) {
    const std::vector<BodyBoxes<Dim>> bodies = by_body<Dim>(boxes, body);
    std::vector<double> distances(boxes.size(), most);
    for (auto a = bodies.begin(); a != bodies.end(); ++a)
        for (auto b = a + 1; b != bodies.end(); ++b) {
            if (distance(a->all, b->all) >= most) continue;
            for (const Group<Dim>& group_1 : a->groups) {
                if (distance(group_1.box, b->all) >= most) continue;
                for (const Group<Dim>& group_2 : b->groups)
                    if (distance(group_1.box, group_2.box) < most) approach(boxes, group_1, group_2, most, distances);
            }
        }
    return distances;
}

template <int Dim>
std::vector<double> distances_to_groups(Boxes<Dim> boxes, std::span<const std::int32_t> body, double most) {
    const std::vector<BodyBoxes<Dim>> bodies = by_body<Dim>(boxes, body);
    std::vector<double> distances(boxes.size(), most);
    std::vector<geometry::Box<Dim>> others;
    for (const BodyBoxes<Dim>& of_body : bodies) {
        others.clear();
        for (const BodyBoxes<Dim>& other : bodies)
            if (&other != &of_body && distance(other.all, of_body.all) < most)
                for (const Group<Dim>& group : other.groups)
                    if (distance(group.box, of_body.all) < most) others.push_back(group.box);
        for (const std::int32_t i : of_body.which)
            for (const geometry::Box<Dim>& group : others) distances[i] = std::min(distances[i], distance(boxes[i], group));
    }
    return distances;
}

template std::vector<double> distances_to_others(Boxes<2>, std::span<const std::int32_t>, double);
template std::vector<double> distances_to_others(Boxes<3>, std::span<const std::int32_t>, double);
template std::vector<double> distances_to_groups(Boxes<2>, std::span<const std::int32_t>, double);
template std::vector<double> distances_to_groups(Boxes<3>, std::span<const std::int32_t>, double);

}  // namespace abut::solid
