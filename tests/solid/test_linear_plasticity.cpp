// J2 plasticity of bodies whose strains are linear: small and floating ones.
#include <Eigen/QR>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

Material metal(double hardening, double kinematic, double saturation = 0.0) {
    Material material{.young = 1.0, .poisson = 0.3, .density = 1.0, .law = MaterialLaw::j2, .flow = {.yield_stress = 1e-3}};
    material.flow.hardening = hardening;
    material.flow.kinematic_hardening = kinematic;
    material.flow.saturation = saturation;
    material.flow.saturation_rate = saturation > 0.0 ? 200.0 : 0.0;
    return material;
}

std::vector<Material> metals() { return {metal(0.0, 0.0), metal(0.05, 0.0), metal(0.0, 0.05), metal(0.02, 0.03, 5e-4)}; }

/// The radial return of textbooks in space, with linear hardening.
struct Radial {
    Material material;
    Matrix<3> plastic = Matrix<3>::Zero();
    double alpha = 0.0;

    Matrix<3> step(const Matrix<3>& strain) {
        const auto deviator = [](const Matrix<3>& a) -> Matrix<3> { return a - a.trace() / 3.0 * Matrix<3>::Identity(); };
        const double mu = material.mu(), back = 2.0 / 3.0 * material.flow.kinematic_hardening;
        const Matrix<3> trial = 2.0 * mu * (deviator(strain) - plastic) - back * plastic;
        const double over =
            trial.norm() - std::sqrt(2.0 / 3.0) * (material.flow.yield_stress + material.flow.hardening * alpha);
        if (over > 0.0) {
            const double gamma = over / (2.0 * mu + back + 2.0 / 3.0 * material.flow.hardening);
            plastic += gamma * trial / trial.norm();
            alpha += std::sqrt(2.0 / 3.0) * gamma;
        }
        return 2.0 * mu * (deviator(strain) - plastic) +
               (material.lambda() + 2.0 / 3.0 * mu) * strain.trace() * Matrix<3>::Identity();
    }
};

/// Energy that plastic flow has dissipated, with jumps and faces that flow along [J].
double of_flow(const dynamics::Losses& lost) { return lost.in_cells + lost.in_jumps + lost.on_faces; }

/// Shapes of cells that a box is made of.
std::vector<CellShape> shapes_in(int dim) {
    if (dim == 2) return {CellShape::quadrangle, CellShape::triangle};
    return {CellShape::hexahedron, CellShape::tetrahedron, CellShape::prism, CellShape::pyramid};
}

/// Stretch and equivalent plastic strain of metal with linear isotropic hardening under a tension that rises to `stress`. In
/// the plane the return is made in small steps, since the stress out of it turns the direction of flow.
template <int Dim>
std::pair<double, double> in_tension(const Material& material, double stress) {
    const double yield = material.flow.yield_stress, hardening = material.flow.hardening;
    if (Dim == 3) return {stress / material.young + (stress - yield) / hardening, (stress - yield) / hardening};
    constexpr int n = 100000;
    double along = 0.0, out_of_plane = 0.0, equivalent = 0.0;  // plastic
    const auto out_of_plane_stress = [&](double x) { return material.poisson * x - material.young * out_of_plane; };
    for (int i = 1; i <= n; ++i) {
        const double x = stress * i / n, z = out_of_plane_stress(x), mises = std::sqrt(x * x - x * z + z * z);
        const double beyond = mises - yield - hardening * equivalent, slope = (2.0 * z - x) / (2.0 * mises);
        if (beyond <= 0.0) continue;
        const double flow = beyond / (material.young * slope * slope + hardening);
        along += flow * (2.0 * x - z) / (2.0 * mises);
        out_of_plane += flow * slope;
        equivalent += flow;
    }
    return {(stress - material.poisson * out_of_plane_stress(stress)) / material.young + along, equivalent};
}

/// Slope of u_x in x over all cells by least squares.
template <int Dim>
double mean_stretch(const TurningScene<Dim>& scene) {
    const auto q = as_vectors<Dim>(scene.memm.q());
    const auto n = static_cast<Eigen::Index>(scene.mesh.n_cells());
    Eigen::MatrixXd affine(n, Dim + 1);
    Eigen::VectorXd moved(n);
    for (Eigen::Index c = 0; c < n; ++c) {
        const Vector<Dim>& x = scene.solid.rest_positions()[static_cast<std::size_t>(c)];
        affine(c, Dim) = 1.0;
        for (int k = 0; k < Dim; ++k) affine(c, k) = x[k];
        moved[c] = q[static_cast<std::size_t>(c)][0];
    }
    return affine.colPivHouseholderQr().solve(moved)[0];
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("metal that loads pull beyond yield stretches as uniaxial tension says, in three cells of any shape",
                       "[solid][material][patch]", ((int Dim), Dim), 2, 3) {
    // All but the innermost of 27 bricks have free faces, and jumps would hold them back if they did not see these flow.
    // The load rises slowly: what swings would be kept by flow.
    constexpr double duration = 400.0, stress = 1.3e-3;
    Material material = metal(0.1, 0.0);
    material.damping.mass = 0.5;
    const auto [stretch, plastic] = in_tension<Dim>(material, stress);
    const auto load_at = [](double t) {
        return 0.5 * stress * (1.0 - std::cos(M_PI * std::min(t / (0.7 * duration), 1.0)));
    };
    struct Pulled {
        Kinematics kinematics;
        bool follows;
    };
    for (const auto& [kinematics, follows] :
         {Pulled{Kinematics::small, false}, Pulled{Kinematics::floating, false}, Pulled{Kinematics::floating, true}})
        for (const CellShape shape : shapes_in(Dim)) {
            if (kinematics == Kinematics::floating && shape != shapes_in(Dim).front()) continue;  // frames know no shapes
            CAPTURE(static_cast<int>(kinematics), follows, static_cast<int>(shape));
            std::array<int, Dim> counts;
            counts.fill(3);
            const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts, shape);
            auto options = alone<Dim>(material);
            for (const auto& [group, sign] : {std::pair{"xmin", -1.0}, std::pair{"xmax", 1.0}})
                options.boundary.traction.push_back({.group = group,
                                                     .history = [=](double t, const Vector<Dim>&) -> Vector<Dim> {
                                                         return sign * load_at(t) * Vector<Dim>::Unit(0);
                                                     },
                                                     .follows = follows});
            TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero())}, 0.9, kinematics);
            const double fall = fall_of_dissipation<Dim>(scene, static_cast<int>(duration / scene.memm.dt()),
                                                         &dynamics::Losses::in_cells, of_flow);
            double off = 0.0;
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
                raise(off, std::abs(scene.solid.cells().plastic_strain(c) / plastic - 1.0));
            const dynamics::Losses lost = scene.solid.dissipated();
            CHECK(mean_stretch(scene) == Approx(stretch).epsilon(1e-3));
            CHECK(off <= 5e-3);
            CHECK(fall <= 0.0);
            CHECK(std::abs(lost.on_faces) <= 4e-3 * lost.in_cells);
            CHECK(scene.drifts().pseudo_energy <= 1e-12);
        }
}

TEST_CASE("a bar of metal four bricks high that is bent beyond yield bears the moment of its layers", "[solid][material]") {
    // Perfectly plastic, ends that turn: layers at y bear min(E kappa |y|, sigma_y), and their sum is within 3 % of
    // M_e (3/2 - (kappa_e/kappa)^2/2) of a bar without layers.
    constexpr int n = 4;
    constexpr double length = 3.0, duration = 600.0, bend = 3.0;  // times what makes it yield
    Material material = metal(0.0, 0.0);
    material.damping.mass = 0.3;
    const double yield = material.flow.yield_stress, curvature = bend * 2.0 * yield / material.young;
    const auto mesh = mesh::structured_box<3>({0.0, -0.5, -0.5}, {length, 0.5, 0.5}, {3 * n, n, n}, CellShape::hexahedron);
    auto options = alone<3>(material);
    for (const auto& [group, sign] : {std::pair{"xmin", 1.0}, std::pair{"xmax", -1.0}})
        options.boundary.dirichlet.push_back({.group = group,
                                              .constraint = solid::Constraint::components,
                                              .components = {true, false, false},
                                              .history = [=](double t, const Vector<3>& x) -> Vector<3> {
                                                  const double share =
                                                      0.5 * (1.0 - std::cos(M_PI * std::min(t / (0.8 * duration), 1.0)));
                                                  return {sign * share * 0.5 * curvature * length * x[1], 0.0, 0.0};
                                              }});
    TurningScene<3> scene(mesh, options, {moving<3>(Vector<3>::Zero())}, 0.9, Kinematics::small);
    const double fall = fall_of_dissipation<3>(scene, static_cast<int>(duration / scene.memm.dt()), of_flow);
    scene.run_until(duration);
    (void)scene.solid.potential(scene.memm.q());
    double moment = 0.0, of_layers = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<3>& x = mesh.cell_centroid[static_cast<std::size_t>(c)];
        if (std::abs(x[0] - 0.5 * length) > 0.5) continue;
        moment -= mesh.cell_measure[c] * x[1] * scene.solid.cells().stress(c)(0, 0);
        of_layers += mesh.cell_measure[c] * std::abs(x[1]) * std::min(material.young * curvature * std::abs(x[1]), yield);
    }
    CHECK(of_layers == Approx(yield / 6.0 * (1.5 - 0.5 / (bend * bend))).epsilon(0.03));
    CHECK(moment == Approx(of_layers).epsilon(0.004));
    CHECK(scene.solid.dissipated().on_faces != 0.0);
    CHECK(fall <= 0.0);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEMPLATE_TEST_CASE_SIG("a body that is strained alike everywhere has the stress of the radial return, there and back",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Material& material : {metal(0.0, 0.0), metal(0.05, 0.0), metal(0.0, 0.05), metal(0.04, 0.03)})
        for (const auto& [name, mesh] : boxes<Dim>()) {
            CAPTURE(name, material.flow.hardening, material.flow.kinematic_hardening);
            auto options = alone<Dim>(material);
            options.kinematics = {Kinematics::small};
            const Matrix<Dim> way = some_gradient<Dim>(5, 6e-3);
            const auto strain_at = [&](double t) -> Matrix<Dim> { return std::sin(t) * way; };
            for (const auto& group : mesh.groups)
                options.boundary.dirichlet.push_back(
                    {.group = group.name,
                     .history = [strain_at](double t, const Vector<Dim>& x) -> Vector<Dim> { return strain_at(t) * x; }});
            solid::Solid<Dim> solid(mesh, options);
            Radial exact{material};
            std::vector<double> q_0(solid.size(), 0.0), q_1 = q_0, force(solid.size());
            constexpr double dt = 0.1;
            double off = 0.0, largest = 0.0;
            for (int i = 1; i <= 90; ++i) {  // into flow, back, and into flow on the other side
                for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
                    vectors<Dim>(q_1)[c] = strain_at(i * dt) * mesh.cell_centroid[c];
                solid.mean_force(q_0, q_1, (i - 1) * dt, dt, force);
                std::swap(q_0, q_1);
                const Matrix<Dim> now = strain_at(i * dt);
                const Matrix<3> strain = in_3d<Dim>(0.5 * (now + now.transpose()));
                const Matrix<3> expected = exact.step(strain);
                (void)solid.potential(q_0);
                for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                    const Matrix<Dim> in_plane = expected.template topLeftCorner<Dim, Dim>();
                    raise(off, (solid.cells().stress(c) - in_plane).norm());
                    if (Dim == 2) raise(off, std::abs(solid.cells().out_of_plane_stress(c) - expected(2, 2)));
                    raise(off, std::abs(solid.cells().plastic_strain(c) - exact.alpha));
                    raise(largest, in_plane.norm());
                }
            }
            CHECK(exact.alpha > 2e-3);
            CHECK(off <= 1e-12 * largest);
        }
}

TEMPLATE_TEST_CASE_SIG(
    "small and floating metal that rings flows, keeps H~ + D, momentum and J~, and feeds no alternating mode",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Material& material : metals())
        for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating})
            for (const auto& [name, mesh] : boxes<Dim>()) {
                CAPTURE(name, static_cast<int>(kinematics), material.flow.hardening, material.flow.kinematic_hardening);
                const Motion<Dim> spinning{Vector<Dim>::Constant(0.003),
                                           some_spin<Dim>(kinematics == Kinematics::small ? 0.0 : 0.01)};
                TurningScene<Dim> scene(mesh, alone<Dim>(material), {spinning}, 0.9, kinematics, 0.005);
                const double fall = fall_of_dissipation<Dim>(scene, 300, &dynamics::Losses::in_cells);
                const Drifts drifts = scene.drifts();
                CHECK(scene.solid.dissipated().in_cells > 0.02 * scene.ledger.largest_energy());
                CHECK(fall <= 0.0);
                CHECK(drifts.pseudo_energy <= 1e-13);
                CHECK(drifts.momentum <= 1e-13);
                if (kinematics == Kinematics::floating)
                    CHECK(drifts.pseudo_moment <= 1e-13);
                else
                    CHECK(drifts.parasitic <= 1e-13);
            }
}

TEST_CASE(
    "a bar all of whose cells have free edges yields at sigma_y when it is pulled, and back at the sum of its hardening",
    "[solid][material]") {
    // Slowly there and back, and damped: uniaxial stress. With E_t the slope of hardening the stress is sigma_y + E_t (eps - eps_y), and
    // after the turn it yields again after 2 sigma_y where hardening is kinematic.
    constexpr double modulus = 0.05, tangent = modulus / (1.0 + modulus);
    for (const CellShape shape : {CellShape::hexahedron, CellShape::tetrahedron}) {
        Material material = metal(0.0, modulus);
        material.damping.mass = 0.5;
        const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {3.0, 1.0, 1.0}, {6, 2, 2}, shape);
        auto options = alone<3>(material);
        constexpr double duration = 400.0, most = 6e-3;
        const auto strain_at = [](double t) {
            return most * (t < 0.5 * duration ? 2.0 * t / duration : 2.0 - 2.0 * t / duration);
        };
        const std::array<bool, 3> along{true, false, false};
        options.boundary.dirichlet = {{.group = "xmin", .constraint = solid::Constraint::components, .components = along},
                                      {.group = "xmax",
                                       .constraint = solid::Constraint::components,
                                       .components = along,
                                       .history = [&](double t, const Vector<3>&) -> Vector<3> {
                                           return {3.0 * strain_at(t), 0.0, 0.0};
                                       }}};
        TurningScene<3> scene(mesh, options, {moving<3>(Vector<3>::Zero())}, 0.9, Kinematics::small);
        const auto mean_stress = [&] {
            (void)scene.solid.potential(scene.memm.q());
            double sum = 0.0;
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
                sum += mesh.cell_measure[c] * scene.solid.cells().stress(c)(0, 0);
            return sum / 3.0;
        };
        const double yield = material.flow.yield_stress, at_top = yield + tangent * (most - yield);
        scene.run_until(0.5 * duration);
        CAPTURE(static_cast<int>(shape));
        CHECK(mean_stress() == Approx(at_top).epsilon(0.03));
        scene.run_until(0.5 * duration * (1.0 + yield / most));  // half of the way that is elastic
        CHECK(mean_stress() == Approx(at_top - yield).margin(0.05 * yield));
        scene.run_until(duration);
        CHECK(mean_stress() == Approx(at_top - 2.0 * yield - tangent * (most - 2.0 * yield)).epsilon(0.03));
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
    }
}

TEST_CASE("a bar that is held as it flies has the plateau of the exact bilinear bar to 0.5 % and its plastic front to 1 %",
          "[solid][material]") {
    // E_t = E/10: an elastic front at c, a plastic one at sqrt(E_t/rho), behind it sigma_y + rho sqrt(E_t/rho) (v_0 - sigma_y/(rho c)).
    // The bar is slender: what flows widens by half of its stretch, and the inertia of that is not in these formulas.
    constexpr int n = 200;
    constexpr double yield = 1e-4, speed = 5.0 * yield, modulus = 0.1, time = 0.8;
    const double plastic_speed = std::sqrt(modulus), plateau = yield + plastic_speed * (speed - yield);
    Material bar{.young = 1.0, .poisson = 0.3, .density = 1.0, .law = MaterialLaw::j2, .flow = {.yield_stress = yield}};
    bar.flow.hardening = modulus / (1.0 - modulus);
    const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 1.0 / n, 1.0 / n}, {n, 2, 2}, CellShape::hexahedron);
    auto options = alone<3>(bar);
    options.boundary.dirichlet = {{.group = "xmin", .constraint = solid::Constraint::normal}};
    TurningScene<3> scene(mesh, options, {moving<3>(-speed * Vector<3>::Unit(0))}, 0.5, Kinematics::small);
    while (scene.memm.time() < time) scene.run(1, 100);
    CHECK(scene.drifts().pseudo_energy <= 1e-13);
    (void)scene.solid.potential(scene.memm.q());
    double sum = 0.0, front = 0.0;
    int count = 0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double x = mesh.cell_centroid[static_cast<std::size_t>(c)][0], pressure = -scene.solid.cells().stress(c)(0, 0);
        if (x > 0.05 && x < 0.2) sum += pressure, ++count;
        if (pressure > 0.5 * (plateau + yield)) front = std::max(front, x);
    }
    CHECK(std::abs(sum / count / plateau - 1.0) <= 0.005);
    CHECK(std::abs(front / (plastic_speed * scene.memm.time()) - 1.0) <= 0.01);
}

TEMPLATE_TEST_CASE_SIG("metal bodies that collide under the pair potential flow, and keep H~ + D and momentum",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating}) {
        Material material = metal(0.05, 0.05);
        material.flow.yield_stress = 4e-3;
        auto options = bodies<Dim>(2);
        options.materials.assign(2, material);
        options.law = solid::ContactLaw::pair_potential;
        std::vector<Motion<Dim>> motion(2);
        mesh::Mesh<Dim> mesh;
        for (int body = 0; body < 2; ++body) {
            if constexpr (Dim == 2)
                motion[body].velocity = disc_velocities[body];
            else
                motion[body].velocity = box_velocities[body];
        }
        if constexpr (Dim == 2)
            mesh = two_discs(0.5);
        else
            mesh = two_boxes(3);
        TurningScene<Dim> scene(mesh, options, motion, 0.6, kinematics);
        scene.run(steps_of_collision<Dim>);
        CHECK(scene.solid.contact().report().active_pairs_max > 0);
        CHECK(scene.solid.contact().report().missed_contacts == 0);
        CHECK(scene.solid.dissipated().in_cells > 1e-3 * scene.ledger.largest_energy());
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
        CHECK(scene.drifts().momentum <= 1e-13);
    }
}

TEMPLATE_TEST_CASE_SIG("a plate that is pressed against a wall flows in all its layers alike", "[solid][material][contact]",
                       ((int Dim), Dim), 2, 3) {
    // Uniaxial strain, slowly and damped: the stress is the same in all layers, and the plastic strain (2 mu eps - sigma_y)/(3 mu + H).
    constexpr int layers = 6;
    constexpr double duration = 60.0, most = 4e-3;
    Material material = metal(0.1, 0.05);
    material.damping.mass = 1.0;
    std::vector<CellShape> shapes{CellShape::quadrangle, CellShape::triangle};
    if (Dim == 3) shapes = {CellShape::hexahedron, CellShape::tetrahedron};
    for (const CellShape shape : shapes) {
        CAPTURE(static_cast<int>(shape));
        mesh::Mesh<Dim> mesh;
        if constexpr (Dim == 2)
            mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {layers, 3}, shape);
        else
            mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 0.5, 0.5}, {layers, 3, 3}, shape);
        auto options = bodies<Dim>(1);
        options.materials = {material};
        options.law = solid::ContactLaw::pair_potential;
        const Vector<Dim> along = Vector<Dim>::Unit(0);
        options.obstacles = {contact::plane_obstacle<Dim>(Vector<Dim>(-1e-7 * along), along, 2.0)};
        for (const auto& group : mesh.groups)
            if (group.name != "xmin")
                options.boundary.dirichlet.push_back({.group = group.name, .constraint = solid::Constraint::normal});
        for (auto& condition : options.boundary.dirichlet)
            if (condition.group == "xmax")
                condition.history = [along](double t, const Vector<Dim>&) -> Vector<Dim> {
                    return -most * std::min(1.0, t / duration) * along;
                };
        TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero())}, 0.8, Kinematics::small);
        double fall = 0.0;
        while (scene.memm.time() < duration) raise(fall, fall_of_dissipation<Dim>(scene, 20, &dynamics::Losses::in_cells));
        (void)scene.solid.potential(scene.memm.q());
        std::array<double, layers> strain{};
        std::array<int, layers> count{};
        double inside = 0.0, exact = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const double x = mesh.cell_centroid[static_cast<std::size_t>(c)][0];
            const auto layer = static_cast<std::size_t>(x * layers);
            strain[layer] += scene.solid.cells().plastic_strain(c);
            ++count[layer];
            if (x < 0.5 || x > 0.8) continue;
            const double eps = -scene.solid.cells().displacement_gradient(c, scene.memm.q())(0, 0);
            inside += scene.solid.cells().plastic_strain(c);
            exact += (2.0 * material.mu() * eps - material.flow.yield_stress) /
                     (3.0 * material.mu() + material.flow.hardening + material.flow.kinematic_hardening);
        }
        for (std::size_t i = 0; i < layers; ++i) strain[i] /= count[i];
        const dynamics::Losses lost = scene.solid.dissipated();
        CAPTURE(strain, lost.on_faces / lost.in_cells, scene.drifts().pseudo_energy);
        CHECK(strain[4] > 1e-3);
        CHECK(inside == Approx(exact).epsilon(0.015));  // what swings is kept by flow
        for (const double of_layer : strain) CHECK(of_layer == Approx(strain[4]).epsilon(0.01));
        CHECK(fall <= 0.0);
        CHECK(std::abs(lost.on_faces) <= 0.01 * lost.in_cells);
        CHECK(scene.drifts().pseudo_energy <= 2e-12);
    }
}

TEST_CASE("what small metal bodies cannot have is refused by name", "[solid][material]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    auto options = alone<2>(metal(0.0, 0.1));
    options.kinematics = {Kinematics::rigid};
    REQUIRE_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("yields"));
    options = bodies<2>(1);
    options.materials = {metal(0.1, 0.0)};
    options.law = solid::ContactLaw::reconstruction;
    REQUIRE_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("pair_potential"));
}
