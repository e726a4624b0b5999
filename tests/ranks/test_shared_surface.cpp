// How nodes and faces of several ranks are numbered, and what is refused of them.
#include <catch2/catch.hpp>

#include "ranks/shared_scene.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using ranks::Communicator;
using ranks::SharedNodalContact;

namespace {

template <int Dim>
using Points = std::vector<Vector<Dim>>;

}  // namespace

TEST_CASE("errors of contact name faces by their numbers, on all ranks", "[ranks][nodal]") {
    const Communicator all = world();
    NodalScene<2> scene = two_boxes<2>(6, 7, 0.02);
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    ScenePart<2> part(all, scene, scattered_faces(all, n_faces));
    for (auto& number : part.face) number = 1000 + 7 * number;
    std::vector<std::int32_t> asked;
    contact::NodalOptions options;
    options.wanted = [&](Face face_1, Face face_2) {
        asked.push_back(static_cast<std::int32_t>(face_1));
        asked.push_back(static_cast<std::int32_t>(face_2));
        return true;
    };
    SharedNodalContact<2> shared(all, part.view(), options);
    contact::NodalContact<2> alone(scene.surface());
    const Points<2> closed = placed<2>(scene, 1, shifted<2>({0.0, -0.1})),
                    deep = placed<2>(scene, 1, shifted<2>({0.0, -0.5}));
    for (const auto& [x_0, x_1] : {std::pair(scene.rest, closed), std::pair(closed, closed)}) {
        alone.step(1.0, x_0, x_1);
        shared.step(1.0, part.own(x_0), part.own(x_1));
    }
    REQUIRE(alone.last().pairs.size() == shared.last().pairs.size());
    REQUIRE(alone.last().is_active());
    for (std::size_t p = 0; p < alone.last().pairs.size(); ++p) {
        const auto &of_alone = alone.last().pairs[p], &of_shared = shared.last().pairs[p];
        CHECK(static_cast<std::int32_t>(of_shared.face_1) == 1000 + 7 * static_cast<std::int32_t>(of_alone.face_1));
        CHECK(static_cast<std::int32_t>(of_shared.face_2) == 1000 + 7 * static_cast<std::int32_t>(of_alone.face_2));
        CHECK(of_shared.force == of_alone.force);
    }
    CHECK(!asked.empty());
    for (const std::int32_t number : asked) CHECK((number >= 1000 && number % 7 == 1000 % 7));

    const Caught of_alone = caught([&] { alone.step(1.0, closed, deep); });
    const Caught of_shared = caught([&] { shared.step(1.0, part.own(closed), part.own(deep)); });
    REQUIRE(of_alone.type == "too deep");
    CHECK(of_shared.type == "too deep");
    CHECK(of_shared.facts.face_1 == 1000 + 7 * of_alone.facts.face_1);
    CHECK(of_shared.facts.face_2 == 1000 + 7 * of_alone.facts.face_2);
    CHECK(of_shared.facts.value == of_alone.facts.value);
    CHECK(has(of_shared.text, "face " + std::to_string(of_shared.facts.face_1) + " (body 0"));
    CHECK(has(of_shared.text, "face " + std::to_string(of_shared.facts.face_2) + " (body 1"));
}

TEST_CASE("faces without numbers are numbered rank after rank", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<2> scene = two_boxes<2>(6, 7, 0.02);
    const std::int32_t n_faces = static_cast<std::int32_t>(scene.faces.body.size()), size = all.size();
    const auto first_of = [&](int rank) { return n_faces * rank / size; };
    const ScenePart<2> part(
        all, scene, [&](std::int32_t face) { return face >= first_of(all.rank()) && face < first_of(all.rank() + 1); });
    ranks::NodalPart<2> without = part.view();
    without.face_number = {};
    SharedNodalContact<2> numbered(all, part.view()), shared(all, without);
    const auto x_0 = part.own(scene.rest), x_1 = part.own(placed<2>(scene, 1, shifted<2>({0.01, -0.1})));
    numbered.step(1.0, x_0, x_1);
    shared.step(1.0, x_0, x_1);
    REQUIRE(numbered.last().is_active());
    CHECK(same_pairs<2>(numbered.last().pairs, shared.last().pairs));
    CHECK(numbered.state() == shared.state());
}

TEST_CASE("what does not fit together is refused on all ranks, by rank, node and face", "[ranks][nodal]") {
    const Communicator all = world();
    const NodalScene<2> scene = two_boxes<2>(4, 5, 0.02);
    const auto n_faces = static_cast<std::int32_t>(scene.faces.body.size());
    const int guilty = all.size() - 1;
    const bool is_guilty = all.rank() == guilty, is_alone = all.size() == 1;
    const std::string at_guilty = "on rank " + std::to_string(guilty);
    ScenePart<2> part(all, scene, scattered_faces(all, n_faces));
    REQUIRE(everywhere(all, part.face.size() > 1));
    contact::NodalOptions options;
    ranks::NodalPart<2> view = part.view();
    const auto refused = [&](const std::string& what) {
        const Caught error = caught([&] { SharedNodalContact<2>(all, view, options); });
        CAPTURE(error.text);
        return error.type == "bad input" && has(error.text, what);
    };
    SECTION("a negative number") {
        if (is_guilty) part.node[3] = -4;
        CHECK(refused("node 3 " + at_guilty + " has the number -4"));
        if (is_guilty) part.node[3] = 999;
        if (is_guilty) part.face[1] = -2;
        CHECK(refused("face 1 " + at_guilty + " has the number -2"));
    }
    SECTION("a number too few") {
        if (is_guilty) view.node_number = view.node_number.first(2);
        CHECK(refused("nodes are given " + at_guilty + " with 2 numbers"));
        view = part.view();
        if (is_guilty) view.face_number = view.face_number.first(1);
        CHECK(refused("faces are given " + at_guilty + " with 1 numbers"));
    }
    SECTION("a number twice on one rank") {
        if (is_guilty) part.node[1] = part.node[0];
        CHECK(refused("two nodes " + at_guilty + " have the number "));
    }
    SECTION("a face twice") {
        ScenePart<2> twice(all, scene, [](std::int32_t face) { return face == 6; });
        view = twice.view();
        if (!is_alone) CHECK(refused("face 6 is given twice, as face 0 on rank 0 and as face 0 on rank 1"));
    }
    SECTION("two positions of a node") {
        if (is_guilty)
            for (auto& x : part.rest) x[0] += 1e-12;
        if (!is_alone) CHECK(refused(" " + at_guilty + ". Copies of a node have the same position at rest"));
    }
    SECTION("another stiffness") {
        if (is_guilty) part.faces.stiffness[1] = 4.0;
        view = part.view();
        if (!is_alone) CHECK(refused("the stiffness of body 1 is 4 " + at_guilty + " and 5 on rank 0"));
        if (is_guilty) part.faces.stiffness = {3.0, 5.0, 5.0};
        view = part.view();
        if (!is_alone) CHECK(refused("the number of bodies in `stiffness` is 3 " + at_guilty));
    }
    SECTION("another option") {
        if (is_guilty) options.search.skin = 0.5;
        if (!is_alone) CHECK(refused("the option search.skin is 0.5 " + at_guilty + " and 0 on rank 0"));
    }
    SECTION("faces with numbers here and without there") {
        if (is_guilty) view.face_number = {};
        if (!is_alone) CHECK(refused("those " + at_guilty + " have none"));
    }
    SECTION("an option out of range, on all") {
        options.compression_limit = -1.0;
        CHECK(refused("compression_limit"));
    }
    SECTION("a face that is none") {
        if (is_guilty) part.faces.depth[1] = -1.0;
        view = part.view();
        CHECK(refused("face 1 has the depth -1"));
    }
    SECTION("pairs that are wanted here alone") {
        options.wanted = [&](Face, Face) { return !is_guilty; };
        SharedNodalContact<2> contact(all, view, options);
        const auto x = part.own(scene.rest);
        const Caught error = caught([&] { contact.step(1.0, x, x); });
        CHECK(error.type == (is_alone ? "none" : "bad input"));
        if (!is_alone) CHECK(has(error.text, "`wanted` must give the same answers on all ranks"));
    }
}
