// What it costs that faces may turn: search_moved and find_overlaps_moved against search and find_overlaps, on surfaces that
// only translate, so that both give the same overlaps.
//
// The two scenes of the benchmark of detection, cylinders in line contact ("press") and a plug in a sleeve ("plug"). One
// body slides by 0.01 of a side of a triangle; all lists have the same skin. Lists made by vertices hold every pair whose
// boxes overlap, whichever way its faces look; those of translating faces leave out what does not face or is out of reach.
// The overlaps of all lists that face and are near are compared before anything is timed. Expected: boxes around moved
// vertices cost little more; lists are longer, and so is the narrow phase.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <functional>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "support/detection_scenes.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using benchmark::DetectionScene;
using contact::GapOf;
using Vectors = std::vector<Vector<3>>;

constexpr double depth_over_side = 0.1, skin_over_side = 0.5, slide_over_side = 0.01;

struct Choices {
    std::vector<std::string> scenes{"press", "plug"};
    int faces = 100'000;
    int repetitions = 5;
    int threads = 1;
    std::string json;
};

/// Both bodies as one surface, vertices shared by the triangles around them.
contact::Surface<3> surface_of(const DetectionScene& scene) {
    contact::Surface<3> surface;
    for (std::size_t body = 0; body < 2; ++body)
        for (std::size_t i = 0; i < scene.bodies[body].triangles.size(); ++i)
            surface.append(scene.bodies[body].corners(i), depth_over_side * scene.side, 1.0,
                           static_cast<std::int32_t>(body));
    surface.vertices.clear();
    surface.face_vertices.clear();
    for (const auto& body : scene.bodies) {
        const auto first = static_cast<std::int32_t>(surface.vertices.size());
        surface.vertices.insert(surface.vertices.end(), body.vertices.begin(), body.vertices.end());
        for (const auto& triangle : body.triangles)
            for (const std::int32_t v : triangle) surface.face_vertices.push_back(first + v);
    }
    return surface;
}

/// The path of a step: body 1 slides.
struct Path {
    Vectors u_0, u_1, x_0, x_1;

    Path(const contact::Surface<3>& surface, const DetectionScene& scene)
        : u_0(surface.area.size(), Vector<3>::Zero()), u_1(u_0), x_0(surface.vertices), x_1(x_0) {
        const Vector<3> way = slide_over_side * scene.side * Vector<3>::UnitZ();
        for (std::size_t face = 0; face < u_1.size(); ++face)
            if (surface.body[face] == 1) u_1[face] = way;
        for (std::size_t v = scene.bodies[0].vertices.size(); v < x_1.size(); ++v) x_1[v] += way;
    }
};

/// One way to search and the narrow phase that goes with it.
struct Way {
    std::string name;
    std::function<void(contact::CandidateSearch<3>&)> search;
    std::function<void(std::span<const geometry::IndexPair>, contact::Overlaps<3>&)> find_overlaps;
    contact::CandidateSearch<3> candidates;
    contact::Overlaps<3> overlaps;
};

/// Sum of area times gap over the pairs that face each other and are near: the same for lists that hold all of them.
double checksum(const contact::Surface<3>& surface, const contact::Overlaps<3>& overlaps, double distance) {
    double sum = 0.0;
    for (const auto& overlap : overlaps.found)
        if (surface.normal[overlap.face_1].dot(surface.normal[overlap.face_2]) < -0.2 && std::abs(overlap.gap) < distance)
            sum += overlap.area * overlap.gap;
    return sum;
}

nlohmann::json measure(const std::string& name, const Choices& choices) {
    const DetectionScene scene = benchmark::detection_scene(name, choices.faces);
    const contact::Surface<3> surface = surface_of(scene);
    const Path path(surface, scene);
    const contact::CandidateOptions options{.distance = scene.distance, .skin = skin_over_side * scene.side};
    const auto translating = [&](const auto& pairs, contact::Overlaps<3>& overlaps) {
        contact::find_overlaps<3>(surface.view(), path.u_1, pairs, geometry::AreaMethod::fast, overlaps);
    };
    const auto moved = [&](const auto& pairs, contact::Overlaps<3>& overlaps) {
        contact::find_overlaps_moved<3>(surface.view(), path.x_1, pairs, geometry::AreaMethod::fast, overlaps);
    };
    std::vector<Way> ways;
    const auto add = [&](const std::string& way, const auto& search, const auto& find) {
        ways.push_back({way, search, find, contact::CandidateSearch<3>(surface.view(), options), {}});
    };
    add(
        "translating", [&](auto& search) { search.search(path.u_0, path.u_1); }, translating);
    add(
        "moved, overlap", [&](auto& search) { search.search_moved(path.x_0, path.x_1, GapOf::overlap); }, moved);
    add(
        "moved, centroids", [&](auto& search) { search.search_moved(path.x_0, path.x_1, GapOf::centroids); }, moved);
    std::vector<std::function<void()>> works;
    for (Way& way : ways) {
        way.search(way.candidates);
        way.find_overlaps(way.candidates.candidates(), way.overlaps);
        const double expected = checksum(surface, ways.front().overlaps, scene.distance);
        const double found = checksum(surface, way.overlaps, scene.distance);
        benchmark::require_small(way.name + ": area times gap", std::abs(found / expected - 1.0), 1e-9);
        works.emplace_back([&way] { way.search(way.candidates); });
        works.emplace_back([&way] { way.find_overlaps(way.candidates.candidates(), way.overlaps); });
    }
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads), works);
    nlohmann::json json{{"scene", name}, {"faces", surface.size()}};
    fmt::print("{}, {} triangles\n  {:<20}{:>12}{:>12}{:>8}{:>14}{:>8}\n", name, surface.size(), "", "pairs", "list, ms",
               "ratio", "overlaps, ms", "ratio");
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const double list = samples[2 * i].least(), overlaps = samples[2 * i + 1].least();
        const std::size_t pairs = ways[i].candidates.candidates().size();
        fmt::print("  {:<20}{:>12}{:>12.2f}{:>8.2f}{:>14.2f}{:>8.2f}\n", ways[i].name, pairs, 1e3 * list,
                   list / samples[0].least(), 1e3 * overlaps, overlaps / samples[1].least());
        json["ways"][ways[i].name] = {{"pairs", pairs}, {"list_ms", 1e3 * list}, {"overlaps_ms", 1e3 * overlaps}};
    }
    return json;
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("What it costs that faces may turn.");
    options.add("--scene", choices.scenes).one_of({"press", "plug"});
    options.add("--faces", choices.faces, "triangles a body").between(100, 10'000'000);
    options.add("--repetitions", choices.repetitions, "rounds; the least is shown").positive();
    options.add("--threads", choices.threads).positive();
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    nlohmann::json result = benchmark::circumstances(argc, argv);
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    for (const std::string& name : choices.scenes) result["results"].push_back(measure(name, choices));
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
