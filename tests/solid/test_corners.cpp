// Free faces of a cell that answer where contact moves another of its faces.
#include <catch2/catch.hpp>

#include <array>
#include <utility>

#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

#include "abut/contact/contact.hpp"

using namespace abut;
using namespace abut::test;
using solid::BoundaryFace;
using solid::CornerRule;

namespace {

/// `eta`: 0: as it is by default.
template <int Dim>
solid::Ccg<Dim> operators(const mesh::Mesh<Dim>& mesh, CornerRule rule, double eta = 0.0) {
    solid::Material material{.young = 2.0, .poisson = 0.3, .density = 1.5};
    if (eta > 0.0) material.eta = eta;
    solid::BoundaryConditions<Dim> conditions;
    conditions.corner_rule = rule;
    return solid::Ccg<Dim>(mesh, std::vector{material}, conditions);
}

template <int Dim>
std::vector<BoundaryFace> all_faces(const solid::Ccg<Dim>& ccg) {
    const auto all = ccg.boundary_faces();
    return {all.begin(), all.end()};
}

template <int Dim>
const Vector<Dim>& normal_of(const mesh::Mesh<Dim>& mesh, BoundaryFace b) {
    return mesh.face_normal[mesh_face(mesh, b)];
}

template <int Dim>
std::vector<BoundaryFace> answering(const solid::Ccg<Dim>& ccg, BoundaryFace b) {
    std::vector<BoundaryFace> faces;
    ccg.boundary().for_each_answer(b, [&](BoundaryFace face, const Matrix<Dim>&) { faces.push_back(face); });
    return faces;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("gradients and coupling are the first and second derivatives of V by corrections, answers included",
                       "[solid][corners]", ((int Dim), Dim), 2, 3) {
    const CornerRule rule = GENERATE(CornerRule::relaxed, CornerRule::fixed);
    for (const auto& [name, mesh] : boxes<Dim>(2)) {
        INFO(name);
        auto ccg = operators<Dim>(mesh, rule);
        const auto faces = all_faces(ccg);
        const auto q = random_state(static_cast<std::size_t>(mesh.n_cells()) * Dim, 5);
        const auto values = random_state(faces.size() * Dim, 6);
        const auto u = vectors<Dim>(q), delta = vectors<Dim>(values);
        std::vector<Vector<Dim>> displacement(faces.size()), gradient(faces.size());
        ccg.evaluate_faces(ccg.region_of_faces(faces), u, {}, displacement, gradient);
        const auto coupling = ccg.coupling(faces);
        double expected = ccg.potential(u, {}, {});
        for (std::size_t f = 0; f < faces.size(); ++f) {
            expected += gradient[f].dot(delta[f]);
            for (std::int32_t i = coupling.offsets[f]; i < coupling.offsets[f + 1]; ++i)
                expected += 0.5 * delta[f].dot(coupling.blocks[i] * delta[coupling.columns[i]]);
        }
        CHECK(ccg.potential(u, {}, {faces, delta, {}}) == Approx(expected).epsilon(1e-12));
    }
}

TEMPLATE_TEST_CASE_SIG("beside a face that contact moves, the free faces of its cell carry no traction", "[solid][corners]",
                       ((int Dim), Dim), 2, 3) {
    double largest_traction = 0.0, largest_fixed = 0.0;
    int corners = 0;
    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        auto relaxed = operators<Dim>(mesh, CornerRule::relaxed), fixed = operators<Dim>(mesh, CornerRule::fixed);
        const std::vector<Vector<Dim>> zero(static_cast<std::size_t>(mesh.n_cells()), Vector<Dim>::Zero());
        std::vector<Vector<Dim>> force(zero.size());
        for (const BoundaryFace b : relaxed.boundary_faces()) {
            const std::vector<BoundaryFace> one{b};
            const std::vector<Vector<Dim>> inwards{-normal_of(mesh, b)};
            const std::int32_t cell = mesh.face_cells[mesh_face(mesh, b)][0];
            relaxed.gradient(zero, {}, {one, inwards, {}}, force);
            fixed.gradient(zero, {}, {one, inwards, {}}, force);
            const double size = fixed.stress(cell).norm();
            for (const BoundaryFace g : answering(relaxed, b)) {
                ++corners;
                raise(largest_traction, (relaxed.stress(cell) * normal_of(mesh, g)).norm() / size);
                raise(largest_fixed, (fixed.stress(cell) * normal_of(mesh, g)).norm() / size);
            }
            CHECK(answering(fixed, b).empty());
        }
    }
    CHECK(corners > (Dim == 2 ? 10 : 40));
    CHECK(largest_traction < 1e-13);
    CHECK(largest_fixed > 0.3);
}

TEMPLATE_TEST_CASE_SIG("the normal stiffness of a boundary face is twice the energy of a unit correction, over its area",
                       "[solid][corners]", ((int Dim), Dim), 2, 3) {
    auto meshes = boxes<Dim>(2);
    meshes.push_back({"round body", round_body<Dim>(0.5)});
    for (const auto& [name, mesh] : meshes) {
        INFO(name);
        auto ccg = operators<Dim>(mesh, CornerRule::relaxed, 1e-14);  // the jumps at interior faces store nothing
        const std::vector<Vector<Dim>> zero(static_cast<std::size_t>(mesh.n_cells()), Vector<Dim>::Zero());
        for (const BoundaryFace b : ccg.boundary_faces()) {
            const std::vector<BoundaryFace> one{b};
            const std::vector<Vector<Dim>> outwards{normal_of(mesh, b)};
            const double measure = mesh.face_measure[mesh_face(mesh, b)];
            const double energy = ccg.potential(zero, {}, {one, outwards, {}});
            CHECK(ccg.normal_stiffness(b) == Approx(2.0 * energy / measure).epsilon(1e-12));
        }
    }
}

TEMPLATE_TEST_CASE_SIG("faces answer across a corner only, and none loses its stiffness by it", "[solid][corners]",
                       ((int Dim), Dim), 2, 3) {
    auto meshes = boxes<Dim>(2);
    meshes.push_back({"round body", round_body<Dim>(0.5)});
    for (const auto& [name, mesh] : meshes) {
        INFO(name);
        const auto ccg = operators<Dim>(mesh, CornerRule::relaxed);
        const double young = 2.0;
        for (const BoundaryFace b : ccg.boundary_faces()) {
            const std::int32_t face = mesh_face(mesh, b), cell = mesh.face_cells[face][0];
            CHECK(ccg.normal_stiffness(b) >= 0.5 * young * mesh.face_measure[face] / mesh.cell_measure[cell]);
            for (const BoundaryFace g : answering(ccg, b)) {
                CHECK(mesh.face_cells[mesh_face(mesh, g)][0] == cell);
                CHECK(std::abs(normal_of(mesh, b).dot(normal_of(mesh, g))) < 0.61);
            }
        }
    }
    const auto disc = mesh::disc({.size = 0.3});
    const auto round = operators<2>(disc, CornerRule::relaxed);
    for (const BoundaryFace b : round.boundary_faces()) CHECK(answering(round, b).empty());
}

TEST_CASE("the tip of a needle, whose cell would give way, has faces that do not answer", "[solid][corners]") {
    // A long tetrahedron, cut at the middles of its edges: into one at each corner and four in the middle.
    mesh::CellSoup<3> soup;
    soup.name = "needle";
    soup.body_names = {"needle"};
    soup.vertices = {{0.2, 0.0, 0.0}, {-0.1, 0.17, 0.0}, {-0.1, -0.17, 0.0}, {0.0, 0.0, 2.0}};
    const auto middle = [&](int a, int b) {
        soup.vertices.push_back(0.5 *
                                (soup.vertices[static_cast<std::size_t>(a)] + soup.vertices[static_cast<std::size_t>(b)]));
        return static_cast<std::int32_t>(soup.vertices.size()) - 1;
    };
    const std::int32_t m01 = middle(0, 1), m02 = middle(0, 2), m03 = middle(0, 3), m12 = middle(1, 2), m13 = middle(1, 3),
                       m23 = middle(2, 3);
    std::array<std::array<std::int32_t, 4>, 8> cells{{{0, m01, m02, m03},
                                                      {m01, 1, m12, m13},
                                                      {m02, m12, 2, m23},
                                                      {m03, m13, m23, 3},
                                                      {m01, m02, m03, m13},
                                                      {m01, m02, m12, m13},
                                                      {m02, m03, m13, m23},
                                                      {m02, m12, m13, m23}}};
    for (auto& cell : cells) {
        const auto x = [&](int i) { return Vector<3>(soup.vertices[static_cast<std::size_t>(cell[i])]); };
        if ((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) < 0.0) std::swap(cell[2], cell[3]);
        soup.cell_vertices.append(cell);
        soup.cell_shape.push_back(CellShape::tetrahedron);
        soup.cell_body.push_back(0);
    }
    const auto mesh = mesh::build_mesh(std::move(soup));
    const auto ccg = operators<3>(mesh, CornerRule::relaxed);
    int at_the_tip = 0;
    for (const BoundaryFace b : ccg.boundary_faces()) {
        if (mesh.cell_centroid[mesh.face_cells[mesh_face(mesh, b)][0]].z() < 1.0) continue;
        ++at_the_tip;
        CHECK(answering(ccg, b).empty());
    }
    CHECK(at_the_tip == 3);
}

TEST_CASE("faces with a prescribed displacement do not answer in its direction", "[solid][corners]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    solid::BoundaryConditions<2> conditions;
    conditions.dirichlet = {{.group = "xmin", .constraint = solid::Constraint::normal},
                            {.group = "xmax", .constraint = solid::Constraint::full}};
    const solid::Ccg<2> ccg(mesh, std::vector{solid::Material{.young = 2.0, .poisson = 0.3}}, conditions);
    int rollers = 0;
    for (const BoundaryFace b : ccg.boundary_faces())
        ccg.boundary().for_each_answer(b, [&](BoundaryFace g, const Matrix<2>& answer) {
            CHECK(ccg.centroid(g).x() < 1.0);
            if (ccg.centroid(g).x() > 0.0) return;
            ++rollers;
            CHECK(answer.row(0).norm() < 1e-14);
            CHECK(answer.row(1).norm() > 0.1);
        });
    CHECK(rollers == 2);
}

TEMPLATE_TEST_CASE_SIG(
    "a boundary half-cell has the stiffness (lambda + 2 mu) |f|/|c| with fixed corners, and the depth (x_f - x_c) . n",
    "[solid][corners]", ((int Dim), Dim), 2, 3) {
    const solid::Material material{.young = 2.0, .poisson = 0.25, .density = 1.0};  // lambda = mu = 0.8
    const auto mesh = round_body<Dim>(0.5);
    auto options = reconstructed_bodies<Dim>(1);
    options.materials = {material};
    options.boundary.corner_rule = solid::CornerRule::fixed;
    solid::Solid<Dim> solid(mesh, options);
    const auto& surface = solid.contact().reconstruction()->surface();
    for (std::size_t b = 0; b < mesh.boundary_faces.size(); ++b) {
        const std::int32_t f = mesh.boundary_faces[b], c = mesh.face_cells[f][0];
        const double stiffness = 2.4 * mesh.face_measure[f] / mesh.cell_measure[c];
        CHECK(solid.ccg().normal_stiffness(static_cast<BoundaryFace>(b)) == Approx(stiffness).epsilon(1e-13));
        CHECK(surface.stiffness[b] == Approx(stiffness).epsilon(1e-13));
        CHECK(surface.cell_depth[b] ==
              Approx((mesh.face_centroid[f] - mesh.cell_centroid[c]).dot(mesh.face_normal[f])).epsilon(1e-13));
    }
}
