// How a program outside of a solid follows the faces that it loads.
#include "abut/solid/outside_view.hpp"

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
std::span<const Vector<Dim>> OutsideView<Dim>::traction() const {
    return solid_.outside_->group(group_).traction;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::position(std::span<const double> q) const {
    const auto& group = solid_.outside_->group(group_);
    std::vector<Vector<Dim>> position = solid_.outside_->displacement(group, as_vectors<Dim>(q));
    for (std::size_t i = 0; i < position.size(); ++i)
        position[i] += solid_.mesh_.face_centroid[static_cast<std::size_t>(group.faces[i])];
    return position;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::velocity(std::span<const double> p) const {
    std::vector<double> of_points(p.begin(), p.end());
    for (std::size_t i = 0; i < of_points.size(); ++i) of_points[i] *= solid_.inverse_mass()[i];
    return solid_.outside_->velocity(solid_.outside_->group(group_), as_vectors<Dim>(std::span<const double>(of_points)));
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::motion(std::span<const double> q_0, std::span<const double> q_1, double time,
                                                  double dt) const {
    return solid_.outside_->motion(solid_.outside_->group(group_), as_vectors<Dim>(q_0), as_vectors<Dim>(q_1), time, dt);
}

template <int Dim>
std::vector<Vector<Dim>> OutsideView<Dim>::normal(std::span<const double> q) const {
    std::vector<Vector<Dim>> normal;
    for (const std::int32_t face : solid_.outside_->group(group_).faces) {
        const std::int32_t cell = solid_.mesh_.face_cells[static_cast<std::size_t>(face)][0];
        const auto [deformable, body] = solid_.bodies_->deformable_cell(cell);
        Matrix<Dim> turn = Matrix<Dim>::Identity();
        if (deformable >= 0) turn = solid_.frames_->end()[static_cast<std::size_t>(body)].turn;
        for (std::size_t i = 0; i < solid_.bodies_->rigid().size(); ++i)
            if (solid_.bodies_->rigid().mesh_body(i) == solid_.mesh_.cell_body[static_cast<std::size_t>(cell)])
                turn = solid_.bodies_->rigid().place(i, as_vectors<Dim>(q)).map;
        normal.push_back(turn * solid_.mesh_.face_normal[static_cast<std::size_t>(face)]);
    }
    return normal;
}

template class OutsideView<2>;
template class OutsideView<3>;

}  // namespace abut::solid
