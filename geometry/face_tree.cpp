#include "abut/geometry/face_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "abut/base/index.hpp"
#include "abut/geometry/convex_distance.hpp"
#include "abut/geometry/points.hpp"

namespace abut::geometry {
namespace {

template <int Dim>
double distance(const Box<Dim>& a, const Box<Dim>& b) {
    return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

/// Calls `visit(f, g)` for pairs of faces until no other pair of boxes is nearer than `best`, which it lowers.
template <int Dim, class Visit>
void visit_near_pairs(const FaceTree<Dim>& tree_1, const FaceTree<Dim>& tree_2, double& best, const Visit& visit) {
    std::vector<std::array<std::size_t, 2>> open{{0, 0}};
    while (!open.empty()) {
        const auto [i, k] = open.back();
        open.pop_back();
        const auto &node_1 = tree_1.nodes()[i], &node_2 = tree_2.nodes()[k];
        if (!(distance<Dim>(node_1.box, node_2.box) < best)) continue;
        if (node_1.children == 0 && node_2.children == 0) {
            for (std::size_t f = node_1.begin; f < node_1.end; ++f)
                for (std::size_t g = node_2.begin; g < node_2.end; ++g)
                    if (distance<Dim>(box_of<Dim>(tree_1.faces()[f]), box_of<Dim>(tree_2.faces()[g])) < best) visit(f, g);
            continue;
        }
        const bool halve_1 =
            node_2.children == 0 || (node_1.children != 0 && node_1.end - node_1.begin > node_2.end - node_2.begin);
        std::array<std::array<std::size_t, 2>, 2> next;
        for (std::size_t half = 0; half < 2; ++half)
            next[half] = halve_1 ? std::array{node_1.children + half, k} : std::array{i, node_2.children + half};
        const auto far = [&](const auto& pair) {
            return distance<Dim>(tree_1.nodes()[pair[0]].box, tree_2.nodes()[pair[1]].box);
        };
        if (far(next[0]) < far(next[1])) std::swap(next[0], next[1]);
        open.insert(open.end(), next.begin(), next.end());  // the nearer one first
    }
}

}  // namespace

template <int Dim>
FaceTree<Dim>::FaceTree(std::vector<std::vector<Vector<Dim>>> faces) : faces_(std::move(faces)), numbers_(faces_.size()) {
    std::iota(numbers_.begin(), numbers_.end(), 0);
    nodes_.push_back({{}, 0, faces_.size()});
    for (std::size_t i = 0; i < nodes_.size(); ++i) split(i);
    std::vector<std::vector<Vector<Dim>>> ordered;
    ordered.reserve(faces_.size());
    for (const std::int32_t number : numbers_) ordered.push_back(std::move(faces_[at(number)]));
    faces_ = std::move(ordered);
}

template <int Dim>
void FaceTree<Dim>::split(std::size_t node) {
    constexpr std::size_t few = 4;
    const auto [begin, end] = std::pair(nodes_[node].begin, nodes_[node].end);
    for (std::size_t f = begin; f < end; ++f) nodes_[node].box.extend(box_of<Dim>(faces_[at(numbers_[f])]));
    if (end - begin <= few) return;
    int axis = 0;
    (nodes_[node].box.upper - nodes_[node].box.lower).maxCoeff(&axis);
    const auto place = [&](std::size_t f) { return numbers_.begin() + static_cast<std::ptrdiff_t>(f); };
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(place(begin), place(middle), place(end), [&](std::int32_t a, std::int32_t b) {
        return mean_of<Dim>(faces_[at(a)])[axis] < mean_of<Dim>(faces_[at(b)])[axis];
    });
    nodes_[node].children = nodes_.size();
    nodes_.push_back({{}, begin, middle});
    nodes_.push_back({{}, middle, end});
}

template <int Dim>
double distance_below(const FaceTree<Dim>& tree_1, const FaceTree<Dim>& tree_2, double limit) {
    double best = limit;
    visit_near_pairs<Dim>(tree_1, tree_2, best, [&](std::size_t f, std::size_t g) {
        best = std::min(best, convex_distance<Dim>(tree_1.faces()[f], tree_2.faces()[g]));
    });
    return best;
}

NearestFaces nearest_faces(const FaceTree<3>& tree_1, const FaceTree<3>& tree_2, double limit) {
    NearestFaces nearest;
    double best = limit;
    visit_near_pairs<3>(tree_1, tree_2, best, [&](std::size_t f, std::size_t g) {
        const NearestPoints points = nearest_points(tree_1.faces()[f], tree_2.faces()[g]);
        if (!(points.distance < best)) return;
        best = points.distance;
        nearest = {tree_1.numbers()[f], tree_2.numbers()[g], points};
    });
    return nearest;
}

template class FaceTree<2>;
template class FaceTree<3>;
template double distance_below<2>(const FaceTree<2>&, const FaceTree<2>&, double);
template double distance_below<3>(const FaceTree<3>&, const FaceTree<3>&, double);

}  // namespace abut::geometry
