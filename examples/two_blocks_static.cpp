// Two elastic blocks, one upon the other, at rest under a pressure: div sigma = 0 with contact, the least potential.
//
// Both 1 m x 1 m, the upper one half as stiff (E = 200 and 100 Pa, nu = 0.3, plane strain), sides on rollers, p = 1 Pa from
// above. Their meshes do not match: 4 faces meet 3. The contact has to carry p everywhere: in sum exactly (balance of
// forces), face by face as well as the discretisation can; and the top sinks by p / (lambda + 2 mu) of each height.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/statics.hpp"

using namespace abut;

namespace {

constexpr double pressure = 1.0;  // [Pa]

mesh::Mesh<2> two_blocks() {
    const auto shape = mesh::CellShape::quadrangle;
    return mesh::combine<2>(std::vector{mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, shape, "lower"),
                                        mesh::structured_box<2>({0.0, 1.0}, {1.0, 2.0}, {3, 3}, shape, "upper")});
}

solid::SolidOptions<2> pressed_together() {
    solid::SolidOptions<2> options;
    options.materials = {{.young = 200.0, .poisson = 0.3}, {.young = 100.0, .poisson = 0.3}};
    for (const char* side : {"lower.xmin", "lower.xmax", "lower.ymin", "upper.xmin", "upper.xmax"})
        options.boundary.dirichlet.push_back({.group = side, .constraint = solid::Constraint::normal});
    options.boundary.traction = {{.group = "upper.ymax", .value = Vector<2>(0.0, -pressure)}};
    options.contact = contact::ContactOptions{};
    options.law = solid::ContactLaw::reconstruction;  // whose pressure of contact is that of the cells behind the faces
    return options;
}

}  // namespace

int main() {
    const mesh::Mesh<2> mesh = two_blocks();
    solid::Solid<2> solid(mesh, pressed_together());
    const solid::StaticSolution solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0));
    std::printf("%s (%d evaluations of the force)\n", solution.report.ending.c_str(), solution.report.evaluations);

    double load = 0.0, worst = 0.0;  // of the upper block's faces [N/m]; largest |pressure - p| [Pa]
    const auto field = solid.contact_at(solution.q).field();
    for (std::size_t b = 0; b < field.pressure.size(); ++b) {
        const std::int32_t face = mesh.boundary_faces[b];
        if (!std::isfinite(field.gap[b])) continue;  // no face is opposite
        worst = std::max(worst, std::abs(field.pressure[b] - pressure));
        if (mesh.cell_body[mesh.face_cells[face][0]] == 1) load += field.pressure[b] * mesh.face_measure[face];
    }
    const auto u = as_vectors<2>(std::span<const double>(solution.q));
    const auto& [lower, upper] = std::pair(solid.options().materials[0], solid.options().materials[1]);
    double sunk = 0.0, exact = 0.0;  // of the upper cells' centres, on the mean [m]
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (mesh.cell_body[c] == 0) continue;
        sunk -= u[c].y() / 9.0;
        exact += pressure * (1.0 / lower.wave_modulus() + (mesh.cell_centroid[c].y() - 1.0) / upper.wave_modulus()) / 9.0;
    }
    std::printf("load carried           %.10f N/m   %.4f\n", load, pressure);
    std::printf("contact pressure, off by up to %.1e Pa\n", worst);
    std::printf("upper block sinks by   %.8f m     %.8f\n", sunk, exact);
    const bool good = solution.report.converged && std::abs(load - pressure) < 1e-6 && worst < 0.05;
    return good && std::abs(sunk - exact) < 0.01 * exact ? 0 : 1;
}
