// Pairs of triangles of two bodies in near contact: ours and what users would pick instead, in one run.
//
// Two cylinders side by side ("press", contact along a line) and a plug in a sleeve ("plug", contact all around), a fifth of a
// side apart; wanted are all pairs of triangles that come as near as half a side. First one query from nothing, what is built
// for it included; then, where a finder can follow bodies that move, 100 steps in which one body slides by a hundredth of a side
// each. Every answer is checked before it is timed: pairs nearer than wanted that are missing are counted, and a finder that
// misses one is out of the comparison. Peak memory comes from a process of its own for each finder.
// Expected: the packed tree several times faster than the best rival when contact is local, 1.5 times when it is conforming;
// a list with a skin tens of times faster a step.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "abut/contact/candidate_search.hpp"
#include "abut/contact/pairs.hpp"
#include "support/detection_rivals.hpp"
#include "support/measure.hpp"

namespace {

using namespace abut;
using benchmark::Body;
using benchmark::DetectionScene;
using benchmark::Finder;
using benchmark::Pairs;
using geometry::BroadPhase;
using geometry::IndexPair;

constexpr double speed = 0.01;  // sides a step
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
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("memory: no process can be started");
    if (child == 0) {
        execl("/proc/self/exe", "detection", "--scene", scene.c_str(), "--faces", std::to_string(faces).c_str(), "--threads",
              std::to_string(threads).c_str(), "--one-query", finder.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) < 0 || status != 0) throw std::runtime_error("memory: a query ended badly");
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
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

/// A host that moves one body and keeps a list: what it does in each step, the bound on the motion included.
class Follower {
public:
    Follower(const contact::Surface<3>& surface, const DetectionScene& scene, BroadPhase method)
        : surface_(surface.view()),
          way_(speed * scene.side),
          search_(surface_, {.broad_phase = method, .distance = scene.distance}),
          u_(surface.area.size(), Vector<3>::Zero()),
          next_(u_),
          searched_(u_) {}

    void step() {
        for (std::size_t face = 0; face < u_.size(); ++face)
            if (surface_.body[face] == 1) next_[face].z() = u_[face].z() + way_;
        double motion = 0.0;
        for (std::size_t face = 0; face < u_.size(); ++face)
            motion = std::max(motion, (next_[face] - searched_[face]).squaredNorm());
        if (!search_.covers(std::sqrt(motion))) {
            search_.search(u_, next_);
            searched_ = u_;
        }
        u_.swap(next_);
    }
    [[nodiscard]] const contact::CandidateSearch<3>& search() const { return search_; }
    [[nodiscard]] const contact::SurfaceView<3>& surface() const { return surface_; }
    [[nodiscard]] const std::vector<Vector<3>>& displacement() const { return u_; }

private:
    contact::SurfaceView<3> surface_;
    double way_;
    contact::CandidateSearch<3> search_;
    std::vector<Vector<3>> u_, next_, searched_;
};

/// Facing pairs with a common area and a gap up to the distance, out of `near`, that the list does not hold.
std::size_t count_missing(const Follower& follower, const Pairs& near, std::int32_t n_faces_1, double distance) {
    const auto list = follower.search().candidates();
    const auto& surface = follower.surface();
    const auto& u = follower.displacement();
    std::size_t missing = 0;
    contact::PairList<3> pairs;
    for (const auto& [i, j] : near) {
        const std::int32_t face_1 = i, face_2 = j + n_faces_1;
        if (!contact::are_facing(surface, face_1, face_2, -0.5)) continue;
        if (std::binary_search(list.begin(), list.end(), IndexPair{face_1, face_2})) continue;
        pairs.clear();
        pairs.append(surface, face_1, face_2, contact::Weights::half);
        const auto& pair = pairs.pairs().front();
        const auto at =
            pairs.position(surface, pair, u[static_cast<std::size_t>(face_1)], u[static_cast<std::size_t>(face_2)]);
        if (at.gap <= distance && pairs.shared_area(pair, at.shift, geometry::AreaMethod::fast).area > 0.0) ++missing;
    }
    return missing;
}

nlohmann::json measure_motion(const DetectionScene& at_start, const Choices& choices) {
    const auto clock = benchmark::clock_for(choices.threads);
    nlohmann::json json;
    std::vector<std::pair<std::string, double>> rival_times, our_times;
    fmt::print("  {:<20}{:>12}{:>10}{:>12}{:>14}\n", "a step of slow motion", "pairs", "missing", "ms", "lists made");
    for (const auto& rival : benchmark::rivals()) {
        if (!choices.wants(rival.name)) continue;
        DetectionScene scene = at_start;
        const auto finder = rival.make();
        const std::size_t missing =
            count_missing(finder->find(scene.bodies[0], scene.bodies[1], scene.distance), required_pairs(scene));
        double seconds = 0.0;
        std::size_t pairs = 0;
        for (int step = 0; step < choices.rival_steps; ++step) {
            scene.bodies[1].translate(speed * scene.side * Vector<3>::UnitZ());
            seconds += benchmark::seconds_of(
                [&] { pairs = finder->follow(scene.bodies[0], scene.bodies[1], scene.distance); }, clock);
        }
        seconds /= choices.rival_steps;
        fmt::print("  {:<20}{:>12}{:>10}{:>12.2f}{:>14}\n", rival.name, pairs, missing, 1e3 * seconds, "");
        json[rival.name] = {{"pairs", pairs}, {"missing", missing}, {"ms", 1e3 * seconds}};
        if (missing == 0) rival_times.emplace_back(rival.name, seconds);
    }
    const contact::Surface<3> surface = surface_of(at_start);
    for (const BroadPhase method : {BroadPhase::packed_tree, BroadPhase::embree, BroadPhase::fcl}) {
        const std::string name(geometry::name(method));
        if (!choices.wants(name)) continue;
        Follower follower(surface, at_start, method);
        const double seconds = benchmark::seconds_of(
                                   [&] {
                                       for (int step = 0; step < choices.steps; ++step) follower.step();
                                   },
                                   clock) /
                               choices.steps;
        DetectionScene moved = at_start;
        moved.bodies[1].translate(choices.steps * speed * at_start.side * Vector<3>::UnitZ());
        const std::size_t missing = count_missing(
            follower, required_pairs(moved), static_cast<std::int32_t>(moved.bodies[0].triangles.size()), moved.distance);
        const auto& report = follower.search().report();
        fmt::print("  {:<20}{:>12}{:>10}{:>12.2f}{:>14}\n", name, report.candidates, missing, 1e3 * seconds,
                   report.searches);
        json[name] = {
            {"pairs", report.candidates},       {"missing", missing},   {"ms", 1e3 * seconds}, {"lists", report.searches},
            {"skin", follower.search().skin()}, {"side", at_start.side}};
        our_times.emplace_back(name, seconds);
    }
    const auto least = [](const auto& times) {
        return *std::ranges::min_element(times, {}, [](const auto& entry) { return entry.second; });
    };
    if (!rival_times.empty() && !our_times.empty()) {
        const auto rival = least(rival_times), ours = our_times.front();
        json["best_rival_over_default"] = rival.second / ours.second;
        fmt::print("  a step: {} takes {:.1f} times as long as {}\n", rival.first, rival.second / ours.second, ours.first);
    }
    return json;
}

int run(int argc, char** argv) {
    Choices choices;
    CLI::App app{"Detection of near triangles of two bodies: ours and what users would pick instead."};
    app.option_defaults()->always_capture_default();
    app.add_option("--scene", choices.scenes)->delimiter(',')->check(CLI::IsMember({"press", "plug"}));
    app.add_option("--faces", choices.faces, "triangles a body")->delimiter(',')->check(CLI::Range(100, 10'000'000));
    app.add_option("--only", choices.only, "names of finders; all by default")->delimiter(',');
    app.add_option("--repetitions", choices.repetitions, "rounds; the least is shown")->check(CLI::PositiveNumber);
    app.add_option("--steps", choices.steps, "of slow motion, ours; 0: none")->check(CLI::NonNegativeNumber);
    app.add_option("--rival-steps", choices.rival_steps, "of slow motion, others: they do the same in each")
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", choices.threads)->check(CLI::PositiveNumber);
    app.add_option("--memory", choices.memory, "measure the peak of memory");
    app.add_option("--json", choices.json, "file for the result");
    app.add_option("--one-query", choices.one_query, "")->group("");  // for the measurement of memory
    CLI11_PARSE(app, argc, argv);

    nlohmann::json result = benchmark::circumstances(argc, argv);
    std::optional<oneapi::tbb::global_control> threads;
    threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(choices.threads));
    if (!choices.one_query.empty()) {
        const DetectionScene scene = benchmark::detection_scene(choices.scenes.front(), choices.faces.front());
        for (const auto& finder : finders())
            if (finder.name == choices.one_query)
                (void)finder.make()->find(scene.bodies[0], scene.bodies[1], scene.distance);
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
