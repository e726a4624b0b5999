#include "studies/scenes/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::studies {
namespace {

constexpr std::array<int, 2> layers{4, 3};  // of cells in the lower and in the upper block
constexpr int cells_below = 4;              // across, in the lower block

constexpr std::array<const char*, 2> block_names{"lower", "upper"};

template <int Dim>
mesh::Mesh<Dim> block(const PatchOptions& options, std::size_t body) {
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    lower[Dim - 1] += static_cast<double>(body);
    upper[Dim - 1] += static_cast<double>(body);
    if (options.mesh == PatchMesh::unstructured)
        return mesh::box<Dim>({.lower = lower,
                               .upper = upper,
                               .size = 1.0 / cells_below,
                               .variant = static_cast<int>(body),
                               .name = block_names[body]});
    std::array<int, Dim> counts;
    counts.fill(options.mesh == PatchMesh::matching || body == 0 ? cells_below : cells_below - 1);
    counts[Dim - 1] = layers[body];
    return mesh::structured_box<Dim>(
        lower, upper, counts, Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron, block_names[body]);
}

/// Stress and strains of a block under the pressure p from above.
struct Uniform {
    double across;       // strain
    double along;        // strain, along the pressure
    double side_stress;  // across [Pa]
};

template <int Dim>
Uniform uniform(const solid::Material& material, PatchSides sides, double p) {
    const double nu = material.poisson, e = material.young;
    if (sides != PatchSides::free) return {0.0, -p / material.wave_modulus(), -p * nu / (1.0 - nu)};
    if (Dim == 2) return {nu * (1.0 + nu) * p / e, -(1.0 - nu * nu) * p / e, 0.0};
    return {nu * p / e, -p / e, 0.0};
}

template <int Dim>
solid::SolidOptions<Dim> solid_options(const PatchOptions& options) {
    solid::SolidOptions<Dim> solid;
    for (std::size_t body = 0; body < 2; ++body)
        solid.materials.push_back({.young = options.young[body], .poisson = options.poisson[body]});
    const std::string top = Dim == 2 ? "ymax" : "zmax", bottom = Dim == 2 ? "ymin" : "zmin";
    std::vector<std::string> rollers{"xmin"};
    if (Dim == 3) rollers.push_back("ymin");
    for (int axis = 0; axis < Dim - 1; ++axis) {
        if (options.sides == PatchSides::rollers) rollers.push_back(axis == 0 ? "xmax" : "ymax");
        if (options.sides == PatchSides::walls)
            solid.obstacles.push_back(contact::plane_obstacle<Dim>(Vector<Dim>::Ones(), -Vector<Dim>::Unit(axis), 4.0));
    }
    for (const char* name : block_names)
        for (const std::string& side : rollers)
            solid.boundary.dirichlet.push_back(
                {.group = std::string(name) + "." + side, .constraint = solid::Constraint::normal});
    solid.boundary.dirichlet.push_back({.group = "lower." + bottom, .constraint = solid::Constraint::normal});
    const double p = options.strain * solid.materials[0].wave_modulus();
    solid.boundary.traction = {{.group = "upper." + top, .value = -p * Vector<Dim>::Unit(Dim - 1)}};
    solid.boundary.free_face_rule = options.free_faces;
    solid.boundary.corner_rule = options.corners;
    solid.contact = options.contact;
    solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    return solid;
}

template <int Dim>
ContactPatchErrors errors(solid::Solid<Dim>& solid, const PatchOptions& options, const std::vector<double>& q) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    const auto& materials = solid.options().materials;
    const double p = options.strain * materials[0].wave_modulus();
    const std::array<Uniform, 2> exact{uniform<Dim>(materials[0], options.sides, p),
                                       uniform<Dim>(materials[1], options.sides, p)};
    ContactPatchErrors result;
    const auto field = solid.contact_at(q).field();
    const auto is_of_the_interface = [&](std::size_t b) {  // and not at a wall
        return std::isfinite(field.gap[b]) && std::abs(mesh.face_normal[mesh.boundary_faces[b]][Dim - 1]) > 0.5;
    };
    for (std::size_t b = 0; b < field.pressure.size(); ++b)
        if (is_of_the_interface(b)) result.pressure = std::max(result.pressure, std::abs(field.pressure[b] - p) / p);
    std::vector<double> force(q.size());
    solid.force(q, force);  // sets the stresses
    double largest = 0.0;
    const auto u = as_vectors<Dim>(std::span<const double>(q));
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        const Vector<Dim>& x = mesh.cell_centroid[c];
        Vector<Dim> expected = exact[body].across * x;
        expected[Dim - 1] = body == 0 ? exact[0].along * x[Dim - 1] : exact[0].along + exact[1].along * (x[Dim - 1] - 1.0);
        Matrix<Dim> stress = exact[body].side_stress * Matrix<Dim>::Identity();
        stress(Dim - 1, Dim - 1) = -p;
        result.stress = std::max(result.stress, (solid.ccg().stress(c) - stress).norm() / p);
        result.displacement = std::max(result.displacement, (u[c] - expected).norm());
        largest = std::max(largest, expected.norm());
    }
    result.displacement /= largest;
    return result;
}

}  // namespace

template <int Dim>
ContactPatchErrors solve_patch(const PatchOptions& options) {
    const auto mesh = mesh::combine<Dim>(std::vector{block<Dim>(options, 0), block<Dim>(options, 1)});
    solid::Solid<Dim> solid(mesh, solid_options<Dim>(options));
    auto solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
    ContactPatchErrors result = errors(solid, options, solution.q);
    result.report = std::move(solution.report);
    return result;
}

template ContactPatchErrors solve_patch<2>(const PatchOptions&);
template ContactPatchErrors solve_patch<3>(const PatchOptions&);

}  // namespace abut::studies
