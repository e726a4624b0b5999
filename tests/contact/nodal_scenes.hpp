#pragma once
// Bodies with nodes for the tests of contact on nodes.

#include <array>
#include <map>
#include <random>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/nodal_faces.hpp"
#include "abut/contact/surface/placement.hpp"
#include "contact/surfaces.hpp"

namespace abut::test {

template <int Dim>
struct NodalScene {
    std::vector<Vector<Dim>> rest;
    contact::NodalFaceArrays<Dim> faces;
    std::vector<std::int32_t> node_body;

    [[nodiscard]] contact::NodalSurface<Dim> surface() const { return {rest, faces.view()}; }
    [[nodiscard]] std::int32_t n_bodies() const { return static_cast<std::int32_t>(faces.stiffness.size()); }
};

/// Nodes of a body by their place on a grid.
template <int Dim>
class GridNodes {
public:
    GridNodes(NodalScene<Dim>& scene, const Vector<Dim>& lower, const Vector<Dim>& size, const std::array<int, Dim>& n)
        : scene_(scene), lower_(lower), size_(size), n_(n), body_(scene.n_bodies() - 1) {}

    std::int32_t operator()(const std::array<int, Dim>& at) {
        const auto [place, is_new] = number_.try_emplace(at, static_cast<std::int32_t>(scene_.rest.size()));
        if (is_new) {
            Vector<Dim> x;
            for (int d = 0; d < Dim; ++d) x[d] = lower_[d] + size_[d] * at[d] / n_[d];
            scene_.rest.push_back(x);
            scene_.node_body.push_back(body_);
        }
        return place->second;
    }

private:
    NodalScene<Dim>& scene_;
    Vector<Dim> lower_, size_;
    std::array<int, Dim> n_;
    std::int32_t body_;
    std::map<std::array<int, Dim>, std::int32_t> number_;
};

/// The surface of a box of n cells along each axis, as a new body. 3D: quadrangles, or two triangles each.
template <int Dim>
void append_box(NodalScene<Dim>& scene, const Vector<Dim>& lower, const Vector<Dim>& upper, const std::array<int, Dim>& n,
                double stiffness, double depth, bool cut = true) {
    scene.faces.stiffness.push_back(stiffness);
    const std::int32_t body = scene.n_bodies() - 1;
    GridNodes<Dim> node(scene, lower, upper - lower, n);
    const auto append = [&](std::vector<std::int32_t> corners, bool outward) {
        if (!outward) std::reverse(corners.begin(), corners.end());
        scene.faces.append_face(corners, depth, body);
    };
    for (int axis = 0; axis < Dim; ++axis)
        for (const int end : {0, 1}) {
            const int u = (axis + 1) % Dim, v = (axis + 2) % Dim;
            for (int i = 0; i < n[u]; ++i)
                for (int j = 0; j < (Dim == 3 ? n[v] : 1); ++j) {
                    const auto at = [&](int a, int b) {
                        std::array<int, Dim> place{};
                        place[axis] = end * n[axis];
                        place[u] = a;
                        if constexpr (Dim == 3) place[v] = b;
                        return node(place);
                    };
                    if constexpr (Dim == 2) {
                        // along x on the lower side, and up on the right one, the outside is on the right
                        append({at(i, 0), at(i + 1, 0)}, (axis == 1) == (end == 0));
                    } else {
                        const std::array<std::int32_t, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
                        if (cut) {
                            append({q[0], q[1], q[2]}, end == 1);
                            append({q[0], q[2], q[3]}, end == 1);
                        } else {
                            append({q[0], q[1], q[2], q[3]}, end == 1);
                        }
                    }
                }
        }
}

template <int Dim>
std::array<int, Dim> counts(int n) {
    std::array<int, Dim> all;
    all.fill(n);
    return all;
}

/// Two boxes of unit sides one over the other, `gap` apart, of n_1 and n_2 cells; the upper one is moved aside and wider or
/// narrower by a little, so that nothing matches unless n_1 = n_2 and `shift` = 0.
template <int Dim>
NodalScene<Dim> two_boxes(int n_1, int n_2, double gap, double shift = 0.013, double k_1 = 3.0, double k_2 = 5.0,
                          bool cut = true) {
    NodalScene<Dim> scene;
    Vector<Dim> aside = shift * axis<Dim>(0);
    if (Dim == 3) aside[1] = 0.6 * shift;  // diagonals do not lie on each other
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts<Dim>(n_1), k_1, 0.1, cut);
    append_box<Dim>(scene, (1.0 + gap) * up<Dim>() + aside, Vector<Dim>::Ones() + (1.0 + gap) * up<Dim>() + aside,
                    counts<Dim>(n_2), k_2, 0.1, cut);
    return scene;
}

/// Every body moved as a whole: turned about `centre`, then shifted.
template <int Dim>
std::vector<Vector<Dim>> placed(const NodalScene<Dim>& scene, std::int32_t body, const contact::Placement<Dim>& placement,
                                std::vector<Vector<Dim>> x = {}) {
    if (x.empty()) x = scene.rest;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (scene.node_body[i] == body) x[i] = placement(scene.rest[i]);
    return x;
}

template <int Dim>
contact::Placement<Dim> shifted(const Vector<Dim>& by) {
    return {Matrix<Dim>::Identity(), by};
}

/// Turned by `angle` (3D: about a skew axis) about `centre`, then shifted.
template <int Dim>
contact::Placement<Dim> turned_about(const Vector<Dim>& centre, double angle, const Vector<Dim>& by = Vector<Dim>::Zero()) {
    contact::Placement<Dim> placement;
    if constexpr (Dim == 2)
        placement.turn = rotation_in_plane(angle);
    else
        placement.turn = rotation_about(Vector<3>(0.3, -0.5, 1.0).normalized(), angle);
    placement.offset = centre - placement.turn * centre + by;
    return placement;
}

/// Forces of a step on all nodes (n_nodes).
template <int Dim>
std::vector<Vector<Dim>> forces(const contact::NodalStep<Dim>& step, std::size_t n_nodes) {
    std::vector<Vector<Dim>> force(n_nodes, Vector<Dim>::Zero());
    step.add_force_to(force);
    return force;
}

}  // namespace abut::test
