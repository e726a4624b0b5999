#pragma once
// Meshes and scenes for the tests of the solid layer.
#include <array>
#include <random>
#include <string>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/solid.hpp"
#include "support/worst.hpp"

namespace abut::test {

/// The rotation by `angle`: in space about a slanted axis.
template <int Dim>
Matrix<Dim> turned_by(double angle) {
    if constexpr (Dim == 2)
        return rotation_in_plane(angle);
    else
        return rotation_about(Vector<3>(1.0, -0.4, 0.7).normalized(), angle);
}

using mesh::CellShape;

template <int Dim>
struct NamedMesh {
    std::string name;
    mesh::Mesh<Dim> mesh;
};

/// Boxes with groups xmin, xmax, ...: structured ones of every cell shape, and one from Gmsh.
template <int Dim>
std::vector<NamedMesh<Dim>> boxes(int cells = 3) {
    const Vector<Dim> lower = Vector<Dim>::Constant(-0.3);
    Vector<Dim> upper = Vector<Dim>::Constant(0.8);
    upper[0] = 1.1;
    std::vector<NamedMesh<Dim>> meshes;
    if constexpr (Dim == 2) {
        for (const CellShape shape : {CellShape::quadrangle, CellShape::triangle})
            meshes.push_back({shape == CellShape::triangle ? "triangles" : "quadrangles",
                              mesh::structured_box<2>(lower, upper, {cells + 1, cells}, shape)});
    } else {
        const std::array<std::pair<CellShape, const char*>, 4> shapes{{{CellShape::hexahedron, "hexahedra"},
                                                                       {CellShape::tetrahedron, "tetrahedra"},
                                                                       {CellShape::prism, "prisms"},
                                                                       {CellShape::pyramid, "pyramids"}}};
        for (const auto& [shape, name] : shapes)
            meshes.push_back({name, mesh::structured_box<3>(lower, upper, {cells + 1, cells, cells}, shape)});
    }
    meshes.push_back({"gmsh box", mesh::box<Dim>({.lower = lower, .upper = upper, .size = 1.2 / cells})});
    return meshes;
}

/// Round bodies from Gmsh.
inline mesh::Mesh<2> unit_disc(double size, int variant = 0, const Vector<2>& centre = Vector<2>::Zero()) {
    return mesh::disc({.centre = centre, .size = size, .variant = variant});
}
inline mesh::Mesh<3> unit_cylinder(double size, int variant = 0, const Vector<3>& centre = Vector<3>::Zero()) {
    return mesh::cylinder({.centre = centre, .length = 0.8, .size = size, .variant = variant});
}
template <int Dim>
mesh::Mesh<Dim> round_body(double size) {
    if constexpr (Dim == 2)
        return unit_disc(size);
    else
        return unit_cylinder(size);
}

template <int Dim>
mesh::Mesh<Dim> together(const mesh::Mesh<Dim>& a, const mesh::Mesh<Dim>& b) {
    return mesh::combine<Dim>(std::vector<mesh::Mesh<Dim>>{a, b});
}

inline std::vector<std::string> box_sides(int dim) {
    std::vector<std::string> sides{"xmin", "xmax", "ymin", "ymax"};
    if (dim == 3) sides.insert(sides.end(), {"zmin", "zmax"});
    return sides;
}

inline std::vector<double> random_state(std::size_t n, unsigned seed, double size = 1.0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-size, size);
    std::vector<double> x(n);
    for (double& x_i : x) x_i = value(random);
    return x;
}

/// Cell displacements of a field given at the centroids.
template <int Dim, class Field>
std::vector<double> sampled(const mesh::Mesh<Dim>& mesh, const Field& field) {
    std::vector<double> q;
    for (const Vector<Dim>& x : mesh.cell_centroid) {
        const Vector<Dim> u = field(x);
        q.insert(q.end(), u.begin(), u.end());
    }
    return q;
}

inline double largest(std::span<const double> values) {
    double size = 0.0;
    for (const double value : values) raise(size, std::abs(value));
    return size;
}

template <int Dim>
std::span<const Vector<Dim>> vectors(const std::vector<double>& values) {
    return as_vectors<Dim>(std::span<const double>(values));
}
template <int Dim>
std::span<Vector<Dim>> vectors(std::vector<double>& values) {
    return as_vectors<Dim>(std::span<double>(values));
}

/// A solid with its mesh and its integrator, at rest in its reference shape except for uniform velocities of its bodies.
template <int Dim>
struct Scene {
    mesh::Mesh<Dim> mesh;
    solid::Solid<Dim> solid;
    dynamics::Memm<solid::Solid<Dim>> memm;
    dynamics::Ledger<Dim> ledger;

    /// dt < 0: that part of the stable step.
    Scene(mesh::Mesh<Dim> made, solid::SolidOptions<Dim> options, const std::vector<Vector<Dim>>& velocity, double dt = -0.9)
        : mesh(std::move(made)),
          solid(mesh, std::move(options)),
          memm(solid, std::vector<double>(solid.size(), 0.0), solid::uniform_momentum<Dim>(solid, velocity),
               dt > 0.0 ? dt : -dt * dynamics::stable_step(solid).dt) {
        record();
    }
    Scene(const Scene&) = delete;

    void record() { ledger.record(dynamics::measure(memm, solid)); }
    void run(int steps, int every = 1) {
        for (int i = 1; i <= steps; ++i) {
            memm.step();
            if (i % every == 0 || i == steps) record();
        }
    }
    void run_until(double time, int every = 1) { run(static_cast<int>(std::ceil((time - memm.time()) / memm.dt())), every); }
    [[nodiscard]] double kinetic_start() const { return ledger.entries().front().kinetic; }
};

template <int Dim>
solid::SolidOptions<Dim> bodies(int n, const contact::ContactOptions& contact = {}) {
    solid::SolidOptions<Dim> options;
    options.materials.assign(static_cast<std::size_t>(n), solid::Material{.young = 1.0, .poisson = 0.3, .density = 1.0});
    options.contact = contact;
    return options;
}

/// The same under the law of reconstruction.
template <int Dim>
solid::SolidOptions<Dim> reconstructed_bodies(int n, const contact::ContactOptions& contact = {}) {
    solid::SolidOptions<Dim> options = bodies<Dim>(n, contact);
    options.law = solid::ContactLaw::reconstruction;
    return options;
}

/// Two discs: R = 1, v = +-0.05, gap 0.02, meshes that do not match.
inline mesh::Mesh<2> two_discs(double offset, double size = 0.25, double gap = 0.02) {
    const double x = std::sqrt(4.0 - offset * offset);  // centres at the distance 2
    return together(unit_disc(size, 0, {-0.5 * (x + gap), -0.5 * offset}),
                    unit_disc(size, 1, {0.5 * (x + gap), 0.5 * offset}));
}
inline const std::vector<Vector<2>> disc_velocities{{0.05, 0.0}, {-0.05, 0.0}};

/// Two small cylinders or boxes of tetrahedra, one above the other, that do not match.
inline mesh::Mesh<3> two_boxes(int n, double gap = 0.01) {
    return together(
        mesh::structured_box<3>({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.0}, {n + 1, n, n - 1}, CellShape::tetrahedron, "lower"),
        mesh::structured_box<3>({-0.5, -0.6, gap}, {0.7, 0.65, 1.0}, {n, n - 1, n - 2}, CellShape::tetrahedron, "upper"));
}
inline const std::vector<Vector<3>> box_velocities{{0.02, 0.01, 0.05}, {-0.02, 0.0, -0.05}};

inline mesh::Mesh<3> two_cylinders(double offset, double size = 0.4) {
    const double x = std::sqrt(4.0 - offset * offset);
    return together(unit_cylinder(size, 0, {-0.5 * (x + 0.02), -0.5 * offset, 0.0}),
                    unit_cylinder(size, 1, {0.5 * (x + 0.02), 0.5 * offset, 0.05}));
}
inline const std::vector<Vector<3>> cylinder_velocities{{0.05, 0.0, 0.0}, {-0.05, 0.0, 0.0}};

template <int Dim>
std::vector<Vector<Dim>> random_vectors(std::size_t n, unsigned seed) {
    const auto values = random_state(n * Dim, seed);
    const auto view = vectors<Dim>(values);
    return {view.begin(), view.end()};
}

/// Held all along one side, on rollers along another, pulled at a third.
template <int Dim>
solid::BoundaryConditions<Dim> held_and_pulled() {
    solid::BoundaryConditions<Dim> conditions;
    conditions.dirichlet.resize(2);
    conditions.dirichlet[0].group = "xmin";
    conditions.dirichlet[0].value = Vector<Dim>::Constant(0.3);
    conditions.dirichlet[1].group = "ymin";
    conditions.dirichlet[1].constraint = solid::Constraint::normal;
    conditions.dirichlet[1].value = Vector<Dim>::Constant(-0.2);
    conditions.traction.push_back({.group = "xmax", .value = Vector<Dim>::Constant(0.7)});
    return conditions;
}

}  // namespace abut::test
