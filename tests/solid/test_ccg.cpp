#include <catch2/catch.hpp>

#include <cstring>

#include "abut/base/large_array.hpp"
#include "abut/solid/operator/largest_motion.hpp"
#include "abut/solid/operator/largest_strain.hpp"
#include "solid/dense_stiffness.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using solid::BoundaryFace;
using solid::FreeFaceRule;

namespace {

inline constexpr std::array neumann_choices{FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate,
                                            FreeFaceRule::adjacent};

const solid::Material rubber{.young = 2.0, .poisson = 0.3, .density = 1.5};

template <int Dim>
solid::BoundaryConditions<Dim> free_boundary(FreeFaceRule neumann) {
    solid::BoundaryConditions<Dim> conditions;
    conditions.free_face_rule = neumann;
    return conditions;
}

template <int Dim>
std::vector<double> eigenvalues(const mesh::Mesh<Dim>& mesh, FreeFaceRule neumann) {
    solid::SolidOptions<Dim> options;
    options.materials = {rubber};
    options.boundary = free_boundary<Dim>(neumann);
    solid::Solid<Dim> solid(mesh, options);
    const MatrixXd k = dense_stiffness(solid);
    const VectorXd values =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (k + k.transpose()), Eigen::EigenvaluesOnly).eigenvalues();
    return {values.begin(), values.end()};
}

template <int Dim>
mesh::Mesh<Dim> small_unstructured(bool box) {
    if (box) return mesh::box<Dim>({.size = Dim == 2 ? 0.3 : 0.6});
    return round_body<Dim>(Dim == 2 ? 0.5 : 0.8);
}

/// Operators and a random state on an unstructured body.
template <int Dim>
struct Operators {
    mesh::Mesh<Dim> mesh;
    solid::Ccg<Dim> ccg;
    std::vector<double> q;

    explicit Operators(FreeFaceRule neumann, double size = 0.5) : Operators(round_body<Dim>(size), neumann) {}
    Operators(mesh::Mesh<Dim> body, FreeFaceRule neumann)
        : mesh(std::move(body)),
          ccg(mesh, std::vector{rubber}, free_boundary<Dim>(neumann)),
          q(random_state(static_cast<std::size_t>(mesh.n_cells()) * Dim, 3)) {}

    std::vector<BoundaryFace> some_faces(int step) const {
        std::vector<BoundaryFace> faces;
        for (std::int32_t b = 1; b < ccg.n_boundary(); b += step) faces.push_back(BoundaryFace{b});
        return faces;
    }
};

/// dV/ddelta_f: of the face itself and of those that answer to it.
template <int Dim>
Vector<Dim> answered_gradient(const solid::Ccg<Dim>& ccg, BoundaryFace face) {
    Vector<Dim> gradient = ccg.boundary_gradient(face);
    ccg.boundary().for_each_answer(face, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
        gradient += answer.transpose() * ccg.boundary_gradient(answering);
    });
    return gradient;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("rigid motions, and nothing else, cost no energy: 3 or 6 zero eigenvalues", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    const FreeFaceRule neumann = GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate);
    const auto values = eigenvalues(small_unstructured<Dim>(GENERATE(false, true)), neumann);
    const double highest = values.back();
    const std::size_t rigid_motions = Dim == 2 ? 3 : 6;
    for (std::size_t i = 0; i < rigid_motions; ++i) CHECK(std::abs(values[i]) < 1e-13 * highest);
    CHECK(values[rigid_motions] > 1e-3 * highest);
}

TEMPLATE_TEST_CASE_SIG("with the adjacent cell's value on free faces only translations cost no energy", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    const auto values = eigenvalues(small_unstructured<Dim>(false), FreeFaceRule::adjacent);
    const double highest = values.back();
    for (std::size_t i = 0; i < Dim; ++i) CHECK(std::abs(values[i]) < 1e-13 * highest);
    CHECK(values[Dim] > 1e-6 * highest);
}

TEMPLATE_TEST_CASE_SIG("the stiffness is symmetric, on every kind of mesh and for every Neumann choice", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    const FreeFaceRule neumann = GENERATE(from_range(neumann_choices));
    for (const auto& [name, mesh] : boxes<Dim>(2)) {
        INFO(name);
        solid::SolidOptions<Dim> options;
        options.materials = {rubber};
        options.boundary.free_face_rule = neumann;
        solid::Solid<Dim> solid(mesh, options);
        const MatrixXd k = dense_stiffness(solid);
        CHECK((k - k.transpose()).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() < 1e-14 * k.cwiseAbs().maxCoeff());
    }
}

TEMPLATE_TEST_CASE_SIG(
    "patch test: under an affine displacement of the whole boundary every cell is in equilibrium and has the exact stress",
    "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    const FreeFaceRule neumann = GENERATE(from_range(neumann_choices));
    const auto values = random_state(Dim * Dim + Dim, 8, 0.1);
    const Matrix<Dim> a(values.data());
    const Vector<Dim> b(values.data() + Dim * Dim);
    const auto affine = [&](const Vector<Dim>& x) { return Vector<Dim>(a * x + b); };
    const Matrix<Dim> strain = 0.5 * (a + a.transpose());
    const Matrix<Dim> stress = rubber.lambda() * strain.trace() * Matrix<Dim>::Identity() + 2.0 * rubber.mu() * strain;

    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        solid::BoundaryConditions<Dim> conditions;
        conditions.free_face_rule = neumann;
        for (const std::string& side : box_sides(Dim)) {
            solid::DirichletCondition<Dim> condition;
            condition.group = side;
            condition.history = [&](double, const Vector<Dim>& x) { return affine(x); };
            conditions.dirichlet.push_back(condition);
        }
        solid::Ccg<Dim> ccg(mesh, std::vector{rubber}, conditions);
        const auto q = sampled(mesh, affine);
        std::vector<double> force(q.size());
        ccg.gradient(vectors<Dim>(q), ccg.load_at(0.0, 0.0), {}, vectors<Dim>(force));
        CHECK(largest(force) < 1e-12 * stress.norm());
        double worst = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) raise(worst, (ccg.stress(c) - stress).norm());
        CHECK(worst < 1e-12 * stress.norm());
    }
}

TEMPLATE_TEST_CASE_SIG("the potential is 1/2 u.Ku and its gradient K u", "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(GENERATE(from_range(neumann_choices)));
    const auto u = vectors<Dim>(operators.q);
    std::vector<double> k_u(operators.q.size());
    operators.ccg.gradient(u, {}, {}, vectors<Dim>(k_u));
    double product = 0.0;
    for (std::size_t i = 0; i < k_u.size(); ++i) product += operators.q[i] * k_u[i];
    CHECK(operators.ccg.potential(u, {}, {}) == Approx(0.5 * product).epsilon(1e-13));
}

TEMPLATE_TEST_CASE_SIG("the gradient is the central difference of the potential, with corrections of boundary faces too",
                       "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(GENERATE(from_range(neumann_choices)));
    const auto faces = operators.some_faces(3);
    const auto delta = random_vectors<Dim>(faces.size(), 4);
    const solid::FaceCorrections<Dim> corrections{faces, delta, {}};
    std::vector<double> gradient(operators.q.size());
    operators.ccg.gradient(vectors<Dim>(operators.q), {}, corrections, vectors<Dim>(gradient));
    for (unsigned seed = 0; seed < 5; ++seed) {
        const auto way = random_state(operators.q.size(), 20 + seed);
        double slope = 0.0;
        for (std::size_t i = 0; i < way.size(); ++i) slope += gradient[i] * way[i];
        const auto potential_at = [&](double s) {  // a quadratic: the central difference has no truncation error
            auto q = operators.q;
            for (std::size_t i = 0; i < q.size(); ++i) q[i] += s * way[i];
            return operators.ccg.potential(vectors<Dim>(q), {}, corrections);
        };
        const double forward = potential_at(1.0), backward = potential_at(-1.0);
        CHECK(std::abs(0.5 * (forward - backward) - slope) < 1e-13 * (std::abs(forward) + std::abs(backward)));
    }
}

TEMPLATE_TEST_CASE_SIG("the forces of a free body sum to zero, also under corrections and opposite pair forces",
                       "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(GENERATE(from_range(neumann_choices)));
    const auto faces = operators.some_faces(3);
    const auto delta = random_vectors<Dim>(faces.size(), 4);
    auto pair_force = random_vectors<Dim>(faces.size(), 5);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& f : pair_force) sum += f;
    pair_force.back() -= sum;
    std::vector<double> force(operators.q.size());
    operators.ccg.gradient(vectors<Dim>(operators.q), {}, {faces, delta, pair_force}, vectors<Dim>(force));
    Vector<Dim> total = Vector<Dim>::Zero();
    double size = 0.0;
    for (const Vector<Dim>& f : vectors<Dim>(force)) total += f, size += f.norm();
    CHECK(total.norm() < 1e-14 * size);
}

TEMPLATE_TEST_CASE_SIG("a translation of 300 body sizes changes forces by no more than its own rounding", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(FreeFaceRule::local_equilibrium);
    auto moved = operators.q;
    for (double& q : moved) q += 600.0;
    std::vector<double> force(moved.size()), force_moved(moved.size());
    operators.ccg.gradient(vectors<Dim>(operators.q), {}, {}, vectors<Dim>(force));
    operators.ccg.gradient(vectors<Dim>(moved), {}, {}, vectors<Dim>(force_moved));
    double worst = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) raise(worst, std::abs(force[i] - force_moved[i]));
    CHECK(worst < 600.0 * 1e-15 * largest(force));
}

TEMPLATE_TEST_CASE_SIG("what is evaluated on a part of the mesh has the bits of the whole sweep", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    const double size = Dim == 2 ? 0.25 : 0.4;
    Operators<Dim> operators(GENERATE(false, true) ? mesh::box<Dim>({.size = size}) : round_body<Dim>(size),
                             GENERATE(from_range(neumann_choices)));
    const auto u = vectors<Dim>(operators.q);
    auto& ccg = operators.ccg;
    std::vector<Vector<Dim>> whole_displacement(static_cast<std::size_t>(ccg.n_boundary()));
    std::vector<double> whole_force(operators.q.size());

    const auto faces = operators.some_faces(7);
    std::vector<Vector<Dim>> displacement(faces.size()), force(faces.size());
    ccg.evaluate_faces(ccg.region_of_faces(faces), u, {}, displacement, force);
    ccg.boundary_displacement(u, {}, whole_displacement);
    ccg.gradient(u, {}, {}, vectors<Dim>(whole_force));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        CHECK(displacement[i] == whole_displacement[static_cast<std::size_t>(faces[i])]);
        CHECK(force[i] == answered_gradient(ccg, faces[i]));
    }

    std::vector<std::int32_t> cells;
    for (std::int32_t c = 0; c < operators.mesh.n_cells(); c += 5) cells.push_back(c);
    const auto delta = random_vectors<Dim>(faces.size(), 4), pair_force = random_vectors<Dim>(faces.size(), 5);
    const solid::FaceCorrections<Dim> corrections{faces, delta, pair_force};
    ccg.gradient(u, {}, corrections, vectors<Dim>(whole_force));
    std::vector<Vector<Dim>> cell_force(cells.size());
    ccg.evaluate_cells(ccg.region_of_cells(cells), u, {}, corrections, cell_force);
    for (std::size_t i = 0; i < cells.size(); ++i)
        CHECK(cell_force[i] == vectors<Dim>(whole_force)[static_cast<std::size_t>(cells[i])]);
}

TEMPLATE_TEST_CASE_SIG(
    "coupling blocks are what unit corrections change in the face forces, and faces left out do not answer", "[solid][ccg]",
    ((int Dim), Dim), 2, 3) {
    const bool fan = Dim == 2 && GENERATE(false, true), box = !fan && GENERATE(false, true);
    const FreeFaceRule neumann = GENERATE(from_range(neumann_choices));
    mesh::Mesh<Dim> mesh = small_unstructured<Dim>(box);
    if constexpr (Dim == 2)
        if (fan) mesh = mesh::fan_disc({0.0, 0.0}, 1.0, 9);
    solid::Ccg<Dim> ccg(mesh, std::vector{rubber}, free_boundary<Dim>(neumann));
    const auto all = ccg.boundary_faces();
    const std::vector<BoundaryFace> faces(all.begin(), all.end());
    const auto coupling = ccg.coupling(faces);
    const std::vector<Vector<Dim>> zero(static_cast<std::size_t>(mesh.n_cells()), Vector<Dim>::Zero());
    std::vector<Vector<Dim>> force(zero.size());
    double worst = 0.0, size = 0.0;
    for (const BoundaryFace g : faces)
        for (int j = 0; j < Dim; ++j) {
            const std::vector<BoundaryFace> one{g};
            const std::vector<Vector<Dim>> unit{Vector<Dim>::Unit(j)};
            ccg.gradient(zero, {}, {one, unit, {}}, force);
            for (const BoundaryFace f : faces) {
                Vector<Dim> expected = Vector<Dim>::Zero();
                for (std::int32_t i = coupling.offsets[number_of(f)]; i < coupling.offsets[number_of(f) + 1]; ++i)
                    if (coupling.columns[i] == number_of(g)) expected = coupling.blocks[i].col(j);
                raise(worst, (answered_gradient(ccg, f) - expected).norm());
                raise(size, expected.norm());
            }
        }
    CHECK(worst < 1e-14 * size);
    if (fan || Dim == 3) CHECK(coupling.columns.size() > faces.size());
    for (std::int32_t f = 0; f < ccg.n_boundary(); ++f)
        CHECK(std::is_sorted(coupling.columns.begin() + coupling.offsets[f],
                             coupling.columns.begin() + coupling.offsets[f + 1]));
}

TEMPLATE_TEST_CASE_SIG("the bound on the motion of boundary faces is never below the motion", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(GENERATE(from_range(neumann_choices)));
    auto& ccg = operators.ccg;
    const auto n = static_cast<std::size_t>(ccg.n_boundary());
    for (unsigned seed = 0; seed < 20; ++seed) {
        auto to = random_state(operators.q.size(), 50 + seed, 0.1);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] += operators.q[i] + (seed % 2 == 0 ? 3.0 : 0.0);
        std::vector<Vector<Dim>> before(n), after(n);
        ccg.boundary_displacement(vectors<Dim>(operators.q), {}, before);
        ccg.boundary_displacement(vectors<Dim>(to), {}, after);
        double motion = 0.0;
        for (std::size_t b = 0; b < n; ++b) raise(motion, (after[b] - before[b]).norm());
        const double bound = ccg.motion_bound(vectors<Dim>(operators.q), {}, vectors<Dim>(to), {});
        CHECK(bound >= motion * (1.0 - 1e-12));
        double of_cells = 0.0;
        const auto from_cells = vectors<Dim>(operators.q), to_cells = vectors<Dim>(to);
        for (std::size_t c = 0; c < from_cells.size(); ++c) raise(of_cells, (to_cells[c] - from_cells[c]).norm());
        CHECK(bound <= ccg.motion_amplification() * of_cells);
    }
}

TEMPLATE_TEST_CASE_SIG("the bound on the motion of boundary faces is the motion of a translation, and follows the loads",
                       "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(GENERATE(from_range(neumann_choices)));
    Vector<Dim> translation = Vector<Dim>::Constant(0.2);
    translation[0] = -0.7;
    auto to = operators.q;
    for (Vector<Dim>& u : vectors<Dim>(to)) u += translation;
    CHECK(operators.ccg.motion_bound(vectors<Dim>(operators.q), {}, vectors<Dim>(to), {}) ==
          Approx(translation.norm()).epsilon(1e-12));

    const auto mesh = round_body<Dim>(0.5);
    auto options = reconstructed_bodies<Dim>(1);
    options.boundary.dirichlet.push_back(
        {.group = mesh.groups.front().name,
         .history = [](double t, const Vector<Dim>&) -> Vector<Dim> { return Vector<Dim>::Unit(0) * t; }});
    solid::Solid<Dim> held(mesh, options);
    const std::vector<double> zero(held.size(), 0.0);
    const auto still = vectors<Dim>(zero);
    CHECK(held.ccg().motion_bound(still, held.ccg().load_at(0.0, 0.0), still, held.ccg().load_at(2.0, 0.0)) >= 2.0);
}

TEMPLATE_TEST_CASE_SIG("the bound on the motion of any cell is not more than sqrt(Dim) times the largest", "[solid][ccg]",
                       ((int Dim), Dim), 2, 3) {
    const std::size_t n = GENERATE(1, 7, 8, 9, 1023, 1024, 3000);  // with and without rests of blocks
    auto a = random_state(n * Dim, 1), b = random_state(n * Dim, 2);
    const auto from = vectors<Dim>(a), to = vectors<Dim>(b);
    const auto bound = [&] { return solid::largest_motion<Dim>(from, to); };
    double largest = 0.0;
    for (std::size_t c = 0; c < n; ++c) raise(largest, (to[c] - from[c]).norm());
    CHECK(bound() >= largest * (1.0 - 1e-15));
    CHECK(bound() <= std::sqrt(static_cast<double>(Dim)) * largest * (1.0 + 1e-15));
    b.back() = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(bound()));
}

TEMPLATE_TEST_CASE_SIG("the bound on the strain of cells is that of the largest, and NaN wherever one of them is",
                       "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    constexpr std::int32_t n = 5;
    LargeArray<double> gradients(std::size_t{solid::lane_width<Dim> * Dim * n}, 0.0);
    const auto bound = [&](std::int32_t begin, std::int32_t end) {
        return solid::largest_root<Dim>(gradients, begin, end, [](const auto& g) { return solid::squared_norm<Dim>(g); });
    };
    const auto set = [&](std::int32_t i, double value) {
        store_tensor(solid::load_packed<Dim>(Matrix<Dim>(value * Matrix<Dim>::Identity())), gradients, i);
    };
    for (std::int32_t i = 0; i < n; ++i) set(i, i == 2 ? -3.0 : 1.0);
    CHECK(bound(0, n) == Approx(3.0 * std::sqrt(static_cast<double>(Dim))).epsilon(1e-15));
    CHECK(bound(3, n) == Approx(std::sqrt(static_cast<double>(Dim))).epsilon(1e-15));
    const std::int32_t broken = GENERATE(0, 3, 4);
    set(broken, std::numeric_limits<double>::quiet_NaN());
    CHECK(std::isnan(bound(0, n)));
}

TEMPLATE_TEST_CASE_SIG("the mean gradient of a step is the gradient at its middle", "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    Operators<Dim> operators(FreeFaceRule::local_equilibrium);
    const auto a = random_vectors<Dim>(static_cast<std::size_t>(operators.mesh.n_cells()), 1);
    const auto b = random_vectors<Dim>(a.size(), 2);
    std::vector<Vector<Dim>> middle(a.size()), mean(a.size()), at_middle(a.size());
    for (std::size_t c = 0; c < a.size(); ++c) middle[c] = 0.5 * (a[c] + b[c]);
    operators.ccg.mean_gradient({a, b}, {}, {}, mean);
    operators.ccg.gradient(middle, {}, {}, at_middle);
    CHECK(mean == at_middle);
}

TEST_CASE("a wave along a strip of square cells has the frequency rho h^2 w^2 = E sin^2 th + 4 eta sin^6(th/2)",
          "[solid][ccg]") {
    const int n = 60;
    const double h = 0.1, young = 3.0, density = 2.0;
    const double eta = young * GENERATE(0.3, 1.0, 3.0);
    const double theta = GENERATE(0.05, 0.5, 1.0, 2.0, 3.0);
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {n * h, 2 * h}, {n, 2}, CellShape::quadrangle);
    solid::SolidOptions<2> options;
    options.materials = {{.young = young, .poisson = 0.0, .density = density, .eta = eta}};
    solid::Solid<2> solid(mesh, options);
    const auto q = sampled<2>(mesh, [&](const Vector<2>& x) { return Vector<2>(std::cos(theta * x[0] / h + 0.3), 0.0); });
    std::vector<double> force(q.size());
    solid.stiffness_product(q, force);
    const double omega_squared =
        (young * std::pow(std::sin(theta), 2) + 4.0 * eta * std::pow(std::sin(0.5 * theta), 6)) / (density * h * h);
    double worst = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (mesh.cell_centroid[c][0] < 5 * h || mesh.cell_centroid[c][0] > (n - 5) * h) continue;  // away from the ends
        raise(worst, std::abs(force[2 * c] - solid.masses()[c] * omega_squared * q[2 * c]));
        raise(worst, std::abs(force[2 * c + 1]));
    }
    CHECK(worst < 1e-12 * young);
}

TEMPLATE_TEST_CASE_SIG("face stiffnesses of a cell add up to its energy", "[solid][ccg]", ((int Dim), Dim), 2, 3) {
    const double lambda = 0.7, mu = 0.9;
    const auto mesh = round_body<Dim>(0.9);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double measure = mesh.cell_measure[c];
        std::vector<Vector<Dim>> area, u;
        Matrix<Dim> gradient = Matrix<Dim>::Zero();
        for (const std::int32_t f : mesh.cell_faces[c]) {
            area.push_back((mesh.face_cells[f][0] == c ? 1.0 : -1.0) * mesh.face_measure[f] * mesh.face_normal[f]);
            for (double& component : u.emplace_back()) component = value(random);
            gradient += u.back() * area.back().transpose() / measure;
        }
        const Matrix<Dim> strain = 0.5 * (gradient + gradient.transpose());
        const double energy = 0.5 * measure * (lambda * strain.trace() * strain.trace() + 2.0 * mu * strain.squaredNorm());
        double sum = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i)
            for (std::size_t j = 0; j < u.size(); ++j)
                sum += 0.5 * u[i].dot(solid::face_stiffness<Dim>(lambda, mu, measure, area[i], area[j]) * u[j]);
        CHECK(sum == Approx(energy).epsilon(1e-12));
    }
}
