// Bodies of simplices have sweeps of their own: the same operator as for cells of any shape.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <numbers>
#include <numeric>

#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::BoundaryFace;
using solid::CellForm;
using solid::FreeFaceRule;

namespace {

template <int Dim>
inline constexpr CellShape simplex = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
template <int Dim>
inline constexpr CellShape block = Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron;

/// Of height 1, or lower, which makes the angles of simplices small.
template <int Dim>
mesh::Mesh<Dim> box_at(double x, double height, int cells, CellShape shape, const std::string& name) {
    const Vector<Dim> lower = x * Vector<Dim>::Unit(0);
    Vector<Dim> size = Vector<Dim>::Ones();
    size[Dim - 1] = height;
    std::array<int, Dim> n;
    n.fill(cells);
    return mesh::structured_box<Dim>(lower, lower + size, n, shape, name);
}

/// Simplices from Gmsh, or flat ones with angles below 3 degrees.
template <int Dim>
mesh::Mesh<Dim> simplex_body(bool flat, int cells = 4) {
    if (flat) return box_at<Dim>(4.0, 0.05, cells, simplex<Dim>, "c");
    return mesh::box<Dim>({.size = 1.0 / cells, .name = "a"});
}

/// Three bodies apart from each other: both kinds of simplices, and others between.
template <int Dim>
mesh::Mesh<Dim> three_bodies(int cells = 4) {
    return mesh::combine<Dim>(std::vector<mesh::Mesh<Dim>>{
        simplex_body<Dim>(false, cells), box_at<Dim>(2.0, 1.0, cells, block<Dim>, "b"), simplex_body<Dim>(true, cells)});
}

const std::vector<solid::Material> materials{{.young = 2.0, .poisson = 0.3, .density = 1.5},
                                             {.young = 0.5, .poisson = 0.2, .density = 1.0},
                                             {.young = 1.0, .poisson = 0.45, .density = 1.0, .eta = 0.4}};

/// Where the free faces of a cell are in its jumps.
enum class Traces { balanced, affine };

/// Two bodies are held, one all along a side, one on a roller; all are pulled somewhere.
template <int Dim>
solid::BoundaryConditions<Dim> held_and_pulled(FreeFaceRule rule) {
    solid::BoundaryConditions<Dim> conditions;
    conditions.free_face_rule = rule;
    conditions.dirichlet.resize(2);
    conditions.dirichlet[0].group = "a.xmin";
    conditions.dirichlet[0].value = Vector<Dim>::Constant(0.3);
    conditions.dirichlet[1].group = "c.ymin";
    conditions.dirichlet[1].constraint = solid::Constraint::normal;
    conditions.dirichlet[1].value = Vector<Dim>::Constant(-0.2);
    for (const char* group : {"a.xmax", "b.xmax", "c.xmax"})
        conditions.traction.push_back({.group = group, .value = Vector<Dim>::Constant(0.7)});
    return conditions;
}

/// What contact of both laws adds on some faces.
template <int Dim>
struct Corrections {
    std::vector<BoundaryFace> faces;
    std::vector<Vector<Dim>> displacement, energy_gradient;
    std::vector<Matrix<Dim>> moment;

    Corrections(const solid::Ccg<Dim>& ccg, bool tilt) {
        for (std::int32_t b = 1; b < ccg.n_boundary(); b += 3)
            if (ccg.prescribed()[BoundaryFace{b}].isZero(0.0)) faces.push_back(BoundaryFace{b});
        energy_gradient = random_vectors<Dim>(faces.size(), 5);
        if (!tilt) {
            displacement = random_vectors<Dim>(faces.size(), 4);
            return;
        }
        const auto values = random_state(faces.size() * Dim * Dim, 6, 0.1);
        for (std::size_t i = 0; i < faces.size(); ++i) moment.push_back(Matrix<Dim>(values.data() + i * Dim * Dim));
    }
    [[nodiscard]] solid::FaceCorrections<Dim> view() const { return {faces, displacement, energy_gradient, moment}; }
};

template <class Values>
double largest_norm(const Values& values) {
    double size = 0.0;
    for (const auto& value : values) raise(size, value.norm());
    return size;
}

/// Largest |a - b| over `size`.
template <class Values>
double difference(const Values& a, const Values& b, double size) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) raise(worst, (a[i] - b[i]).norm());
    return worst / size;
}

/// Where the points of cells are.
enum class Points { centroids, as_of_bodies_that_turn };

/// Away from the centroids by up to a tenth of the cell in most of them.
template <int Dim>
mesh::Mesh<Dim> with_points(mesh::Mesh<Dim> mesh, Points points) {
    if (points == Points::centroids) return mesh;
    const auto shift = random_vectors<Dim>(static_cast<std::size_t>(mesh.n_cells()), 8);
    for (std::int32_t c = 1; c < mesh.n_cells(); ++c)
        if (c % 3 != 0)
            mesh.cell_centroid[c] += 0.1 * std::pow(mesh.cell_measure[c], 1.0 / Dim) * shift[static_cast<std::size_t>(c)];
    return mesh;
}

template <int Dim>
solid::BoundaryConditions<Dim> with_traces(solid::BoundaryConditions<Dim> conditions, const mesh::Mesh<Dim>& mesh,
                                           Traces traces) {
    if (traces == Traces::balanced) return conditions;
    conditions.thick_cells.resize(static_cast<std::size_t>(mesh.n_cells()));
    std::iota(conditions.thick_cells.begin(), conditions.thick_cells.end(), 0);
    return conditions;
}

/// Both forms of the operators, in one state.
template <int Dim>
struct BothForms {
    mesh::Mesh<Dim> mesh;
    solid::BoundaryConditions<Dim> conditions;
    solid::Ccg<Dim> general, simplices;
    std::vector<Vector<Dim>> u;

    explicit BothForms(FreeFaceRule rule = FreeFaceRule::local_equilibrium, Points points = Points::centroids,
                       Traces traces = Traces::balanced)
        : mesh(with_points(three_bodies<Dim>(), points)),
          conditions(with_traces(held_and_pulled<Dim>(rule), mesh, traces)),
          general(mesh, materials, conditions, {}, CellForm::general),
          simplices(mesh, materials, conditions),
          u(random_vectors<Dim>(static_cast<std::size_t>(mesh.n_cells()), 3)) {}

    template <class Evaluate>
    [[nodiscard]] double difference_of(const Evaluate& evaluate) {
        const auto expected = evaluate(general);
        return difference(expected, evaluate(simplices), largest_norm(expected));
    }
    /// Of forces of faces, which nearly cancel where they are free: over the largest force of a cell.
    template <class Evaluate>
    [[nodiscard]] double difference_of_faces(const Evaluate& evaluate, const solid::BoundaryLoad<Dim>& load) {
        std::vector<Vector<Dim>> of_cells(u.size());
        general.gradient(u, load, {}, of_cells);
        return difference(evaluate(general), evaluate(simplices), largest_norm(of_cells));
    }
};

inline constexpr double rounding = 5e-15;  // of the largest

}  // namespace

TEMPLATE_TEST_CASE_SIG("forces of bodies of simplices are those of the form for any cells, with supports, loads and contact",
                       "[solid][simplices]", ((int Dim), Dim), 2, 3) {
    BothForms<Dim> forms(GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent),
                         GENERATE(Points::centroids, Points::as_of_bodies_that_turn),
                         GENERATE(Traces::balanced, Traces::affine));
    const auto load = forms.general.load_at(0.0, 0.0);
    const Corrections<Dim> none(forms.general, false), tilted(forms.general, true);
    for (const auto& corrections : {solid::FaceCorrections<Dim>{}, none.view(), tilted.view()}) {
        const auto gradient = [&](solid::Ccg<Dim>& ccg) {
            std::vector<Vector<Dim>> result(forms.u.size());
            ccg.gradient(forms.u, load, corrections, result);
            return result;
        };
        CHECK(forms.difference_of(gradient) < rounding);
        const auto of_faces = [&](solid::Ccg<Dim>& ccg) {
            static_cast<void>(gradient(ccg));
            std::vector<Vector<Dim>> result;
            for (const BoundaryFace b : ccg.boundary_faces()) result.push_back(ccg.boundary_gradient(b));
            return result;
        };
        CHECK(forms.difference_of_faces(of_faces, load) < rounding);
        const double energy = forms.general.potential(forms.u, load, corrections);
        CHECK(forms.simplices.potential(forms.u, load, corrections) == Approx(energy).epsilon(rounding));
    }
}

TEMPLATE_TEST_CASE_SIG("displacements of faces, displacement gradients and stresses of simplices are those of any cells",
                       "[solid][simplices]", ((int Dim), Dim), 2, 3) {
    BothForms<Dim> forms(FreeFaceRule::local_equilibrium, Points::centroids, GENERATE(Traces::balanced, Traces::affine));
    const auto load = forms.general.load_at(0.0, 0.0);
    CHECK(forms.difference_of([&](solid::Ccg<Dim>& ccg) {
        std::vector<Vector<Dim>> displacement(static_cast<std::size_t>(ccg.n_boundary()));
        ccg.boundary_displacement(forms.u, load, displacement);
        return displacement;
    }) < rounding);
    const auto of_cells = [&](solid::Ccg<Dim>& ccg, const auto& value) {
        std::vector<Vector<Dim>> gradient(forms.u.size()), displacement(static_cast<std::size_t>(ccg.n_boundary()));
        ccg.gradient(forms.u, load, {}, gradient);
        const auto elsewhere = random_vectors<Dim>(forms.u.size(), 9);
        ccg.boundary_displacement(elsewhere, load, displacement);  // leaves the state alone
        std::vector<Matrix<Dim>> values;
        for (std::int32_t c = 0; c < ccg.n_cells(); ++c) values.push_back(value(c));
        return values;
    };
    CHECK(forms.difference_of([&](solid::Ccg<Dim>& ccg) {
        return of_cells(ccg, [&](std::int32_t c) { return ccg.displacement_gradient(c); });
    }) < rounding);
    CHECK(forms.difference_of([&](solid::Ccg<Dim>& ccg) {
        return of_cells(ccg, [&](std::int32_t c) { return ccg.stress(c); });
    }) < rounding);
}

TEMPLATE_TEST_CASE_SIG("what bodies of simplices have on some cells and faces is that of any cells, and of the whole sweep",
                       "[solid][simplices]", ((int Dim), Dim), 2, 3) {
    BothForms<Dim> forms(FreeFaceRule::local_equilibrium, Points::centroids, GENERATE(Traces::balanced, Traces::affine));
    const auto load = forms.general.load_at(0.0, 0.0);
    const Corrections<Dim> corrections(forms.general, GENERATE(false, true));
    std::vector<std::int32_t> cells;
    for (std::int32_t c = 0; c < forms.mesh.n_cells(); c += 5) cells.push_back(c);
    const auto on_cells = [&](solid::Ccg<Dim>& ccg) {
        std::vector<Vector<Dim>> gradient(cells.size());
        ccg.evaluate_cells(ccg.region_of_cells(cells), forms.u, load, corrections.view(), gradient);
        return gradient;
    };
    CHECK(forms.difference_of(on_cells) < rounding);
    std::vector<Vector<Dim>> whole(forms.u.size());
    forms.simplices.gradient(forms.u, load, corrections.view(), whole);
    const auto part = on_cells(forms.simplices);
    for (std::size_t i = 0; i < cells.size(); ++i) CHECK(part[i] == whole[static_cast<std::size_t>(cells[i])]);

    const auto on_faces = [&](solid::Ccg<Dim>& ccg) {
        std::vector<Vector<Dim>> displacement(corrections.faces.size()), gradient(corrections.faces.size());
        ccg.evaluate_faces(ccg.region_of_faces(corrections.faces), forms.u, load, displacement, gradient);
        return std::pair(displacement, gradient);
    };
    CHECK(forms.difference_of([&](solid::Ccg<Dim>& ccg) { return on_faces(ccg).first; }) < rounding);
    CHECK(forms.difference_of_faces([&](solid::Ccg<Dim>& ccg) { return on_faces(ccg).second; }, load) < rounding);
    CHECK(forms.difference_of([&](solid::Ccg<Dim>& ccg) {
        std::vector<Vector<Dim>> displacement(corrections.faces.size());
        std::vector<Matrix<Dim>> gradient(corrections.faces.size());
        ccg.evaluate_tilted_faces(ccg.region_of_tilted_faces(corrections.faces), forms.u, load, displacement, gradient);
        return gradient;
    }) < rounding);
}

TEMPLATE_TEST_CASE_SIG("simplices under the tractions of an affine field are in equilibrium in it, flat ones too",
                       "[solid][simplices]", ((int Dim), Dim), 2, 3) {
    const auto values = random_state(Dim * Dim, 8, 0.1);
    const Matrix<Dim> a(values.data());
    const bool flat = GENERATE(false, true);
    const auto mesh = simplex_body<Dim>(flat);
    const solid::Material material = materials[flat ? 2 : 0];
    const Matrix<Dim> strain = 0.5 * (a + a.transpose());
    const Matrix<Dim> stress = material.lambda() * strain.trace() * Matrix<Dim>::Identity() + 2.0 * material.mu() * strain;
    solid::BoundaryConditions<Dim> conditions;
    for (const std::string& side : box_sides(Dim)) {
        const double sign = side.ends_with("max") ? 1.0 : -1.0;
        conditions.traction.push_back({.group = side, .value = sign * stress.col(side[0] - 'x')});
    }
    solid::Ccg<Dim> ccg(mesh, std::vector{material}, conditions);
    const auto q = sampled(mesh, [&](const Vector<Dim>& x) { return Vector<Dim>(a * x); });
    std::vector<double> force(q.size());
    ccg.gradient(vectors<Dim>(q), ccg.load_at(0.0, 0.0), {}, vectors<Dim>(force));
    CHECK(largest(force) < 1e-13 * stress.norm());
    double worst = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) raise(worst, (ccg.stress(c) - stress).norm());
    CHECK(worst < 1e-12 * stress.norm());
}

TEMPLATE_TEST_CASE_SIG("an infinitesimal turn of free simplices has no force and no energy", "[solid][simplices]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = three_bodies<Dim>();
    solid::Ccg<Dim> ccg(mesh, materials, {});
    const Matrix<Dim> turn = turned_by<Dim>(0.5 * std::numbers::pi) - turned_by<Dim>(-0.5 * std::numbers::pi);  // skew
    const auto turned = sampled(mesh, [&](const Vector<Dim>& x) { return Vector<Dim>(turn * x); });
    const auto random = random_state(turned.size(), 3);
    std::vector<double> force(turned.size()), of_random(turned.size());
    ccg.gradient(vectors<Dim>(turned), {}, {}, vectors<Dim>(force));
    ccg.gradient(vectors<Dim>(random), {}, {}, vectors<Dim>(of_random));
    CHECK(largest(force) < 1e-14 * largest(of_random));
    CHECK(std::abs(ccg.potential(vectors<Dim>(turned), {}, {})) < 1e-25);
}

TEMPLATE_TEST_CASE_SIG("the operator of simplices is symmetric, and half its product with a state the energy",
                       "[solid][simplices]", ((int Dim), Dim), 2, 3) {
    BothForms<Dim> forms(FreeFaceRule::local_equilibrium, Points::centroids, GENERATE(Traces::balanced, Traces::affine));
    auto& ccg = forms.simplices;
    const auto free = ccg.load_free();
    const auto product = [](const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
        double sum = 0.0, size = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]), size += std::abs(a[i].dot(b[i]));
        return std::pair(sum, size);
    };
    const auto times_k = [&](const std::vector<Vector<Dim>>& u) {
        std::vector<Vector<Dim>> k_u(u.size());
        ccg.gradient(u, free, {}, k_u);
        return k_u;
    };
    for (unsigned seed = 20; seed < 25; ++seed) {
        const auto a = random_vectors<Dim>(forms.u.size(), seed), b = random_vectors<Dim>(forms.u.size(), seed + 10);
        const auto [a_k_b, size] = product(a, times_k(b));
        CHECK(std::abs(a_k_b - product(b, times_k(a)).first) < 1e-14 * size);
        CHECK(ccg.potential(a, free, {}) == Approx(0.5 * product(a, times_k(a)).first).epsilon(1e-13));
    }
}

TEMPLATE_TEST_CASE_SIG("the forces of simplices have the same bits on one thread, two and four", "[solid][simplices]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = three_bodies<Dim>(Dim == 2 ? 48 : 10);  // more chunks than the threads take one by one
    const auto conditions =
        with_traces(held_and_pulled<Dim>(FreeFaceRule::local_equilibrium), mesh, GENERATE(Traces::balanced, Traces::affine));
    solid::Ccg<Dim> ccg(mesh, materials, conditions);
    const Corrections<Dim> corrections(ccg, false);
    const auto load = ccg.load_at(0.0, 0.0);
    const auto u = random_vectors<Dim>(static_cast<std::size_t>(mesh.n_cells()), 3);
    const auto on_threads = [&](int threads) {
        const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads));
        oneapi::tbb::task_arena arena(threads);
        std::vector<Vector<Dim>> force(u.size(), Vector<Dim>::Zero());
        arena.execute([&] { ccg.gradient(u, load, corrections.view(), force); });
        return force;
    };
    const auto one = on_threads(1);
    for (const int threads : {2, 4}) {
        const auto several = on_threads(threads);
        CHECK(std::memcmp(several.data(), one.data(), one.size() * sizeof one[0]) == 0);
    }
}
