// What contact on nodes costs: an active pair by itself, beside a node-to-segment penalty written plainly; an active pair of
// two meshes that press on each other, beside the modified reconstruction, both without friction and with it; and a whole step
// of bodies of linear finite elements.
//
// Expected: 0.2 (2D) and 0.5 microseconds (3D) for the mean gradient of a pair; with friction at most 0.8 (2D) and 4.6 (3D)
// microseconds for an active pair of two plates; less than 2 % of a step where nothing is near.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <random>

#include "abut/base/error.hpp"
#include "abut/contact/contact.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/p1_bodies.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using geometry::PairCorners;

double uniform(std::mt19937& random, double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
}
template <int Dim>
Vector<Dim> random_vector(std::mt19937& random, double size) {
    Vector<Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = uniform(random, -size, size);
    return v;
}

/// Faces of size 1 that look at each other, some corners beside the other face.
template <int Dim>
PairCorners<Dim> facing_pair(std::mt19937& random) {
    PairCorners<Dim> x;
    const Vector<Dim> aside = random_vector<Dim>(random, 0.4);
    for (int v = 0; v < Dim; ++v) {
        Vector<Dim> a = Vector<Dim>::Zero(), b = Vector<Dim>::Zero();
        const double angle = 2.0 * M_PI * v / Dim;
        a[0] = std::cos(angle), b[0] = -std::cos(angle);
        if constexpr (Dim == 3) a[1] = std::sin(angle), b[0] = -b[0], b[1] = -std::sin(angle);
        x[v] = a + random_vector<Dim>(random, 0.1);
        x[Dim + v] = b + aside + random_vector<Dim>(random, 0.1);
        x[Dim + v][Dim - 1] -= 0.1;
    }
    return x;
}

template <int Dim>
struct Pairs {
    std::vector<PairCorners<Dim>> start, end, translated;
    std::vector<geometry::PairLaw<Dim>> law;

    /// Corners move by up to `motion` of the size of a face.
    Pairs(int n, double motion) {
        std::mt19937 random(1);
        while (static_cast<int>(start.size()) < n) {
            const PairCorners<Dim> x = facing_pair<Dim>(random);
            geometry::PairLaw<Dim> of_pair{.stiffness = 1.0};
            if constexpr (Dim == 2) of_pair.length = {(x[1] - x[0]).norm(), (x[3] - x[2]).norm()};
            if (geometry::pair_gradient<Dim>(x, of_pair).energy == 0.0) continue;
            PairCorners<Dim> moved = x, shifted = x;
            const Vector<Dim> by = random_vector<Dim>(random, motion);
            for (int v = 0; v < 2 * Dim; ++v) {
                moved[v] += random_vector<Dim>(random, motion);
                if (v < Dim) shifted[v] += by;
            }
            start.push_back(x), end.push_back(moved), translated.push_back(shifted), law.push_back(of_pair);
        }
    }
};

/// A node against a segment or triangle with a penalty: projection, test, gap, forces on the nodes.
double penalty(const PairCorners<2>& x, double k, PairCorners<2>& force) {
    double energy = 0.0;
    const Vector<2> along = x[3] - x[2], normal = Vector<2>(along[1], -along[0]).normalized();
    for (int v = 0; v < 2; ++v) {
        const double s = along.dot(x[v] - x[2]) / along.squaredNorm(), gap = normal.dot(x[v] - x[2]);
        if (s < 0.0 || s > 1.0 || gap >= 0.0) continue;
        const Vector<2> f = -k * gap * normal;
        force[v] += f;
        force[2] -= (1.0 - s) * f;
        force[3] -= s * f;
        energy += 0.5 * k * gap * gap;
    }
    return energy;
}
double penalty(const PairCorners<3>& x, double k, PairCorners<3>& force) {
    double energy = 0.0;
    const Vector<3> u = x[4] - x[3], w = x[5] - x[3], normal = u.cross(w).normalized();
    const double uu = u.dot(u), uw = u.dot(w), ww = w.dot(w), determinant = uu * ww - uw * uw;
    for (int v = 0; v < 3; ++v) {
        const Vector<3> r = x[v] - x[3];
        const double b = (ww * u.dot(r) - uw * w.dot(r)) / determinant, c = (uu * w.dot(r) - uw * u.dot(r)) / determinant;
        const double gap = normal.dot(r);
        if (b < 0.0 || c < 0.0 || b + c > 1.0 || gap >= 0.0) continue;
        const Vector<3> f = -k * gap * normal;
        force[v] += f;
        force[3] -= (1.0 - b - c) * f;
        force[4] -= b * f;
        force[5] -= c * f;
        energy += 0.5 * k * gap * gap;
    }
    return energy;
}

/// Work on the corners against the change of W.
template <int Dim>
void check(const Pairs<Dim>& pairs) {
    double worst = 0.0;
    for (std::size_t i = 0; i < pairs.start.size(); ++i)
        for (const auto* end : {&pairs.end[i], &pairs.translated[i]}) {
            const auto found = geometry::pair_mean_gradient<Dim>(pairs.start[i], *end, pairs.law[i]);
            double work = found.energy_0 - found.energy_1, force = 0.0;
            for (int v = 0; v < 2 * Dim; ++v) {
                work += found.gradient[v].dot((*end)[v] - pairs.start[i][v]);
                force += found.gradient[v].norm();
            }
            worst = std::max(worst, std::abs(work) / (found.energy_0 + found.energy_1 + 0.02 * force));
        }
    benchmark::require_small("balance of energy of a pair", worst, 1e-13);
}

/// The steps of all pairs, with the start known as it is in a run; and their starts as states.
template <int Dim>
struct ManySteps {
    explicit ManySteps(const Pairs<Dim>& pairs) : start(pairs.start.size()), end(start.size()), mean(start.size()) {
        for (std::size_t i = 0; i < start.size(); ++i) {
            states.push_back({&pairs.start[i], &pairs.start[i], &pairs.law[i], nullptr, &start[i], &mean[i]});
            known.push_back({&pairs.start[i], &pairs.end[i], &pairs.law[i], &start[i], &end[i], &mean[i]});
        }
        geometry::evaluate_pairs<Dim>(states);
    }
    std::vector<geometry::PairEnd<Dim>> start, end;
    std::vector<geometry::PairMeanGradient<Dim>> mean;
    std::vector<geometry::PairStep<Dim>> states, known;
};

template <int Dim>
nlohmann::json time_pairs(int repetitions, double motion) {
    const Pairs<Dim> pairs(4000, motion);
    check<Dim>(pairs);
    double sink = 0.0;
    const auto each = [&](const auto& work) {
        return [&, work] {
            for (std::size_t i = 0; i < pairs.start.size(); ++i) sink += work(i);
        };
    };
    PairCorners<Dim> force{};
    ManySteps<Dim> many(pairs);
    const auto times = benchmark::time_in_turn(
        repetitions, benchmark::Clock::processor,
        {[&] { geometry::integrate_pairs<Dim>(many.known); },
         [&] { geometry::integrate_pairs<Dim>(many.known, {.gauss = true}); },
         [&] { geometry::evaluate_pairs<Dim>(many.states); },
         each([&](std::size_t i) { return geometry::pair_placement<Dim>(pairs.start[i], pairs.law[i]).facing; }),
         each([&](std::size_t i) { return penalty(pairs.start[i], 1.0, force); })});
    const auto ns = [&](std::size_t i) { return 1e9 * times[i].least() / static_cast<double>(pairs.start.size()); };
    nlohmann::json result{{"dim", Dim},        {"mean gradient", ns(0)}, {"mean gradient, Gauss's rule", ns(1)},
                          {"gradient", ns(2)}, {"glance", ns(3)},        {"node-to-segment penalty, one state", ns(4)},
                          {"sink", sink}};
    fmt::print(
        "{}D, ns per pair, many at once: mean gradient {:.0f} (Gauss's rule {:.0f}), gradient {:.0f}; a glance {:.0f}, "
        "penalty {:.0f} for one state\n",
        Dim, ns(0), ns(1), ns(2), ns(3), ns(4));
    return result;
}

/// A flat grid of n cells a side of unit length that looks up or down, triangles or segments.
template <int Dim>
void append_plate(int n, double height, int body, std::vector<Vector<Dim>>& nodes, contact::NodalFaceArrays<Dim>& faces,
                  contact::Surface<Dim>& surface) {
    const auto first = static_cast<std::int32_t>(nodes.size());
    const auto at = [&](int i, int j) { return first + (Dim == 2 ? i : i * (n + 1) + j); };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= (Dim == 2 ? 0 : n); ++j) {
            Vector<Dim> x = height * Vector<Dim>::Unit(Dim - 1);
            x[0] = static_cast<double>(i) / n;
            if (Dim == 3) x[1] = static_cast<double>(j) / n;
            nodes.push_back(x);
        }
    const auto append = [&](std::vector<std::int32_t> corners) {
        if (body == 0) std::reverse(corners.begin(), corners.end());
        std::vector<Vector<Dim>> points;
        for (const std::int32_t node : corners) points.push_back(nodes[static_cast<std::size_t>(node)]);
        faces.append_face(corners, 0.5 / n, body);
        surface.append(points, 0.5 / n, 1.0, body);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < (Dim == 2 ? 1 : n); ++j) {
            if constexpr (Dim == 2) append({at(i, 0), at(i + 1, 0)});
            if constexpr (Dim == 3) {
                append({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
                append({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
            }
        }
}

/// Two plates that do not match, pressed together and slid a little, for both laws.
template <int Dim>
struct Plates {
    explicit Plates(int n) {
        append_plate<Dim>(n, 0.0, 0, nodes, faces, surface);
        const std::size_t lower = nodes.size();
        append_plate<Dim>(n * 7 / 6, 0.01 / n, 1, nodes, faces, surface);
        faces.stiffness = {1.0, 1.0};
        surface.shear_stiffness.assign(surface.stiffness.size(), shear_stiffness[0]);
        start = nodes;
        for (std::size_t i = lower; i < nodes.size(); ++i) start[i] -= 0.05 / n * Vector<Dim>::Unit(Dim - 1);
        end = start;
        std::mt19937 random(2);
        for (Vector<Dim>& x : end) x += random_vector<Dim>(random, 1e-4 / n);
        for (std::int32_t f = 0; f < surface.size(); ++f) {
            u_0.push_back(surface.body[f] == 0 ? 0.0 * Vector<Dim>::Unit(0) : -0.05 / n * Vector<Dim>::Unit(Dim - 1));
            u_1.push_back(u_0.back() + random_vector<Dim>(random, 1e-4 / n));
        }
        rest.assign(u_0.size(), Vector<Dim>::Zero());
    }
    [[nodiscard]] contact::NodalSurface<Dim> nodal_surface() const {
        contact::NodalFaces<Dim> all = faces.view();
        all.shear_stiffness = shear_stiffness;
        return {nodes, all};
    }
    std::vector<Vector<Dim>> nodes;
    contact::NodalFaceArrays<Dim> faces;
    std::array<double, 2> shear_stiffness{2.0 / 7.0, 2.0 / 7.0};  // of bodies with nu = 0.3
    contact::Surface<Dim> surface;
    std::vector<Vector<Dim>> start, end;      // of the nodes
    std::vector<Vector<Dim>> rest, u_0, u_1;  // of the faces
};

/// Faces that answer to their own correction alone, and hold no gradient of their own.
template <int Dim>
contact::FaceCoupling<Dim> own_coupling(std::span<const contact::Face> listed) {
    contact::FaceCoupling<Dim> own;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        own.columns.push_back(static_cast<std::int32_t>(i));
        own.offsets.push_back(static_cast<std::int32_t>(i) + 1);
        own.blocks.push_back(Matrix<Dim>::Identity());
    }
    return own;
}

/// Work of the forces of a step with friction against what W, springs of faces that stick and friction make of it.
template <int Dim>
void check_friction(contact::NodalContact<Dim>& nodal, const Plates<Dim>& plates) {
    const double stuck = nodal.step(1.0, plates.start, plates.end).report.friction.energy;
    const contact::NodalStep<Dim>& step = nodal.step(1.0, plates.start, plates.end);
    const contact::FrictionFigures& friction = step.report.friction;
    double balance = step.energy - step.energy_0 + friction.energy - stuck + friction.dissipated;
    for (std::size_t i = 0; i < step.nodes.size(); ++i) {
        const auto node = static_cast<std::size_t>(step.nodes[i]);
        balance -= step.gradient[i].dot(plates.end[node] - plates.start[node]);
    }
    benchmark::require_small("balance of energy of plates with friction", std::abs(balance) / step.energy, 1e-12);
}

/// Both laws of contact, without friction and with it, in turn.
template <int Dim>
nlohmann::json time_laws(int repetitions, double coefficient) {
    const Plates<Dim> plates(Dim == 2 ? 2000 : 30);
    const contact::FrictionOptions friction{.laws = {{.coefficient = coefficient}}};
    contact::NodalContact<Dim> nodal(plates.nodal_surface()), rubbing_nodal(plates.nodal_surface(), {.friction = friction});
    contact::Contact<Dim> by_faces(plates.surface.view()), rubbing_by_faces(plates.surface.view(), {.friction = friction});
    const contact::CouplingOf<Dim> coupling = own_coupling<Dim>;
    const auto gradients = [](auto, auto y_0, auto y_1) {
        std::ranges::fill(y_0, Vector<Dim>::Zero());
        std::ranges::fill(y_1, Vector<Dim>::Zero());
    };
    for (auto* of : {&nodal, &rubbing_nodal}) of->step(1.0, plates.nodes, plates.nodes);
    for (auto* of : {&by_faces, &rubbing_by_faces}) of->step(1.0, {plates.rest, plates.rest, coupling, gradients});
    check_friction(rubbing_nodal, plates);
    // there and back: each step begins where the last one has ended
    const auto step_of = [&](auto& of) {
        return [&] {
            (void)of.step(0.5, plates.start, plates.end);
            (void)of.step(0.5, plates.end, plates.start);
        };
    };
    const auto step_of_faces = [&](auto& of) {
        return [&] { (void)of.step(1.0, {plates.u_0, plates.u_1, coupling, gradients}); };
    };
    const auto times = benchmark::time_in_turn(
        repetitions, benchmark::Clock::processor,
        {step_of(nodal), [&] { (void)nodal.step(1.0, plates.start, plates.start, contact::TakenForce::end); },
         step_of_faces(by_faces), step_of(rubbing_nodal), step_of_faces(rubbing_by_faces)});
    const double nodal_pairs = static_cast<double>(nodal.report().active_pairs);
    const double face_pairs = static_cast<double>(by_faces.report().active_pairs);
    if (!(nodal_pairs > 0.0) || !(face_pairs > 0.0)) throw Misuse("the plates do not touch under both laws");
    fmt::print(
        "{}D, two plates, ns per active pair, search left out: potential {:.0f} (end of step alone {:.0f}), "
        "{:.0f} pairs; modified reconstruction {:.0f}, {:.0f} pairs\n",
        Dim, 0.5e9 * times[0].least() / nodal_pairs, 1e9 * times[1].least() / nodal_pairs, nodal_pairs,
        1e9 * times[2].least() / face_pairs, face_pairs);
    const double nodal_ratio = times[3].least() / times[0].least(), face_ratio = times[4].least() / times[2].least();
    const auto faces = [](const contact::ContactReport& report) {
        return fmt::format("{} faces stick, {} slide", report.sticking_faces, report.sliding_faces);
    };
    fmt::print("{}D, with friction {}, times as long: potential {:.2f} ({}); modified reconstruction {:.2f} ({})\n", Dim,
               coefficient, nodal_ratio, faces(rubbing_nodal.report()), face_ratio, faces(rubbing_by_faces.report()));
    return {{"dim", Dim},
            {"potential", 0.5e9 * times[0].least() / nodal_pairs},
            {"potential, end of step", 1e9 * times[1].least() / nodal_pairs},
            {"modified reconstruction", 1e9 * times[2].least() / face_pairs},
            {"friction", coefficient},
            {"potential, with friction over without", nodal_ratio},
            {"modified reconstruction, with friction over without", face_ratio}};
}

/// Two discs or rods, `gap` apart.
template <int Dim>
studies::nodal::P1Bodies<Dim> bodies(double size, double gap) {
    run::Scene<Dim> scene;
    if constexpr (Dim == 2)
        scene.mesh = mesh::combine<2>(
            std::vector{mesh::disc({.size = size}), mesh::disc({.centre = {2.0 + gap, 0.0}, .size = size, .variant = 1})});
    else
        scene.mesh = mesh::combine<3>(std::vector{
            mesh::cylinder({.size = size}), mesh::cylinder({.centre = {2.0 + gap, 0.0, 0.0}, .size = size, .variant = 1})});
    scene.solid.materials = {{}, {}};
    return studies::nodal::P1Bodies<Dim>(std::move(scene));
}

template <int Dim>
std::vector<Vector<Dim>> placed(const studies::nodal::P1Bodies<Dim>& host, std::span<const double> q) {
    std::vector<Vector<Dim>> x = host.mesh().vertices;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += as_vectors<Dim>(q)[i];
    return x;
}

/// The share of contact in a step of the whole: pressed together, and far apart.
template <int Dim>
nlohmann::json time_steps(int repetitions, double size) {
    nlohmann::json result{{"dim", Dim}};
    for (const bool near : {true, false}) {
        auto host = bodies<Dim>(size, near ? 1e-4 : 1.0);
        std::vector<double> q(host.size(), 0.0), f(host.size());
        host.mean_force(q, q, 0.0, 1e-3, f);
        if (near)
            for (std::size_t i = 0; i < host.masses().size(); ++i)
                if (host.body_of_points()[i] == 1) q[Dim * i] = -0.01;
        const auto times =
            benchmark::time_in_turn(repetitions, benchmark::Clock::processor,
                                    {[&] { host.mean_force(q, q, 0.0, 1e-3, f); },
                                     [&] { (void)host.contact().step(1.0, placed<Dim>(host, q), placed<Dim>(host, q)); },
                                     [&] { (void)placed<Dim>(host, q), (void)placed<Dim>(host, q); }});
        const double contact = times[1].least() - times[2].least();
        if (near != (host.contact().report().active_pairs > 0))
            throw Misuse("bodies touch where they should not, or do not");
        fmt::print("{}D, {} elements, {}: a step {:.3f} ms, contact {:.2f} % of the rest, {} active pairs of {}\n", Dim,
                   host.mesh().n_cells(), near ? "pressed together" : "far apart", 1e3 * times[0].least(),
                   100.0 * contact / (times[0].least() - contact), host.contact().report().active_pairs,
                   host.contact().report().candidates);
        result[near ? "pressed together" : "far apart"] = contact / (times[0].least() - contact);
    }
    return result;
}

int run_benchmark(int argc, char** argv) {
    int repetitions = 100;
    double friction = 0.3, motion = 3e-3;
    std::string json;
    benchmark::Options options("What contact on nodes costs.");
    options.add("--repetitions", repetitions).positive();
    options.add("--friction", friction, "coefficient of friction [-]: with 0.3 faces stick, with 1e-4 they slide")
        .positive();
    options.add("--motion", motion, "of the corners of a pair in a step, over the size of a face [-]").positive();
    options.add("--json", json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;
    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["pairs"] = {time_pairs<2>(repetitions, motion), time_pairs<3>(repetitions, motion)};
    result["laws"] = {time_laws<2>(repetitions, friction), time_laws<3>(repetitions, friction)};
    result["steps"] = {time_steps<2>(repetitions, 0.05), time_steps<3>(repetitions, 0.1)};
    benchmark::write(result, json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return benchmark::main(argc, argv, run_benchmark); }
