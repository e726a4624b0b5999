// What facets remember: a law that is made for these tests adds up impulses on each facet, and the engine keeps them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/contact.hpp"
#include "abut/contact/engine/engine.hpp"
#include "abut/contact/law/node_law.hpp"
#include "abut/contact/surface/facet_store.hpp"
#include "abut/contact/surface/old_facets.hpp"
#include "contact/nodal_scenes.hpp"
#include "contact/parts.hpp"
#include "contact/plates.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using contact::Engine;
using contact::Face;
using contact::Facet;
using contact::FacetStore;
using contact::NodalOptions;
using contact::NodalSurface;
using contact::NodeLaw;
using contact::TakenForce;

namespace {

/// The pair potential, with two numbers per facet that no force depends on: the impulse of the pairs of its face, once for the
/// first half of a face and twice for the second, and the number of these pairs.
template <int Dim>
class AddingLaw : public NodeLaw<Dim> {
public:
    using NodeLaw<Dim>::NodeLaw;

    [[nodiscard]] std::int32_t facet_memory() const { return 2; }
    std::int64_t step(double dt, const typename NodeLaw<Dim>::Path& path, std::span<contact::PairMemory> memory,
                      FacetStore& facets, contact::NodalStep<Dim>& step) {
        const std::int64_t inadmissible = NodeLaw<Dim>::step(dt, path, memory, facets, step);
        const auto offsets = this->surface().host().facet_offsets();
        std::map<Facet, std::array<double, 2>> next;
        for (const auto& pair : step.pairs)
            for (const Face face : {pair.face_1, pair.face_2}) {
                const auto f = static_cast<std::size_t>(face);
                for (std::int32_t facet = offsets[f]; facet < offsets[f + 1]; ++facet) {
                    const auto known = facets[Facet{facet}];
                    auto& values = next.try_emplace(Facet{facet}, std::array{known[0], known[1]}).first->second;
                    values[0] += (facet - offsets[f] + 1) * dt * pair.normal_force;
                    values[1] += 1.0;
                }
            }
        for (const auto& [facet, values] : next) facets.set_next(facet, values);
        return inadmissible;
    }
    [[nodiscard]] AddingLaw on(NodalSurface<Dim> surface) const { return AddingLaw(NodeLaw<Dim>::on(std::move(surface))); }

private:
    explicit AddingLaw(NodeLaw<Dim>&& law) : NodeLaw<Dim>(std::move(law)) {}
};

template <int Dim>
using AddingEngine = Engine<AddingLaw<Dim>>;

contact::CandidateOptions with_skin(double skin) {
    contact::CandidateOptions options;
    options.skin = skin;
    options.largest_motion = 100.0;
    return options;
}

template <int Dim>
struct Adding {
    explicit Adding(const NodalSurface<Dim>& surface, double skin = 0.05, contact::Sharing* sharing = nullptr)
        : engine(AddingLaw<Dim>(surface, NodalOptions{}, sharing), with_skin(skin), {.warning = 0.3, .limit = 2.0},
                 sharing) {}

    const contact::NodalStep<Dim>& go(double dt, const std::vector<Vector<Dim>>& x_0, const std::vector<Vector<Dim>>& x_1) {
        if (!engine.is_valid_at(x_0) || !engine.is_valid_at(x_1)) engine.search(x_0, x_1, [](const auto&) {});
        return engine.step(dt, {x_0, x_1, TakenForce::mean});
    }
    [[nodiscard]] std::vector<double> memory() const {
        std::vector<double> all;
        for (std::int32_t facet = 0; facet < engine.law().facets().size(); ++facet)
            for (const double value : engine.facets()[Facet{facet}]) all.push_back(value);
        return all;
    }

    AddingEngine<Dim> engine;
};

/// The upper one of two boxes goes down onto the lower one and slides.
template <int Dim>
std::vector<Vector<Dim>> pressed(const NodalScene<Dim>& scene, int i) {
    const double t = i / 12.0;
    return placed<Dim>(scene, 1, shifted<Dim>(0.2 * t * axis<Dim>(0) - 0.1 * t * (2.0 - t) * up<Dim>()));
}

double length_of(int step) { return 0.5 + 0.25 * (step % 3); }

/// The pair potential knows nothing of memory: what it gives is added up here for each face.
template <int Dim>
struct Expected {
    explicit Expected(const NodalSurface<Dim>& surface)
        : impulse(static_cast<std::size_t>(surface.n_faces()), 0.0), pairs(impulse) {}
    void add(double dt, const contact::NodalStep<Dim>& step) {
        for (const auto& pair : step.pairs)
            for (const Face face : {pair.face_1, pair.face_2}) {
                impulse[static_cast<std::size_t>(face)] += dt * pair.normal_force;
                pairs[static_cast<std::size_t>(face)] += 1.0;
            }
    }
    std::vector<double> impulse, pairs;
};

template <int Dim>
void check_memory(const Adding<Dim>& adding, const Expected<Dim>& expected) {
    const auto offsets = adding.engine.law().surface().host().facet_offsets();
    for (std::size_t face = 0; face < expected.impulse.size(); ++face)
        for (std::int32_t facet = offsets[face]; facet < offsets[face + 1]; ++facet) {
            const auto values = adding.engine.facets()[Facet{facet}];
            CHECK(values[0] == Approx((facet - offsets[face] + 1) * expected.impulse[face]));
            CHECK(values[1] == expected.pairs[face]);
        }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a facet remembers what its law adds up, whether or not it is in a list", "[contact][memory]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(3, 4, 0.02, 0.013, 3.0, 5.0, false);  // in 3D of faces with two facets
    Adding<Dim> adding(scene.surface());
    contact::NodalContact<Dim> plain(scene.surface(), {.search = with_skin(0.05)});
    Expected<Dim> expected(scene.surface());
    for (int i = 0; i < 12; ++i) {
        const auto x_0 = pressed(scene, i), x_1 = pressed(scene, i + 1);
        const auto& step = plain.step(length_of(i), x_0, x_1);
        expected.add(length_of(i), step);
        CHECK(adding.go(length_of(i), x_0, x_1).energy == step.energy);
    }
    REQUIRE(*std::ranges::max_element(expected.pairs) > 5.0);
    check_memory(adding, expected);

    const auto far = placed<Dim>(scene, 1, shifted<Dim>(9.0 * up<Dim>()));
    adding.go(1.0, far, far);
    CHECK(adding.engine.report().candidates == 0);
    check_memory(adding, expected);
}

TEMPLATE_TEST_CASE_SIG("a step that is refused leaves the memory of facets as it was", "[contact][memory]", ((int Dim), Dim),
                       2, 3) {
    const auto scene = two_boxes<Dim>(2, 3, 0.02);
    Adding<Dim> adding(scene.surface(), 2.0);
    for (int i = 0; i < 6; ++i) adding.go(1.0, pressed(scene, i), pressed(scene, i + 1));
    const auto before = adding.memory();
    const auto x = pressed(scene, 6);
    const auto deep = placed<Dim>(scene, 1, shifted<Dim>(-0.6 * up<Dim>()));  // three times D
    CHECK_THROWS_AS(adding.go(1.0, x, deep), TooDeep);
    CHECK(adding.memory() == before);
    CHECK_THROWS_AS(adding.go(0.0, x, x), BadInput);
    CHECK(adding.memory() == before);
    adding.engine.evaluate(x);
    adding.engine.evaluate_elsewhere(deep);
    CHECK(adding.memory() == before);
    adding.go(1.0, x, pressed(scene, 7));
    CHECK(adding.memory() != before);
}

TEMPLATE_TEST_CASE_SIG("the memory of facets goes on after save and restore, and is refused by a law that has another",
                       "[contact][memory]", ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(2, 3, 0.02);
    Adding<Dim> whole(scene.surface()), again(scene.surface());
    for (int i = 0; i < 8; ++i) whole.go(length_of(i), pressed(scene, i), pressed(scene, i + 1));
    again.engine.restore(whole.engine.state());
    CHECK(again.memory() == whole.memory());
    for (int i = 8; i < 12; ++i)
        for (auto* one : {&whole, &again}) one->go(length_of(i), pressed(scene, i), pressed(scene, i + 1));
    CHECK(again.memory() == whole.memory());
    CHECK(again.engine.state() == whole.engine.state());

    contact::NodalContact<Dim> without(scene.surface());
    CHECK_THROWS_WITH(without.restore(whole.engine.state()), Contains("2 numbers per facet") && Contains("has 0"));
    CHECK_THROWS_WITH(again.engine.restore(without.state()), Contains("0 numbers per facet") && Contains("has 2"));
    CHECK(again.memory() == whole.memory());
}

TEMPLATE_TEST_CASE_SIG("the memory of facets is handed over to a surface with other numbers; a new facet remembers nothing",
                       "[contact][memory]", ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(2, 3, 0.02, 0.013, 3.0, 5.0, false);
    Adding<Dim> adding(scene.surface());
    for (int i = 0; i < 12; ++i) adding.go(1.0, pressed(scene, i), pressed(scene, i + 1));
    const FacetStore before = adding.engine.facets();
    const NodalSurface<Dim> old_surface = scene.surface();

    NodalScene<Dim> turned = scene;  // faces in reverse order; every third one is said to be new
    turned.faces.nodes.clear();
    turned.faces.offsets = {0};
    turned.faces.body.clear();
    turned.faces.depth.clear();
    std::vector<std::int32_t> old_face_of;
    for (std::int32_t face = old_surface.n_faces(); face-- > 0;) {
        const auto begin = scene.faces.nodes.begin() + scene.faces.offsets[face];
        const auto end = scene.faces.nodes.begin() + scene.faces.offsets[face + 1];
        turned.faces.append_face(std::vector<std::int32_t>(begin, end), scene.faces.depth[face], scene.faces.body[face]);
        old_face_of.push_back(face % 3 == 2 ? -1 : face);
    }
    const NodalSurface<Dim> surface = turned.surface();
    adding.engine.replace(adding.engine.law().on(surface), old_facets(old_surface, surface, old_face_of));

    int remembered = 0;
    for (std::size_t face = 0; face < old_face_of.size(); ++face)
        for (std::int32_t i = 0; i < surface.facet_offsets()[face + 1] - surface.facet_offsets()[face]; ++i) {
            const auto values = adding.engine.facets()[Facet{surface.facet_offsets()[face] + i}];
            if (old_face_of[face] < 0) {
                CHECK(values[0] == 0.0);
                CHECK(values[1] == 0.0);
                continue;
            }
            const auto old = before[Facet{old_surface.facet_offsets()[static_cast<std::size_t>(old_face_of[face])] + i}];
            CHECK(values[0] == old[0]);
            CHECK(values[1] == old[1]);
            if (values[1] > 0.0) ++remembered;
        }
    CHECK(remembered > 2);
    const auto at_once = adding.memory();
    adding.go(1.0, pressed(scene, 12), pressed(scene, 12));
    CHECK(adding.memory() != at_once);
}

TEMPLATE_TEST_CASE_SIG("parts that share contact have the memory of facets of one that has it alone",
                       "[contact][memory][sharing]", ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(4, 5, 0.02);
    const auto run = [&](contact::Sharing* sharing) {
        Adding<Dim> adding(scene.surface(), 0.05, sharing);
        for (int i = 0; i < 12; ++i) adding.go(length_of(i), pressed(scene, i), pressed(scene, i + 1));
        return std::pair(adding.memory(), adding.engine.state());
    };
    const auto alone = run(nullptr);
    CHECK(*std::ranges::max_element(alone.first) > 0.0);
    for (const auto& of_part : on_parts(3, [&](ThreadPart& part) { return run(&part); })) CHECK((of_part == alone));
}

TEST_CASE("a law without memory of facets keeps no number", "[contact][memory]") {
    FacetStore store(1000, 0);
    CHECK(store[Facet{999}].empty());
    store.begin_step();
    store.set_next(Facet{999}, {});
    CHECK(NodeLaw<2>(two_boxes<2>(2, 2, 0.1).surface(), {}, nullptr).facet_memory() == 0);
}

TEST_CASE("a saved memory with numbers that are not finite, or too few, is refused", "[contact][memory]") {
    const auto read = [](const auto& write, std::int32_t n_facets) {
        StateWriter state("facets", 1);
        write(state);
        const auto bytes = std::move(state).finish();
        StateReader reader(bytes, "facets", 1);
        return FacetStore::restored(reader, n_facets, 1);
    };
    const auto good = [](StateWriter& state) { FacetStore(3, 1).save(state); };
    const auto bad = [](StateWriter& state) {
        const std::vector<double> values{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
        state.put(std::int32_t{1});
        state.put_all(std::span<const double>(values));
    };
    CHECK_NOTHROW(read(good, 3));
    CHECK_THROWS_WITH(read(good, 4), Contains("3 numbers are saved for 4 facets"));
    CHECK_THROWS_WITH(read(bad, 3), Contains("number 1 of a saved state is not finite"));
}

TEMPLATE_TEST_CASE_SIG("the length of a step must be finite and > 0; a step that is refused for it changes nothing",
                       "[contact][step]", ((int Dim), Dim), 2, 3) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const auto scene = two_boxes<Dim>(2, 3, 0.02);
    const auto surface = plates<Dim>();
    contact::NodalContact<Dim> nodal(scene.surface());
    contact::Contact<Dim> by_faces(surface.view());
    const auto of_nodal = nodal.state(), of_faces = by_faces.state();
    const auto u = at_rest(surface);
    const contact::HostStep<Dim> host{.displacement_0 = u,
                                      .displacement_1 = u,
                                      .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size()); },
                                      .gradients_of =
                                          [](auto, auto y_0, auto y_1) {
                                              std::ranges::fill(y_0, Vector<Dim>::Zero());
                                              std::ranges::fill(y_1, Vector<Dim>::Zero());
                                          }};
    for (const double dt : {0.0, -1e-3, nan, infinity}) {
        CHECK_THROWS_AS(nodal.step(dt, scene.rest, scene.rest), BadInput);
        CHECK_THROWS_WITH(nodal.step(dt, scene.rest, scene.rest), Contains("dt = ") && Contains("finite and > 0"));
        CHECK_THROWS_AS(by_faces.step(dt, host), BadInput);
    }
    CHECK(nodal.state() == of_nodal);
    CHECK(by_faces.state() == of_faces);
    CHECK_NOTHROW(nodal.step(1e-300, scene.rest, scene.rest));
    CHECK_NOTHROW(by_faces.step(1e-300, host));
}
