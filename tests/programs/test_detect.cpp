#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "abut/contact/search/candidate_search.hpp"
#include "apps/detect/bodies.hpp"
#include "apps/detect/verification.hpp"
#include "programs/detect.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::apps;
using namespace abut::test::programs;
using Catch::Matchers::Contains;

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

/// Two bodies near each other, with the lists that detection makes of them.
struct Scene {
    Bodies bodies;
    std::vector<geometry::IndexPair> candidates;
    std::vector<contact::Overlap<3>> overlaps;
    Requirement requirement{.distance = 0.0, .depth = 0.0, .facing_cosine = -0.5};

    Scene() {
        DetectOptions options;
        options.inputs = {"sphere:n=80,radius=1", "sphere:n=80,radius=1.05,flip=1"};
        ReadingTimes times;
        bodies = read_bodies(options, times);
        requirement.distance = requirement.depth = 0.1;
        set_depth(bodies, requirement.depth, requirement.distance);
        const std::vector<Vector<3>> u(bodies.face_label.size(), Vector<3>::Zero());
        contact::CandidateSearch<3> search(bodies.surface.view(), {.distance = requirement.distance, .skin = 1e-9});
        search.search(u, u);
        candidates.assign(search.candidates().begin(), search.candidates().end());
        for (const auto& overlap : contact::find_overlaps<3>(bodies.surface.view(), u, candidates).found)
            if (overlap.area > 1e-9) overlaps.push_back(overlap);  // not those that touch up to rounding
    }
    [[nodiscard]] Verification verified(const VerificationLimits& limits = {}) const {
        return verify(bodies.surface.view(), bodies.start, requirement, limits, candidates, overlaps);
    }
};

}  // namespace

TEST_CASE("detect: two squares shifted by 0.25 share 0.75 of their area at their gap", "[programs][detect]") {
    const double gap = GENERATE(0.05, 0.0, -0.05);
    const Squares squares("facing_squares", gap);
    const auto outcome = detect(squares.arguments() + "--distance 0.1 --verify", "squares");
    const auto last = last_step(outcome);
    CHECK(last["area"].get<double>() == Approx(0.75).epsilon(1e-14));
    CHECK(last["gap_min"].get<double>() == Approx(gap).margin(1e-15));
    CHECK(last["gap_max"].get<double>() == Approx(gap).margin(1e-15));
    const auto table = read_table(outcome, "overlaps.csv");
    CHECK(sum(table.column("area")) == Approx(0.75).epsilon(1e-14));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        CHECK(table.column("nz")[i] == 1.0);  // from the lower body into the upper
        CHECK(table.column("z")[i] == Approx(0.5 * gap).margin(1e-15));
        CHECK((table.column("x")[i] > 0.25 && table.column("x")[i] < 1.0));
    }
    CHECK(read_summary(outcome)["verification"]["required"] == last["overlaps"]);
}

TEST_CASE("detect: a file is scaled, turned and moved by keys behind its name, and is called as told",
          "[programs][detect]") {
    const Folder folder("placed");
    write_square(folder.path() / "a:b=c.obj", 0.0, 0.0, 0.0, true);
    std::ofstream(folder.path() / "mm.obj") << "v 0 0 0\nv 500 0 0\nv 500 500 0\nv 0 500 0\nf 1 2 3\nf 1 3 4\n";
    const auto outcome =
        detect(fmt::format("'{0}/a:b=c.obj' '{0}/mm.obj:unit=mm,scale=2,rx=180,x=0.25,y=1,z=0.05,name=upper' "
                           "--distance 0.1 --verify",
                           folder.path().string()),
               "placed_results");
    CHECK(read_summary(outcome)["bodies"] == std::vector<std::string>{"a:b=c", "upper"});
    CHECK(last_step(outcome)["area"].get<double>() == Approx(0.75).epsilon(1e-14));
    CHECK(last_step(outcome)["gap_min"].get<double>() == Approx(0.05).epsilon(1e-13));
    const std::string contacts = read_text(outcome.directory / "contacts.csv");
    CHECK_THAT(contacts, Contains("area [m^2],gap_min [m]") && Contains("0,a:b=c,upper,4,0.75,"));
    CHECK_THAT(read_text(outcome.directory / "overlaps.vtp"), Contains("Name=\"body: upper\""));
}

TEST_CASE("detect: the nearest faces of two bodies are named with their points and exact distance, beyond --distance, too",
          "[programs][detect]") {
    const Folder folder("tilted");
    write_square(folder.path() / "flat.obj", 0.0, 0.0, 0.0, true);
    // the second stands on its edge from (1, 0, 0) to (1, 1, 0), turned by 45 degrees about y: 0.8 - sqrt(1/2) above the first
    const auto outcome = detect(fmt::format("'{0}/flat.obj' '{0}/flat.obj:ry=45,x=0.2,z=0.8,name=tilted' sphere:z=9 "
                                            "--distance 0.01",
                                            folder.path().string()),
                                "tilted_results");
    const auto nearest = read_summary(outcome)["nearest"];
    REQUIRE(nearest.size() == 2);  // the sphere's nearest is the tilted square
    CHECK(nearest[0]["distance"].get<double>() == Approx(0.8 - std::sqrt(0.5)).epsilon(1e-14));
    CHECK(nearest[0]["point_1"][2] == 0.0);
    CHECK(nearest[0]["point_2"][0].get<double>() == Approx(0.2 + std::sqrt(0.5)).epsilon(1e-14));
    CHECK((nearest[1]["body_1"] == 1 && nearest[1]["body_2"] == 2));
    CHECK(outcome.out.starts_with("'flat' and 'tilted' are 0.09289 m apart at (0.9071, "));  // the answer comes first
    CHECK_THAT(outcome.out, Contains("nearest bodies") && Contains("0.0928932188 m: 'flat', face 0 at (0.907107, "));
    CHECK_THAT(read_text(outcome.directory / "nearest.csv"),
               Contains("step,body_1,face_1,body_2,face_2,distance [m],x_1 [m]") && Contains("0,flat,0,tilted,"));
}

TEST_CASE("detect: bodies that cross deeper than --distance have a row with their depth, and so has one inside another",
          "[programs][detect]") {
    const Folder folder("crossing");
    std::ofstream(folder.path() / "cube.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                                 "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    const auto outcome = detect(fmt::format("'{0}/cube.obj' '{0}/cube.obj:x=0.25,z=0.875,name=upper' "
                                            "'{0}/cube.obj:scale=0.25,x=0.25,y=0.25,z=0.25,name=core' "
                                            "'{0}/cube.obj:x=-1.5,name=far' --distance 0.01",
                                            folder.path().string()),
                                "crossing_results");
    const auto contacts = read_summary(outcome)["contacts"];
    REQUIRE(contacts.size() == 2);
    CHECK((contacts[0]["body_2"] == 1 && contacts[0]["crosses"] == true && contacts[0]["inside"].is_null()));
    CHECK(contacts[0]["depth"].get<double>() == Approx(0.125));
    CHECK((contacts[0]["overlaps"] == 0 && contacts[0]["gap_min"].is_null()));
    CHECK((contacts[1]["body_2"] == 2 && contacts[1]["inside"] == 2));
    CHECK(contacts[1]["depth"].get<double>() == Approx(0.5));  // of the corner that is nearest to the middle of the cube
    const std::string rows = read_text(outcome.directory / "contacts.csv");
    CHECK_THAT(rows,
               Contains("distance_min [m],crosses,depth [m],inside\n") && Contains("0,cube,upper,0,0,nan,nan,1,0.125,\n"));
    CHECK_THAT(outcome.out, Contains("'cube' and 'upper' cross each other, 0.125 m deep, at ("));
}

TEST_CASE("detect: squares beyond --distance or as deep as --depth are counted, not kept", "[programs][detect]") {
    const auto [gap, far, deep] = GENERATE(table<double, bool, bool>({{0.1001, true, false}, {-0.1001, false, true}}));
    const Squares squares("squares_beyond", gap);
    // boxes reach farther than both limits, so that the narrow phase sees the pairs
    const auto outcome = detect(squares.arguments() + "--distance 0.1 --skin 0.1 --verify", "squares_apart");
    const auto last = last_step(outcome);
    CHECK(last["overlaps"] == 0);
    CHECK(last["gap_min"].is_null());
    CHECK((last["too_far"] > 0) == far);
    CHECK((last["too_deep"] > 0) == deep);
}

TEST_CASE("detect: a sphere in a hollow sphere is in contact all over, at a gap of the difference of radii",
          "[programs][detect]") {
    const double h = 0.1;  // edges, about
    const auto outcome =
        detect("sphere:n=5120,radius=1 sphere:n=5120,radius=1.05,flip=1 --distance 0.06 --verify", "spheres");
    const auto last = last_step(outcome);
    CHECK(last["gap_min"].get<double>() == Approx(0.05).margin(h * h / 2));
    CHECK(last["gap_max"].get<double>() == Approx(0.05).margin(h * h / 2));
    // each pair as seen along its normal: between the areas of the two, up to the discretisation
    CHECK(last["area"].get<double>() > 4.0 * std::numbers::pi * (1.0 - h * h));
    CHECK(last["area"].get<double>() < 4.0 * std::numbers::pi * 1.05 * 1.05 * (1.0 + h * h));
    const auto surface = read_summary(outcome)["inputs"][1];
    CHECK(surface["health"]["closed"] == true);
    CHECK(outcome.out.find("inside out") != std::string::npos);  // the wall of a cavity, and it is said
}

TEST_CASE("detect: a ball wholly inside of another one is told, and one in a hollow that looks inwards is not",
          "[programs][detect]") {
    const bool is_hollow = GENERATE(false, true);
    const auto outcome =
        detect(fmt::format("sphere:n=80,radius=1 sphere:n=320,radius=3{} --no-files", is_hollow ? ",flip=1" : ""), "inside");
    const bool is_told = outcome.out.find("wholly inside of another body") != std::string::npos;
    CHECK(is_told == !is_hollow);
}

TEST_CASE("detect: interlocked tori are as near as 1 - r_1 - r_2, and far apart nothing is found", "[programs][detect]") {
    const auto near = detect("torus:n=16000 torus:n=16000,x=1,axis=1,tube=0.6 --distance 0.12", "tori");
    CHECK(last_step(near)["gap_min"].get<double>() == Approx(0.1).margin(0.05 * 0.05));
    CHECK(read_summary(near)["bodies"] == std::vector<std::string>{"torus", "torus_2"});
    CHECK(read_summary(near)["contacts"].size() == 1);
    const auto far = detect("torus:n=4000 torus:n=4000,x=10 --distance 0.12 --verify", "tori_apart");
    CHECK(last_step(far)["overlaps"] == 0);
    CHECK(read_summary(far)["search"]["candidates"] == 0);
    CHECK(read_table(far, "overlaps.csv").rows.empty());
}

TEST_CASE("detect: --self finds the two leaves of a folded sheet, and --rings leaves out what is near the fold",
          "[programs][detect]") {
    const Folder folder("folded");
    std::ofstream file(folder.path() / "fold.obj");  // leaves at z = 0 facing up and at z = 0.1 facing down, joined at x = 0
    file << "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n";
    file << "v 0 0 0.1\nv 1 0 0.1\nv 2 0 0.1\nv 0 1 0.1\nv 1 1 0.1\nv 2 1 0.1\n";
    file << "f 1 2 5 4\nf 2 3 6 5\nf 7 10 11 8\nf 8 11 12 9\nf 1 4 10 7\n";
    file.close();
    const std::string arguments = fmt::format("'{}' --distance 0.15 --verify ", (folder.path() / "fold.obj").string());
    CHECK(last_step(detect(arguments, "unfolded"))["overlaps"] == 0);
    const auto all = last_step(detect(arguments + "--self", "folded_self"));
    CHECK(all["overlaps"] == 2);
    CHECK(all["area"].get<double>() == Approx(2.0).epsilon(1e-14));
    CHECK(all["gap_min"].get<double>() == Approx(0.1).epsilon(1e-14));
    // leaf - back - leaf are two steps, the outer two faces four
    CHECK(last_step(detect(arguments + "--self --rings 2", "folded_ring"))["overlaps"] == 1);
}

TEST_CASE("detect: every broad phase and any number of threads give the same files", "[programs][detect]") {
    const std::string scene =
        "gear:n=200 gear:n=200,x=1.9,turn=0.1571 soup:n=100,size=0.2 --self --rotate gear:0,0,1,10 --steps 2 ";
    const auto expected = detect(scene + "--write-every 1", "phase_automatic");
    REQUIRE(read_table(expected, "overlaps.csv").rows.size() > 100);
    for (const std::string choice : {"--broad-phase packed_tree", "--broad-phase embree", "--broad-phase fcl",
                                     "--broad-phase brute_force", "--threads 1", "--threads 3"}) {
        CAPTURE(choice);
        const auto outcome = detect(scene + "--write-every 1 " + choice, "phase_other");
        CHECK(read_text(outcome.directory / "candidates.csv") == read_text(expected.directory / "candidates.csv"));
        CHECK(files_in(outcome.directory) == files_in(expected.directory));
        for (const auto& file : files_in(expected.directory))
            if (file != "summary.json") CHECK(read_text(outcome.directory / file) == read_text(expected.directory / file));
    }
}

TEST_CASE("detect: a body moved by option or script ends where it should", "[programs][detect]") {
    const Squares squares("moved_squares", 1.0);
    std::ofstream(squares.path() / "script.csv")
        << "step,body,x,y,z,rx,ry,rz\n2,upper,0,0,-0.5,0,0,0\n4,1,0.25,0,-0.9,0,0,90\n";
    const std::string motion = GENERATE("--translate upper:0.25,0,-0.9 --rotate 1:0,0,1,90 --steps 4", "--script");
    const std::string script = motion == "--script" ? " '" + (squares.path() / "script.csv").string() + "'" : "";
    const auto outcome = detect(squares.arguments() + "--distance 0.2 --verify " + motion + script, "moved");
    CHECK(read_summary(outcome)["steps"] == 4);
    const auto last = last_step(outcome);
    CHECK(last["area"].get<double>() == Approx(0.5).epsilon(1e-13));
    CHECK(last["gap_min"].get<double>() == Approx(0.1).epsilon(1e-13));
    const auto steps = read_table(outcome, "steps.csv");
    CHECK(steps.column("step") == std::vector<double>{0, 1, 2, 3, 4});
    CHECK(steps.column("overlaps").front() == 0.0);
}

TEST_CASE("detect: a list with a skin lasts for steps that translate, turn and deform, and is complete in each",
          "[programs][detect]") {
    const auto outcome = detect("torus torus:x=3 --translate 1:-0.5,0,0 --steps 50 --distance 0.1 --verify", "lasting");
    const auto summary = read_summary(outcome);
    CHECK(summary["search"]["lists_made"] < 30);
    CHECK(summary["verification"]["required"] > 100);
    const auto turned = detect(
        "gear gear:x=1.9,turn=0.1571 --rotate 0:0,0,1,9 --rotate 1:0,0,1,-9 --steps 9 --skin 0.1 --distance 0.1 --verify",
        "turning");
    CHECK(read_summary(turned)["search"]["lists_made"] < 6);
    CHECK(read_summary(turned)["verification"]["required"] > 100);
}

TEST_CASE("detect: --verify passes on every shape, on samples, and with exact areas", "[programs][detect]") {
    const auto [scene, sampled] = GENERATE(table<std::string, std::string>({
        {"torus torus:x=1,axis=1,tube=0.6", ""},
        {"gear gear:x=1.9,turn=0.1571", ""},
        {"sphere sphere:x=1.99", ""},
        {"sphere sphere:x=1.9 --depth 0.2", "--verify-samples 50 --seed 7"},
        {"sphere:n=80 sphere:n=80,radius=1.05,flip=1 --area exact", ""},
        {"sheet sheet:z=0.05,flip=1", ""},
        {"barrel barrel:x=2.01", "--verify-tests 1e5"},
        {"soup:n=1000 --self", ""},
        {"soup:n=1500 soup:n=1500,seed=2 --facing 0", ""},
        {"soup:n=1500 soup:n=1500,seed=2 --facing 0", "--verify-samples 50 --seed 7"},
        {"torus:n=2000 --connected --self --rings 2", ""},
    }));
    CAPTURE(scene, sampled);
    const auto found = read_summary(detect(scene + " --verify --distance 0.05 " + sampled, "verified"))["verification"];
    CHECK(found["missed_candidates"] == 0);
    CHECK(found["missed_overlaps"] == 0);
    CHECK(found["wrong_overlaps"] == 0);
    CHECK(found["pairs_tested"] > 0);
}

TEST_CASE("the verifier finds one pair taken from, put into or changed in a list", "[programs][detect]") {
    Scene scene;
    REQUIRE(scene.verified().passed());
    const auto n = static_cast<std::int64_t>(scene.bodies.face_label.size());
    CHECK(scene.verified().tested == n / 2 * (n / 2));
    REQUIRE(scene.verified().required == static_cast<std::int64_t>(scene.overlaps.size()));
    const auto taken = scene.overlaps[scene.overlaps.size() / 3];
    const geometry::IndexPair pair{taken.face_1, taken.face_2};
    SECTION("a candidate less") {
        std::erase(scene.candidates, pair);
        CHECK(scene.verified().missed_candidates == 1);
        CHECK(scene.verified({.samples = static_cast<std::int32_t>(n)}).missed_candidates == 2);  // seen from both faces
        CHECK_THAT(scene.verified().first_fault, Contains(fmt::format("faces {} and {}", pair.first, pair.second)) &&
                                                     Contains("missing among the candidates"));
    }
    SECTION("an overlap less") {
        scene.overlaps.erase(scene.overlaps.begin() + static_cast<long>(scene.overlaps.size() / 3));
        CHECK(scene.verified().missed_overlaps == 1);
        CHECK(scene.verified().missed_candidates == 0);
    }
    SECTION("an overlap too many") {
        scene.overlaps.push_back(taken);
        scene.overlaps.back().face_1 = 0;
        scene.overlaps.back().face_2 = 1;
        std::ranges::sort(scene.overlaps, {}, [](const auto& overlap) { return std::pair(overlap.face_1, overlap.face_2); });
        CHECK(scene.verified().wrong_overlaps == 1);
    }
    SECTION("another area, or gap") {
        auto& overlap = scene.overlaps[scene.overlaps.size() / 3];
        (GENERATE(true, false) ? overlap.area : overlap.gap) += 1e-6;
        CHECK(scene.verified().wrong_overlaps == 1);
    }
    CHECK_FALSE(scene.verified().passed());
}
