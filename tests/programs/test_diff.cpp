// abut diff: whether two runs are the same, and where they first differ.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::test::programs;
using Catch::Contains;
namespace fs = std::filesystem;

Outcome compare(const fs::path& first, const fs::path& second, const std::string& options = "") {
    return run_program("abut", fmt::format("diff '{}' '{}' {}", first.string(), second.string(), options), "");
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

Outcome short_run(const std::string& options, const std::string& folder) {
    return run_well(
        "abut", slip("--set values.size=0.3 --steps 12 --interval 3 --frames 2 --keep-last-checkpoint " + options), folder);
}

void write_file(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
}

constexpr const char* three_rows = "step,time [s],kinetic [J]\n0,0,2\n5,0.5,1\n10,1,0.5\n";

/// Two folders of results with a table each.
struct TwoRuns {
    Folder folder{"two_runs_to_compare"};
    fs::path a = folder.path() / "a", b = folder.path() / "b";

    TwoRuns(const std::string& of_a, const std::string& of_b) {
        write_file(a / "energy.csv", of_a);
        write_file(b / "energy.csv", of_b);
    }
};

/// A frame of two squares with a field, and the list that names it.
void write_frame(const fs::path& folder, const std::vector<double>& field) {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {2.0, 1.0}, {2, 1}, mesh::CellShape::quadrangle);
    mesh::VtuSeries<2> series(folder, "bodies", mesh);
    const std::vector<Vector<2>> still(field.size(), Vector<2>::Zero());
    series.write({.time = 0.25, .displacement = still, .cell_fields = {{"heat [J]", std::span<const double>(field)}}});
}

}  // namespace

TEST_CASE("abut diff finds runs on one and two threads bitwise identical, whatever their folders are called",
          "[programs][diff]") {
    const auto one = short_run("--threads 1", "diff_one"), two = short_run("--threads 2", "diff_two");
    const Outcome same = compare(one.directory, two.directory);
    CAPTURE(same.out, same.error);
    CHECK(same.exit_code == 0);
    CHECK_THAT(first_line(same.out), Contains("bitwise identical"));
    CHECK_THAT(same.out, Contains("energy.csv (5 rows") && Contains("bodies.pvd (2 frames)") &&
                             Contains("checkpoint (step 12") && Contains("summary.json") && !Contains("settings"));
}

TEST_CASE("abut diff names the key that was changed, and finds the first record where values differ", "[programs][diff]") {
    const auto slow = short_run("", "diff_slow"), fast = short_run("--set bodies.left.density=1.5", "diff_fast");
    const Outcome differ = compare(slow.directory, fast.directory);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("differ, first in energy.csv at row 1, step 0, t = 0 s"));
    CHECK_THAT(differ.out, Contains("bodies.left.density=1.5") && Contains("bodies.0.mass"));
}

TEST_CASE("abut diff names the keys of scenes that differ", "[programs][diff]") {
    TwoRuns runs(three_rows, three_rows);
    write_file(runs.a / "checkpoints/scene.toml", "dim = 2\n[bodies.left]\ndensity = 1\n");
    write_file(runs.b / "checkpoints/scene.toml", "dim = 2\n[bodies.left]\ndensity = 2\n");
    const Outcome same = compare(runs.a, runs.b);
    CAPTURE(same.out, same.error);
    CHECK(same.exit_code == 0);  // the results are the same
    CHECK_THAT(same.out, Contains("bodies.left.density is the number 2 now, it was the number 1"));
}

TEST_CASE("abut diff finds the first row and the column in which two tables differ, and by how much", "[programs][diff]") {
    const TwoRuns runs(three_rows, "step,time [s],kinetic [J]\n0,0,2\n5,0.5,1.0000000000000002\n10,1,0.75\n");
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("row 2, step 5, t = 0.5 s: kinetic [J] is 1 | 1.0000000000000002"));
    CHECK_THAT(differ.out, Contains("largest: kinetic [J] 0.12"));  // 0.25 of 2
}

TEST_CASE("abut diff takes values as the same that differ by less than its tolerance times the largest of their column",
          "[programs][diff]") {
    const TwoRuns runs(three_rows, "step,time [s],kinetic [J]\n0,0,2\n5,0.5,1.002\n10,1,0.52\n");
    CHECK(compare(runs.a, runs.b, "--tolerance 0.011").exit_code == 0);
    const Outcome differ = compare(runs.a, runs.b, "--tolerance 0.009");
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("row 3, step 10"));
    CHECK(compare(runs.a, runs.b, "--tolerance 0.0009").exit_code == 2);
    CHECK_THAT(first_line(compare(runs.a, runs.b, "--tolerance 0.0009").out), Contains("row 2, step 5"));
    CHECK(compare(runs.a, runs.b, "--tolerance=-1").exit_code == 1);
}

TEST_CASE("abut diff leaves out a half-written line, and says which run has more rows", "[programs][diff]") {
    const TwoRuns runs(three_rows, three_rows);
    fs::remove(runs.b / "energy.csv");
    write_file(runs.b / "energy.csv.partial", "step,time [s],kinetic [J]\n0,0,2\n5,0.5,1\n10,1,0.");
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("bitwise identical in all that both have"));
    CHECK_THAT(differ.out,
               Contains("1 row more in the first run") && Contains("last line of the second run is half-written"));
}

TEST_CASE("abut diff compares no rows behind one of another step or of other bodies", "[programs][diff]") {
    const TwoRuns steps(three_rows, "step,time [s],kinetic [J]\n0,0,2\n6,0.5,9\n10,1,0.5\n");
    const Outcome of_steps = compare(steps.a, steps.b);
    CAPTURE(of_steps.out, of_steps.error);
    CHECK(of_steps.exit_code == 2);
    CHECK_THAT(first_line(of_steps.out), Contains("row 2, step 5") && Contains("step is 5 | 6"));
    CHECK_THAT(of_steps.out, Contains("from row 2 on rows are of another step") && !Contains("kinetic"));
}

TEST_CASE("abut diff takes NaN as NaN, 0 as another number than -0, columns in any order and names with commas",
          "[programs][diff]") {
    const TwoRuns runs("step,body,push [N],pull [N]\n0,\"a,b\",nan,0\n1,\"a,b\",2,0\n",
                       "step,body,pull [N],push [N]\n0,\"a,b\",0,nan\n1,\"a,b\",-0,2\n");
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("row 2, step 1: pull [N] is 0 | -0"));
    CHECK(compare(runs.a, runs.b, "--tolerance 1e-12").exit_code == 0);
}

TEST_CASE("abut diff compares the rows behind an empty cell, which is no number", "[programs][diff]") {
    const TwoRuns runs("step,time [s],kinetic [J]\n0,0,\n5,0.5,1\n", "step,time [s],kinetic [J]\n0,0,2\n5,0.5,3\n");
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("row 1, step 0, t = 0 s: kinetic [J] is nan | 2"));
    CHECK_THAT(differ.out, Contains("energy.csv") && !Contains("rows are of another"));
}

TEST_CASE("abut diff names frames in HDF5 of the second run alone, and says what of both it does not compare",
          "[programs][diff]") {
    const TwoRuns runs(three_rows, three_rows);
    write_file(runs.b / "bodies.h5", "of the second run");
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(differ.out, Contains("bodies.h5          in the second run only"));
    write_file(runs.a / "bodies.h5", "of the first run");
    const Outcome same = compare(runs.a, runs.b);
    CHECK(same.exit_code == 0);
    CHECK_THAT(first_line(same.out), Contains("bitwise identical in all that was compared"));
    CHECK_THAT(same.out, Contains("frames in one file of HDF5 are not compared"));
}

TEST_CASE("abut diff names columns and files that one run alone has", "[programs][diff]") {
    const TwoRuns runs(three_rows, "step,time [s],kinetic [J],work [J]\n0,0,2,0\n5,0.5,1,0\n10,1,0.5,0\n");
    write_file(runs.a / "probes.csv", three_rows);
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(differ.out,
               Contains("column work [J] in the second run only") && Contains("probes.csv         in the first run only"));
}

TEST_CASE("abut diff finds the cell of a frame whose value differs", "[programs][diff]") {
    const TwoRuns runs(three_rows, three_rows);
    write_frame(runs.a, {4.0, 1.0});
    write_frame(runs.b, {4.0, 3.0});
    const Outcome differ = compare(runs.a, runs.b);
    CAPTURE(differ.out, differ.error);
    CHECK(differ.exit_code == 2);
    CHECK_THAT(first_line(differ.out), Contains("bodies.pvd at frame 0, t = 0.25 s: heat [J] of cell 1 is 1 | 3"));
    CHECK_THAT(differ.out, Contains("largest: heat [J] of cell 1 0.5"));  // 2 of 4
    CHECK(compare(runs.a, runs.b, "--tolerance 0.51").exit_code == 0);
}

TEST_CASE("abut diff refuses what is no folder of results, and runs of other dimensions", "[programs][diff]") {
    const TwoRuns runs(three_rows, three_rows);
    const Outcome nowhere = compare(runs.a, runs.folder.path());
    CHECK(nowhere.exit_code == 1);
    CHECK_THAT(nowhere.error, Contains("no folder of results") && Contains("--out"));
    write_file(runs.a / "summary.json", "{\"dim\": 2}");
    write_file(runs.b / "summary.json", "{\"dim\": 3}");
    const Outcome dimensions = compare(runs.a, runs.b);
    CHECK(dimensions.exit_code == 1);
    CHECK_THAT(dimensions.error, Contains("the first run is in 2D, the second in 3D"));
}
