// A body that touches itself, on given motions: what acts, against all pairs one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using contact::NodalContact;
using contact::NodalStep;

namespace {

constexpr double size = 0.1;               // of a face
constexpr double cell_depth = 0.5 * size;  // of the cells behind them: D = 0.1

using Outline = std::vector<Vector<2>>;  // counter-clockwise

/// The sides of a prism over an outline, whose edges are cut to faces of `size`; 3D: of two triangles each, `size` high.
template <int Dim>
NodalScene<Dim> body_of(const Outline& outline) {
    Outline points;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector<2> from = outline[i], to = outline[(i + 1) % outline.size()];
        const int n = std::max(1, static_cast<int>(std::lround((to - from).norm() / size)));
        for (int part = 0; part < n; ++part) points.push_back(from + part * (to - from) / n);
    }
    NodalScene<Dim> scene;
    scene.faces.stiffness.push_back(3.0);
    const auto n = static_cast<std::int32_t>(points.size());
    for (int layer = 0; layer < (Dim == 2 ? 1 : 2); ++layer)
        for (const Vector<2>& point : points) {
            Vector<Dim> x = Vector<Dim>::Zero();
            x[0] = point[0], x[1] = point[1];
            if constexpr (Dim == 3) x[2] = size * layer;
            scene.rest.push_back(x);
            scene.node_body.push_back(0);
        }
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t next = (i + 1) % n;
        if constexpr (Dim == 2) {
            scene.faces.append_face(std::array{i, next}, cell_depth, 0);
        } else {
            scene.faces.append_face(std::array{i, next, n + next}, cell_depth, 0);
            scene.faces.append_face(std::array{i, n + next, n + i}, cell_depth, 0);
        }
    }
    return scene;
}

Outline wedge(double degrees) {
    const double half = 0.5 * degrees * std::numbers::pi / 180.0;
    return {{0.0, 0.0}, {std::cos(half), -std::sin(half)}, {std::cos(half), std::sin(half)}};
}

/// A square with a crack from its right side, along `path` to its tip; closed, or open by so much.
Outline cracked(const Outline& path, double open = 0.0) {
    Outline outline{{-1.0, -1.0}, {1.0, -1.0}};
    for (std::size_t i = 0; i < path.size(); ++i)
        outline.push_back(path[i] - Vector<2>(0.0, i + 1 < path.size() ? 0.5 * open : 0.0));
    for (std::size_t i = path.size() - 1; i-- > 0;) outline.push_back(path[i] + Vector<2>(0.0, 0.5 * open));
    outline.insert(outline.end(), {{1.0, 1.0}, {-1.0, 1.0}});
    return outline;
}

Outline plate(int cells) { return {{0.0, 0.0}, {2.0, 0.0}, {2.0, cells * size}, {0.0, cells * size}}; }

struct Shape {
    std::string name;
    Outline outline;
};
std::vector<Shape> shapes() {
    std::vector<Shape> all;
    for (const int degrees : {30, 45, 60, 75, 90}) all.push_back({"wedge of " + std::to_string(degrees), wedge(degrees)});
    all.push_back({"straight crack", cracked({{1.0, 0.0}, {0.0, 0.0}})});
    all.push_back({"kinked crack", cracked({{1.0, 0.0}, {0.7, 0.1}, {0.4, -0.1}, {0.0, 0.1}})});
    all.push_back({"crack with sharp kinks", cracked({{1.0, 0.0}, {0.8, 0.25}, {0.6, -0.25}, {0.4, 0.25}, {0.2, -0.1}})});
    all.push_back(
        {"C", {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.3}, {0.3, 0.3}, {0.3, 0.34}, {1.0, 0.34}, {1.0, 0.64}, {0.0, 0.64}}});
    all.push_back({"notch", cracked({{1.0, 0.0}, {0.0, 0.0}}, 0.2)});
    for (const int cells : {1, 2, 4}) all.push_back({"plate of " + std::to_string(cells), plate(cells)});
    return all;
}

contact::NodalOptions touching_itself() {
    contact::NodalOptions options;
    options.search.self_contact = true;
    options.search.largest_motion = 10.0;
    return options;
}

using FacePair = std::pair<std::int32_t, std::int32_t>;
FacePair in_order(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Pairs of a scene that are pressed in at x, of those that `may` touch: each with each.
template <int Dim>
std::set<FacePair> pressed_in(const NodalContact<Dim>& contact, const std::vector<Vector<Dim>>& x,
                              const std::function<bool(std::int32_t, std::int32_t)>& may) {
    const contact::Surface<Dim>& facets = contact.surface().facets();
    const auto box_of = [&](std::int32_t facet) {
        geometry::Box<Dim> box;
        for (int v = 0; v < Dim; ++v) box.extend(x[facets.face_vertices[Dim * facet + v]]);
        return box.grown(size);
    };
    std::set<FacePair> found;
    for (std::int32_t a = 0; a < facets.size(); ++a)
        for (std::int32_t b = a + 1; b < facets.size(); ++b) {
            if (!may(a, b) || !box_of(a).overlaps(box_of(b))) continue;
            geometry::PairCorners<Dim> corners;
            for (int v = 0; v < Dim; ++v) {
                corners[v] = x[facets.face_vertices[Dim * a + v]];
                corners[Dim + v] = x[facets.face_vertices[Dim * b + v]];
            }
            geometry::PairLaw<Dim> law{.stiffness = 1.0};
            if constexpr (Dim == 2) law.length = {facets.area[a], facets.area[b]};
            const auto state = geometry::pair_state<Dim>(corners, law);
            if (state.energy > 1e-20 && state.gap > -2.0 * cell_depth) found.insert({a, b});
        }
    return found;
}

struct Compared {
    int true_pairs = 0, missed = 0, wrong = 0;
    std::vector<double> energies;
};

/// Goes through states 0 to n, and compares at the end of each step.
template <int Dim>
Compared compare(const NodalScene<Dim>& scene, const contact::NodalOptions& options, int n,
                 const std::function<std::vector<Vector<Dim>>(int)>& state,
                 const std::function<bool(std::int32_t, std::int32_t)>& may) {
    NodalContact<Dim> contact(scene.surface(), options);
    Compared compared;
    for (int i = 0; i < n; ++i) {
        const auto x_0 = state(i), x_1 = state(i + 1);
        const NodalStep<Dim>& step = contact.step(1.0, x_0, x_1);
        compared.energies.push_back(step.energy);
        std::set<FacePair> acting;
        double work = 0.0;
        for (std::size_t k = 0; k < step.nodes.size(); ++k)
            work += step.gradient[k].dot(x_1[step.nodes[k]] - x_0[step.nodes[k]]);
        CHECK(std::abs(work - (step.energy - step.energy_0)) <= 1e-13 * (step.energy + step.energy_0) + 1e-16);
        for (const auto& pair : step.pairs) {
            const auto faces = in_order(number_of(pair.face_1), number_of(pair.face_2));
            if (pair.gap_1 < 0.0) acting.insert(faces);
            if (!may(faces.first, faces.second)) ++compared.wrong;
        }
        const auto truth = pressed_in<Dim>(contact, x_1, may);
        compared.true_pairs += static_cast<int>(truth.size());
        for (const FacePair& pair : truth)
            if (!acting.contains(pair)) ++compared.missed;
    }
    CHECK(contact.report().missed_contacts == 0);
    return compared;
}

/// Nodes of a layer between y = `height` and `height` + `size`, in cells of `size`, as part of body 0.
template <int Dim>
void append_layer(NodalScene<Dim>& scene, double begin, int cells, double height) {
    Vector<Dim> lower = Vector<Dim>::Constant(0.0);
    lower[0] = begin, lower[1] = height;
    Vector<Dim> upper = Vector<Dim>::Constant(2.0 * size);
    upper[0] = begin + cells * size, upper[1] = height + size;
    auto n = counts<Dim>(2);
    n[0] = cells, n[1] = 1;
    append_box<Dim>(scene, lower, upper, n, 3.0, cell_depth);
}

/// The strip of one layer: its middle line goes along a spiral up to a length, and straight on from there.
constexpr double pitch = 0.98 * size, inner_radius = 0.4, turns = 1.6;

struct OnSpiral {
    Vector<2> at, along;
};
OnSpiral on_spiral(double length, double rolled) {
    const double b = pitch / (2.0 * std::numbers::pi);
    double angle = 0.0;  // Newton on the length of the spiral, by small steps
    const double wanted = std::min(length, rolled);
    const int parts = 400;
    for (int i = 0; i < parts; ++i) {  // midpoint rule of dphi/ds
        const double half = angle + 0.5 * wanted / parts / std::hypot(inner_radius + b * angle, b);
        angle += wanted / parts / std::hypot(inner_radius + b * half, b);
    }
    const double r = inner_radius + b * angle;
    const Vector<2> out(std::cos(angle), std::sin(angle)), around(-out[1], out[0]);
    const Vector<2> along = (b * out + r * around).normalized();
    return {r * out + std::max(0.0, length - rolled) * along, along};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("no body that may touch itself does so at rest, whatever its outline", "[contact][nodal][self]",
                       ((int Dim), Dim), 2, 3) {
    for (const Shape& shape : shapes()) {
        CAPTURE(shape.name);
        const auto scene = body_of<Dim>(shape.outline);
        NodalContact<Dim> contact(scene.surface(), touching_itself());
        const NodalStep<Dim>& step = contact.step(1.0, scene.rest, scene.rest);
        CHECK(step.energy <= 1e-30);  // a closed crack is closed to round-off
        for (const auto& pair : step.pairs) CHECK(std::min(pair.gap_0, pair.gap_1) > -1e-15);
    }
}

TEMPLATE_TEST_CASE_SIG("wedges and plates that turn and shear have no contact with themselves", "[contact][nodal][self]",
                       ((int Dim), Dim), 2, 3) {
    for (const Shape& shape : shapes()) {
        if (!shape.name.starts_with("wedge") && !shape.name.starts_with("plate")) continue;
        CAPTURE(shape.name);
        const auto scene = body_of<Dim>(shape.outline);
        NodalContact<Dim> contact(scene.surface(), touching_itself());
        std::vector<Vector<Dim>> x = scene.rest, next(x.size());
        for (int i = 1; i <= 300; ++i) {
            const double shear = 0.15 * std::sin(0.1 * i), stretch = 1.0 + 0.1 * std::sin(0.07 * i);
            const auto turned = turned_about<Dim>(Vector<Dim>::Zero(), 0.03 * i, 0.01 * i * axis<Dim>(0));
            for (std::size_t v = 0; v < x.size(); ++v) {
                Vector<Dim> at = scene.rest[v];
                at[0] = stretch * at[0] + shear * at[1];
                next[v] = turned(at);
            }
            REQUIRE_FALSE(contact.step(1.0, x, next).is_active());
            x.swap(next);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("layers of one body that slide while pressed have every contact, and those of two bodies",
                       "[contact][nodal][self]", ((int Dim), Dim), 2, 3) {
    const double gap = GENERATE(0.0, 0.03);
    const double skin = GENERATE(0.0, 0.02);
    NodalScene<Dim> scene;
    append_layer<Dim>(scene, 0.0, Dim == 2 ? 20 : 8, 0.0);
    const std::int32_t n_lower = static_cast<std::int32_t>(scene.faces.body.size());
    append_layer<Dim>(scene, 0.013, Dim == 2 ? 10 : 3, size + gap);
    const std::vector<std::int32_t> two = scene.node_body;
    auto labelled = scene;
    for (auto& body : scene.faces.body) body = 0;
    scene.faces.stiffness.pop_back();
    const auto state = [&](int i) {
        auto x = scene.rest;
        const double t = i / 200.0, down = (gap + 0.02 * size) * std::min(1.0, 10.0 * t);
        for (std::size_t v = 0; v < x.size(); ++v)
            if (two[v] == 1) x[v] += 0.9 * t * axis<Dim>(0) - down * axis<Dim>(1);
        return x;
    };
    const auto lies_at = [&](std::int32_t face, double height) {
        const auto nodes = std::span(scene.faces.nodes)
                               .subspan(static_cast<std::size_t>(scene.faces.offsets[face]),
                                        static_cast<std::size_t>(scene.faces.offsets[face + 1] - scene.faces.offsets[face]));
        return std::ranges::all_of(nodes, [&](std::int32_t node) { return std::abs(scene.rest[node][1] - height) < 1e-9; });
    };
    const auto may = [&](std::int32_t a, std::int32_t b) {
        return a < n_lower && b >= n_lower && lies_at(a, size) && lies_at(b, size + gap);
    };
    contact::NodalOptions options = touching_itself();
    options.search.skin = skin;
    const Compared compared = compare<Dim>(scene, options, 200, state, may);
    CHECK(compared.true_pairs > 2000);
    CHECK(compared.missed == 0);
    CHECK(compared.wrong == 0);
    options.search.self_contact = false;
    const Compared of_two = compare<Dim>(labelled, options, 200, state, may);
    for (std::size_t i = 0; i < compared.energies.size(); ++i)
        CHECK(compared.energies[i] == Approx(of_two.energies[i]).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("a C that claps has the energies of arms that are two bodies", "[contact][nodal][self]",
                       ((int Dim), Dim), 2, 3) {
    const auto all = shapes();
    const auto scene = body_of<Dim>(std::ranges::find(all, "C", &Shape::name)->outline);
    const double middle = 0.32;
    auto labelled = scene;
    labelled.faces.stiffness.push_back(labelled.faces.stiffness[0]);
    for (std::size_t face = 0; face < labelled.faces.body.size(); ++face) {
        double y = 0.0;
        for (std::int32_t c = scene.faces.offsets[face]; c < scene.faces.offsets[face + 1]; ++c)
            y += scene.rest[scene.faces.nodes[c]][1] / (scene.faces.offsets[face + 1] - scene.faces.offsets[face]);
        labelled.faces.body[face] = y > middle ? 1 : 0;
    }
    const auto state = [&](int i) {
        auto x = scene.rest;
        const double angle = 0.04 * std::sin(0.05 * i);
        for (std::size_t v = 0; v < x.size(); ++v)
            x[v] += (scene.rest[v][1] > middle ? -angle : angle) * std::max(0.0, scene.rest[v][0] - 0.3) * axis<Dim>(1);
        return x;
    };
    NodalContact<Dim> itself(scene.surface(), touching_itself()), of_two(labelled.surface());
    int active = 0;
    for (int i = 0; i < 130; ++i) {
        const auto x_0 = state(i), x_1 = state(i + 1);
        const NodalStep<Dim>&a = itself.step(1.0, x_0, x_1), &b = of_two.step(1.0, x_0, x_1);
        REQUIRE(a.pairs.size() == b.pairs.size());
        REQUIRE(a.energy == Approx(b.energy).epsilon(1e-13));
        if (a.is_active()) ++active;
        for (const auto& pair : a.body_pairs) CHECK(pair.force == Vector<Dim>::Zero());
    }
    CHECK(active > 20);
    CHECK(itself.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a strip of one layer that rolls up touches itself with its two sides, and nothing else acts",
                       "[contact][nodal][self]", ((int Dim), Dim), 2, 3) {
    const double b = pitch / (2.0 * std::numbers::pi);
    const double whole = 2.0 * std::numbers::pi * turns * (inner_radius + b * std::numbers::pi * turns);
    const int n = static_cast<int>(whole / size);
    const auto scene = body_of<Dim>({{0.0, 0.0}, {n * size, 0.0}, {n * size, size}, {0.0, size}});
    constexpr int n_steps = 400;
    const auto state = [&](int i) {
        auto x = scene.rest;
        const double rolled = whole * i / n_steps;
        for (Vector<Dim>& at : x) {
            const OnSpiral line = on_spiral(at[0], rolled);
            // the spiral turns left: y = `size` is its inner side
            const Vector<2> moved = line.at + (at[1] - 0.5 * size) * Vector<2>(-line.along[1], line.along[0]);
            at[0] = moved[0], at[1] = moved[1];
        }
        return x;
    };
    // Two sides that are more than half a turn from each other along the strip.
    const int per_edge = Dim == 2 ? 1 : 2;
    const auto length_of = [&](std::int32_t face) {
        double middle = 0.0;
        for (std::int32_t c = scene.faces.offsets[face]; c < scene.faces.offsets[face + 1]; ++c)
            middle += scene.rest[scene.faces.nodes[c]][0] / (scene.faces.offsets[face + 1] - scene.faces.offsets[face]);
        return middle;
    };
    const auto is_below = [&](std::int32_t face) { return face < per_edge * n; };
    const auto is_above = [&](std::int32_t face) { return face >= per_edge * (n + 1) && face < per_edge * (2 * n + 1); };
    const auto may = [&](std::int32_t a, std::int32_t c) {
        return ((is_below(a) && is_above(c)) || (is_above(a) && is_below(c))) &&
               std::abs(length_of(a) - length_of(c)) > std::numbers::pi * inner_radius;
    };
    const Compared compared = compare<Dim>(scene, touching_itself(), n_steps, state, may);
    CHECK(compared.true_pairs > 1000);
    CHECK(compared.missed == 0);
    CHECK(compared.wrong == 0);
}

TEMPLATE_TEST_CASE_SIG("a body that touches itself goes on from its state with the same bits", "[contact][nodal][self]",
                       ((int Dim), Dim), 2, 3) {
    // A crack with kinks that opens, closes and slides.
    const auto scene = body_of<Dim>(cracked({{1.0, 0.0}, {0.8, 0.25}, {0.6, -0.25}, {0.4, 0.25}, {0.2, -0.1}}));
    const auto state = [&](int i) {
        auto x = scene.rest;
        for (std::size_t v = 0; v < x.size(); ++v) {
            const std::size_t in_layer = v % (x.size() / (Dim == 2 ? 1 : 2));
            const bool is_upper = in_layer > x.size() / (Dim == 2 ? 2 : 4);
            const double reach = std::max(0.0, scene.rest[v][0] - 0.2);
            if (is_upper) x[v] += reach * (0.02 * std::sin(0.4 * i) * axis<Dim>(1) + 0.004 * i * axis<Dim>(0));
        }
        return x;
    };
    NodalContact<Dim> whole(scene.surface(), touching_itself()), again(scene.surface(), touching_itself());
    for (int i = 0; i < 12; ++i) whole.step(1.0, state(i), state(i + 1));
    again.restore(whole.state());
    double most = 0.0;
    for (int i = 12; i < 40; ++i) {
        const auto x_0 = state(i), x_1 = state(i + 1);
        const auto& a = whole.step(1.0, x_0, x_1);
        const auto& c = again.step(1.0, x_0, x_1);
        REQUIRE(forces<Dim>(a, x_0.size()) == forces<Dim>(c, x_0.size()));
        REQUIRE(a.energy == c.energy);
        most = std::max(most, a.energy);
        whole.evaluate(state(0));  // changes nothing
    }
    CHECK(most > 0.0);
    NodalContact<Dim> fresh(scene.surface(), touching_itself());
    fresh.restore(whole.state());
    CHECK(fresh.state() == whole.state());
}

TEST_CASE("contact within a body does not depend on how long its lists live, though its faces turn far",
          "[contact][nodal][self]") {
    // Two arms of one face a side stand on one foot, and close like a book by up to 1.35 rad.
    const auto turned = [](const Vector<2>& x, const Vector<2>& centre, double angle) {
        const Vector<2> arm = x - centre;
        const double c = std::cos(angle), s = std::sin(angle);
        return Vector<2>(centre + Vector<2>(c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]));
    };
    const auto arms = [&](double opening) {
        std::vector<Vector<2>> x{{0.0, -0.3}, {1.0, -0.3}};
        for (const Vector<2>& corner : {Vector<2>(1.0, 0.0), Vector<2>(1.0, 1.0), Vector<2>(0.8, 1.0), Vector<2>(0.8, 0.0)})
            x.push_back(turned(corner, {0.8, 0.0}, -opening));
        for (const Vector<2>& corner : {Vector<2>(0.2, 0.0), Vector<2>(0.2, 1.0), Vector<2>(0.0, 1.0), Vector<2>(0.0, 0.0)})
            x.push_back(turned(corner, {0.2, 0.0}, opening));
        return x;
    };
    const double ends_at = -0.45;
    struct Closing {
        double begins_at;
        int n_steps;
    };
    for (const Closing closing : {Closing{0.9, 30}, Closing{0.9, 300}, Closing{0.5, 100}, Closing{0.2, 100}}) {
        const double begins_at = closing.begins_at;
        const int n_steps = closing.n_steps;
        NodalScene<2> scene;
        scene.faces.stiffness.push_back(1.0);
        scene.rest = arms(begins_at);
        const auto n = static_cast<std::int32_t>(scene.rest.size());
        scene.node_body.assign(scene.rest.size(), 0);
        for (std::int32_t i = 0; i < n; ++i) scene.faces.append_face(std::array{i, (i + 1) % n}, 0.2, 0);
        std::vector<double> energies;
        for (const double skin : {1e-4, 0.0, 0.05, 0.5, 2.0, 10.0}) {
            contact::NodalOptions options = touching_itself();
            options.compression_limit = 1e9;
            options.search.skin = skin;
            NodalContact<2> contact(scene.surface(), options);
            for (int i = 0; i < n_steps; ++i) {
                const auto at = [&](int step) { return arms(begins_at + (ends_at - begins_at) * step / n_steps); };
                contact.step(1e-3, at(i), at(i + 1));
            }
            CHECK(contact.report().missed_contacts == 0);
            energies.push_back(contact.last().energy);
        }
        CAPTURE(begins_at, n_steps, energies);
        CHECK(energies[0] > 1e-3);  // its list is made in each step
        for (const double energy : energies) CHECK(energy == energies[0]);
    }
}
