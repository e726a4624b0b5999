// Which pairs of faces are contacts where corners and edges of bodies meet: those that look at each other, and not those that
// look past each other because a tip is thinner than D.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include "abut/base/rotation.hpp"

#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;
using contact::NodalStep;

namespace {

constexpr double depth_of_faces = 0.1;            // D = 0.2
constexpr double stiffness_of_pair = 15.0 / 8.0;  // of k = 3 and 5 in series

template <int Dim>
Matrix<Dim> edge_up() {
    if constexpr (Dim == 2)
        return rotation_in_plane(std::numbers::pi / 4.0);
    else
        return rotation_about(Vector<3>(0.0, 1.0, 0.0), std::numbers::pi / 4.0);
}
Matrix<3> corner_up() { return rotation_between({1.0, 1.0, 1.0}, {0.0, 0.0, 1.0}); }

/// Two unit boxes of n cells about their middles, each turned: one below the origin, the upper ends of which meet the lower
/// ends of the other one.
template <int Dim>
struct EndOnEnd {
    EndOnEnd(int n, const Matrix<Dim>& turn) : turn_(turn) {
        append_box<Dim>(scene, -Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts<Dim>(n), 3.0, depth_of_faces);
        append_box<Dim>(scene, -Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts<Dim>(n), 5.0, depth_of_faces);
        for (const Vector<Dim>& x : scene.rest) half_height_ = std::max(half_height_, Vector<Dim>(turn * x)[Dim - 1]);
    }
    /// The lower end of the upper box is at `end`.
    [[nodiscard]] std::vector<Vector<Dim>> at(const Vector<Dim>& end) const {
        const Vector<Dim> down = -half_height_ * up<Dim>();
        return placed<Dim>(scene, 1, {turn_, end - down}, placed<Dim>(scene, 0, {turn_, down}));
    }

    NodalScene<Dim> scene;

private:
    Matrix<Dim> turn_;
    double half_height_ = 0.0;
};

/// Lets the upper box come down by `by` from a hundredth above the lower one.
template <int Dim, class Look>
void come_down(const EndOnEnd<Dim>& boxes, NodalContact<Dim>& bodies, const Vector<Dim>& aside, double by,
               const Look& look) {
    constexpr int steps = 40;
    const auto height = [&](int i) { return 0.01 - by * i / steps; };
    for (int i = 0; i < steps; ++i)
        look(bodies.step(1.0, boxes.at(aside + height(i) * up<Dim>()), boxes.at(aside + height(i + 1) * up<Dim>())));
}

}  // namespace

TEST_CASE("corners and edges that meet beside each other are pushed apart, by the faces that look at each other alone",
          "[contact][corners]") {
    const double shift = GENERATE(0.004, 0.01, 0.03);
    const auto check = [&]<int Dim>(const char* name, const EndOnEnd<Dim>& boxes, const Vector<Dim>& aside) {
        CAPTURE(name, shift);
        NodalContact<Dim> bodies(boxes.scene.surface());
        int touching = 0;
        come_down<Dim>(boxes, bodies, aside, 0.06, [&](const NodalStep<Dim>& step) {
            for (const contact::PairStep<Dim>& pair : step.pairs) {
                // The upper box is aside: what it meets is on its other side. Pairs that look past each other have the
                // normals of the flanks behind.
                const bool first_is_lower = boxes.scene.faces.body[number_of(pair.face_1)] == 0;
                const Vector<Dim> upwards = first_is_lower ? pair.normal : Vector<Dim>(-pair.normal);
                CHECK(upwards.dot(aside) > 0.0);
            }
            touching += step.is_active();
        });
        CHECK(touching > 5);
        CHECK(bodies.report().missed_contacts == 0);
    };
    check.template operator()<2>("squares", EndOnEnd<2>(5, edge_up<2>()), Vector<2>(shift, 0.0));
    check.template operator()<3>("edge on edge", EndOnEnd<3>(4, edge_up<3>()), Vector<3>(shift, 0.3 * shift, 0.0));
    check.template operator()<3>("corner on corner", EndOnEnd<3>(4, corner_up()), Vector<3>(shift, 0.3 * shift, 0.0));
}

TEST_CASE("a corner that slides over a flat side is handed over from facet to facet, as deep as it is pressed in",
          "[contact][corners]") {
    const auto check = [&]<int Dim>(const Matrix<Dim>& turn, const Vector<Dim>& along) {
        NodalScene<Dim> scene;
        Vector<Dim> lower = Vector<Dim>::Constant(-1.0), upper = Vector<Dim>::Constant(1.0);
        upper[Dim - 1] = 0.0;
        append_box<Dim>(scene, lower, upper, counts<Dim>(8), 3.0, depth_of_faces);
        append_box<Dim>(scene, -Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts<Dim>(4), 5.0, depth_of_faces);
        double half_height = 0.0;
        for (std::size_t i = 0; i < scene.rest.size(); ++i)
            if (scene.node_body[i] == 1) half_height = std::max(half_height, Vector<Dim>(turn * scene.rest[i])[Dim - 1]);
        const auto at = [&](double s, double height) {
            return placed<Dim>(scene, 1, {turn, s * along + (half_height + height) * up<Dim>()});
        };
        NodalContact<Dim> bodies(scene.surface());
        constexpr double pressed = -0.08;  // 0.4 D
        bodies.step(1.0, at(-0.5, 0.01), at(-0.5, pressed));
        const double energy = bodies.evaluate(at(-0.5, pressed)).energy;
        CHECK(energy > 0.0);
        // Where facets meet the tip is over two of them, and each has the normals of its own pairs: W is not quite even.
        double least = energy, largest = energy;
        for (int i = 0; i < 200; ++i) {
            const double s = -0.5 + 0.005 * i;
            const auto& step = bodies.step(1.0, at(s, pressed), at(s + 0.005, pressed));
            least = std::min(least, step.energy);
            largest = std::max(largest, step.energy);
        }
        CHECK(least > 0.99 * energy);
        CHECK(largest < 1.01 * energy);
        CHECK(bodies.report().missed_contacts == 0);
        CHECK(bodies.report().inadmissible_overlaps == 0);
    };
    check.template operator()<2>(edge_up<2>(), Vector<2>(1.0, 0.0));
    check.template operator()<3>(edge_up<3>(), Vector<3>(1.0, 0.13, 0.0));
    check.template operator()<3>(corner_up(), Vector<3>(1.0, 0.13, 0.0));
}

TEST_CASE("a block that slides along an edge of another one, flush with it, is pressed by k |g| over all that they share",
          "[contact][corners]") {
    const double aside = GENERATE(0.0, 1e-13, -1e-13, 1e-4, -1e-4);  // across the edge
    const int n = GENERATE(2, 3);
    constexpr double pressed = -0.06;  // 0.3 D
    NodalScene<3> scene;
    append_box<3>(scene, {0.0, 0.0, -1.0}, {2.0, 1.0, 0.0}, {4, 2, 2}, 3.0, depth_of_faces);
    append_box<3>(scene, {0.0, 0.0, 0.0}, {1.0, 0.5, 1.0}, {n, n, n}, 5.0, depth_of_faces);
    const auto at = [&](double s, double height) { return placed<3>(scene, 1, shifted<3>({s, aside, height})); };
    NodalContact<3> bodies(scene.surface());
    bodies.step(1.0, at(0.01, 0.01), at(0.01, pressed));
    for (int i = 0; i < 110; ++i) {
        const double s = 0.01 + 0.0171 * i;  // it sticks out over the end at last
        bodies.step(1.0, at(s, pressed), at(s + 0.0171, pressed));
        const auto& step = bodies.evaluate(at(s + 0.0171, pressed));
        const double shared = std::min(1.0, 2.0 - (s + 0.0171)) * (0.5 - std::max(0.0, -aside));
        double pressing = 0.0;
        for (const auto& pair : step.pairs)
            if (std::abs(pair.normal[2]) > 0.99) pressing += pair.normal_force;
        CHECK(pressing == Approx(stiffness_of_pair * -pressed * shared).epsilon(1e-9));
    }
    CHECK(bodies.report().missed_contacts == 0);
}

TEST_CASE(
    "tips for which a flat face has less than a quarter of the weight of a pair are blind, with body and place; bevels see "
    "them",
    "[contact][blind]") {
    // y^2 (3 - 2 y) = 1/4 at y = 1/2 - sin(10 degrees) of the fade from -0.6 to -0.2; the flanks of a tip look at a face that
    // comes straight at it by minus the sine of half its angle.
    const double limit = 2.0 * std::asin(0.2 + 0.4 * (0.5 - std::sin(std::numbers::pi / 18.0)));
    CHECK(limit * 180.0 / std::numbers::pi == Approx(38.6).epsilon(1e-3));
    for (const double angle : {25.0 * std::numbers::pi / 180.0, 0.999 * limit, 1.001 * limit}) {
        NodalScene<2> scene;
        append_box<2>(scene, {-1.0, -1.0}, {1.0, 0.0}, counts<2>(4), 3.0, depth_of_faces);
        const auto first = static_cast<std::int32_t>(scene.rest.size());
        const Vector<2> tip(0.01, 0.02);
        for (const double side : {0.0, 1.0, -1.0})
            scene.rest.push_back(tip + std::abs(side) * Vector<2>(side * std::tan(0.5 * angle), 1.0));
        scene.faces.stiffness.push_back(5.0);
        for (int i = 0; i < 3; ++i)  // counter-clockwise: the outside is on the right
            scene.faces.append_face(std::vector<std::int32_t>{first + i, first + (i + 1) % 3}, depth_of_faces, 1);
        const auto surface = scene.surface();
        const auto blind = contact::blind_corners<2>(surface.facets().view(), contact::quarter_weight_cosine({}));
        CHECK(NodalContact<2>(surface).blind_corners().empty());
        REQUIRE(blind.size() == (angle < limit ? 1 : 0));
        if (blind.empty()) continue;
        CHECK(blind[0].body == 1);
        CHECK(blind[0].position == tip);
    }
}
