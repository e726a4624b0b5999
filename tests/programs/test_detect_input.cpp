// What `detect` reads, what it refuses, and which files it leaves.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "abut/geometry/health/surface_health.hpp"
#include "apps/detect/shapes.hpp"
#include "programs/detect.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::apps;
using namespace abut::test::programs;
using Catch::Matchers::Contains;

void check_error(const Outcome& outcome, const std::vector<std::string>& words) {
    CHECK(outcome.exit_code == 1);
    CAPTURE(outcome.error);
    CHECK(std::ranges::count(outcome.error, '\n') == 1);
    for (const auto& word : words) CHECK_THAT(outcome.error, Contains(word));
    if (!outcome.folder) return;
    for (const std::string& name : files_in(outcome.directory)) {  // rows of the steps before the error
        INFO(name);
        CHECK(name.ends_with(".csv.partial"));
    }
}

}  // namespace

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
    check_error(run_program("abut", "detect " + inputs + "--displacement velocity", "no_array"),
                {"'velocity'", "there is 'u'", "--displacement"});
    check_error(run_program("abut", "detect torus --displacement u", "no_file"), {"--displacement u", "no input", ".vtp"});
}

TEST_CASE("detect: faces that cannot be used end the run, or are left out and counted", "[programs][detect]") {
    const Squares squares("unusable", 0.05);
    std::ofstream(squares.path() / "upper.obj", std::ios::app) << "f 1 1 2\nf 3 2 1\n";
    check_error(
        run_program("abut", "detect " + squares.arguments(), "unusable_fail"),
        {"upper.obj", "2 of 4 faces cannot be used", "face 2", "face 3", "repeats an earlier face", "--unusable skip"});
    const auto outcome = detect(squares.arguments() + "--unusable skip --distance 0.1 --verify", "unusable_skip");
    CHECK(last_step(outcome)["area"].get<double>() == Approx(0.75).epsilon(1e-14));
    const auto upper = read_summary(outcome)["inputs"][1];
    CHECK(upper["skipped_faces"] == 2);
    CHECK(upper["health"]["unusable_by_reason"] == nlohmann::json{{"repeated_corner", 1}, {"duplicate", 1}});
    CHECK_THAT(outcome.out, Contains("2 unusable faces are left out"));
}

TEST_CASE("detect: bad input ends with one message that names place, value, limit and remedy, and leaves no result",
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
        {"torus:unit=yard", {"'yard' is no unit of length", "mm, um, in, ft"}},
        {"torus:scale=0", {"torus:scale=0: scale", "above 0"}},
        {"nowhere.obj:n=9", {"'n' is no key", "unit, scale, rx"}},
        {"nowhere.obj:x=1", {"nowhere.obj: ", "no such file"}},
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
        check_error(run_program("abut", "detect " + arguments, "bad_detect"), words);
    }
}

TEST_CASE("detect: files of an earlier run are gone, others stay, and --no-files writes none", "[programs][detect]") {
    const auto outcome = detect("torus torus:x=2.6 --translate 1:-0.1,0,0 --steps 2 --write-every 1", "written_twice");
    CHECK(files_in(outcome.directory) ==
          std::vector<std::string>{"candidates.csv", "contacts.csv", "nearest.csv", "overlaps.csv", "overlaps_000000.vtp",
                                   "overlaps_000001.vtp", "overlaps_000002.vtp", "steps.csv", "summary.json",
                                   "surface_000000.vtp", "surface_000001.vtp", "surface_000002.vtp"});
    std::ofstream(outcome.directory / "surface_mine.vtp") << "mine\n";
    const std::string out = fmt::format("--out '{}'", outcome.directory.string());
    REQUIRE(run_program("abut", "detect torus " + out, "").exit_code == 0);
    CHECK(files_in(outcome.directory) == std::vector<std::string>{"candidates.csv", "contacts.csv", "nearest.csv",
                                                                  "overlaps.csv", "overlaps.vtp", "steps.csv",
                                                                  "summary.json", "surface.vtp", "surface_mine.vtp"});
    const auto none = detect("torus --no-files", "no_files");
    CHECK(files_in(none.directory).empty());
}

TEST_CASE("detect: an output folder with a file in its place is refused before anything is read", "[programs][detect]") {
    const Folder folder("detect_in_the_way");
    const auto file = folder.path() / "results";
    std::ofstream(file) << "mine\n";
    check_error(run_program("abut", "detect " + fmt::format("nowhere.obj --out '{}'", file.string()), ""),
                {"--out", "cannot be written to", "a file is in its place"});
    CHECK(read_text(file) == "mine\n");
}
