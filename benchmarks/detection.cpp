// Pairs of triangles of two bodies in near contact: ours and what users would pick instead, in one run.
//
// Two cylinders side by side ("press", contact along a line) and a plug in a sleeve ("plug", contact all around), a fifth of
// a side apart; wanted are all pairs of triangles that come as near as half a side. First one query from nothing, what is
// built for it included; then, where a finder can follow bodies that move, 100 steps in which one body slides, by 0.002 of a
// side each. Every answer is checked before it is timed: pairs nearer than wanted that are missing are counted, and a finder
// that misses one is out of the comparison. Peak memory comes from a process of its own for each finder.
// Expected: the packed tree several times faster than the best rival when contact is local, 1.5 times when it is conforming;
// a list with a skin tens of times faster a step.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>

#include "abut/contact/search/candidate_search.hpp"
#include "support/detection_rivals.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using benchmark::Body;
using benchmark::DetectionScene;
using benchmark::Finder;
using benchmark::Pairs;
using geometry::BroadPhase;
using geometry::IndexPair;

constexpr const char* no_query = "none";

template <BroadPhase method>
class Ours : public Finder {
public:
    Pairs find(const Body& body_1, const Body& body_2, double distance) override {
        const auto boxes_1 = body_1.boxes(0.5 * distance), boxes_2 = body_2.boxes(0.5 * distance);
        return geometry::overlapping_pairs<3>({.method = method}, boxes_1, boxes_2);
    }
};

std::vector<benchmark::Rival> finders() {
    std::vector<benchmark::Rival> all{
        {"packed_tree", "ours, the default", [] { return std::unique_ptr<Finder>(new Ours<BroadPhase::packed_tree>); }},
        {"embree", "ours, over Embree", [] { return std::unique_ptr<Finder>(new Ours<BroadPhase::embree>); }},
        {"fcl", "ours, over FCL's tree", [] { return std::unique_ptr<Finder>(new Ours<BroadPhase::fcl>); }}};
    const auto& rivals = benchmark::rivals();
    all.insert(all.end(), rivals.begin(), rivals.end());
    return all;
}

struct Choices {
    std::vector<std::string> scenes{"press", "plug"};
    std::vector<int> faces{10'000, 100'000, 1'000'000};
    std::vector<std::string> only;
    int repetitions = 3;
    int steps = 100;
    int rival_steps = 5;
    double speed = 0.002;  ///< sides a step
    int threads = 1;
    bool memory = true;
    std::string json;
    std::string one_query;  ///< finder that does one query and nothing else

    [[nodiscard]] bool wants(const std::string& name) const {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    }
};

/// Pairs of triangles as near as the scene wants them, sorted: out of those whose boxes overlap.
Pairs required_pairs(const DetectionScene& scene) {
    const auto& [body_1, body_2] = scene.bodies;
    Pairs required;
    const auto boxes_1 = body_1.boxes(0.5 * scene.distance), boxes_2 = body_2.boxes(0.5 * scene.distance);
    for (const auto& [i, j] : geometry::overlapping_pairs<3>({.method = BroadPhase::fcl}, boxes_1, boxes_2))
        if (benchmark::triangle_distance(body_1.corners(static_cast<std::size_t>(i)),
                                         body_2.corners(static_cast<std::size_t>(j))) <= scene.distance)
            required.push_back({i, j});
    return required;
}

std::size_t count_missing(Pairs found, const Pairs& required) {
    std::sort(found.begin(), found.end());
    Pairs missing;
    std::ranges::set_difference(required, found, std::back_inserter(missing));
    return missing.size();
}

/// Peak of memory of this program as a process of its own, which makes the scene and does one query, or none [bytes].
double peak_of_process(const std::string& scene, int faces, int threads, const std::string& finder) {
    const std::string command = fmt::format("/proc/{}/exe --scene {} --faces {} --threads {} --one-query {}", getpid(),
                                            scene, faces, threads, finder);
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
    double kilobytes = 0.0;
    if (!pipe || std::fscanf(pipe.get(), "%lf", &kilobytes) != 1) throw std::runtime_error("memory: a query ended badly");
    return 1024.0 * kilobytes;
}

/// Peak of memory of this process so far [kB].
double own_peak() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6));
    throw std::runtime_error("memory: /proc/self/status has no VmHWM");
}

struct StaticResult {
    benchmark::Rival finder;
    std::size_t pairs = 0;
    std::size_t missing = 0;
    double seconds = 0.0;
    double bytes = 0.0;
};

std::vector<StaticResult> measure_static(const std::string& name, int faces, const DetectionScene& scene,
                                         const Choices& choices) {
    const auto& [body_1, body_2] = scene.bodies;
    std::vector<StaticResult> results;
    for (const auto& finder : finders())
        if (choices.wants(finder.name)) results.push_back({.finder = finder});
    if (choices.memory) {
        const double without = peak_of_process(name, faces, choices.threads, no_query);
        for (StaticResult& result : results)
            result.bytes = peak_of_process(name, faces, choices.threads, result.finder.name) - without;
    }
    const Pairs required = required_pairs(scene);
    std::vector<std::function<void()>> works;
    for (StaticResult& result : results) {
        const Pairs found = result.finder.make()->find(body_1, body_2, scene.distance);
        result.pairs = found.size();
        result.missing = count_missing(found, required);
        works.emplace_back([&] { (void)result.finder.make()->find(body_1, body_2, scene.distance); });
    }
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads), works);
    for (std::size_t i = 0; i < results.size(); ++i) results[i].seconds = samples[i].least();
    fmt::print("  {} pairs are nearer than wanted\n", required.size());
    return results;
}

nlohmann::json report_static(const std::vector<StaticResult>& results) {
    double best = std::numeric_limits<double>::infinity();
    for (const StaticResult& result : results)
        if (result.missing == 0 && result.finder.what.find("ours") == std::string::npos)
            best = std::min(best, result.seconds);
    nlohmann::json json;
    fmt::print("  {:<20}{:>12}{:>10}{:>12}{:>14}{:>12}\n", "one query", "pairs", "missing", "ms", "best rival/it", "MB");
    for (const auto& [finder, pairs, missing, seconds, bytes] : results) {
        fmt::print("  {:<20}{:>12}{:>10}{:>12.2f}{:>14.2f}{:>12.1f}\n", finder.name, pairs, missing, 1e3 * seconds,
                   best / seconds, bytes / 1e6);
        json[finder.name] = {{"pairs", pairs}, {"missing", missing}, {"ms", 1e3 * seconds}, {"MB", bytes / 1e6}};
    }
    return json;
}

/// The two bodies as contact takes them.
contact::Surface<3> surface_of(const DetectionScene& scene) {
    contact::Surface<3> surface;
    for (std::int32_t body = 0; body < 2; ++body)
        for (std::size_t i = 0; i < scene.bodies[static_cast<std::size_t>(body)].triangles.size(); ++i)
            surface.append(scene.bodies[static_cast<std::size_t>(body)].corners(i), 0.1 * scene.side, 1.0, body);
    return surface;
}

/// A host that keeps a list of the pairs that are near, whatever their normals.
class Follower {
public:
    Follower(const contact::Surface<3>& surface, double distance, BroadPhase method)
        : search_(surface.view(), {.broad_phase = method, .facing_cosine = 1.0, .distance = distance}),
          searched_(surface.area.size(), Vector<3>::Zero()) {}

    /// A step from u to `next`: the bound on the motion, and a new list if need be.
    void step(const std::vector<Vector<3>>& u, const std::vector<Vector<3>>& next) {
        double motion = 0.0;
        for (std::size_t face = 0; face < u.size(); ++face)
            motion = std::max(motion, (next[face] - searched_[face]).squaredNorm());
        if (search_.is_valid_for(std::sqrt(motion))) return;
        search_.search(u, next);
        searched_ = u;
    }
    [[nodiscard]] const contact::CandidateSearch<3>& search() const { return search_; }

private:
    contact::CandidateSearch<3> search_;
    std::vector<Vector<3>> searched_;
};

/// What a finder costs a step, and whether it is still right.
struct MotionResult {
    std::string name;
    std::size_t pairs = 0;
    std::size_t missing = 0;
    double seconds = 0.0;
    std::int64_t lists = 0;  ///< that ours made
    double skin = 0.0;       ///< of its last one [m]
};

Vector<3> way_of_step(const DetectionScene& scene, const Choices& choices) {
    return choices.speed * scene.side * Vector<3>::UnitZ();
}

MotionResult follow_by_rival(const benchmark::Rival& rival, DetectionScene scene, const Choices& choices) {
    const auto clock = benchmark::clock_for(choices.threads);
    const Vector<3> way = way_of_step(scene, choices);
    const auto finder = rival.make();
    auto& [body_1, body_2] = scene.bodies;
    MotionResult result{.name = rival.name};
    result.missing = count_missing(finder->find(body_1, body_2, scene.distance), required_pairs(scene));
    for (int step = 0; step < choices.rival_steps; ++step) {
        body_2.translate(way);
        result.seconds +=
            benchmark::seconds_of([&] { result.pairs = finder->follow(body_1, body_2, scene.distance); }, clock);
    }
    result.seconds /= choices.rival_steps;
    return result;
}

/// Pairs that are near after the last step and are not in the list, whose faces are numbered through both bodies.
std::size_t missing_at_end(DetectionScene scene, const Choices& choices, std::span<const IndexPair> list) {
    scene.bodies[1].translate(choices.steps * way_of_step(scene, choices));
    const auto n_1 = static_cast<std::int32_t>(scene.bodies[0].triangles.size());
    Pairs found;
    for (const auto& [i, j] : list) found.push_back({i, j - n_1});
    return count_missing(std::move(found), required_pairs(scene));
}

MotionResult follow_by_list(BroadPhase method, const contact::Surface<3>& surface, const DetectionScene& scene,
                            const Choices& choices) {
    const auto clock = benchmark::clock_for(choices.threads);
    const double way = way_of_step(scene, choices).z();
    Follower follower(surface, scene.distance, method);
    std::vector<Vector<3>> u(surface.area.size(), Vector<3>::Zero()), next = u;
    MotionResult result{.name = std::string(geometry::name(method))};
    for (int step = 1; step <= choices.steps; ++step) {
        for (std::size_t face = 0; face < u.size(); ++face)
            if (surface.body[face] == 1) next[face].z() = step * way;
        result.seconds += benchmark::seconds_of([&] { follower.step(u, next); }, clock);
        u.swap(next);
    }
    result.seconds /= choices.steps;
    const auto list = follower.search().candidates();
    result.pairs = list.size();
    result.missing = missing_at_end(scene, choices, list);
    result.lists = follower.search().report().searches;
    result.skin = follower.search().skin();
    return result;
}

void print(const MotionResult& result) {
    fmt::print("  {:<20}{:>12}{:>10}{:>12.2f}{:>14}\n", result.name, result.pairs, result.missing, 1e3 * result.seconds,
               result.lists > 0 ? std::to_string(result.lists) : "");
}

nlohmann::json measure_motion(const DetectionScene& scene, const Choices& choices) {
    nlohmann::json json;
    std::vector<MotionResult> complete_rivals, ours;
    fmt::print("  {:<20}{:>12}{:>10}{:>12}{:>14}\n", "a step of slow motion", "pairs", "missing", "ms", "lists made");
    for (const auto& rival : benchmark::rivals()) {
        if (!choices.wants(rival.name)) continue;
        const MotionResult result = follow_by_rival(rival, scene, choices);
        print(result);
        json[result.name] = {{"pairs", result.pairs}, {"missing", result.missing}, {"ms", 1e3 * result.seconds}};
        if (result.missing == 0) complete_rivals.push_back(result);
    }
    const contact::Surface<3> surface = surface_of(scene);
    for (const BroadPhase method : {BroadPhase::packed_tree, BroadPhase::embree, BroadPhase::fcl}) {
        if (!choices.wants(std::string(geometry::name(method)))) continue;
        const MotionResult& result = ours.emplace_back(follow_by_list(method, surface, scene, choices));
        print(result);
        json[result.name] = {{"pairs", result.pairs}, {"missing", result.missing}, {"ms", 1e3 * result.seconds},
                             {"lists", result.lists}, {"skin", result.skin},       {"side", scene.side}};
    }
    if (!complete_rivals.empty() && !ours.empty()) {
        const MotionResult& rival = *std::ranges::min_element(complete_rivals, {}, &MotionResult::seconds);
        json["best_rival_over_default"] = rival.seconds / ours.front().seconds;
        fmt::print("  a step: {} takes {:.1f} times as long as {}\n", rival.name, rival.seconds / ours.front().seconds,
                   ours.front().name);
    }
    return json;
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Detection of near triangles of two bodies: ours and what users would pick instead.");
    options.add("--scene", choices.scenes).one_of({"press", "plug"});
    options.add("--faces", choices.faces, "triangles a body").between(100, 10'000'000);
    options.add("--only", choices.only, "names of finders; all by default");
    options.add("--repetitions", choices.repetitions, "rounds; the least is shown").positive();
    options.add("--steps", choices.steps, "of slow motion, ours; 0: none").not_negative();
    options.add("--speed", choices.speed, "of the sliding body, sides of a triangle a step").positive();
    options.add("--rival-steps", choices.rival_steps, "of slow motion, others: they do the same in each").positive();
    options.add("--threads", choices.threads).positive();
    options.add("--memory", choices.memory, "measure the peak of memory");
    options.add("--json", choices.json, "file for the result");
    options.add("--one-query", choices.one_query, "").hidden();  // for the measurement of memory
    if (const auto status = options.parse(argc, argv)) return *status;

    nlohmann::json result = benchmark::circumstances(argc, argv);
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    if (!choices.one_query.empty()) {
        const DetectionScene scene = benchmark::detection_scene(choices.scenes.front(), choices.faces.front());
        for (const auto& finder : finders())
            if (finder.name == choices.one_query)
                (void)finder.make()->find(scene.bodies[0], scene.bodies[1], scene.distance);
        fmt::print("{}\n", own_peak());
        return 0;
    }
    for (const std::string& name : choices.scenes)
        for (const int n : choices.faces) {
            const DetectionScene scene = benchmark::detection_scene(name, n);
            fmt::print("{}, {} and {} triangles\n", name, scene.bodies[0].triangles.size(),
                       scene.bodies[1].triangles.size());
            nlohmann::json entry{{"scene", name}, {"triangles", n}};
            entry["static"] = report_static(measure_static(name, n, scene, choices));
            if (choices.steps > 0) entry["motion"] = measure_motion(scene, choices);
            result["results"].push_back(entry);
        }
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
