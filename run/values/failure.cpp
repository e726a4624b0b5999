#include "abut/run/values/failure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <span>

#include "abut/mesh/mesh.hpp"

namespace abut::run {

template <int Dim>
WorstCell worst_cell(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> velocity) {
    WorstCell worst{.cell = 0, .speed = -1.0};
    for (std::size_t c = 0; c < velocity.size(); ++c) {
        const double speed = velocity[c].norm();
        const bool finite = std::isfinite(speed) && displacement[c].allFinite();
        if (finite && speed <= worst.speed) continue;
        worst = {static_cast<std::int32_t>(c), speed};
        if (!finite) break;
    }
    return worst;
}

template <int Dim>
std::string name_of_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell) {
    return name_of_cell<Dim>(mesh, cell, mesh.cell_centroid[static_cast<std::size_t>(cell)]);
}

template <int Dim>
std::string name_of_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Vector<Dim>& position) {
    const auto c = static_cast<std::size_t>(cell);
    return fmt::format("cell {} of body '{}' at ({:.4g})", mesh.cell_label[c],
                       mesh.body_names[static_cast<std::size_t>(mesh.cell_body[c])],
                       fmt::join(std::span(position.data(), Dim), ", "));
}

#define ABUT_INSTANTIATE(Dim)                                                                       \
    template WorstCell worst_cell<Dim>(std::span<const Vector<Dim>>, std::span<const Vector<Dim>>); \
    template std::string name_of_cell<Dim>(const mesh::Mesh<Dim>&, std::int32_t);                   \
    template std::string name_of_cell<Dim>(const mesh::Mesh<Dim>&, std::int32_t, const Vector<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
