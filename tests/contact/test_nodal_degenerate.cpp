// Bodies that touch at a gap of exactly 0, and faces that break down: the law gives numbers or an error that names faces.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "abut/base/error.hpp"
#include "abut/base/rotation.hpp"
#include "contact/nodal_scenes.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;
using contact::TakenForce;

namespace {

Vector<3> any_vector_of(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    return {uniform(random), uniform(random), uniform(random)};
}

/// Matching squares of n x n faces with four corners or twice as many triangles at exactly the same places, one body looking
/// up and one down, in a plane that is turned and shifted freely in space; on nodes of their own, or all on the same ones.
NodalScene<3> matching_squares(int n, bool cut, bool on_same_nodes, std::mt19937_64& random) {
    NodalScene<3> scene;
    const Matrix<3> turn = rotation_about(any_vector_of(random, 1.0).normalized(), 3.0 * any_vector_of(random, 1.0).x());
    const Vector<3> by = any_vector_of(random, 2.0);
    scene.faces.stiffness = {1.0, 3.0};
    for (int body = 0; body < 2; ++body) {
        if (body == 0 || !on_same_nodes)
            for (int i = 0; i <= n; ++i)
                for (int j = 0; j <= n; ++j) {
                    scene.rest.push_back(turn * Vector<3>(i, j, 0.0) / n + by);
                    scene.node_body.push_back(body);
                }
        const auto node = [&](int i, int j) { return (on_same_nodes ? 0 : body * (n + 1) * (n + 1)) + i * (n + 1) + j; };
        const auto append = [&](std::vector<std::int32_t> corners) {
            if (body == 1) std::ranges::reverse(corners);
            scene.faces.append_face(corners, 0.1, body);
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const std::int32_t a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
                if (cut) {
                    append({a, b, c});
                    append({a, c, d});
                } else {
                    append({a, b, c, d});
                }
            }
    }
    return scene;
}

std::vector<Vector<3>> jittered(const std::vector<Vector<3>>& x, double motion, std::mt19937_64& random) {
    std::vector<Vector<3>> moved;
    for (const Vector<3>& corner : x) moved.push_back(corner + any_vector_of(random, motion));
    return moved;
}

template <class Call>
std::string text_of_divergence(const Call& call) {
    try {
        call();
    } catch (const Diverged& error) {
        CHECK(error.facts().face_1 == 0);
        CHECK(error.facts().face_2 == 1);
        return error.what();
    }
    return "";
}

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("matching squares at a gap of exactly 0 in any plane press no more than their motion makes them",
          "[contact][nodal][degenerate]") {
    const int n = GENERATE(1, 3, 7);
    const bool cut = GENERATE(false, true), on_same_nodes = GENERATE(false, true);
    const double motion = GENERATE(0.0, 1e-16, 1e-10);
    std::mt19937_64 random(17);
    double energy = 0.0, momentum = 0.0, balance = 0.0, force = 0.0;
    for (int seed = 0; seed < (n == 7 ? 5 : 15); ++seed) {
        const auto scene = matching_squares(n, cut, on_same_nodes, random);
        NodalContact<3> contact(scene.surface());
        auto x_0 = scene.rest;
        for (int i = 0; i < 4; ++i) {
            const auto x_1 = jittered(x_0, motion, random);
            const auto& step = contact.step(1.0, x_0, x_1, i % 2 == 0 ? TakenForce::mean : TakenForce::end);
            Vector<3> sum = Vector<3>::Zero();
            double work = 0.0;
            for (std::size_t v = 0; v < step.nodes.size(); ++v) {
                sum += step.gradient[v];
                raise(force, step.gradient[v].norm());
                work += step.gradient[v].dot(x_1[step.nodes[v]] - x_0[step.nodes[v]]);
            }
            raise(momentum, sum.norm());
            raise(energy, std::abs(step.energy));
            CHECK(step.energy >= 0.0);
            CHECK(step.energy_0 >= 0.0);
            if (i % 2 == 0) raise(balance, std::abs(work - (step.energy - step.energy_0)));
            x_0 = x_1;
        }
    }
    // k = 3/4 over an area of 1; pressed in by the motion of four steps, and by the rounding of coordinates of size 2
    const double deepest = 16.0 * motion + 1e-14;
    CHECK(energy <= 0.5 * 0.75 * deepest * deepest);
    CHECK(force <= 0.75 * deepest);
    CHECK(momentum <= 1e-12 * deepest);
    CHECK(balance <= 1e-12 * deepest * deepest + 1e-14 * deepest);
}

TEST_CASE("of matching squares that are pressed in, W is k/2 times the area times the depth squared, in any plane",
          "[contact][nodal][degenerate]") {
    const int n = GENERATE(1, 3);
    const bool cut = GENERATE(false, true);
    std::mt19937_64 random(18);
    double worst = 0.0;
    for (int seed = 0; seed < 20; ++seed) {
        const auto scene = matching_squares(n, cut, false, random);
        NodalContact<3> contact(scene.surface());
        const Vector<3> normal =
            (scene.rest[static_cast<std::size_t>(n) + 1] - scene.rest[0]).cross(scene.rest[1] - scene.rest[0]).normalized();
        const auto pressed = placed<3>(scene, 1, shifted<3>(-0.01 * normal));
        raise(worst, std::abs(contact.step(1.0, scene.rest, pressed).energy / (0.5 * 0.75 * 1e-4) - 1.0));
    }
    CHECK(worst < 1e-11);
}

TEST_CASE("a face that turns over within a step is an error that names it, and the next step goes on",
          "[contact][nodal][degenerate]") {
    // The second corner of face 0 passes over its third one half way through the step: n turns over.
    NodalScene<3> scene;
    scene.rest = {{0, 0, 3}, {1, 1, 3}, {0, 1, 3}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    scene.faces.stiffness = {1e12, std::numeric_limits<double>::infinity()};
    scene.faces.append_face(std::vector<std::int32_t>{0, 1, 2}, 1e9, 0);
    scene.faces.append_face(std::vector<std::int32_t>{3, 5, 4}, 0.0, 1);
    NodalContact<3> contact(scene.surface());
    auto turned = scene.rest;
    turned[1] = {-1, 1, 3};
    const std::string text = text_of_divergence([&] { contact.step(1.0, scene.rest, turned); });
    CHECK(tells(text, "face 0 (body 0"));
    CHECK(tells(text, "face 0 turns over"));
    CHECK(tells(text, "smaller time step"));
    auto closer = scene.rest;
    closer[3] = closer[3] + Vector<3>(0, 0, 0.1);
    CHECK(contact.step(1.0, scene.rest, closer).is_active());
}

TEST_CASE("forces beyond the range of numbers are an error that names both faces", "[contact][nodal][degenerate]") {
    const TakenForce take = GENERATE(TakenForce::mean, TakenForce::end);
    NodalScene<2> scene;
    scene.rest = {{0, 0}, {1e60, 0}, {1e60, -1e60}, {0, -1e60}};  // pressed in by 1e60: k g^2/2 times 1e60 is 5e279
    scene.faces.stiffness = {1e100, 1e100};
    scene.faces.append_face(std::vector<std::int32_t>{1, 0}, 1e60, 0);
    scene.faces.append_face(std::vector<std::int32_t>{3, 2}, 1e60, 1);
    NodalContact<2> contact(scene.surface());
    const std::string text = text_of_divergence([&] { contact.step(1.0, scene.rest, scene.rest, take); });
    CHECK(tells(text, "face 0 (body 0"));
    CHECK(tells(text, "face 1 (body 1"));
    CHECK(tells(text, "pressed 1e+60 m"));
    CHECK(tells(text, "5e+99 Pa/m"));
    CHECK(tells(text_of_divergence([&] { contact.evaluate(scene.rest); }), "pressed 1e+60 m"));
}

TEST_CASE("stiffnesses and lengths whose products are no numbers are refused by name", "[contact][nodal][degenerate]") {
    const auto message = [](const NodalScene<3>& scene) -> std::string {
        try {
            static_cast<void>(scene.surface());
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    };
    const auto good = two_boxes<3>(1, 1, 0.1);
    for (const double stiffness : {1e308, 1e-200, std::numeric_limits<double>::quiet_NaN()}) {
        auto scene = good;
        scene.faces.stiffness[1] = stiffness;
        CHECK(tells(message(scene), "body 1 has the stiffness"));
    }
    for (const double depth : {1e100, 5e-324, std::numeric_limits<double>::infinity()}) {
        auto scene = good;
        scene.faces.depth[2] = depth;
        CHECK(tells(message(scene), "face 2 has the depth"));
    }
    for (const double size : {1e-70, 1e70}) {
        auto scene = good;
        for (Vector<3>& corner : scene.rest) corner *= size;
        CHECK(message(scene).empty());
        for (Vector<3>& corner : scene.rest) corner *= size;
        CHECK(tells(message(scene), "face 0 has"));
    }
}
