#include <algorithm>
#include <map>

#include "abut/base/disjoint_sets.hpp"
#include "abut/geometry/polygon.hpp"
#include "studies/nodal/p1_bodies.hpp"

namespace abut::studies::nodal {
/// None for a face of an obstacle.
template <int Dim>
std::vector<std::int32_t> P1Bodies<Dim>::element_nodes(contact::Face face) const {
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    const auto index = static_cast<std::size_t>(face);
    if (index >= mesh.boundary_faces.size()) return {};
    const auto nodes = mesh.cell_vertices[mesh.face_cells[mesh.boundary_faces[index]][0]];
    return {nodes.begin(), nodes.end()};
}

/// In the middle of the last step. A wall holds what moves into it: that the faces on it are tilted, and push along it a
/// little, must not let the filter change the momentum along it.
template <int Dim>
Vector<Dim> P1Bodies<Dim>::obstacle_normal(contact::Face face) const {
    const auto& surface = contact_.surface();
    const std::int32_t facet = surface.facet_offsets()[static_cast<std::size_t>(face)];
    std::array<Vector<Dim>, Dim> corners;
    for (int i = 0; i < Dim; ++i) {
        const std::int32_t node = surface.facets().view().vertices_of(facet)[i];
        corners[static_cast<std::size_t>(i)] = 0.5 * (x_0_[node] + x_1_[node]);
    }
    return geometry::face_normal<Dim>(corners);
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> P1Bodies<Dim>::contact_patches() const {
    DisjointSets joined(mass_.size());
    std::vector<std::int32_t> points;
    const auto& pairs = contact_.last().pairs;
    for (const auto& pair : pairs) {
        std::vector<std::int32_t> nodes = element_nodes(pair.face_1);
        const auto others = element_nodes(pair.face_2);
        nodes.insert(nodes.end(), others.begin(), others.end());
        for (const std::int32_t node : nodes) joined.join(nodes.front(), node);
        points.insert(points.end(), nodes.begin(), nodes.end());
    }
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());

    std::map<std::int32_t, dynamics::ContactPatch<Dim>> patches;
    for (const std::int32_t point : points) patches[joined.find(point)].points.push_back(point);
    const bool turns = is_finite_;
    for (const auto& pair : pairs)
        for (const auto& [face, other] : {std::pair{pair.face_1, pair.face_2}, std::pair{pair.face_2, pair.face_1}}) {
            if (!element_nodes(other).empty()) continue;
            const Vector<Dim> wall = obstacle_normal(other);
            const auto corners = scene_.mesh.face_vertices[scene_.mesh.boundary_faces[static_cast<std::size_t>(face)]];
            for (const std::int32_t node : corners)
                patches[joined.find(node)].holds.push_back(
                    {.position = turns ? Vector<Dim>(0.5 * (x_0_[node] + x_1_[node])) : rest_[node], .direction = wall});
        }
    std::vector<dynamics::ContactPatch<Dim>> result;
    for (auto& [root, patch] : patches) result.push_back(std::move(patch));
    return result;
}

template <int Dim>
void P1Bodies<Dim>::end_force_on(std::span<const std::int32_t> points, std::span<const double> q,
                                 std::span<Vector<Dim>> force) {
    place(q, time_, x_1_);
    const contact::NodalStep<Dim>& contact = contact_.evaluate(x_1_);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::int32_t point = points[i];
        force[i] = mass_[point] * gravity(static_cast<std::size_t>(point));
        for (const std::int32_t index : node_elements_[point]) {
            const Element& element = elements_[index];
            const auto corner = std::ranges::find(element.node, point) - element.node.begin();
            const Matrix<Dim> g = gradient(element, q);
            force[i] -= element.measure * stress_between(element, g, g) * element.slope[static_cast<std::size_t>(corner)];
        }
        const auto at = std::ranges::lower_bound(contact.nodes, point);
        if (at != contact.nodes.end() && *at == point) force[i] -= contact.gradient[at - contact.nodes.begin()];
    }
    for (const Pin<Dim>& pin : parts_.pins) {
        const Vector<Dim> pull = pin_force(pin, q, q);
        for (const std::int32_t node : pin.nodes)
            if (const auto at = std::ranges::lower_bound(points, node); at != points.end() && *at == node)
                force[at - points.begin()] += pull;
    }
}

template <int Dim>
std::vector<double> P1Bodies<Dim>::contact_pressure() const {
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    std::vector<double> pressure(mesh.boundary_faces.size(), 0.0);
    for (const auto& pair : contact_.last().pairs)
        for (const contact::Face face : {pair.face_1, pair.face_2})
            if (const auto i = static_cast<std::size_t>(face); i < pressure.size())
                pressure[i] += pair.normal_force / mesh.face_measure[mesh.boundary_faces[i]];
    return pressure;
}

template <int Dim>
void P1Bodies<Dim>::append_stiffness(std::span<const double>, double factor,
                                     std::vector<dynamics::MatrixEntry>& entries) const {
    for (const Element& element : elements_)
        for (int i = 0; i < Dim + 1; ++i)
            for (int j = 0; j < Dim + 1; ++j) {
                const Vector<Dim>&a = element.slope[i], b = element.slope[j];
                const Matrix<Dim> block = element.lambda * a * b.transpose() + element.mu * b * a.transpose() +
                                          element.mu * a.dot(b) * Matrix<Dim>::Identity();
                for (int k = 0; k < Dim; ++k)
                    for (int l = 0; l < Dim; ++l)
                        entries.push_back(
                            {element.node[i] * Dim + k, element.node[j] * Dim + l, factor * element.measure * block(k, l)});
            }
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template std::vector<std::int32_t> P1Bodies<Dim>::element_nodes(contact::Face) const;                               \
    template Vector<Dim> P1Bodies<Dim>::obstacle_normal(contact::Face) const;                                           \
    template std::vector<dynamics::ContactPatch<Dim>> P1Bodies<Dim>::contact_patches() const;                           \
    template void P1Bodies<Dim>::end_force_on(std::span<const std::int32_t>, std::span<const double>,                   \
                                              std::span<Vector<Dim>>);                                                  \
    template std::vector<double> P1Bodies<Dim>::contact_pressure() const;                                               \
    template void P1Bodies<Dim>::append_stiffness(std::span<const double>, double, std::vector<dynamics::MatrixEntry>&) \
        const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::nodal
