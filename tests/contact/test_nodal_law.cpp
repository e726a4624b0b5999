#include <catch2/catch.hpp>
#include <cmath>

#include "contact/nodal_scenes.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;
using contact::NodalStep;

namespace {

/// Of nodes whose faces reach no rim.
template <int Dim>
bool is_inside(const Vector<Dim>& x) {
    for (int d = 0; d + 1 < Dim; ++d)
        if (x[d] < 0.25 || x[d] > 0.75) return false;
    return true;
}

/// A third of the triangles, half of the segments at a node that look up (sign 1) or down (-1).
template <int Dim>
std::vector<double> areas_looking(const NodalScene<Dim>& scene, double sign) {
    std::vector<double> area(scene.rest.size(), 0.0);
    const contact::NodalSurface<Dim> surface = scene.surface();
    const auto& facets = surface.facets();
    for (std::int32_t f = 0; f < facets.size(); ++f)
        if (sign * facets.normal[f][Dim - 1] > 0.5)
            for (const std::int32_t v : facets.view().vertices_of(f)) area[v] += facets.area[f] / Dim;
    return area;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("over a flat interface of two meshes every node gets k g times its area, and nothing along it",
                       "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    const bool matching = GENERATE(false, true);
    const double g = 0.01, k = 3.0 * 5.0 / 8.0;
    const auto scene = matching ? two_boxes<Dim>(6, 6, 0.002, 0.0) : two_boxes<Dim>(5, 7, 0.002);
    NodalContact<Dim> contact(scene.surface());
    const auto open = scene.rest, closed = placed<Dim>(scene, 1, shifted<Dim>(-(g + 0.002) * up<Dim>()));
    contact.step(1.0, open, open);
    const auto force = forces<Dim>(contact.step(1.0, closed, closed), scene.rest.size());

    const auto area_up = areas_looking<Dim>(scene, 1.0), area_down = areas_looking<Dim>(scene, -1.0);
    double normal = 0.0, along = 0.0;
    int inside = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
        const double expected = scene.node_body[i] == 0 ? -k * g * area_up[i] : k * g * area_down[i];
        if (expected == 0.0 || !is_inside<Dim>(closed[i])) continue;
        ++inside;
        raise(normal, std::abs(force[i][Dim - 1] - expected) / std::abs(expected));
        raise(along, (force[i] - force[i][Dim - 1] * up<Dim>()).norm() / std::abs(expected));
    }
    CHECK(inside >= (Dim == 2 ? 4 : 10));
    CHECK(normal < 1e-12);
    CHECK(along < 1e-12);
}

TEMPLATE_TEST_CASE_SIG("along any step the work on the nodes is the change of W, and no force or moment is left over",
                       "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(3, 4, 0.05);
    NodalContact<Dim> contact(scene.surface());
    std::mt19937 random(3);
    const Vector<Dim> centre = 0.5 * Vector<Dim>::Ones() + (1.05) * up<Dim>();
    auto x_0 = scene.rest;
    double work_error = 0.0, force_error = 0.0, moment_error = 0.0, largest_energy = 0.0;
    int active = 0;
    for (int i = 1; i <= 60; ++i) {
        // Down, rocking, and up again.
        const double s = i / 60.0;
        const auto x_1 = placed<Dim>(scene, 1,
                                     turned_about<Dim>(centre, 0.15 * std::sin(9.0 * s),
                                                       -0.1 * std::sin(3.14 * s) * up<Dim>() + 0.1 * s * axis<Dim>(0)));
        const NodalStep<Dim>& step = contact.step(1.0, x_0, x_1);
        const auto force = forces<Dim>(step, x_0.size());
        double work = 0.0, size = 0.0;
        Vector<Dim> sum = Vector<Dim>::Zero();
        AxialVector<Dim> moments = AxialVector<Dim>::Zero();
        for (std::size_t n = 0; n < force.size(); ++n) {
            work += force[n].dot(x_1[n] - x_0[n]);
            size += force[n].norm();
            sum += force[n];
            moments += moment<Dim>(0.5 * (x_0[n] + x_1[n]), force[n]);
        }
        raise(largest_energy, step.energy);
        raise(work_error, std::abs(work + step.energy - step.energy_0));
        if (size > 0.0) {
            ++active;
            raise(force_error, sum.norm() / size);
            raise(moment_error, moments.norm() / size);
        }
        x_0 = x_1;
    }
    CHECK(active > 20);
    CHECK(largest_energy > 1e-4);
    CHECK(work_error < 1e-13 * largest_energy);
    CHECK(force_error < 1e-14);
    CHECK(moment_error < 1e-14);
    CHECK(contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a kept list gives the bits of a list made at each step, whatever turns", "[contact][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(3, 5, 0.03);
    contact::NodalOptions narrow, wide;
    narrow.search.skin = 1e-9;  // a new list at each step
    wide.search.skin = 0.3;
    NodalContact<Dim> often(scene.surface(), narrow), seldom(scene.surface(), wide);
    const Vector<Dim> centre = 0.5 * Vector<Dim>::Ones() + up<Dim>();
    auto x_0 = scene.rest;
    for (int i = 1; i <= 100; ++i) {
        const double s = 0.02 * i;
        const auto x_1 = placed<Dim>(scene, 1, turned_about<Dim>(centre, 0.6 * s, -0.04 * std::sin(2.0 * s) * up<Dim>()));
        for (const auto take : {contact::TakenForce::mean, contact::TakenForce::end}) {
            if (take == contact::TakenForce::end && i % 2 == 0) continue;
            const NodalStep<Dim>&a = often.step(1.0, x_0, x_1, take), &b = seldom.step(1.0, x_0, x_1, take);
            REQUIRE(a.pairs.size() == b.pairs.size());
            REQUIRE(a.energy == b.energy);
            REQUIRE(forces<Dim>(a, x_0.size()) == forces<Dim>(b, x_0.size()));
        }
        x_0 = x_1;
    }
    CHECK(seldom.report().active_pairs_max > 3);
    CHECK(often.report().rebuilds > 90);
    CHECK(seldom.report().rebuilds < 20);
}

TEST_CASE("quadrangles give the forces and energy of the triangles that they are cut into", "[contact][nodal]") {
    const auto cut = two_boxes<3>(3, 4, 0.02, 0.013, 3.0, 5.0, true),
               whole = two_boxes<3>(3, 4, 0.02, 0.013, 3.0, 5.0, false);
    NodalContact<3> of_triangles(cut.surface()), of_quadrangles(whole.surface());
    CHECK(of_quadrangles.surface().n_faces() * 2 == of_triangles.surface().n_faces());
    CHECK(of_quadrangles.surface().facets().size() == of_triangles.surface().facets().size());
    const auto down = [](const NodalScene<3>& scene) { return placed<3>(scene, 1, shifted<3>({0.0, 0.0, -0.03})); };
    of_triangles.step(1.0, cut.rest, cut.rest);
    of_quadrangles.step(1.0, whole.rest, whole.rest);
    const double energy = of_triangles.step(1.0, cut.rest, down(cut)).energy;
    CHECK(of_quadrangles.step(1.0, whole.rest, down(whole)).energy == Approx(energy).epsilon(1e-12));
    CHECK(energy == Approx(0.5 * 15.0 / 8.0 * 0.01 * 0.01 * (1.0 - 0.013) * (1.0 - 0.6 * 0.013)).epsilon(1e-3));
    // Pairs name the faces of the host.
    for (const auto& pair : of_quadrangles.last().pairs) CHECK(number_of(pair.face_2) < of_quadrangles.surface().n_faces());
}

TEMPLATE_TEST_CASE_SIG("tables by body and by pair of bodies add up to the pairs, and work to what obstacles do",
                       "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    NodalScene<Dim> scene;
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts<Dim>(3), 3.0, 0.1);
    append_box<Dim>(scene, 1.02 * up<Dim>(), Vector<Dim>::Ones() + 1.02 * up<Dim>(), counts<Dim>(4), 5.0, 0.1);
    append_box<Dim>(scene, -1.02 * up<Dim>(), Vector<Dim>::Ones() - 1.02 * up<Dim>(), counts<Dim>(2), rigid, 0.0);
    NodalContact<Dim> contact(scene.surface());
    contact.step(1.0, scene.rest, scene.rest);
    auto x_0 = placed<Dim>(scene, 1, shifted<Dim>(-0.03 * up<Dim>()));
    x_0 = placed<Dim>(scene, 2, shifted<Dim>(0.03 * up<Dim>()), x_0);
    contact.step(1.0, scene.rest, x_0);
    const auto x_1 = placed<Dim>(scene, 2, turned_about<Dim>(Vector<Dim>::Zero(), 0.005, 0.032 * up<Dim>()), x_0);
    const NodalStep<Dim>& step = contact.step(1.0, x_0, x_1);

    REQUIRE(step.bodies.size() == 3);
    REQUIRE(step.body_pairs.size() == 2);
    const auto force = forces<Dim>(step, x_0.size());
    std::array<Vector<Dim>, 3> by_nodes;
    by_nodes.fill(Vector<Dim>::Zero());
    double work = 0.0;
    for (std::size_t n = 0; n < force.size(); ++n) {
        by_nodes[scene.node_body[n]] += force[n];
        if (scene.node_body[n] == 2) work -= force[n].dot(x_1[n] - x_0[n]);
    }
    for (const auto& body : step.bodies) CHECK((body.force - by_nodes[body.body]).norm() < 1e-14);
    CHECK(step.body_pairs[0].body_1 == 0);
    CHECK(step.body_pairs[0].body_2 == 1);
    CHECK((step.body_pairs[0].force - by_nodes[1]).norm() < 1e-14);
    CHECK((step.body_pairs[1].force - by_nodes[2]).norm() < 1e-14);
    CHECK(step.body_pairs[1].normal_force > 0.0);
    CHECK(step.work == Approx(work).epsilon(1e-12));
    // Only the obstacle moves: what it does is what W gains.
    CHECK(step.work == Approx(step.energy - step.energy_0).epsilon(1e-12));
    double pairs = 0.0;
    for (const auto& pair : step.pairs) pairs += pair.normal_force;
    CHECK(pairs == Approx(step.body_pairs[0].normal_force + step.body_pairs[1].normal_force).epsilon(1e-12));
}

TEST_CASE("arrays of a host are read where they lie, whatever their strides", "[contact][nodal]") {
    const auto scene = two_boxes<3>(2, 3, 0.02);
    const auto x_1 = placed<3>(scene, 1, shifted<3>({0.0, 0.01, -0.05}));
    NodalContact<3> packed(scene.surface()), strided(scene.surface());
    const auto n = static_cast<std::int32_t>(scene.rest.size());
    // One array per component, and every second entry of an array of four.
    std::vector<double> by_component(3 * scene.rest.size()), spread(8 * scene.rest.size());
    for (std::int32_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d) {
            by_component[d * n + i] = scene.rest[i][d];
            spread[8 * i + 2 * d] = x_1[i][d];
        }
    const PointsView<3> start(by_component.data(), n, 1, n), end(spread.data(), n, 8, 2);
    const auto expected = forces<3>(packed.step(1.0, scene.rest, x_1), scene.rest.size());
    std::vector<double> force(3 * scene.rest.size(), 0.0);
    strided.step(1.0, start, end).add_force_to(PointsSpan<3>(force.data(), n, 1, n));
    CHECK(packed.last().is_active());
    for (std::int32_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d) REQUIRE(force[d * n + i] == expected[i][d]);
}
