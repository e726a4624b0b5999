#include <catch2/catch.hpp>

#include <string>

#include "abut/solid/cell_view.hpp"
#include "solid/scenes.hpp"

// Blocks that are pressed together evenly, free at their sides, are in a uniform stress. That state has to be one of rest, and each cell
// has to show this stress, those that touch and those behind them.

using namespace abut;
using namespace abut::test;
using solid::ContactLaw;
using solid::Kinematics;

namespace {

constexpr double block_pressure = 1e-7;  // of the modulus: what is of second order in the strain is below what is tested
/// Finite bodies have terms of second order: up to 12 times the strain in pyramids.
double allowed_error(Kinematics kinematics) { return kinematics == Kinematics::finite ? 2e-6 : 1e-6; }
const solid::Material elastic_block{.young = 1.0, .poisson = 0.3, .density = 1.0};
constexpr double block_bottom = -0.3;  // of the boxes

/// Uniaxial stress along the last axis: the strains along it and across.
template <int Dim>
std::array<double, 2> squeezed() {
    const double nu = elastic_block.poisson;
    const double along = -block_pressure / elastic_block.young * (Dim == 3 ? 1.0 : 1.0 - nu * nu);
    return {along, -along * (Dim == 3 ? nu : nu / (1.0 - nu))};
}

/// `motion`: an orthogonal matrix, which turns the pile and the floor, or mirrors them.
template <int Dim>
solid::SolidOptions<Dim> pressed_pile(std::size_t n_bodies, Kinematics kinematics, ContactLaw law, const std::string& above,
                                      const Matrix<Dim>& motion = Matrix<Dim>::Identity()) {
    solid::SolidOptions<Dim> options;
    const Vector<Dim> up = motion * Vector<Dim>::Unit(Dim - 1);
    options.materials.assign(n_bodies, elastic_block);
    options.kinematics.assign(n_bodies, kinematics);
    options.law = law;
    options.contact.emplace();
    options.boundary.traction = {{.group = above, .value = -block_pressure * up, .follows = true}};
    options.obstacles = {contact::plane_obstacle<Dim>(block_bottom * up, up, 5.0)};
    return options;
}

/// The image of a mesh under an orthogonal matrix.
template <int Dim>
mesh::Mesh<Dim> image_of(const mesh::Mesh<Dim>& mesh, const Matrix<Dim>& motion) {
    mesh::CellSoup<Dim> soup;
    soup.name = mesh.name;
    soup.cell_shape = mesh.cell_shape;
    soup.cell_vertices = mesh.cell_vertices;
    soup.cell_body = mesh.cell_body;
    soup.body_names = mesh.body_names;
    for (const Vector<Dim>& x : mesh.vertices) soup.vertices.push_back(motion * x);
    for (const mesh::BoundaryGroup& group : mesh.groups) {
        for (const std::int32_t face : group.faces) {
            const auto vertices = mesh.face_vertices[face];
            soup.named_faces.push_back(
                {{vertices.begin(), vertices.end()}, static_cast<std::int32_t>(soup.group_names.size())});
        }
        soup.group_names.push_back(group.name);
    }
    return mesh::build_mesh(std::move(soup));
}

/// Every cell of a pile on the floor is at rest in the exact state, and shows its stress.
template <int Dim>
void check_pile(const mesh::Mesh<Dim>& upright, const solid::SolidOptions<Dim>& options,
                const Matrix<Dim>& motion = Matrix<Dim>::Identity()) {
    const mesh::Mesh<Dim> mesh = image_of(upright, motion);
    solid::Solid<Dim> solid(mesh, options);
    const auto [along, across] = squeezed<Dim>();
    std::vector<Vector<Dim>> u;
    const Vector<Dim> up = motion * Vector<Dim>::Unit(Dim - 1);
    for (const Vector<Dim>& x : mesh.cell_centroid) {
        const double height = x.dot(up);
        u.push_back(across * (x - height * up) + along * (height - block_bottom) * up);
    }
    std::vector<double> force(solid.size());
    solid.force(solid.cells().to_q(u), force);
    const Matrix<Dim> exact = -block_pressure * up * up.transpose();
    // Strain is plane: nu times the pressure out of it.
    const double out_of_plane = Dim == 2 ? -elastic_block.poisson * block_pressure : 0.0;
    double worst_force = 0.0, worst_stress = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double area = std::pow(mesh.cell_measure[c], (Dim - 1.0) / Dim);
        raise(worst_force, vectors<Dim>(force)[c].norm() / (block_pressure * area));
        raise(worst_stress, (solid.cells().stress(c) - exact).norm() / block_pressure);
        raise(worst_stress, std::abs(solid.cells().out_of_plane_stress(c) - out_of_plane) / block_pressure);
    }
    CHECK(worst_force < allowed_error(options.kinematics[0]));
    CHECK(worst_stress < allowed_error(options.kinematics[0]));
}

template <int Dim>
void check_block(Kinematics kinematics, ContactLaw law) {
    for (const auto& [name, mesh] : boxes<Dim>(Dim == 2 ? 8 : 10)) {
        CAPTURE(Dim, name, static_cast<int>(kinematics), static_cast<int>(law));
        check_pile<Dim>(mesh, pressed_pile<Dim>(1, kinematics, law, Dim == 2 ? "ymax" : "zmax"));
    }
}

/// Two blocks of one width whose faces do not match.
template <int Dim>
mesh::Mesh<Dim> two_blocks(CellShape shape) {
    const double joint = 0.2;
    Vector<Dim> lower = Vector<Dim>::Constant(block_bottom), upper = Vector<Dim>::Constant(0.8);
    Vector<Dim> lower_top = upper, upper_bottom = lower;
    lower_top[Dim - 1] = upper_bottom[Dim - 1] = joint;
    std::array<int, Dim> of_lower, of_upper;
    of_lower.fill(9);
    of_upper.fill(8);
    return together(mesh::structured_box<Dim>(lower, lower_top, of_lower, shape, "lower"),
                    mesh::structured_box<Dim>(upper_bottom, upper, of_upper, shape, "upper"));
}

}  // namespace

TEST_CASE("a block that is pressed on a floor is at rest under a uniform stress, which every cell shows",
          "[solid][contact][fields]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    check_block<2>(kinematics, ContactLaw::pair_potential);
    check_block<3>(kinematics, ContactLaw::pair_potential);
}

TEST_CASE("under the modified reconstruction, too, every cell of a block on a floor shows the pressure on it",
          "[solid][contact][fields]") {
    check_block<2>(Kinematics::small, ContactLaw::reconstruction);
    check_block<3>(Kinematics::small, ContactLaw::reconstruction);
}

TEST_CASE("blocks whose faces do not match press each other with a uniform stress, which every cell shows",
          "[solid][contact][fields]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    for (const CellShape shape : {CellShape::quadrangle, CellShape::triangle}) {
        CAPTURE(static_cast<int>(shape));
        check_pile<2>(two_blocks<2>(shape), pressed_pile<2>(2, kinematics, ContactLaw::pair_potential, "upper.ymax"));
    }
    for (const CellShape shape : {CellShape::hexahedron, CellShape::tetrahedron, CellShape::prism, CellShape::pyramid}) {
        CAPTURE(static_cast<int>(shape));
        check_pile<3>(two_blocks<3>(shape), pressed_pile<3>(2, kinematics, ContactLaw::pair_potential, "upper.zmax"));
    }
}

TEMPLATE_TEST_CASE_SIG("blocks of simplices show the stress that presses them however they are turned or mirrored",
                       "[solid][contact][fields]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating);
    const bool is_mirrored = GENERATE(false, true);
    CAPTURE(Dim, static_cast<int>(kinematics), is_mirrored);
    Matrix<Dim> motion = turned_by<Dim>(0.7);
    if (is_mirrored) motion.col(0) = -motion.col(0);
    const CellShape simplex = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    check_pile<Dim>(
        two_blocks<Dim>(simplex),
        pressed_pile<Dim>(2, kinematics, ContactLaw::pair_potential, Dim == 2 ? "upper.ymax" : "upper.zmax", motion),
        motion);
}

TEST_CASE("a block whose law has a stress out of the plane of its own shows that of the pressure on it, too",
          "[solid][contact][fields]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    solid::SolidOptions<2> options = pressed_pile<2>(1, kinematics, ContactLaw::pair_potential, "ymax");
    options.materials[0].expansion.along_1 = 1e-5;
    options.temperature_rise = {{.value = [](double, const Vector<2>&) { return 0.0; }}};
    check_pile<2>(boxes<2>(8).front().mesh, options);
}
