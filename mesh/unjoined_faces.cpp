#include "abut/mesh/unjoined_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/plane_frame.hpp"
#include "abut/mesh/measures.hpp"

namespace abut::mesh {
namespace {

constexpr double lying_on = 1e-6;  // of the smaller face

/// A face as it is seen along a normal.
template <int Dim>
class SeenFace {
public:
    SeenFace(const Mesh<Dim>& mesh, std::int32_t face, const geometry::PlaneFrame<Dim>& frame) {
        const auto corners = face_corners<Dim>(mesh.vertices, mesh.face_vertices[face]);
        for (const Vector<Dim>& corner : corners.view()) corners_[count_++] = frame.project(corner);
        const auto own = mesh.face_normal[static_cast<std::size_t>(face)];
        if (own.dot(frame.normal()) < 0.0) std::reverse(corners_.begin(), corners_.begin() + count_);
    }
    [[nodiscard]] geometry::ProjectedFace<Dim> view() const { return {corners_.data(), static_cast<std::size_t>(count_)}; }

private:
    std::array<PlaneVector<Dim>, max_face_vertices> corners_;
    std::ptrdiff_t count_ = 0;
};

template <int Dim>
bool lie_on_each_other(const Mesh<Dim>& mesh, std::int32_t face_1, std::int32_t face_2) {
    const auto f_1 = static_cast<std::size_t>(face_1), f_2 = static_cast<std::size_t>(face_2);
    const Vector<Dim>& normal = mesh.face_normal[f_1];
    if (normal.dot(mesh.face_normal[f_2]) > lying_on - 1.0) return false;
    const double smaller = std::min(mesh.face_measure[f_1], mesh.face_measure[f_2]);
    if (std::abs(normal.dot(mesh.face_centroid[f_2] - mesh.face_centroid[f_1])) > lying_on * face_size<Dim>(smaller))
        return false;
    const geometry::PlaneFrame<Dim> frame(normal);
    const SeenFace<Dim> seen_1(mesh, face_1, frame), seen_2(mesh, face_2, frame);
    return geometry::overlap_area<Dim>(seen_1.view(), seen_2.view(), PlaneVector<Dim>::Zero()).area > lying_on * smaller;
}

}  // namespace

template <int Dim>
UnjoinedFaces find_unjoined_faces(const Mesh<Dim>& mesh, std::span<const std::array<std::int32_t, 2>> bonded) {
    using Pair = std::array<std::int32_t, 2>;
    const auto ordered = [](const Pair& faces) { return Pair{std::min(faces[0], faces[1]), std::max(faces[0], faces[1])}; };
    std::set<Pair> held;
    for (const Pair& faces : bonded) held.insert(ordered(faces));
    const auto face_of = [&](std::int32_t i) { return mesh.boundary_faces[static_cast<std::size_t>(i)]; };
    const auto body_of = [&](std::int32_t face) {
        return mesh.cell_body[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0])];
    };
    std::vector<geometry::Box<Dim>> boxes;
    for (const std::int32_t face : mesh.boundary_faces) {
        geometry::Box<Dim> box;
        for (const std::int32_t vertex : mesh.face_vertices[face])
            box.extend(mesh.vertices[static_cast<std::size_t>(vertex)]);
        boxes.push_back(box.grown(lying_on * face_size<Dim>(mesh.face_measure[static_cast<std::size_t>(face)])));
    }
    const auto pairs = geometry::overlapping_pairs<Dim>({}, boxes, [&](std::int32_t i, std::int32_t k) {
        return body_of(face_of(i)) == body_of(face_of(k)) && lie_on_each_other(mesh, face_of(i), face_of(k));
    });
    std::vector<std::int32_t> faces;
    for (const auto& [i, k] : pairs)
        if (!held.contains(ordered({face_of(i), face_of(k)}))) faces.insert(faces.end(), {face_of(i), face_of(k)});
    std::ranges::sort(faces);
    faces.erase(std::ranges::unique(faces).begin(), faces.end());
    UnjoinedFaces unjoined{.n_faces = static_cast<std::int32_t>(faces.size())};
    if (faces.empty()) return unjoined;
    unjoined.body = mesh.body_names[static_cast<std::size_t>(body_of(faces.front()))];
    for (int i = 0; i < Dim; ++i)
        unjoined.place[static_cast<std::size_t>(i)] = mesh.face_centroid[static_cast<std::size_t>(faces.front())][i];
    return unjoined;
}

template UnjoinedFaces find_unjoined_faces<2>(const Mesh<2>&, std::span<const std::array<std::int32_t, 2>>);
template UnjoinedFaces find_unjoined_faces<3>(const Mesh<3>&, std::span<const std::array<std::int32_t, 2>>);

}  // namespace abut::mesh
