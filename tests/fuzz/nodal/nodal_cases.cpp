#include "fuzz/nodal/nodal_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "abut/base/rotation.hpp"

namespace abut::fuzz {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
Vector<Dim> any_vector(Dice& dice, double size) {
    Vector<Dim> vector;
    for (int d = 0; d < Dim; ++d) vector[d] = dice.uniform(-size, size);
    return vector;
}

template <int Dim>
Matrix<Dim> any_turn(Dice& dice, double most) {
    const double angle = dice.uniform(-most, most);
    if constexpr (Dim == 2)
        return rotation_in_plane(angle);
    else
        return rotation_about((any_vector<3>(dice, 1.0) + 1e-3 * Vector<3>::UnitX()).normalized(), angle);
}

/// Puts faces and nodes into a case.
template <int Dim>
class Maker {
public:
    Maker(NodalCase<Dim>& scene, Dice& dice) : scene_(scene), dice_(dice) {}

    void begin_body() { scene_.faces.stiffness.push_back(any_stiffness()); }
    std::int32_t node(const Vector<Dim>& at) {
        scene_.rest.push_back(at);
        return static_cast<std::int32_t>(scene_.rest.size()) - 1;
    }
    void face(const std::vector<std::int32_t>& corners, double depth) {
        scene_.faces.append_face(corners, depth, static_cast<std::int32_t>(scene_.faces.stiffness.size()) - 1);
    }
    void last_body_turned_over(std::size_t first_face) {
        auto& [nodes, offsets, body, depth, stiffness] = scene_.faces;
        for (std::size_t f = first_face; f < body.size(); ++f)
            std::reverse(nodes.begin() + offsets[f], nodes.begin() + offsets[f + 1]);
    }
    /// One depth for a body: mostly some part of its size.
    double any_depth() {
        if (dice_.one_in(20)) return dice_.any_of({1e-9, 1e9, 1e-70, 1e74, 0.0, infinity, 5e-324});
        return dice_.power(-3.0, 1.0);
    }

private:
    double any_stiffness() {
        if (dice_.one_in(4)) return infinity;
        if (dice_.one_in(20)) return dice_.any_of({1e-12, 1e12, 1e-149, 1e149, 1e308, 5e-324});
        return dice_.power(-3.0, 12.0);
    }

    NodalCase<Dim>& scene_;
    Dice& dice_;
};

/// A sheet of n^(Dim-1) faces over the unit square, looking up; cut into triangles, in four-cornered faces, or either.
template <int Dim>
void append_sheet(Maker<Dim>& maker, Dice& dice, int n, const Vector<Dim>& by, const std::vector<std::int32_t>* same_nodes,
                  std::vector<std::int32_t>& nodes) {
    const double depth = maker.any_depth();
    const int rows = Dim == 2 ? 0 : n;
    const int cut = dice.below(4);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= rows; ++j) {
            Vector<Dim> at = by;
            at[0] += static_cast<double>(i) / n;
            if (Dim == 3) at[1] += static_cast<double>(j) / n;
            nodes.push_back(same_nodes != nullptr ? (*same_nodes)[nodes.size()] : maker.node(at));
        }
    const auto at = [&](int i, int j) { return nodes[static_cast<std::size_t>(i * (rows + 1) + j)]; };
    for (int i = 0; i < n; ++i) {
        if (Dim == 2) maker.face({at(i + 1, 0), at(i, 0)}, depth);  // the outside is on the right
        for (int j = 0; j < rows; ++j) {
            const std::int32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if (cut == 0) maker.face({a, b, c, d}, depth);
            if (cut == 1) maker.face({a, b, c}, depth), maker.face({a, c, d}, depth);
            if (cut == 2) maker.face({a, b, d}, depth), maker.face({b, c, d}, depth);
            if (cut == 3) maker.face({a, c, d}, depth);  // with holes
        }
    }
}

/// Two or three sheets that look at each other: at exactly the same places, on the same nodes, or shifted by next to nothing
/// or by something.
template <int Dim>
void make_sheets(NodalCase<Dim>& scene, Dice& dice) {
    Maker<Dim> maker(scene, dice);
    const int n = 1 + dice.below(Dim == 2 ? 6 : 3), n_2 = dice.one_in(2) ? n : 1 + dice.below(4);
    std::vector<std::int32_t> first, second, third;
    maker.begin_body();
    append_sheet<Dim>(maker, dice, n, Vector<Dim>::Zero(), nullptr, first);
    Vector<Dim> by = Vector<Dim>::Zero();
    if (!dice.one_in(3)) by[Dim - 1] = dice.any_of({-1.0, 1.0}) * dice.power(-17.0, 0.0);  // the gap
    if (dice.one_in(2)) by[0] = dice.any_of({1.0, 0.5, 0.25, dice.power(-17.0, 0.0), -1.0});
    if (Dim == 3 && dice.one_in(2)) by[1] = dice.any_of({1.0, 0.5, dice.power(-17.0, 0.0)});
    const std::size_t first_face = scene.faces.body.size();
    maker.begin_body();
    append_sheet<Dim>(maker, dice, n_2, by, n == n_2 && dice.one_in(3) ? &first : nullptr, second);
    maker.last_body_turned_over(first_face);
    if (!dice.one_in(3)) return;
    const std::size_t third_face = scene.faces.body.size();
    maker.begin_body();
    append_sheet<Dim>(maker, dice, n, by, nullptr, third);
    if (dice.one_in(2)) maker.last_body_turned_over(third_face);
}

/// Random faces between few nodes, some of which are copies of others, lie on the line of two others, or next to it.
template <int Dim>
void make_soup(NodalCase<Dim>& scene, Dice& dice) {
    Maker<Dim> maker(scene, dice);
    const int n_nodes = Dim + 1 + dice.below(10);
    for (int i = 0; i < n_nodes; ++i) {
        Vector<Dim> at = any_vector<Dim>(dice, 1.0);
        const auto other = [&] { return scene.rest[static_cast<std::size_t>(dice.below(i))]; };
        if (dice.one_in(3)) at[Dim - 1] = 0.0;
        if (i > 1 && dice.one_in(4)) at = other();
        if (i > 1 && dice.one_in(4)) {
            const Vector<Dim> from = other(), to = other();
            at = from + dice.any_of({0.5, dice.uniform(-0.5, 1.5)}) * (to - from);
        }
        if (dice.one_in(4)) at += any_vector<Dim>(dice, dice.power(-17.0, -3.0));
        maker.node(at);
    }
    for (int body = 0; body < 2 + dice.below(3); ++body) {
        maker.begin_body();
        const double depth = maker.any_depth();
        for (int f = 0; f < 1 + dice.below(4); ++f) {
            std::vector<std::int32_t> corners;
            for (int v = 0; v < Dim + (Dim == 3 && dice.one_in(5) ? 1 : 0); ++v) corners.push_back(dice.below(n_nodes));
            maker.face(corners, depth);
            if (!dice.one_in(3)) continue;
            std::reverse(corners.begin(), corners.end());  // the same face again, looked at from behind, on another body
            maker.begin_body();
            maker.face(corners, depth);
        }
    }
}

/// Triangles of two bodies around one edge, segments of two bodies around one node.
template <int Dim>
void make_fan(NodalCase<Dim>& scene, Dice& dice) {
    Maker<Dim> maker(scene, dice);
    const std::int32_t a = maker.node(any_vector<Dim>(dice, 1.0)), b = maker.node(any_vector<Dim>(dice, 1.0));
    for (int body = 0; body < 2; ++body) {
        maker.begin_body();
        const double depth = maker.any_depth();
        for (int f = 0; f < 1 + dice.below(3); ++f) {
            const std::int32_t c = maker.node(any_vector<Dim>(dice, dice.any_of({1.0, 1e-3, 1e-8})));
            std::vector<std::int32_t> corners{a, b};
            if (Dim == 3) corners = {a, b, c};
            if (Dim == 2) corners = {dice.one_in(2) ? a : b, c};
            if ((body == 1) != dice.one_in(4)) std::reverse(corners.begin(), corners.end());
            maker.face(corners, depth);
        }
    }
}

contact::NodalOptions any_options(Dice& dice, double size) {
    contact::NodalOptions options;
    if (dice.one_in(3)) options.search.skin = size * dice.power(-12.0, 2.0);
    if (dice.one_in(2)) options.compression_limit = dice.any_of({infinity, 1e300, 1e3, 0.5});
    if (dice.one_in(4)) options.facing = {.full = dice.uniform(-1.0, -0.5), .none = dice.uniform(-0.49, 0.0)};
    if (dice.one_in(10)) options.facing = {.full = -1.0, .none = -0.99};
    if (dice.one_in(4)) options.events = false;
    if (dice.one_in(4)) options.search.largest_motion = dice.any_of({1e6, 1e300, infinity});
    if (dice.one_in(40)) options.search.limits.pairs = dice.any_of({std::int64_t{-5}, std::int64_t{0}, std::int64_t{3}});
    return options;
}

}  // namespace

double Dice::power(double from, double to) { return std::pow(10.0, uniform(from, to)); }

template <int Dim>
NodalCase<Dim> make_case(Dice& dice) {
    NodalCase<Dim> scene;
    switch (dice.below(4)) {
        case 0:
            make_soup<Dim>(scene, dice);
            break;
        case 1:
            make_fan<Dim>(scene, dice);
            break;
        default:
            make_sheets<Dim>(scene, dice);
    }
    if (!dice.one_in(2)) scene.size = dice.any_of({1e-3, 1e3, 1e-9, 1e9, 1e-30, 1e30, 1e-74, 1e74, dice.power(-20.0, 20.0)});
    const Matrix<Dim> turn = dice.one_in(4) ? Matrix<Dim>::Identity() : any_turn<Dim>(dice, 3.2);
    const Vector<Dim> by = dice.one_in(2) ? Vector<Dim>::Zero() : any_vector<Dim>(dice, dice.power(-1.0, 4.0));
    for (Vector<Dim>& corner : scene.rest) corner = scene.size * (turn * corner + by);
    for (double& depth : scene.faces.depth) depth *= scene.size;
    scene.options = any_options(dice, scene.size);
    return scene;
}

template <int Dim>
std::vector<Vector<Dim>> moved(const NodalCase<Dim>& scene, const std::vector<Vector<Dim>>& x, Dice& dice) {
    std::vector<Vector<Dim>> to = x;
    const auto any_node = [&] { return static_cast<std::size_t>(dice.below(static_cast<int>(x.size()))); };
    const double motion = scene.size * dice.any_of({1e-16, 1e-10, 1e-3, 0.1, 1.0, dice.power(-16.0, 1.0)});
    switch (dice.below(7)) {
        case 0:
            break;
        case 1:  // one body, or half of it, as a whole
        case 2: {
            const Matrix<Dim> turn = dice.one_in(2) ? Matrix<Dim>::Identity() : any_turn<Dim>(dice, 3.2);
            const Vector<Dim> by = any_vector<Dim>(dice, motion), centre = x[any_node()];
            for (std::size_t i = x.size() / 2; i < x.size(); ++i) to[i] = centre + turn * (x[i] - centre) + by;
            break;
        }
        case 3:  // back to where all was
            to = scene.rest;
            break;
        case 4:  // a face collapses
            to[any_node()] = x[any_node()];
            break;
        case 5:  // a node passes through another one, or goes far away
            to[any_node()] = x[any_node()] + (dice.one_in(4) ? 1e6 : 1.0) * any_vector<Dim>(dice, scene.size);
            break;
        default:
            for (Vector<Dim>& corner : to) corner += any_vector<Dim>(dice, motion);
    }
    if (dice.one_in(200)) to[any_node()][0] = dice.any_of({infinity, std::nan(""), 1e308, 5e-324});
    return to;
}

template struct NodalCase<2>;
template struct NodalCase<3>;
template NodalCase<2> make_case(Dice&);
template NodalCase<3> make_case(Dice&);
template std::vector<Vector<2>> moved(const NodalCase<2>&, const std::vector<Vector<2>>&, Dice&);
template std::vector<Vector<3>> moved(const NodalCase<3>&, const std::vector<Vector<3>>&, Dice&);

}  // namespace abut::fuzz
