#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/step.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/contact/rank_faces.hpp"

namespace abut::solid {

/// Whether each of `n_faces` faces of contact is in a group of the mesh: those of `shared`, rigid ones behind them, and
/// then those of obstacles. `boundary`: the boundary face of all but the last, `no_face` if there is none here. A call
/// of all ranks.
template <int Dim>
[[nodiscard]] std::vector<bool> faces_in_group(const mesh::Mesh<Dim>& mesh, std::size_t group,
                                               const SharedFaces<Dim>& shared, std::span<const BoundaryFace> boundary,
                                               std::size_t n_faces) {
    std::vector<bool> in_mesh(mesh.boundary_faces.size());
    for (const std::int32_t face : mesh.groups[group].faces)
        in_mesh[static_cast<std::size_t>(std::ranges::lower_bound(mesh.boundary_faces, face) -
                                         mesh.boundary_faces.begin())] = true;
    const auto is_in = [&](BoundaryFace b) { return b != no_face && in_mesh[static_cast<std::size_t>(b)]; };
    std::vector<double> own;
    for (std::size_t i = 0; i < shared.size(); ++i)
        if (shared.is_own(i)) own.push_back(is_in(boundary[i]) ? 1.0 : 0.0);
    std::vector<bool> in;
    for (const double of_face : shared.numbers_of_all(own)) in.push_back(of_face != 0.0);
    for (const BoundaryFace b : boundary.subspan(shared.size())) in.push_back(is_in(b));
    in.resize(n_faces);
    return in;
}

/// The sides of pairs, bodies, obstacles or groups, of faces of the surface of contact.
class FaceSides {
public:
    /// `body_of`: of each face, the body in the mesh, n_bodies + i of a face of obstacle i.
    FaceSides(std::vector<std::int32_t> body_of, std::int32_t n_bodies_and_obstacles)
        : body_of_(std::move(body_of)), n_bodies_(n_bodies_and_obstacles) {}

    /// A side as in BodyFriction::bodies and BodyInterference::bodies. `faces_of(g)`: whether each face is in group g
    /// of the mesh.
    template <class FacesOf>
    void add(std::int32_t side, const FacesOf& faces_of) {
        if (is_group(side)) in_group_.try_emplace(side, faces_of(static_cast<std::size_t>(side - n_bodies_)));
    }
    [[nodiscard]] bool is_group(std::int32_t side) const { return side >= n_bodies_; }
    [[nodiscard]] bool has(std::int32_t side, contact::Face face) const {
        const auto i = static_cast<std::size_t>(face);
        return is_group(side) ? in_group_.at(side)[i] : body_of_[i] == side;
    }

private:
    std::vector<std::int32_t> body_of_;
    std::int32_t n_bodies_;
    std::map<std::int32_t, std::vector<bool>> in_group_;
};

}  // namespace abut::solid
