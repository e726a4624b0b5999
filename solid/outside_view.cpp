// How a program outside of a solid follows the faces that it loads.
#include "abut/solid/outside_view.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
std::span<const std::int32_t> OutsideView<Dim>::faces() const {
    return solid_.outside_->group(group_).faces.own();
}

template <int Dim>
std::span<const std::int32_t> OutsideView<Dim>::numbers() const {
    return solid_.outside_->group(group_).faces.numbers();
}

template <int Dim>
std::size_t OutsideView<Dim>::n_all() const {
    return solid_.outside_->group(group_).faces.n_all();
}

template <int Dim>
void OutsideView<Dim>::require_values(std::size_t n_given) const {
    dynamics::agreed(solid_.ranks(), [&] {
        if (const std::size_t n_faces = faces().size(); n_given != n_faces)
            throw BadInput("faces of '" + group_ + "': " + std::to_string(n_given) + " values are given for " +
                               std::to_string(n_faces) + " faces. Give one per face of the group that this rank has.",
                           {.value = static_cast<double>(n_given), .allowed = static_cast<double>(n_faces)});
    });
}

template <int Dim>
std::vector<double> OutsideView<Dim>::gather(std::span<const double> of_faces) const {
    require_values(of_faces.size());
    return solid_.outside_->group(group_).faces.gather(of_faces);
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::gather(std::span<const Vector<Dim>> of_faces) const {
    require_values(of_faces.size());
    return solid_.outside_->group(group_).faces.gather(of_faces);
}

template <int Dim>
std::span<const Vector<Dim>> OutsideView<Dim>::traction() const {
    return solid_.outside_->group(group_).traction;
}

template <int Dim>
std::vector<double> OutsideView<Dim>::bonded() const {
    const mesh::Mesh<Dim>& mesh = solid_.mesh_;
    const std::span<const std::int32_t> own = faces();
    std::vector<double> share(own.size(), 0.0);
    const std::span<const BondPlace<Dim>> places = solid_.bonds_->places();
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (solid_.bonds_->is_broken(p)) continue;
        for (const BoundaryFace b : places[p].faces) {
            if (b == no_face) continue;
            const std::int32_t face = mesh_face(mesh, b);
            const auto at = std::ranges::lower_bound(own, face);
            if (at == own.end() || *at != face) continue;
            double& of_face = share[static_cast<std::size_t>(at - own.begin())];
            of_face = std::min(of_face + places[p].area / mesh.face_measure[static_cast<std::size_t>(face)], 1.0);
        }
    }
    return share;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::position(std::span<const double> q) const {
    const auto& group = solid_.outside_->group(group_);
    std::vector<Vector<Dim>> of_part;
    std::vector<Vector<Dim>> position =
        solid_.outside_->displacement(group, solid_.part_->filled(as_vectors<Dim>(q), of_part));
    for (std::size_t i = 0; i < position.size(); ++i)
        position[i] += solid_.mesh_.face_centroid[static_cast<std::size_t>(group.faces.own()[i])];
    return position;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::velocity(std::span<const double> p) const {
    const auto& group = solid_.outside_->group(group_);
    std::vector<double> of_points(p.begin(), p.end());
    for (std::size_t i = 0; i < of_points.size(); ++i) of_points[i] *= solid_.inverse_mass()[i];
    std::vector<Vector<Dim>> of_part;
    return solid_.outside_->velocity(group,
                                     solid_.part_->filled(as_vectors<Dim>(std::span<const double>(of_points)), of_part));
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::motion(std::span<const double> q_0, std::span<const double> q_1, double time,
                                                  double dt) const {
    const auto& group = solid_.outside_->group(group_);
    std::vector<Vector<Dim>> of_part_0, of_part_1;
    const auto here_0 = solid_.part_->filled(as_vectors<Dim>(q_0), of_part_0);
    return solid_.outside_->motion(group, here_0, solid_.part_->filled(as_vectors<Dim>(q_1), of_part_1), time, dt);
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::normal(std::span<const double> q) const {
    const auto& group = solid_.outside_->group(group_);
    std::vector<Vector<Dim>> of_part, normal;
    const auto here = solid_.part_->filled(as_vectors<Dim>(q), of_part);
    for (const std::int32_t face : group.faces.own()) {
        const std::int32_t cell = solid_.mesh_.face_cells[static_cast<std::size_t>(face)][0];
        const auto [deformable, body] = solid_.bodies_->deformable_cell(cell);
        Matrix<Dim> turn = Matrix<Dim>::Identity();
        if (deformable >= 0) turn = solid_.frames_->end()[static_cast<std::size_t>(body)].turn;
        for (std::size_t i = 0; i < solid_.bodies_->rigid().size(); ++i)
            if (solid_.bodies_->rigid().mesh_body(i) == solid_.mesh_.cell_body[static_cast<std::size_t>(cell)])
                turn = solid_.bodies_->rigid().place(i, here).map;
        normal.push_back(turn * solid_.mesh_.face_normal[static_cast<std::size_t>(face)]);
    }
    return normal;
}

template class OutsideView<2>;
template class OutsideView<3>;

}  // namespace abut::solid
