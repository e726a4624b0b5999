// Bodies that overlap at the start on purpose: press fits.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "abut/solid/body_interference.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

using solid::Kinematics;
using solid::Material;
using solid::Solid;
using solid::SolidOptions;

constexpr double bore = 0.4, seat = 1.0, outside = 2.0, overlap = 2e-3;

/// Quadrangles whose corners lie on `sectors` rays.
mesh::Mesh<2> annulus(double inner, double outer, int sectors, int layers, const std::string& name) {
    mesh::CellSoup<2> soup;
    soup.name = name;
    soup.body_names = {name};
    for (int layer = 0; layer <= layers; ++layer)
        for (int i = 0; i < sectors; ++i) {
            const double r = inner + (outer - inner) * layer / layers, angle = 2.0 * std::numbers::pi * i / sectors;
            soup.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
    for (int layer = 0; layer < layers; ++layer)
        for (int i = 0; i < sectors; ++i) {
            const int next = (i + 1) % sectors, below = layer * sectors, above = below + sectors;
            soup.cell_vertices.append(std::array{below + i, above + i, above + next, below + next});
            soup.cell_shape.push_back(mesh::CellShape::quadrangle);
            soup.cell_body.push_back(0);
        }
    return mesh::build_mesh(std::move(soup));
}

mesh::Mesh<2> press_fit(int sectors, int layers) {
    return together(annulus(bore, seat + 0.5 * overlap, sectors, layers, "shaft"),
                    annulus(seat - 0.5 * overlap, outside, sectors, layers + layers / 2, "ring"));
}

SolidOptions<2> resolving(std::array<Material, 2> materials, double time, Kinematics kinematics) {
    SolidOptions<2> options;
    options.materials.assign(materials.begin(), materials.end());
    options.kinematics.assign(2, kinematics);
    options.contact.emplace();
    options.interference = {{.bodies = {0, 1}, .time = time}};
    return options;
}

/// Lame's pressure of two thick rings in plane strain.
double pressure_of(const Material& shaft, const Material& ring) {
    const auto gives_way = [](const Material& material, double geometry, double sign) {
        const double nu = material.poisson / (1.0 - material.poisson);
        return (geometry + sign * nu) * (1.0 - material.poisson * material.poisson) / material.young;
    };
    const double a = bore * bore, b = seat * seat, c = outside * outside;
    return overlap / seat / (gives_way(shaft, (b + a) / (b - a), -1.0) + gives_way(ring, (c + b) / (c - b), 1.0));
}

/// Least and largest of the faces in contact, once all has come to rest.
std::array<double, 2> pressures_at_rest(int sectors, int layers, const std::array<Material, 2>& materials,
                                        Kinematics kinematics) {
    const auto mesh = press_fit(sectors, layers);
    TurningScene<2> scene(mesh, resolving(materials, 20.0, kinematics), std::vector<Motion<2>>(2), 0.6,
                          std::vector(2, kinematics));
    scene.run_until(45.0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    CHECK(scene.ledger.pseudo_energy_drift() <= 1e-12 * scene.ledger.largest_energy());
    std::array<double, 2> found{1e300, 0.0};
    for (const double p : scene.solid.contact_at(scene.memm.q()).field().pressure)
        if (p > 0.0) found = {std::min(found[0], p), std::max(found[1], p)};
    return found;
}

}  // namespace

TEST_CASE("a ring that is pressed on a shaft has Lame's pressure within 2 %", "[solid][interference]") {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    const double young = GENERATE(1.0, 0.3);  // of the shaft
    const std::array<Material, 2> materials{
        Material{.young = young, .poisson = 0.2, .density = 1.0, .damping = {.mass = 1.0}},
        Material{.young = 1.0, .poisson = 0.3, .density = 1.0, .damping = {.mass = 1.0}}};
    const double expected = pressure_of(materials[0], materials[1]);
    const auto [least, largest] = pressures_at_rest(60, 10, materials, kinematics);
    CAPTURE(static_cast<int>(kinematics), young, expected, least, largest);
    CHECK(least == Approx(expected).epsilon(0.02));
    CHECK(largest == Approx(expected).epsilon(0.02));
}

TEST_CASE("a shaft that is warmed in a ring has Lame's pressure of the overlap (1 + nu) alpha T within 2 %",
          "[solid][interference][thermal]") {
    // In plane strain. Both fit at the start; strains of finite bodies are small.
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    Material shaft{.young = 0.5, .poisson = 0.2, .density = 1.0, .damping = {.mass = 1.0}},
        ring{.young = 1.0, .poisson = 0.3, .density = 1.0, .damping = {.mass = 1.0}};
    shaft.expansion.along_1 = overlap / seat / (1.0 + shaft.poisson) / 100.0;
    const auto mesh = together(annulus(bore, seat, 48, 8, "shaft"), annulus(seat, outside, 48, 12, "ring"));
    auto options = resolving({shaft, ring}, 1.0, kinematics);
    options.interference.clear();
    options.temperature_rise = {{.value =
                                     [](double t, const Vector<2>&) {
                                         const double share = std::min(1.0, t / 20.0);
                                         return 100.0 * share * share * (3.0 - 2.0 * share);
                                     },
                                 .varies = true},
                                {}};
    TurningScene<2> scene(mesh, options, std::vector<Motion<2>>(2), 0.6, std::vector(2, kinematics));
    scene.run_until(45.0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    CHECK(scene.ledger.pseudo_energy_drift() <= 1e-12 * scene.ledger.largest_energy());
    const double expected = pressure_of(shaft, ring);
    CAPTURE(static_cast<int>(kinematics), expected);
    for (const double p : scene.solid.contact_at(scene.memm.q()).field().pressure)
        if (p > 0.0) CHECK(p == Approx(expected).epsilon(0.02));
}

TEST_CASE("interference is work from outside: H~ less that work, momentum and J~ are kept", "[solid][interference]") {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    const Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    const auto mesh = press_fit(24, 4);
    const AxialVector<2> spin(kinematics == Kinematics::small ? 0.0 : 0.01);
    TurningScene<2> scene(mesh, resolving({material, material}, 3.0, kinematics),
                          std::vector(2, moving<2>({0.01, 0.0}, spin)), 0.6, std::vector(2, kinematics), 1e-4);
    scene.run_until(10.0);
    CHECK(scene.solid.work() > 0.0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
}

TEST_CASE("a saved state goes on with what is left of the interference, bit by bit", "[solid][interference]") {
    const Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    const auto made = [&] {
        return std::make_unique<TurningScene<2>>(press_fit(24, 4),
                                                 resolving({material, material}, 3.0, Kinematics::floating),
                                                 std::vector<Motion<2>>(2), 0.6, std::vector(2, Kinematics::floating));
    };
    const auto whole = made(), other = made();
    whole->run_until(1.0);
    other->solid.restore(whole->solid.state(), whole->memm.q());
    CHECK(other->solid.work() == whole->solid.work());
    const std::vector<double> q(whole->memm.q().begin(), whole->memm.q().end());
    std::vector<double> next = q, expected(q.size()), found(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) next[i] += 1e-4 * std::sin(static_cast<double>(i));
    whole->solid.mean_force(q, next, whole->memm.time(), whole->memm.dt(), expected);
    other->solid.mean_force(q, next, whole->memm.time(), whole->memm.dt(), found);
    CHECK(found == expected);
    CHECK(other->solid.work() == whole->solid.work());
}

TEST_CASE("interference is refused under the law of faces, and where its sides are none", "[solid][interference]") {
    const Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    const auto mesh = press_fit(24, 4);
    const auto message = [&](const auto& change) {
        auto options = resolving({material, material}, 1.0, Kinematics::small);
        change(options);
        try {
            Solid<2>(mesh, options);
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Contains;
    CHECK_THAT(message([](auto& options) { options.law = solid::ContactLaw::reconstruction; }), Contains("(interference)"));
    CHECK_THAT(message([](auto& options) { options.interference[0].bodies = {0, 2}; }), Contains("counted from 0 to 1"));
    CHECK_THAT(message([](auto& options) { options.interference[0].time = 0.0; }), Contains("finite and > 0 s"));
    CHECK(message([](auto& options) { options.contact->overlap = contact::OverlapMode::frozen; }).find("overlap") !=
          std::string::npos);  // an option of the other law
}

}  // namespace abut::test
