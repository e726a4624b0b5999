// How a program outside of a solid loads it and follows its faces.
#include "abut/solid/bodies.hpp"
#include "abut/solid/outside_loads.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
void Solid<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction) {
    outside_->set_traction(group, traction);
}

template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::traction(const std::string& group) const {
    return outside_->group(group).traction;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::face_position(const std::string& name, std::span<const double> q) const {
    const auto& group = outside_->group(name);
    std::vector<Vector<Dim>> position = outside_->displacement(group, as_vectors<Dim>(q));
    for (std::size_t i = 0; i < position.size(); ++i)
        position[i] += mesh_.face_centroid[static_cast<std::size_t>(group.faces[i])];
    return position;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::face_velocity(const std::string& group, std::span<const double> p) const {
    std::vector<double> of_points(p.begin(), p.end());
    for (std::size_t i = 0; i < of_points.size(); ++i) of_points[i] *= inverse_mass()[i];
    return outside_->velocity(outside_->group(group), as_vectors<Dim>(std::span<const double>(of_points)));
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::face_motion(const std::string& group, std::span<const double> q_0,
                                                 std::span<const double> q_1, double time, double dt) const {
    return outside_->motion(outside_->group(group), as_vectors<Dim>(q_0), as_vectors<Dim>(q_1), time, dt);
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::face_normal(const std::string& group, std::span<const double> q) const {
    std::vector<Vector<Dim>> normal;
    for (const std::int32_t face : outside_->group(group).faces) {
        const std::int32_t cell = mesh_.face_cells[static_cast<std::size_t>(face)][0];
        const auto [deformable, body] = bodies_->deformable_cell(cell);
        Matrix<Dim> turn = Matrix<Dim>::Identity();
        if (deformable >= 0) turn = frames_->end()[static_cast<std::size_t>(body)].turn;
        for (std::size_t i = 0; i < bodies_->rigid().size(); ++i)
            if (bodies_->rigid().mesh_body(i) == mesh_.cell_body[static_cast<std::size_t>(cell)])
                turn = bodies_->rigid().place(i, as_vectors<Dim>(q)).map;
        normal.push_back(turn * mesh_.face_normal[static_cast<std::size_t>(face)]);
    }
    return normal;
}

template <int Dim>
OutsideWork Solid<Dim>::outside_work(std::span<const double> q) const {
    return outside_->work(as_vectors<Dim>(q));
}

#define ABUT_INSTANTIATE(Dim)                                                                                               \
    template void Solid<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction);                \
    template std::span<const Vector<Dim>> Solid<Dim>::traction(const std::string& group) const;                             \
    template std::vector<Vector<Dim>> Solid<Dim>::face_position(const std::string& group, std::span<const double> q) const; \
    template std::vector<Vector<Dim>> Solid<Dim>::face_velocity(const std::string& group, std::span<const double> p) const; \
    template std::vector<Vector<Dim>> Solid<Dim>::face_motion(const std::string& group, std::span<const double> q_0,        \
                                                              std::span<const double> q_1, double time, double dt) const;   \
    template std::vector<Vector<Dim>> Solid<Dim>::face_normal(const std::string& group, std::span<const double> q) const;   \
    template OutsideWork Solid<Dim>::outside_work(std::span<const double> q) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
