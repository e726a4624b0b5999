#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "abut/contact/search/candidate_search.hpp"
#include "apps/detect/motion.hpp"
#include "apps/detect/shapes.hpp"
#include "apps/detect/verification.hpp"
#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut;
using namespace abut::apps;
using namespace abut::test::programs;
using Catch::Matchers::Contains;

/// A square of the side 1 with its lower corner at (x, y, z), two triangles, facing up or down, as .obj.
void write_square(const fs::path& path, double x, double y, double z, bool up) {
    std::ofstream file(path);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        file << fmt::format("v {} {} {}\n", x + i, y + j, z);
    file << (up ? "f 1 2 3\nf 1 3 4\n" : "f 3 2 1\nf 4 3 1\n");
}

/// Two unit squares that face each other, the upper one `gap` higher and moved by 0.25 along x.
class Squares {
public:
    Squares(const std::string& name, double gap) : folder_(name) {
        write_square(folder_.path() / "lower.obj", 0.0, 0.0, 0.0, true);
        write_square(folder_.path() / "upper.obj", 0.25, 0.0, gap, false);
    }
    [[nodiscard]] std::string arguments() const {
        return fmt::format("'{0}/lower.obj' '{0}/upper.obj' ", folder_.path().string());
    }
    [[nodiscard]] const fs::path& path() const { return folder_.path(); }

private:
    Folder folder_;
};

Outcome detect(const std::string& arguments, const std::string& folder) { return run_well("detect", arguments, folder); }

nlohmann::json last_step(const Outcome& outcome) { return read_summary(outcome)["last_step"]; }

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

void check_error(const Outcome& outcome, const std::vector<std::string>& words) {
    CHECK(outcome.exit_code == 1);
    CAPTURE(outcome.error);
    CHECK(std::ranges::count(outcome.error, '\n') == 1);
    for (const auto& word : words) CHECK_THAT(outcome.error, Contains(word));
    if (outcome.folder) CHECK(files_in(outcome.directory).empty());
}

/// Two bodies near each other, with the lists that detection makes of them.
struct Scene {
    Bodies bodies;
    std::vector<geometry::IndexPair> candidates;
    std::vector<contact::Overlap<3>> overlaps;
    Requirement requirement{.distance = 0.0, .depth = 0.0, .facing_cosine = -0.5};

    Scene() {
        DetectOptions options;
        options.inputs = {"sphere:n=320,radius=1", "sphere:n=320,radius=1.05,flip=1"};
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
    const std::string scene = "gear gear:x=1.9,turn=0.1571 soup:n=300,size=0.2 --self --rotate gear:0,0,1,10 --steps 3 ";
    const auto expected = detect(scene + "--write-every 1", "phase_automatic");
    const std::string choice = GENERATE("--broad-phase packed_tree", "--broad-phase embree", "--broad-phase fcl",
                                        "--broad-phase brute_force", "--threads 1", "--threads 3", "--area exact");
    CAPTURE(choice);
    const auto outcome = detect(scene + "--write-every 1 " + choice, "phase_other");
    CHECK(read_text(outcome.directory / "candidates.csv") == read_text(expected.directory / "candidates.csv"));
    if (choice == "--area exact") return;  // areas may differ in the last digit
    CHECK(read_table(expected, "overlaps.csv").rows.size() > 100);
    CHECK(files_in(outcome.directory) == files_in(expected.directory));
    for (const auto& file : files_in(expected.directory))
        if (file != "summary.json") CHECK(read_text(outcome.directory / file) == read_text(expected.directory / file));
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

TEST_CASE("detect: a list with a skin lasts for steps that only translate, and is complete in each", "[programs][detect]") {
    const auto outcome = detect("torus torus:x=3 --translate 1:-0.5,0,0 --steps 50 --distance 0.1 --verify", "lasting");
    const auto summary = read_summary(outcome);
    CHECK(summary["search"]["lists_made"] < 30);
    CHECK(summary["verification"]["required"] > 100);
    const auto turned = detect(
        "gear gear:x=1.9,turn=0.1571 --rotate 0:0,0,1,9 --rotate 1:0,0,1,-9 --steps 9 --distance 0.1 --verify", "turning");
    CHECK(read_summary(turned)["search"]["lists_made"] == 10);
    CHECK(read_summary(turned)["verification"]["required"] > 100);
}

TEST_CASE("a shape has about n faces, unless a count is given by its own key, and stands where it is told to",
          "[programs][detect]") {
    const double n = 5000.0;
    for (const std::string shape : {"torus", "gear", "sheet", "barrel", "soup"}) {
        CAPTURE(shape);
        const double found = make_shape(shape + ":n=5000").faces.size();
        CHECK(found > n / 1.5);
        CHECK(found < n * 1.5);
    }
    CHECK(make_shape("sphere:n=5000").faces.size() == 20 * 256);  // the nearest power of four
    CHECK(make_shape("gear:teeth=7,n_flank=3,n=5000,n_radial=2,n_axial=1").faces.size() == 16 * 7 * 3 * (2 + 1));
    CHECK(make_shape("barrel:n_side=2,n_along=3").faces.size() == 8 * 2 * 3 + 4 * 2 * 2);
    CHECK(make_shape("barrel:n_side=2,n_along=3,closed=0").faces.size() == 8 * 2 * 3);
    const auto volume = [](const std::string& text) {
        return geometry::check_surface(make_shape(text).soup()).components.at(0).volume;
    };
    CHECK(volume("sphere:n=1280,radius=2") == Approx(8.0 * volume("sphere:n=1280")));
    CHECK(volume("sphere:n=1280,flip=1") == Approx(-volume("sphere:n=1280")));
    const auto moved = make_shape("sphere:x=1,y=-2,z=3,name=ball"), sphere = make_shape("sphere");
    CHECK(moved.body_names == std::vector<std::string>{"ball"});
    CHECK(moved.vertices[0] == sphere.vertices[0] + Vector<3>(1.0, -2.0, 3.0));
    CHECK(make_shape("soup:seed=1").vertices == make_shape("soup").vertices);
    CHECK(make_shape("soup:seed=2").vertices != make_shape("soup").vertices);
}

TEST_CASE("detect: --connected makes bodies of the parts of one file", "[programs][detect]") {
    const Folder folder("two_parts");
    std::ofstream file(folder.path() / "squares.obj");
    file << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.25 0 0.05\nv 1.25 0 0.05\nv 1.25 1 0.05\nv 0.25 1 0.05\n";
    file << "f 1 2 3 4\nf 8 7 6 5\n";
    file.close();
    const std::string arguments = fmt::format("'{}' --distance 0.1 --verify ", (folder.path() / "squares.obj").string());
    const auto as_one = detect(arguments, "one_body");
    CHECK(read_summary(as_one)["bodies"] == std::vector<std::string>{"squares"});
    CHECK(last_step(as_one)["overlaps"] == 0);
    const auto as_two = detect(arguments + "--connected", "two_bodies");
    CHECK(read_summary(as_two)["bodies"] == std::vector<std::string>{"body_1", "body_2"});
    CHECK(last_step(as_two)["area"].get<double>() == Approx(0.75).epsilon(1e-14));
}

TEST_CASE("detect: --self-intersections counts faces that cross, and shows them; without it nobody looks",
          "[programs][detect]") {
    const Folder folder("crossing");
    std::ofstream file(folder.path() / "crossing.obj");  // the second goes through the first, the third stands aside
    file << "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0.5 0.5 -1\nv 0.5 0.5 1\nv 3 3 0\nv 5 5 0\nv 6 5 0\nv 5 6 0\n";
    file << "f 1 2 3\nf 4 5 6\nf 7 8 9\n";
    file.close();
    const std::string arguments = fmt::format("'{}' --self ", (folder.path() / "crossing.obj").string());
    const auto count = [](const Outcome& outcome) {
        return read_summary(outcome)["inputs"][0]["health"]["self_intersections"];
    };
    const auto looked = detect(arguments + "--self-intersections", "looked");
    CHECK(count(looked) == 1);
    CHECK_THAT(looked.out, Contains("1 pair of faces intersects: first face 0 and face 1"));
    CHECK(count(detect(arguments, "not_looked")).is_null());
}

TEST_CASE("detect: --verify passes on every shape and every sample", "[programs][detect]") {
    const std::string scene = GENERATE(
        "torus torus:x=1,axis=1,tube=0.6", "gear gear:x=1.9,turn=0.1571", "sphere sphere:x=1.99",
        "sphere sphere:x=1.9 --depth 0.2", "sheet sheet:z=0.05,flip=1", "barrel barrel:x=2.01", "soup:n=1000 --self",
        "soup:n=1500 soup:n=1500,seed=2 --facing 0", "torus:n=2000 --connected --self --rings 2");
    const std::string sampled = GENERATE("", "--verify-samples 50 --seed 7", "--verify-tests 1e5");
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

TEST_CASE("detect: a displacement array is applied over the run in equal parts", "[programs][detect]") {
    const Folder folder("displaced");
    const auto path = folder.path() / "upper.vtp";
    std::ofstream(path) << R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
<PointData><DataArray type="Float64" Name="u" NumberOfComponents="3" format="ascii">
0 0 -0.9  0 0 -0.9  0 0 -0.9  0 0 -0.9</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 1  0 1 1  1 1 1  1 0 1</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Polys>
</Piece></PolyData></VTKFile>
)";
    write_square(folder.path() / "lower.obj", 0.0, 0.0, 0.0, true);
    const std::string inputs = fmt::format("'{0}/lower.obj' '{0}/upper.vtp' ", folder.path().string());
    const auto outcome = detect(inputs + "--displacement u --steps 3 --distance 0.5 --verify", "displacement");
    CHECK(last_step(outcome)["gap_min"].get<double>() == Approx(0.1).epsilon(1e-14));
    CHECK(last_step(outcome)["area"].get<double>() == Approx(1.0).epsilon(1e-14));
    const auto gaps = read_table(outcome, "steps.csv").column("gap_min");
    CHECK(gaps[2] == Approx(0.4).epsilon(1e-14));
    check_error(run_program("detect", inputs + "--displacement velocity", "no_array"),
                {"'velocity'", "there is 'u'", "--displacement"});
    check_error(run_program("detect", "torus --displacement u", "no_file"), {"--displacement u", "no input", ".vtp"});
}

TEST_CASE("detect: faces that cannot be used end the run, or are left out and counted", "[programs][detect]") {
    const Squares squares("unusable", 0.05);
    std::ofstream(squares.path() / "upper.obj", std::ios::app) << "f 1 1 2\nf 3 2 1\n";
    check_error(
        run_program("detect", squares.arguments(), "unusable_fail"),
        {"upper.obj", "2 of 4 faces cannot be used", "face 2", "face 3", "repeats an earlier face", "--unusable skip"});
    const auto outcome = detect(squares.arguments() + "--unusable skip --distance 0.1 --verify", "unusable_skip");
    CHECK(last_step(outcome)["area"].get<double>() == Approx(0.75).epsilon(1e-14));
    const auto upper = read_summary(outcome)["inputs"][1];
    CHECK(upper["skipped_faces"] == 2);
    CHECK(upper["health"]["unusable_by_reason"] == nlohmann::json{{"repeated_corner", 1}, {"duplicate", 1}});
    CHECK_THAT(outcome.out, Contains("2 unusable faces are left out"));
}

TEST_CASE("detect: bad input ends with one message that names place, value, limit and remedy, and leaves no file",
          "[programs][detect]") {
    const Squares squares("bad_for_detect", 0.05);
    const auto file = [&](const std::string& name, const std::string& text) {
        std::ofstream(squares.path() / name) << text;
        return fmt::format("'{}'", (squares.path() / name).string());
    };
    const std::string two = squares.arguments();
    const std::string nan = file("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");
    const std::string head = "step,body,x,y,z,rx,ry,rz\n";
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"", {"mesh", "required"}},
        {"nowhere.obj", {"nowhere.obj", "no such file"}},
        {"what.xyz", {"what.xyz", ".obj"}},
        {nan, {"nan.off"}},
        {"torus:n=0", {"torus:n=0: n", "above 0"}},
        {"torus:tube=2", {"torus", "2", "radius"}},
        {"torus:colour=1", {"'colour' is no key", "tube", "--help"}},
        {"torus:n", {"'n' is no key=value"}},
        {"torus:n=9,n=9", {"'n' is given twice"}},
        {two + "--translate nobody:1,0,0", {"--translate nobody:1,0,0", "no body 'nobody'", "lower, upper"}},
        {two + "--translate 1:1,0", {"--translate 1:1,0", "2 numbers", "3 are needed"}},
        {two + "--translate 1:1,x,0", {"--translate 1:1,x,0", "'x' is no number"}},
        {two + "--rotate 1:0,0,0,90", {"--rotate", "axis", "above 0"}},
        {two + "--rotate 1:0,0,1", {"--rotate", "4 or 7 are needed"}},
        {two + "--rotate 1:0,0,1,9 --rotate 1:1,0,0,9", {"turns already", "script"}},
        {two + "--translate 1:1000,0,0", {"step 1", "'upper' moves by 100 m", "is allowed", "--largest-motion", "--steps"}},
        {two + "--script nowhere.csv", {"--script nowhere.csv", "cannot be read"}},
        {two + "--script " + file("head.csv", "a,b\n"), {"head.csv: line 1", "step,body,x,y,z,rx,ry,rz"}},
        {two + "--script " + file("short.csv", head + "1,0,0,0,0,0,0,0\n2,0,0\n"), {"short.csv: line 3", "3 columns", "8"}},
        {two + "--script " + file("word.csv", head + "1,0,0,0,up,0,0,0\n"),
         {"word.csv: line 2, column z", "'up' is no number"}},
        {two + "--script " + file("body.csv", head + "1,7,0,0,0,0,0,0\n"), {"body.csv: line 2, column body", "no body '7'"}},
        {two + "--script " + file("back.csv", head + "2,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0\n"),
         {"line 3, column step", "1 follows 2"}},
        {two + "--script " + file("empty.csv", head), {"empty.csv", "no row"}},
        {two + "--script " + file("blank.csv", head + "\n\n"), {"blank.csv", "no row"}},
        {two + "--steps 1 --script " + file("late.csv", head + "9,0,0,0,0,0,0,0\n"), {"--steps 1", "step 9"}},
        {"torus torus:x=0.1 --distance 0.5 --max-pairs 10", {"step 0", "10 are allowed", "--max-pairs"}},
        {"torus torus:x=0.1 --max-memory 0.001", {"step 0", "bytes", "--max-memory"}},
        {"torus --distance 0", {"--distance", "above 0 m"}},
        {"torus --facing 0.5", {"--facing", "not above 0"}},
        {"torus --rings -1", {"--rings", "at least 0"}},
        {"torus --broad-phase bvh", {"--broad-phase", "embree"}},
        {"torus --unusable mend", {"--unusable", "fail, skip"}}};
    for (const auto& [arguments, words] : cases) {
        INFO(arguments);
        check_error(run_program("detect", arguments, "bad_detect"), words);
    }
}

TEST_CASE("detect: files of an earlier run are gone, others stay, and --no-files writes none", "[programs][detect]") {
    const auto outcome = detect("torus torus:x=2.6 --translate 1:-0.1,0,0 --steps 2 --write-every 1", "written_twice");
    CHECK(files_in(outcome.directory) == std::vector<std::string>{"candidates.csv", "overlaps.csv", "overlaps_000000.vtp",
                                                                  "overlaps_000001.vtp", "overlaps_000002.vtp", "steps.csv",
                                                                  "summary.json", "surface_000000.vtp", "surface_000001.vtp",
                                                                  "surface_000002.vtp"});
    std::ofstream(outcome.directory / "surface_mine.vtp") << "mine\n";
    const std::string out = fmt::format("--out '{}'", outcome.directory.string());
    REQUIRE(run_program("detect", "torus " + out, "").exit_code == 0);
    CHECK(files_in(outcome.directory) == std::vector<std::string>{"candidates.csv", "overlaps.csv", "overlaps.vtp",
                                                                  "steps.csv", "summary.json", "surface.vtp",
                                                                  "surface_mine.vtp"});
    const auto none = detect("torus --no-files", "no_files");
    CHECK(files_in(none.directory).empty());
}

TEST_CASE("detect: an output folder with a file in its place is refused before anything is read", "[programs][detect]") {
    const Folder folder("detect_in_the_way");
    const auto file = folder.path() / "results";
    std::ofstream(file) << "mine\n";
    check_error(run_program("detect", fmt::format("nowhere.obj --out '{}'", file.string()), ""),
                {"--out", "cannot be written to", "a file is in its place"});
    CHECK(read_text(file) == "mine\n");
}
