#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "ranks/shared_scene.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using contact::TakenForce;
using ranks::Communicator;
using ranks::SharedNodalContact;

namespace {

template <int Dim>
using Points = std::vector<Vector<Dim>>;

/// Two boxes of different meshes, the upper one of quadrangles in 3D.
template <int Dim>
NodalScene<Dim> scene_of_boxes() {
    NodalScene<Dim> scene;
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts<Dim>(Dim == 2 ? 12 : 4), 3.0, 0.1);
    append_box<Dim>(scene, 1.02 * up<Dim>(), Vector<Dim>::Ones() + 1.02 * up<Dim>(), counts<Dim>(Dim == 2 ? 13 : 5), 5.0,
                    0.1, false);
    return scene;
}

/// The upper box comes down and turns, so that an edge of it comes first, is pushed aside and up again, and on; the nodes
/// shake a little.
template <int Dim>
Points<Dim> at_time(const NodalScene<Dim>& scene, double t) {
    const Vector<Dim> centre = 0.5 * Vector<Dim>::Ones() + 1.02 * up<Dim>();
    const Vector<Dim> by = -0.15 * std::sin(3.0 * t) * up<Dim>() + 0.4 * t * axis<Dim>(0);
    Points<Dim> x = placed<Dim>(scene, 1, turned_about<Dim>(centre, 0.5 * t, by));
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int d = 0; d < Dim; ++d) x[i][d] += 0.002 * std::sin(40.0 * t + 7.0 * static_cast<double>(i) + d);
    return x;
}

/// A communicator of the first ranks; empty on the others.
std::optional<Communicator> first_ranks(const Communicator& all, int n) {
    MPI_Comm few = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, all.rank() < n ? 0 : MPI_UNDEFINED, all.rank(), &few);
    if (few == MPI_COMM_NULL) return std::nullopt;
    std::optional<Communicator> communicator(MPI_Comm_c2f(few));
    MPI_Comm_free(&few);
    return communicator;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("nodes and faces of many ranks have the bits of contact on one, step by step", "[ranks][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const Communicator all = world();
    const NodalScene<Dim> scene = scene_of_boxes<Dim>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    const int empty_rank = GENERATE(-1, 0);
    BothContacts<Dim> both(all, scene, scattered_faces(all, n_faces, all.size() > 1 ? empty_rank : -1));
    const int n = 60;
    Points<Dim> x_0 = at_time(scene, 0.0);
    for (int i = 1; i <= n; ++i) {
        CAPTURE(all.rank(), i);
        const Points<Dim> x_1 = at_time(scene, 2.0 * i / n);
        REQUIRE(both.step(x_0, x_1, i % 7 == 0 ? TakenForce::end : TakenForce::mean));
        if (i % 5 == 0) REQUIRE(both.evaluate(x_1));
        if (i % 9 == 0) REQUIRE(both.evaluate(at_time(scene, 2.0 * (i + 0.3) / n)));
        if (i % 20 == 0) REQUIRE(both.evaluate(scene.rest));  // where no list holds
        x_0 = x_1;
    }
    CHECK(both.shared.report().events > 0);
    CHECK(both.shared.report().rebuilds > 2);
    CHECK(both.shared.report().active_pairs_max > 4);
    if (Dim == 3) CHECK(both.shared.report().tilted_pairs_max > 0);
}

TEMPLATE_TEST_CASE_SIG("friction on many ranks has the bits of one, with laws by number of face", "[ranks][nodal][friction]",
                       ((int Dim), Dim), 2, 3) {
    const Communicator all = world();
    const NodalScene<Dim> scene = scene_of_boxes<Dim>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    contact::NodalOptions options;
    options.friction.laws = {{.coefficient = 0.1}, {.coefficient = 0.4}};
    options.friction.law_of = [](Face face_1, Face face_2) { return (number_of(face_1) + number_of(face_2)) % 3 - 1; };
    BothContacts<Dim> both(all, scene, scattered_faces(all, n_faces), options);
    const int n = 40;
    Points<Dim> x_0 = at_time(scene, 0.0);
    for (int i = 1; i <= n; ++i) {
        CAPTURE(all.rank(), i);
        const Points<Dim> x_1 = at_time(scene, 2.0 * i / n);
        REQUIRE(both.step(x_0, x_1, i % 7 == 0 ? TakenForce::end : TakenForce::mean));
        if (i % 5 == 0) REQUIRE(both.evaluate(x_1));
        if (i % 9 == 0) REQUIRE(both.evaluate(at_time(scene, 2.0 * (i + 0.3) / n)));
        x_0 = x_1;
    }
    CHECK(both.shared.report().sliding_faces_max > 2);
    CHECK(both.shared.report().friction_dissipated > 0.0);
}

TEMPLATE_TEST_CASE_SIG("boxes that overlap on purpose come to push each other on many ranks with the bits of one",
                       "[ranks][nodal][interference]", ((int Dim), Dim), 2, 3) {
    const Communicator all = world();
    NodalScene<Dim> scene;
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts<Dim>(Dim == 2 ? 12 : 4), 3.0, 0.1);
    append_box<Dim>(scene, 0.98 * up<Dim>() + 0.1 * axis<Dim>(0),
                    Vector<Dim>::Ones() + 0.98 * up<Dim>() + 0.1 * axis<Dim>(0), counts<Dim>(Dim == 2 ? 13 : 5), 5.0, 0.1,
                    false);
    contact::NodalOptions options;
    options.interference.times = {9.0, 7.0};  // steps of 1 s
    options.interference.of = [](Face face_1, Face face_2) { return (number_of(face_1) + number_of(face_2)) % 2; };
    BothContacts<Dim> both(all, scene, scattered_faces(all, static_cast<std::int32_t>(scene.faces.body.size())), options);
    double work = 0.0;
    for (int i = 1; i <= 12; ++i) {
        CAPTURE(all.rank(), i);
        REQUIRE(both.step(scene.rest, scene.rest));
        REQUIRE(everywhere(all, both.alone.last().interference_work == both.shared.last().interference_work));
        work += both.shared.last().interference_work;
    }
    CHECK(both.shared.last().energy > 0.0);
    CHECK(work == Approx(both.shared.last().energy).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("forces on first copies add up to nothing over all ranks, and so do their moments", "[ranks][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const Communicator all = world();
    const NodalScene<Dim> scene = scene_of_boxes<Dim>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    const ScenePart<Dim> part(all, scene, scattered_faces(all, n_faces));
    SharedNodalContact<Dim> contact(all, part.view(), {}, ranks::CopyForce::on_first);
    double largest_force = 0.0;
    for (int i = 1; i <= 30; ++i) {
        const auto x_0 = part.own(at_time(scene, (i - 1) / 30.0)), x_1 = part.own(at_time(scene, i / 30.0));
        const auto force = forces<Dim>(contact.step(1.0, x_0, x_1), part.rest.size());
        Vector<6> sum = Vector<6>::Zero();
        for (std::size_t k = 0; k < force.size(); ++k) {
            const AxialVector<Dim> turning = moment<Dim>(0.5 * (x_0[k] + x_1[k]), force[k]);
            for (int d = 0; d < Dim; ++d) sum[d] += force[k][d];
            for (int d = 0; d < turning.size(); ++d) sum[6 - turning.size() + d] += turning[d];
            largest_force = std::max(largest_force, force[k].norm());
        }
        MPI_Allreduce(MPI_IN_PLACE, sum.data(), 6, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        CHECK(sum.norm() < 1e-14);
    }
    CHECK(all.largest(largest_force) > 1e-3);
}

TEST_CASE("a list is renewed where the nodes of one rank alone move", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<2> scene = scene_of_boxes<2>();
    const int last = all.size() - 1;  // has all of the upper box
    BothContacts<2> both(all, scene,
                         [&](std::int32_t face) { return all.rank() == (scene.faces.body[face] == 1 ? last : 0); });
    Points<2> x_0 = scene.rest;
    for (int i = 1; i <= 20; ++i) {
        const Points<2> x_1 = placed<2>(scene, 1, shifted<2>({0.1 * i, 0.01 * i}));
        REQUIRE(both.step(x_0, x_1));
        x_0 = x_1;
    }
    CHECK(both.shared.report().rebuilds > 5);
}

TEMPLATE_TEST_CASE_SIG("an obstacle that one rank places has the bits of one rank, force, moment and work", "[ranks][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const Communicator all = world();
    NodalScene<Dim> scene;
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts<Dim>(5), 3.0, 0.1);
    const auto plane = contact::plane_obstacle<Dim>(0.5 * axis<Dim>(0) - 0.02 * up<Dim>(), up<Dim>(), 3.0);
    const std::int32_t body = scene.faces.append_obstacle(plane, scene.rest);
    scene.node_body.resize(scene.rest.size(), body);
    const int last = all.size() - 1;
    BothContacts<Dim> both(all, scene, [&](std::int32_t face) {
        return all.rank() == (scene.faces.body[face] == body ? last : face % all.size());
    });
    Points<Dim> x_0 = scene.rest;
    double work = 0.0;
    for (int i = 1; i <= 40; ++i) {
        const double t = i / 40.0;
        const Points<Dim> x_1 =
            placed<Dim>(scene, body, turned_about<Dim>(Vector<Dim>::Zero(), 0.05 * std::sin(2.0 * t), 0.1 * t * up<Dim>()));
        REQUIRE(both.step(x_0, x_1));
        work = std::max(work, std::abs(both.shared.last().work));
        x_0 = x_1;
    }
    CHECK(work > 0.0);
}

TEST_CASE("what is saved on many ranks goes on on one, two and all with the same bits", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<3> scene = scene_of_boxes<3>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    const auto x = [&](int i) { return at_time(scene, 1.0 * i / 30.0); };
    BothContacts<3> both(all, scene, scattered_faces(all, n_faces));
    for (int i = 0; i < 15; ++i) REQUIRE(both.step(x(i), x(i + 1)));
    REQUIRE(both.shared.last().is_active());
    const std::vector<std::byte> state = both.shared.state();
    std::vector<Points<3>> later;  // forces
    for (int i = 15; i < 30; ++i) {
        REQUIRE(both.step(x(i), x(i + 1)));
        later.push_back(forces<3>(both.alone.last(), scene.rest.size()));
    }
    for (const int n : {1, std::min(2, all.size()), all.size()}) {
        bool same = true;
        if (const auto few = first_ranks(all, n)) {
            BothContacts<3> again(*few, scene, scattered_faces(*few, n_faces));
            again.alone.restore(state);
            again.shared.restore(state);
            for (int i = 15; i < 30; ++i)
                same = again.step(x(i), x(i + 1)) &&
                       same_bits<3>(again.part.own(later[static_cast<std::size_t>(i - 15)]),
                                    forces<3>(again.shared.last(), again.part.rest.size())) &&
                       same;
        }
        CHECK(everywhere(all, same));
    }
    const bool is_last = all.rank() == all.size() - 1;
    const std::vector<std::byte> other = is_last && all.size() > 1 ? both.shared.state() : state;
    CHECK(caught([&] { both.shared.restore(other); }).type == (all.size() > 1 ? "bad input" : "none"));
    std::vector<std::byte> damaged = state;
    damaged[damaged.size() / 2] ^= std::byte{1};
    CHECK(caught([&] { both.shared.restore(damaged); }).type == "bad input");
}

TEST_CASE("an error of one rank in a step ends it on all, and all go on together", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<2> scene = scene_of_boxes<2>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    const int guilty = all.size() - 1;
    const bool is_guilty = all.rank() == guilty;
    bool throws = false;
    contact::NodalOptions options;
    options.wanted = [&](Face, Face) {
        if (throws && is_guilty) throw std::length_error("a host's own");
        return true;
    };
    BothContacts<2> both(all, scene, scattered_faces(all, n_faces), options);
    const auto x = [&](int i) { return at_time(scene, i / 60.0); };
    REQUIRE(both.step(x(0), x(1)));
    const std::vector<std::byte> state = both.alone.state();
    const auto type_of = [&](const Points<2>& x_0, const Points<2>& x_1) {
        const Caught error = caught([&] { both.shared.step(1.0, x_0, x_1); });
        CHECK(everywhere(all, both.shared.state() == state));
        return error.type;
    };
    const Points<2> x_1 = both.part.own(x(1)), x_2 = both.part.own(x(2));
    Points<2> far = x_2;
    for (auto& p : far) p[0] += 1.0;
    SECTION("an array of another size") { CHECK(type_of(x_1, is_guilty ? Points<2>() : x_2) == "bad input"); }
    SECTION("a step of another length, or of none") {
        for (const double dt : {2.0, 0.0, std::nan("")}) {
            const Caught error = caught([&] { both.shared.step(is_guilty ? dt : 1.0, x_1, x_2); });
            CHECK(error.type == (all.size() == 1 && dt == 2.0 ? "none" : "bad input"));
            if (error.type == "bad input") CHECK(everywhere(all, both.shared.state() == state));
            if (error.type == "none") both.shared.restore(state);
        }
    }
    SECTION("a callback that throws") {
        throws = true;
        CHECK(type_of(x_1, far) == "other");
        throws = false;
    }
    SECTION("a node that is not finite, on one rank") {
        Points<2> broken = x_2;
        if (is_guilty)
            for (auto& p : broken) p[1] = std::nan("");
        CHECK(type_of(x_1, broken) == "diverged");
    }
    SECTION("copies of nodes that have gone different ways") {
        Points<2> apart = far;
        if (is_guilty)
            for (auto& p : apart) p[1] += 0.01;
        if (all.size() > 1) CHECK(type_of(x_1, apart) == "bad input");
    }
    both.alone.restore(both.alone.state());  // both make a new list
    both.shared.restore(both.shared.state());
    for (int i = 1; i < 40; ++i) REQUIRE(both.step(x(i), x(i + 1)));
    CHECK(both.shared.report().active_pairs_max > 0);
}

TEST_CASE("the stable step is that of one rank, and wants whole masses", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<3> scene = scene_of_boxes<3>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    BothContacts<3> both(all, scene, scattered_faces(all, n_faces));
    std::vector<double> mass;
    for (std::size_t i = 0; i < scene.rest.size(); ++i) mass.push_back(1.0 + 0.5 * std::sin(static_cast<double>(3 * i)));
    const auto of_alone = both.alone.stable_step(mass, 7.0);
    const auto of_shared = both.shared.stable_step(both.part.own(mass), all.rank() == 0 ? 7.0 : 1.0);
    CHECK(of_shared.dt == of_alone.dt);
    CHECK(of_shared.node == of_alone.node);
    CHECK(of_shared.reason == of_alone.reason);
    std::vector<double> part_of = both.part.own(mass), none = part_of;
    if (all.rank() == all.size() - 1)
        for (double& m : part_of) m *= 0.5;
    const Caught halves = caught([&] { return both.shared.stable_step(part_of, 7.0); });
    CHECK(halves.type == (all.size() > 1 ? "bad input" : "none"));
    if (all.size() > 1) CHECK(has(halves.text, "Give the whole mass of a node on each rank"));
    none.assign(none.size(), 0.0);
    CHECK(has(caught([&] { return both.shared.stable_step(none, 7.0); }).text, "has the mass 0 kg on rank"));
}

TEST_CASE("a step that goes on sends one number to reduce and the ends of the listed nodes", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<3> scene = scene_of_boxes<3>();
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    BothContacts<3> both(all, scene, [&](std::int32_t face) { return face * all.size() / n_faces == all.rank(); });
    const auto near = [&](double by) { return placed<3>(scene, 1, shifted<3>({by, 0.0, -0.03})); };
    REQUIRE(both.step(near(0.0), near(1e-4)));
    REQUIRE(both.step(near(1e-4), near(2e-4)));
    const std::int64_t rebuilds = both.shared.report().rebuilds;
    const ranks::Traffic before = both.shared.traffic();
    for (int i = 2; i < 12; ++i) {
        REQUIRE(both.step(near(1e-4 * i), near(1e-4 * (i + 1))));
        REQUIRE(both.evaluate(near(1e-4 * (i + 1))));  // where the step ended: nothing is sent
    }
    REQUIRE(both.shared.report().rebuilds == rebuilds);
    const ranks::Traffic& after = both.shared.traffic();
    CHECK(after.gathers - before.gathers == 10);
    CHECK(after.reductions - before.reductions == 20);
    // All ranks together receive each listed node as often as there are other ranks.
    double received = static_cast<double>(after.gathered_bytes - before.gathered_bytes);
    MPI_Allreduce(MPI_IN_PLACE, &received, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    CHECK(received == 10.0 * 3 * 8 * (all.size() - 1) * static_cast<double>(both.alone.last().nodes.size()));

    const auto far = [&](double by) { return placed<3>(scene, 1, shifted<3>({by, 0.0, 5.0})); };
    REQUIRE(both.step(far(0.0), far(1e-4)));
    const std::int64_t gathers = both.shared.traffic().gathers;
    REQUIRE(both.step(far(1e-4), far(2e-4)));
    CHECK(both.shared.traffic().gathers == gathers);  // the list is empty
}
