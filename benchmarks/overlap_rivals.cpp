// Area that two triangles share: ours against plain clipping, CGAL, Boost.Geometry and Clipper; nanoseconds a pair, one
// thread, and what becomes of degenerate pairs.
//
// Pairs as contact meets them: two triangulated wavy sheets on each other, all pairs of faces whose boxes overlap. Once the
// meshes do not match; once they match to the last digit, so that every pair is degenerate; once they match except for a gap
// and are flat, so that all corners that should coincide are a rounding error apart in projection.
// Expected: find_overlaps, projection included, no slower than plain clipping of triangles that are projected already.
#include <fmt/core.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <exception>
#include <random>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/pairs/pair.hpp"
#include "support/clippers.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using benchmark::Clipper;
using geometry::AreaMethod;
using geometry::TrianglePair;
using Corners = std::array<PlaneVector<3>, 3>;

// ---- ours ---------------------------------------------------------------------------------------------------------------

void many_at_once(std::span<const TrianglePair> pairs, std::span<double> areas) {
    std::vector<geometry::OverlapArea<3>> shared(pairs.size());
    geometry::overlap_areas(pairs, shared);
    for (std::size_t k = 0; k < pairs.size(); ++k) areas[k] = shared[k].area;
}
template <AreaMethod method>
void one_by_one(std::span<const TrianglePair> pairs, std::span<double> areas) {
    for (std::size_t k = 0; k < pairs.size(); ++k)
        areas[k] = geometry::overlap_area<3>(pairs[k].face_1, pairs[k].face_2, pairs[k].shift, method).area;
}

std::vector<Clipper> all_clippers() {
    std::vector<Clipper> all{{"overlap_areas (many at once)", ~std::size_t{0}, many_at_once},
                             {"overlap_area, fast (one by one)", ~std::size_t{0}, one_by_one<AreaMethod::fast>},
                             {"overlap_area, exact", 10'000, one_by_one<AreaMethod::exact>}};
    for (const Clipper& clipper : benchmark::clippers()) all.push_back(clipper);
    return all;
}

// ---- pairs as contact meets them ----------------------------------------------------------------------------------------

struct Sheets {
    int cells;
    double turn;   ///< of the upper one against the lower one [rad]
    double gap;    ///< along the normal in the middle, by displacement [m]
    bool is_flat;  ///< and inclined; else wavy
};

class SheetMaker {
public:
    SheetMaker(int cells, bool is_flat) : cells_(cells), is_flat_(is_flat) {}

    void append(contact::Surface<3>& surface, int body, double turn) const {
        for (int i = 0; i < cells_; ++i)
            for (int j = 0; j < cells_; ++j) {
                append(surface, body, {point(i, j, turn), point(i + 1, j, turn), point(i + 1, j + 1, turn)});
                append(surface, body, {point(i, j, turn), point(i + 1, j + 1, turn), point(i, j + 1, turn)});
            }
    }

private:
    static void append(contact::Surface<3>& surface, int body, std::array<Vector<3>, 3> corners) {
        if (body == 1) std::swap(corners[1], corners[2]);  // looks down
        surface.append(corners, 0.1, 1.0, body);
    }
    // The same for every body: a function of the indices alone.
    Vector<3> point(int i, int j, double turn) const {
        std::minstd_rand random(static_cast<unsigned>(1 + i * (cells_ + 1) + j));
        random.discard(3);
        std::uniform_real_distribution<double> jitter(-0.2, 0.2);
        const double u = (i + jitter(random)) / cells_ - 0.5, v = (j + jitter(random)) / cells_ - 0.5;
        const double x = std::cos(turn) * u - std::sin(turn) * v, y = std::sin(turn) * u + std::cos(turn) * v;
        return {x, y, is_flat_ ? 0.3 * x + 0.2 * y : 0.05 * std::sin(7.0 * x) * std::cos(5.0 * y)};
    }
    int cells_;
    bool is_flat_;
};

struct Scene {
    contact::Surface<3> surface;
    std::vector<Vector<3>> displacement;
    std::vector<geometry::IndexPair> pairs;
};

Scene make_scene(const Sheets& sheets) {
    Scene scene;
    const SheetMaker maker(sheets.cells, sheets.is_flat);
    for (int body = 0; body < 2; ++body) maker.append(scene.surface, body, body * sheets.turn);
    const std::int32_t n = scene.surface.size() / 2;
    scene.displacement.assign(static_cast<std::size_t>(2 * n), Vector<3>::Zero());
    for (std::int32_t f = n; f < 2 * n; ++f) scene.displacement[f] = sheets.gap * Vector<3>(-0.3, -0.2, 1.0).normalized();
    std::vector<geometry::Box<3>> boxes(static_cast<std::size_t>(2 * n));
    for (std::int32_t f = 0; f < 2 * n; ++f)
        for (const std::int32_t v : scene.surface.view().vertices_of(f)) boxes[f].extend(scene.surface.vertices[v]);
    const std::span<const geometry::Box<3>> all(boxes);
    scene.pairs = geometry::overlapping_pairs<3>({}, all.first(n), all.last(n));
    for (auto& pair : scene.pairs) pair.second += n;
    return scene;
}

// As find_overlaps projects: along the pair's normal, seen from a corner of face 1.
TrianglePair projected(const Scene& scene, geometry::IndexPair pair) {
    const auto view = scene.surface.view();
    const geometry::PlaneFrame<3> frame(contact::pair_normal<3>(view, pair.first, pair.second));
    const auto vertices_1 = view.vertices_of(pair.first), vertices_2 = view.vertices_of(pair.second);
    const Vector<3> origin = view.vertices[vertices_1[0]];
    const Vector<3> motion = scene.displacement[pair.second] - scene.displacement[pair.first];
    TrianglePair result{{}, {}, PlaneVector<3>::Zero()};
    for (int i = 0; i < 3; ++i) {
        result.face_1[i] = frame.project(view.vertices[vertices_1[i]] - origin);
        result.face_2[2 - i] = frame.project((view.vertices[vertices_2[i]] - origin) + motion);
    }
    return result;
}

std::vector<TrianglePair> projected(const Scene& scene) {
    std::vector<TrianglePair> pairs;
    pairs.reserve(scene.pairs.size());
    for (const auto pair : scene.pairs) pairs.push_back(projected(scene, pair));
    return pairs;
}

// n of all, evenly spread.
std::vector<TrianglePair> sample(const std::vector<TrianglePair>& pairs, std::size_t n) {
    if (n >= pairs.size()) return pairs;
    std::vector<TrianglePair> chosen;
    for (std::size_t k = 0; k < n; ++k) chosen.push_back(pairs[k * pairs.size() / n]);
    return chosen;
}

// ---- right or wrong -----------------------------------------------------------------------------------------------------

struct Errors {
    double largest = 0.0;  ///< over the smaller face
    int wrong = 0;         ///< overlap or not
    int thrown = 0;
    int failures = 0;  ///< pairs that are wrong, have thrown or err by more than 1e-6
    std::string which;
};

void judge(const Clipper& clipper, const TrianglePair& pair, const std::string& name, Errors& errors) {
    const benchmark::TrueAreas truth = benchmark::true_areas(pair);
    double area = 0.0;
    try {
        clipper.areas({&pair, 1}, {&area, 1});
    } catch (const std::exception&) {
        ++errors.thrown;
        ++errors.failures;
        errors.which += " " + name;
        return;
    }
    const bool is_wrong = (area > 0.0) != truth.overlaps;
    const double smaller = std::max(std::min(truth.face_1, truth.face_2), std::numeric_limits<double>::min());
    // what is below the smallest normal number may be rounded up to that
    const double error = std::max(0.0, std::abs(area - truth.shared) - std::numeric_limits<double>::min()) / smaller;
    errors.largest = std::max(errors.largest, std::isnan(area) ? std::numeric_limits<double>::infinity() : error);
    errors.wrong += is_wrong;
    if (!is_wrong && error <= 1e-6 && !std::isnan(area)) return;
    ++errors.failures;
    errors.which += " " + name;
}

nlohmann::json to_json(const Errors& errors) {
    return {{"largest_relative", errors.largest},
            {"wrong_decisions", errors.wrong},
            {"exceptions", errors.thrown},
            {"failures", errors.failures}};
}

struct Degenerate {
    std::string name;
    TrianglePair pair;
};

std::vector<Degenerate> degenerate_pairs() {
    const Corners triangle{{{0, 0}, {1, 0}, {0.25, 0.875}}}, slanted{{{0.1, 0.2}, {0.9, 0.3}, {0.3, 0.8}}};
    const auto moved = [](Corners c, double x, double y) {
        for (auto& p : c) p += PlaneVector<3>(x, y);
        return c;
    };
    const auto scaled = [](Corners c, double scale, double offset = 0.0) {
        for (auto& p : c) p = scale * p + PlaneVector<3>(offset, offset);
        return c;
    };
    const Corners other{{{0.5, 0.125}, {1.5, 0.25}, {0.75, 1.0}}}, below{{{1, 0}, {0, 0}, {0.5, -1}}};
    std::vector<Degenerate> pairs;
    const auto add = [&](const char* name, const Corners& a, const Corners& b) {
        pairs.push_back({name, {a, b, PlaneVector<3>::Zero()}});
    };
    add("identical", triangle, triangle);
    add("identical-slanted", slanted, {slanted[1], slanted[2], slanted[0]});
    add("shared-edge", triangle, below);
    add("shared-edge-slanted", slanted, {slanted[1], slanted[0], {0.6, -0.5}});
    add("part-of-an-edge", triangle, {{{0.75, 0}, {0.25, 0}, {0.5, -1}}});
    add("part-of-an-edge-inside", triangle, {{{0.25, 0}, {0.75, 0}, {0.5, 0.25}}});
    add("edge-beyond-an-edge", triangle, {{{0.5, 0}, {1.5, 0}, {0.5, 0.25}}});
    add("shared-corner", triangle, {{{1, 0}, {2, 0}, {1.5, 1}}});
    add("shared-corner-inside", triangle, {{{0, 0}, {0.5, 0.125}, {0.25, 0.25}}});
    add("corner-on-an-edge", triangle, {{{0.5, 0}, {0.25, -1}, {0.75, -1}}});
    add("corner-on-an-edge-inside", triangle, {{{0.5, 0}, {0.625, 0.25}, {0.375, 0.25}}});
    add("edge-through-a-corner", triangle, {{{0.25, 0.875}, {-1, 0.875}, {0.5, -2}}});
    add("inside-touching-thrice", triangle, {{{0.5, 0}, {0.625, 0.4375}, {0.125, 0.4375}}});
    add("no-area-point", triangle, {{{0.25, 0.25}, {0.25, 0.25}, {0.25, 0.25}}});
    add("no-area-line", triangle, {{{0, 0.25}, {0.5, 0.25}, {1, 0.25}}});
    add("no-area-line-first", {{{0, 0.25}, {0.5, 0.25}, {1, 0.25}}}, triangle);
    add("no-area-two-corners", triangle, {{{0.25, 0.25}, {0.25, 0.25}, {0.5, 0.5}}});
    add("needle-1e12", triangle, {{{-0.5, 0.25}, {1.5, 0.25}, {0.5, 0.25 + 2e-12}}});
    add("needle-on-an-edge-inside", triangle, {{{0, 0}, {1, 0}, {0.5, 0x1p-40}}});
    add("needle-on-an-edge-outside", triangle, {{{1, 0}, {0, 0}, {0.5, -0x1p-40}}});
    add("two-needles", {{{0, 0}, {1, 0}, {0.5, 1e-12}}}, {{{0.25, -1e-12}, {0.75, 1e-13}, {0.25, 1e-12}}});
    add("sliver", slanted,
        {slanted[0], slanted[1], slanted[0] + 0.5 * (slanted[1] - slanted[0]) + PlaneVector<3>(0, 1e-14)});
    add("overlap-of-a-last-digit", triangle, moved(below, 0, 0x1p-53));
    add("apart-by-a-last-digit", triangle, moved(below, 0, -0x1p-53));
    add("small-in-large-1e6", scaled(triangle, 1e6, -3e5), triangle);
    for (const double scale : {1e-160, 1e-9, 1e9}) {
        const std::string label = fmt::format("{:.0e}", scale);
        pairs.push_back({"identical-scale-" + label, {scaled(triangle, scale), scaled(triangle, scale), {0, 0}}});
        pairs.push_back({"overlap-scale-" + label, {scaled(triangle, scale), scaled(other, scale), {0, 0}}});
        pairs.push_back({"shared-edge-scale-" + label, {scaled(triangle, scale), scaled(below, scale), {0, 0}}});
    }
    pairs.push_back({"identical-offset-1e7", {scaled(slanted, 1e-2, 1e7), scaled(slanted, 1e-2, 1e7), {0, 0}}});
    pairs.push_back({"overlap-offset-1e7", {scaled(triangle, 1e-2, 1e7), scaled(other, 1e-2, 1e7), {0, 0}}});
    pairs.push_back({"shared-edge-offset-1e7", {scaled(triangle, 1e-2, 1e7), scaled(below, 1e-2, 1e7), {0, 0}}});
    return pairs;
}

nlohmann::json compare_degenerate() {
    const auto pairs = degenerate_pairs();
    fmt::print("\n{} degenerate pairs\n{:<34} {:>9} {:>14}  failures\n", pairs.size(), "", "failures", "largest error");
    nlohmann::json result{{"pairs", pairs.size()}};
    for (const Clipper& clipper : all_clippers()) {
        Errors errors;
        for (const auto& [name, pair] : pairs) judge(clipper, pair, name, errors);
        fmt::print("{:<34} {:>9} {:>14.1e} {}\n", clipper.name, errors.failures, errors.largest, errors.which);
        result["methods"][clipper.name] = to_json(errors);
        result["methods"][clipper.name]["which"] = errors.which;
    }
    return result;
}

// ---- time ---------------------------------------------------------------------------------------------------------------

struct Timed {
    Clipper clipper;
    std::vector<TrianglePair> pairs;
    std::vector<double> areas;
};

void require_same_sums(const std::vector<Timed>& timed, const contact::Overlaps<3>& overlaps) {
    double found = 0.0, batch = 0.0;
    for (const auto& overlap : overlaps.found) found += overlap.area;
    for (const double area : timed[0].areas) batch += area;
    benchmark::require_small("sum of areas, find_overlaps against overlap_areas", std::abs(found - batch) / batch, 1e-12);
}

nlohmann::json measure(const std::string& name, const Scene& scene, std::size_t checked, int repetitions) {
    const auto pairs = projected(scene);
    std::vector<Timed> timed;
    for (const Clipper& clipper : all_clippers()) {
        timed.push_back({clipper, sample(pairs, clipper.most_pairs), {}});
        timed.back().areas.resize(timed.back().pairs.size());
    }
    contact::Overlaps<3> overlaps;
    std::vector<std::function<void()>> works{[&] {
        contact::find_overlaps<3>(scene.surface.view(), scene.displacement, scene.pairs, AreaMethod::fast, overlaps);
    }};
    for (Timed& t : timed)
        works.push_back([&t] {
            try {
                t.clipper.areas(t.pairs, t.areas);
            } catch (const std::exception&) {  // counted below, pair by pair
            }
        });
    std::vector<benchmark::Samples> samples;
    oneapi::tbb::task_arena(1).execute(
        [&] { samples = benchmark::time_in_turn(repetitions, benchmark::Clock::processor, works); });
    require_same_sums(timed, overlaps);

    const auto& decided = overlaps.report.decided;
    const double n = static_cast<double>(scene.pairs.size());
    fmt::print(
        "\n{}: {} pairs, {} overlaps; decided by doubles {:.4f} %, by the scalar path {:.4f} %, by exact arithmetic "
        "{:.4f} %\n{:<34} {:>11} {:>14} {:>9} {:>9}\n",
        name, scene.pairs.size(), overlaps.report.overlaps, 100 * decided.by_doubles / n, 100 * decided.by_scalar_path / n,
        100 * decided.by_exact_arithmetic / n, "", "ns per pair", "largest error", "wrong", "failures");
    const double ours = 1e9 * samples[0].least() / n;
    fmt::print("{:<34} {:>11.1f}\n", "find_overlaps, projection included", ours);
    nlohmann::json result{{"name", name},
                          {"pairs", scene.pairs.size()},
                          {"overlaps", overlaps.report.overlaps},
                          {"not_facing", overlaps.report.not_facing},
                          {"by_doubles", decided.by_doubles},
                          {"by_scalar_path", decided.by_scalar_path},
                          {"by_exact_arithmetic", decided.by_exact_arithmetic}};
    result["methods"]["find_overlaps"]["ns_a_pair"] = ours;
    for (std::size_t i = 0; i < timed.size(); ++i) {
        Errors errors;
        for (const TrianglePair& pair : sample(pairs, std::min(checked, timed[i].pairs.size())))
            judge(timed[i].clipper, pair, "", errors);
        const double ns = 1e9 * samples[i + 1].least() / static_cast<double>(timed[i].pairs.size());
        fmt::print("{:<34} {:>11.1f} {:>14.1e} {:>9} {:>9}\n", timed[i].clipper.name, ns, errors.largest, errors.wrong,
                   errors.failures);
        result["methods"][timed[i].clipper.name] = to_json(errors);
        result["methods"][timed[i].clipper.name]["ns_a_pair"] = ns;
        result["methods"][timed[i].clipper.name]["pairs"] = timed[i].pairs.size();
    }
    return result;
}

int run(int argc, char** argv) {
    int cells = 200, repetitions = 3;
    std::size_t checked = 10'000;
    std::string json;
    benchmark::Options options("Shared area of two triangles: ours against other libraries.");
    options.add("--cells", cells, "of a sheet along either side; 200 make a million pairs").positive();
    options.add("--checked", checked, "pairs that are compared with rational arithmetic").positive();
    options.add("--repetitions", repetitions, "rounds; the least is shown").positive();
    options.add("--json", json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["degenerate"] = compare_degenerate();
    const std::vector<std::pair<std::string, Sheets>> scenes{
        {"sheets that do not match", {cells, 0.4, 0.0, false}},
        {"matching sheets", {cells, 0.0, 0.0, false}},
        {"matching inclined planes with a gap", {cells, 0.0, 1e-3 / cells, true}}};
    for (const auto& [name, sheets] : scenes)
        result["scenes"].push_back(measure(name, make_scene(sheets), checked, repetitions));
    benchmark::write(result, json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
