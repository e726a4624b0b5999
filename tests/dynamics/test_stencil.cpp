#include <catch2/catch.hpp>

#include "abut/dynamics/stencil.hpp"
#include "dynamics/scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;

namespace {

template <int Dim>
std::vector<std::int32_t> all_faces(const mesh::Mesh<Dim>& mesh) {
    std::vector<std::int32_t> faces;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f) faces.push_back(f);
    return faces;
}

template <int Dim>
std::vector<NamedMesh<Dim>> all_meshes() {
    auto meshes = boxes<Dim>();
    meshes.push_back({"gmsh round body", round_body<Dim>(0.3)});
    if constexpr (Dim == 3) meshes.push_back({"gmsh sphere", mesh::sphere({.size = 0.5})});
    return meshes;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("affine fields are reproduced on every face of every kind of mesh", "[dynamics][stencil]",
                       ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : all_meshes<Dim>()) {
        INFO(name);
        dynamics::StencilReport report;
        const auto faces = all_faces(mesh);
        const auto stencils = dynamics::select_stencils<Dim>(mesh, faces, report);
        double worst = 0.0;
        for (std::size_t f = 0; f < stencils.size(); ++f) {
            double sum = 0.0;
            Vector<Dim> point = Vector<Dim>::Zero();
            for (int j = 0; j <= Dim; ++j) {
                sum += stencils[f].weights[j];
                point += stencils[f].weights[j] * mesh.cell_centroid[stencils[f].cells[j]];
            }
            worst = std::max({worst, std::abs(sum - 1.0), (point - mesh.face_centroid[f]).norm()});
        }
        CHECK(worst < 1e-12);
    }
}

TEMPLATE_TEST_CASE_SIG("a stencil stays within the body of its face", "[dynamics][stencil]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> shift = Vector<Dim>::Zero();
    shift[0] = 1.0;
    const Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    const auto mesh =
        together(mesh::box<Dim>({.lower = lower, .upper = upper, .size = 0.4}),
                 mesh::box<Dim>({.lower = Vector<Dim>(lower + shift), .upper = Vector<Dim>(upper + shift), .size = 0.3}));
    dynamics::StencilReport report;
    const auto stencils = dynamics::select_stencils<Dim>(mesh, all_faces(mesh), report);
    for (std::size_t f = 0; f < stencils.size(); ++f)
        for (const std::int32_t cell : stencils[f].cells)
            CHECK(mesh.cell_body[cell] == mesh.cell_body[mesh.face_cells[f][0]]);
}

TEMPLATE_TEST_CASE_SIG("the report counts the faces that extrapolate and names the worst", "[dynamics][stencil]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = round_body<Dim>(0.3);
    dynamics::StencilReport report;
    const auto faces = all_faces(mesh);  // boundary faces too: these lie outside every simplex of centroids
    const auto stencils = dynamics::select_stencils<Dim>(mesh, faces, report);
    std::int64_t extrapolated = 0;
    double worst = 0.0;
    std::int32_t worst_face = -1;
    for (std::size_t f = 0; f < stencils.size(); ++f) {
        const double lowest = *std::min_element(stencils[f].weights.begin(), stencils[f].weights.end());
        if (lowest < -1e-3) ++extrapolated;
        if (lowest < worst) worst = lowest, worst_face = static_cast<std::int32_t>(f);
    }
    CHECK(report.faces == static_cast<std::int64_t>(faces.size()));
    CHECK(report.extrapolated == extrapolated);
    CHECK(report.extrapolated >= static_cast<std::int64_t>(mesh.boundary_faces.size()));
    CHECK(report.worst_weight == worst);
    CHECK(report.worst_face == worst_face);
}

TEST_CASE("no interior face of a uniform grid extrapolates", "[dynamics][stencil]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {6, 5}, CellShape::quadrangle);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (!mesh.is_boundary(f)) interior.push_back(f);
    dynamics::StencilReport report;
    const auto stencils = dynamics::select_stencils<2>(mesh, interior, report);
    CHECK(report.extrapolated == 0);
    CHECK(report.worst_weight > -1e-12);
    // On a grid a face lies half way between its two cells.
    for (const auto& stencil : stencils) {
        int halves = 0;
        for (const double weight : stencil.weights) halves += std::abs(weight - 0.5) < 1e-12;
        CHECK(halves == 2);
    }
}

TEMPLATE_TEST_CASE_SIG("a body one cell thick is refused with the face and the remedy", "[dynamics][stencil]",
                       ((int Dim), Dim), 2, 3) {
    std::array<int, Dim> counts;
    counts.fill(5);
    counts[Dim - 1] = 1;
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "plate");
    dynamics::StencilReport report;
    const auto faces = all_faces(mesh);
    CHECK_THROWS_AS(dynamics::select_stencils<Dim>(mesh, faces, report), std::runtime_error);
    CHECK_THROWS_WITH(dynamics::select_stencils<Dim>(mesh, faces, report),
                      Contains("plate: face ") && Contains("at least two cells"));
}
