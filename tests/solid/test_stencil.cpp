#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "abut/base/eigen.hpp"
#include "abut/solid/operator/stencil.hpp"
#include "solid/scenes.hpp"

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

/// A box of bricks whose vertices have been moved.
template <int Dim, class Move>
mesh::Mesh<Dim> moved_bricks(const Vector<Dim>& upper, const std::array<int, Dim>& counts, const Move& move) {
    const auto box = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts,
                                               Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
    mesh::CellSoup<Dim> soup;
    soup.name = box.name;
    soup.cell_shape = box.cell_shape;
    soup.cell_vertices = box.cell_vertices;
    soup.cell_body = box.cell_body;
    soup.body_names = box.body_names;
    for (const Vector<Dim>& x : box.vertices) soup.vertices.push_back(move(x));
    return mesh::build_mesh(std::move(soup));
}

/// Cells of the stencil of each face, by its vertices, of a mesh whose vertices have been moved and keep their numbers.
template <int Dim>
std::map<std::vector<std::int32_t>, std::array<std::int32_t, Dim + 1>> stencils_of_faces(const mesh::Mesh<Dim>& mesh,
                                                                                         const Matrix<Dim>& motion) {
    mesh::CellSoup<Dim> soup;
    soup.name = mesh.name;
    soup.cell_shape = mesh.cell_shape;
    soup.cell_vertices = mesh.cell_vertices;
    soup.cell_body = mesh.cell_body;
    soup.body_names = mesh.body_names;
    for (const Vector<Dim>& x : mesh.vertices) soup.vertices.push_back(motion * x);
    const auto moved = mesh::build_mesh(std::move(soup), {.reorder = false});
    solid::StencilReport report;
    const auto stencils = solid::select_stencils<Dim>(moved, all_faces(moved), report);
    std::map<std::vector<std::int32_t>, std::array<std::int32_t, Dim + 1>> of_faces;
    for (std::int32_t f = 0; f < moved.n_faces(); ++f) {
        const auto vertices = moved.face_vertices[f];
        std::vector<std::int32_t> key(vertices.begin(), vertices.end());
        std::ranges::sort(key);
        auto cells = stencils[static_cast<std::size_t>(f)].cells;
        std::ranges::sort(cells);
        of_faces.emplace(std::move(key), cells);
    }
    return of_faces;
}

/// A simplex of cell centroids around a face's point.
template <int Dim>
struct Simplex {
    solid::FaceStencil<Dim> stencil{};                  ///< cells in increasing order
    double volume = 0.0;                                ///< in parts of the face's first cell
    double distances = 0.0;                             ///< their sum
    double second_moment = 0.0;                         ///< |sum w (x_c - x_f) (x_c - x_f)^T|
    [[nodiscard]] double thousandths_outside() const {  // whole ones
        return std::floor(1e3 * std::max(0.0, -*std::min_element(stencil.weights.begin(), stencil.weights.end())) + 1e-6);
    }
};

template <int Dim>
bool better(const Simplex<Dim>& a, const Simplex<Dim>& b) {
    if (a.thousandths_outside() != b.thousandths_outside()) return a.thousandths_outside() < b.thousandths_outside();
    if (a.distances != Approx(b.distances).epsilon(1e-12)) return a.distances < b.distances;
    return a.stencil.cells < b.stencil.cells;
}

/// All simplices of these cells but the flat ones.
template <int Dim>
std::vector<Simplex<Dim>> all_simplices(const mesh::Mesh<Dim>& mesh, std::int32_t face, std::vector<std::int32_t> cells) {
    std::sort(cells.begin(), cells.end());
    std::vector<Simplex<Dim>> simplices;
    std::vector<char> taken(cells.size(), 0);
    std::fill_n(taken.begin(), std::min<std::size_t>(cells.size(), Dim + 1), 1);
    do {
        Simplex<Dim> simplex;
        Eigen::Matrix<double, Dim + 1, Dim + 1> corners;  // columns (1, x_c - x_f): corners w = (1, 0)
        int j = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (!taken[i]) continue;
            corners.col(j) << 1.0, as_eigen(mesh.cell_centroid[cells[i]] - mesh.face_centroid[face]);
            simplex.distances += corners.col(j).template tail<Dim>().norm();
            simplex.stencil.cells[j++] = cells[i];
        }
        simplex.volume =
            std::abs(corners.determinant()) / (Dim == 2 ? 2.0 : 6.0) / mesh.cell_measure[mesh.face_cells[face][0]];
        if (simplex.volume < 1e-9) continue;
        const Eigen::Matrix<double, Dim + 1, 1> w = corners.fullPivLu().solve(corners.Identity().col(0));
        std::copy(w.begin(), w.end(), simplex.stencil.weights.begin());
        const Eigen::Matrix<double, Dim, Dim + 1> arms = corners.template bottomRows<Dim>();
        simplex.second_moment = (arms * w.asDiagonal() * arms.transpose()).norm();
        simplices.push_back(simplex);
    } while (std::prev_permutation(taken.begin(), taken.end()));
    return simplices;
}

/// Whether the cell of another face of the same surface is nearer to the plane of a boundary face than to its own.
template <int Dim>
bool is_hollow(const mesh::Mesh<Dim>& mesh, std::int32_t face, std::span<const std::int32_t> cells) {
    if (!mesh.is_boundary(face)) return false;
    return std::ranges::any_of(mesh.boundary_faces, [&](std::int32_t other) {
        const std::int32_t c = mesh.face_cells[other][0];
        if (c == mesh.face_cells[face][0] || std::ranges::find(cells, c) == cells.end()) return false;
        const auto below = [&](std::int32_t f) {
            return mesh.face_normal[f].dot(mesh.face_centroid[f] - mesh.cell_centroid[c]);
        };
        return mesh.face_normal[other].dot(mesh.face_normal[face]) > 0.5 && below(face) < 0.999 * below(other);
    });
}

/// What the documentation of select_stencils promises for a face.
template <int Dim>
struct Choice {
    Simplex<Dim> best;
    bool lowered_floor = false;
    std::size_t looked_at = 0;  ///< nearest cells
};

template <int Dim>
Choice<Dim> choice_by_enumeration(const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    std::vector<std::int32_t> cells;
    const auto distance = [&](std::int32_t c) { return (mesh.cell_centroid[c] - mesh.face_centroid[face]).norm(); };
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_body[c] == mesh.cell_body[mesh.face_cells[face][0]]) cells.push_back(c);
    std::sort(cells.begin(), cells.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    for (std::size_t n = Dim == 2 ? 10 : 14; n <= (Dim == 2 ? 40 : 56); n *= 2) {
        // Several cells may be equally far where the nearest end: with all of them, none of them may matter.
        std::size_t n_all = std::min(n, cells.size());
        const double end = distance(cells[n_all - 1]) * (1.0 + 1e-9);
        while (n_all < cells.size() && distance(cells[n_all]) < end) ++n_all;
        std::vector<std::int32_t> near{cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(n_all)};
        const bool hollow = is_hollow<Dim>(mesh, face, near);
        if (hollow)  // with what shares a face with the cell
            for (const std::int32_t own : mesh.cell_faces[mesh.face_cells[face][0]])
                for (const std::int32_t c : mesh.face_cells[own])
                    if (c >= 0 && std::ranges::find(near, c) == near.end()) near.push_back(c);
        const auto simplices = all_simplices<Dim>(mesh, face, near);
        if (simplices.empty()) continue;

        double largest = 0.0, floor = 0.05;
        for (const auto& simplex : simplices) raise(largest, simplex.volume);
        while (largest < floor) floor *= 0.5;
        double most = std::numeric_limits<double>::infinity();  // of the second moment
        if (hollow) {
            for (const auto& simplex : simplices)
                if (simplex.volume >= floor) most = std::min(most, (1.0 + 1e-6) * simplex.second_moment);
        }
        const Simplex<Dim>* best = nullptr;
        for (const auto& simplex : simplices)
            if (simplex.volume >= floor && simplex.second_moment <= most && (!best || better(simplex, *best)))
                best = &simplex;
        if (n_all > n) {
            REQUIRE(floor == 0.05);
            for (const std::int32_t c : best->stencil.cells) REQUIRE(distance(c) < end * (1.0 - 3e-9));
        }
        return {*best, floor < 0.05, n};
    }
    FAIL("no simplex near face " << face);
    return {};
}

/// Compares all stencils with those by enumeration; returns the choices for what a test has to know about its mesh.
template <int Dim>
std::vector<Choice<Dim>> check_against_enumeration(const mesh::Mesh<Dim>& mesh, const std::vector<std::int32_t>& faces) {
    solid::StencilReport report;
    const auto stencils = solid::select_stencils<Dim>(mesh, faces, report);
    std::vector<Choice<Dim>> choices;
    std::vector<std::int32_t> differing;
    double worst = 0.0;  // of the weights, which flat simplices make less certain
    for (std::size_t i = 0; i < faces.size(); ++i) {
        choices.push_back(choice_by_enumeration(mesh, faces[i]));
        const auto& [expected, volume, distances, second_moment] = choices.back().best;
        auto cells = stencils[i].cells;
        std::sort(cells.begin(), cells.end());
        if (cells != expected.cells) differing.push_back(faces[i]);
        for (int j = 0; j <= Dim; ++j) {
            const auto at = std::find(expected.cells.begin(), expected.cells.end(), stencils[i].cells[j]);
            if (at == expected.cells.end()) continue;
            raise(worst, volume * std::abs(stencils[i].weights[j] - expected.weights[at - expected.cells.begin()]));
        }
    }
    CHECK(differing == std::vector<std::int32_t>{});
    CHECK(worst < 1e-13);
    CHECK(report.lowered_floor ==
          std::count_if(choices.begin(), choices.end(), [](const auto& choice) { return choice.lowered_floor; }));
    return choices;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("affine fields are reproduced on every face of every kind of mesh", "[solid][stencil]",
                       ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : all_meshes<Dim>()) {
        INFO(name);
        solid::StencilReport report;
        const auto faces = all_faces(mesh);
        const auto stencils = solid::select_stencils<Dim>(mesh, faces, report);
        double worst = 0.0;
        for (std::size_t f = 0; f < stencils.size(); ++f) {
            double sum = 0.0;
            Vector<Dim> point = Vector<Dim>::Zero();
            for (int j = 0; j <= Dim; ++j) {
                sum += stencils[f].weights[j];
                point += stencils[f].weights[j] * mesh.cell_centroid[stencils[f].cells[j]];
            }
            raise(worst, std::abs(sum - 1.0));
            raise(worst, (point - mesh.face_centroid[f]).norm());
        }
        CHECK(worst < 1e-12);
    }
}

TEMPLATE_TEST_CASE_SIG("a stencil stays within the body of its face", "[solid][stencil]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> shift = Vector<Dim>::Zero();
    shift[0] = 1.0;
    const Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    const auto mesh =
        together(mesh::box<Dim>({.lower = lower, .upper = upper, .size = 0.4}),
                 mesh::box<Dim>({.lower = Vector<Dim>(lower + shift), .upper = Vector<Dim>(upper + shift), .size = 0.3}));
    solid::StencilReport report;
    const auto stencils = solid::select_stencils<Dim>(mesh, all_faces(mesh), report);
    for (std::size_t f = 0; f < stencils.size(); ++f)
        for (const std::int32_t cell : stencils[f].cells)
            CHECK(mesh.cell_body[cell] == mesh.cell_body[mesh.face_cells[f][0]]);
}

TEMPLATE_TEST_CASE_SIG("the report counts the faces that extrapolate and names the worst", "[solid][stencil]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = round_body<Dim>(0.3);
    solid::StencilReport report;
    const auto faces = all_faces(mesh);  // boundary faces too: these lie outside every simplex of centroids
    const auto stencils = solid::select_stencils<Dim>(mesh, faces, report);
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

TEST_CASE("a mesh has the same stencils in any unit of length and anywhere, also where simplices are equally good",
          "[stencil]") {
    const auto stencils_of = [](double unit, const Vector<3>& place) {
        const auto mesh = mesh::structured_box<3>(unit * place, unit * (place + Vector<3>(1.0, 0.9, 1.1)), {3, 3, 3},
                                                  mesh::CellShape::hexahedron);
        solid::StencilReport report;
        std::vector<std::array<std::int32_t, 4>> cells;
        for (const auto& stencil : solid::select_stencils<3>(mesh, all_faces<3>(mesh), report)) {
            cells.push_back(stencil.cells);
            std::sort(cells.back().begin(), cells.back().end());
        }
        return cells;
    };
    const auto plain = stencils_of(1.0, Vector<3>::Zero());
    for (const double unit : {1e-9, 1e-3, 1e9}) CHECK(stencils_of(unit, Vector<3>::Zero()) == plain);
    for (const double offset : {1.0, 1e2, 1e6}) CHECK(stencils_of(1.0, offset * Vector<3>(1.0, -0.7, 0.3)) == plain);
}

TEMPLATE_TEST_CASE_SIG(
    "rounding has no say in stencils: a mesh that is turned or mirrored and keeps its numbers has the same ones",
    "[solid][stencil]", ((int Dim), Dim), 2, 3) {
    // Grids of cubes, and cells around a centre: of half of the faces of tetrahedra, and all of a fan, simplices are equally
    // good and not the same.
    std::vector<NamedMesh<Dim>> meshes = boxes<Dim>();
    std::array<int, Dim> counts;
    counts.fill(6);
    for (NamedMesh<Dim>& named : meshes)
        if (const CellShape shape = named.mesh.cell_shape.front(); named.name.find("gmsh") == std::string::npos)
            named.mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts, shape);
    if constexpr (Dim == 2)
        for (const int sectors : {8, 12, 24})
            meshes.push_back({"fan of " + std::to_string(sectors), mesh::fan_disc({0.2, -0.1}, 0.3, sectors)});
    for (const auto& [name, mesh] : meshes) {
        const auto stencils = stencils_of_faces<Dim>(mesh, Matrix<Dim>::Identity());
        for (const double angle : {0.7, 2.5})
            for (const double side : {1.0, -1.0}) {
                CAPTURE(name, angle, side);
                Matrix<Dim> motion = turned_by<Dim>(angle);
                motion.col(0) = side * motion.col(0);
                CHECK(stencils_of_faces<Dim>(mesh, motion) == stencils);
            }
    }
}

TEST_CASE("no interior face of a uniform grid extrapolates", "[solid][stencil]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {6, 5}, CellShape::quadrangle);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (!mesh.is_boundary(f)) interior.push_back(f);
    solid::StencilReport report;
    const auto stencils = solid::select_stencils<2>(mesh, interior, report);
    CHECK(report.extrapolated == 0);
    CHECK(report.worst_weight > -1e-12);
    // On a grid a face lies half way between its two cells.
    for (const auto& stencil : stencils) {
        int halves = 0;
        for (const double weight : stencil.weights) halves += std::abs(weight - 0.5) < 1e-12;
        CHECK(halves == 2);
    }
}

TEMPLATE_TEST_CASE_SIG("cells forty times as long as thick have stencils, as all cells near a face may be of one row",
                       "[solid][stencil]", ((int Dim), Dim), 2, 3) {
    std::array<int, Dim> counts;
    counts.fill(3);
    counts[Dim - 1] = 80;
    Vector<Dim> upper = Vector<Dim>::Constant(3.0);
    upper[Dim - 1] = 2.0;
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "pile");
    solid::StencilReport report;
    const auto faces = all_faces(mesh);
    const auto stencils = solid::select_stencils<Dim>(mesh, faces, report);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        Vector<Dim> point = Vector<Dim>::Zero();
        for (std::size_t j = 0; j <= Dim; ++j) point += stencils[i].weights[j] * mesh.cell_centroid[stencils[i].cells[j]];
        CAPTURE(faces[i]);
        CHECK((point - mesh.face_centroid[faces[i]]).norm() < 1e-12);
        CHECK(std::ranges::min(stencils[i].weights) > (mesh.is_boundary(faces[i]) ? -0.5 - 1e-12 : -1e-12));
    }
}

TEMPLATE_TEST_CASE_SIG("a body one cell thick is refused with the face and the remedy", "[solid][stencil]", ((int Dim), Dim),
                       2, 3) {
    std::array<int, Dim> counts;
    counts.fill(5);
    counts[Dim - 1] = 1;
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "plate");
    solid::StencilReport report;
    const auto faces = all_faces(mesh);
    CHECK_THROWS_AS(solid::select_stencils<Dim>(mesh, faces, report), BadInput);
    CHECK_THROWS_WITH(solid::select_stencils<Dim>(mesh, faces, report),
                      Contains("plate: face ") && Contains("at least two cells"));
}

TEMPLATE_TEST_CASE_SIG(
    "the stencil of every face is the best of all simplices of the nearest cells of its body, looked at one by one",
    "[solid][stencil]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5), upper = Vector<Dim>::Constant(0.5);
    lower[0] = 1.0, upper[0] = 1.9;  // where the round body ends
    const auto mesh =
        together(round_body<Dim>(Dim == 2 ? 0.25 : 0.4), mesh::box<Dim>({.lower = lower, .upper = upper, .size = 0.3}));
    const auto choices = check_against_enumeration(mesh, all_faces(mesh));
    CHECK(choices.size() > 200);
}

TEMPLATE_TEST_CASE_SIG("between simplices that are equally good the lowest cell numbers decide", "[solid][stencil]",
                       ((int Dim), Dim), 2, 3) {
    // Unit bricks: an interior face has its own two cells, and 4 (2D) or 8 (3D) others exactly equally far.
    std::array<int, Dim> counts;
    counts.fill(4);
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Constant(4.0), counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (!mesh.is_boundary(f)) interior.push_back(f);
    check_against_enumeration(mesh, interior);
}

TEMPLATE_TEST_CASE_SIG("where no simplex reaches the smallest volume it is halved until one does, and the face counted",
                       "[solid][stencil]", ((int Dim), Dim), 2, 3) {
    // One wavy layer of bricks, ever flatter: centroids almost in one plane.
    Vector<Dim> upper = Vector<Dim>::Ones();
    upper[0] = 8.0;
    std::array<int, Dim> counts;
    counts.fill(4);
    counts[0] = 20;
    counts[Dim - 1] = 1;
    const auto mesh = moved_bricks<Dim>(upper, counts, [](const Vector<Dim>& x) {
        Vector<Dim> y = x + 0.03 * x.cwiseProduct(x);  // no two distances are equal
        y[Dim - 1] = x[Dim - 1] * (1.0 + 0.3 * std::exp(-0.7 * x[0]) * std::sin(5.0 * x[0]));
        return y;
    });
    const auto choices = check_against_enumeration(mesh, all_faces(mesh));
    const auto lowered =
        std::count_if(choices.begin(), choices.end(), [](const auto& choice) { return choice.lowered_floor; });
    CHECK(lowered > 20);
    CHECK(lowered + 20 < static_cast<std::ptrdiff_t>(choices.size()));
}

TEMPLATE_TEST_CASE_SIG("where the nearest cells lie in one plane up to four times as many are looked at", "[solid][stencil]",
                       ((int Dim), Dim), 2, 3) {
    // Two thick layers of bricks, ever wider along x.
    Vector<Dim> upper = Vector<Dim>::Ones();
    upper[Dim - 1] = Dim == 2 ? 2.0 : 3.0;
    std::array<int, Dim> counts;
    counts.fill(5);
    counts[0] = Dim == 2 ? 40 : 10;
    counts[Dim - 1] = 2;
    const auto mesh = moved_bricks<Dim>(upper, counts, [](const Vector<Dim>& x) {
        Vector<Dim> y = x + 0.03 * x.cwiseProduct(x);
        y[0] = 0.1 * x[0] + 3.0 * std::pow(x[0], 3);
        return y;
    });
    std::vector<std::int32_t> faces;
    for (std::int32_t f = 0; f < mesh.n_faces(); f += Dim == 2 ? 1 : 21) faces.push_back(f);
    const auto choices = check_against_enumeration(mesh, faces);
    for (const std::size_t times : {1, 2, 4}) {
        CAPTURE(times);
        const std::size_t wanted = times * (Dim == 2 ? 10 : 14);
        CHECK(std::any_of(choices.begin(), choices.end(), [&](const auto& choice) { return choice.looked_at == wanted; }));
    }
}

TEST_CASE("a face of a hole is extrapolated from the layers behind it, however coarse the hole is", "[solid][stencil]") {
    // e_r/r on three quarters of a ring: two layers of cells right behind a face are off by 3/8 h^2 of the second derivative, 2/a^3, at most.
    constexpr double a = 1.0, h = 0.125;
    const int around = GENERATE(12, 18, 24, 30, 48, 90);
    CAPTURE(around);
    const auto mesh = moved_bricks<2>({1.0, 1.0}, {8, around}, [&](const Vector<2>& x) {
        const double angle = 1.5 * M_PI * x[1];
        return Vector<2>((a + x[0]) * Vector<2>(std::cos(angle), std::sin(angle)));
    });
    const auto field = [](const Vector<2>& x) { return Vector<2>(x / x.squaredNorm()); };
    std::vector<std::int32_t> bore;
    for (const std::int32_t f : mesh.boundary_faces)
        if (mesh.face_normal[f].dot(mesh.face_centroid[f].normalized()) < -0.9) bore.push_back(f);
    REQUIRE(std::ssize(bore) == around);
    solid::StencilReport report;
    const auto stencils = solid::select_stencils<2>(mesh, bore, report);
    double worst = 0.0;
    for (std::size_t i = 0; i < bore.size(); ++i) {
        Vector<2> off = -field(mesh.face_centroid[bore[i]]);
        for (std::size_t j = 0; j < 3; ++j) off += stencils[i].weights[j] * field(mesh.cell_centroid[stencils[i].cells[j]]);
        raise(worst, off.norm());
    }
    CHECK(worst < 3.0 / 8.0 * h * h * 2.0 / (a * a * a));
}
