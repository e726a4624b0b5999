#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/verdict.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using test::Folder;
using test::read_text;
namespace fs = std::filesystem;

/// Asks to stop once a step is taken.
class StopAt : public run::Observer<2> {
public:
    explicit StopAt(std::int64_t step) : step_(step) {}
    void look(const dynamics::RunView<2>& view, solid::Solid<2>&) override { seen_ = view.steps; }
    [[nodiscard]] bool asks_to_stop() const override { return seen_ + 1 >= step_; }

private:
    std::int64_t step_;
    std::int64_t seen_ = -1;
};

}  // namespace

TEST_CASE("a program of a few lines leaves the files of a run, and a summary of what the result holds", "[run][files]") {
    const Folder folder;
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.options = {{"speed", 0.01}, {"shape", "block"}, {"counts", std::vector<std::int64_t>{2, 2}}};
    scene.findings = [](const run::RunResult<2>&) -> std::vector<run::Finding> {
        return {{"known", "a number [m]", 0.5}, {"unknown", "another [m]", {}}};
    };
    const run::RunOptions options{.out = folder.path() / "out", .frames = 3};
    run::ResultFiles<2> files(options, "mine", "block");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);

    for (const char* name : {"energy.csv", "energy.svg", "summary.json", "block.pvd", "frames/block_000002.vtu",
                             "frames/block_surface_000002.vtp"})
        CHECK(fs::exists(options.out / name));
    CHECK_FALSE(fs::exists(options.out / "frames/block_000003.vtu"));
    CHECK_FALSE(fs::exists(options.out / "energy.csv.partial"));

    std::istringstream energies(read_text(options.out / "energy.csv"));
    std::int64_t lines = 0;
    for (std::string line; std::getline(energies, line);) ++lines;
    CHECK(lines == result.run.steps + 2);  // names of the columns, and the start

    const std::string text = read_text(options.out / "summary.json");
    CHECK(text == run::summary_json("mine", scene, result));
    const auto json = nlohmann::ordered_json::parse(text);
    CHECK(json["program"] == "mine");
    CHECK(json["steps"] == result.run.steps);
    CHECK(json["dt"] == result.run.dt);
    CHECK(json["pseudo_energy_drift"] == result.ledger.pseudo_energy_drift());
    CHECK(json["known"] == 0.5);
    CHECK(json["unknown"].is_null());
    CHECK(json["options"]["shape"] == "block");
    CHECK(json["options"]["counts"] == std::vector{2, 2});
    CHECK(json["options"]["time"] == scene.time);
    CHECK(json["options"]["cfl"] == 0.9);
    CHECK(json["options"].begin().key() == "speed");  // the scene's own come first, in their order

    const std::string table = run::closing_table("mine", scene, result);
    CHECK(table.starts_with("mine: " + run::verdict(scene, result).text + "\n"));
    CHECK(table.find("velocity of 'block'") != std::string::npos);
    CHECK(table.find("a number [m]") != std::string::npos);
    CHECK(files.table().find((options.out / "block.pvd").string()) != std::string::npos);
}

TEST_CASE(
    "obstacles are a series beside the bodies: named, where they are at each frame, and no larger than can be looked at",
    "[run][files]") {
    const Folder folder;
    run::Scene<3> scene;
    scene.mesh = mesh::structured_box<3>({0, 0, 1e-3}, {1, 1, 1 + 1e-3}, {2, 2, 2}, mesh::CellShape::hexahedron, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    const auto down = [](double time) { return Vector<3>(0, 0, -0.5 * time); };
    const Vector<3> middle(0.5, 0.5, 0.5);
    scene.solid.obstacles = {contact::endless_plane_obstacle<3>({0, 0, 0}, Vector<3>::UnitZ(), middle, 5000.0, down),
                             contact::plane_obstacle<3>({-0.1, 0.5, 0.5}, Vector<3>::UnitX(), 2.0)};
    scene.outputs.obstacles = {"floor", "wall"};
    scene.velocity = {Vector<3>(0, 0, -0.01)};
    scene.time = 1.0;
    const run::RunOptions options{.out = folder.path() / "out", .frames = 3};
    run::ResultFiles<3> files(options, "mine", "block");
    run::RunResult<3> result = run::simulate<3>(scene, options, files);
    files.finish(scene, result);
    const std::string text = read_text(options.out / "frames/block_obstacles_000002.vtp");
    CHECK_THAT(text, Catch::Contains("Name=\"obstacle: floor\" NumberOfTuples=\"1\" format=\"ascii\">0<") &&
                         Catch::Contains("Name=\"obstacle: wall\" NumberOfTuples=\"1\" format=\"ascii\">1<"));
    for (const auto& [frame, depth] :
         {std::pair{"000000", 0.0}, {"000002", 0.5 * result.run.dt * static_cast<double>(result.run.steps)}}) {
        const auto shown = mesh::read_surface(options.out / (std::string("frames/block_obstacles_") + frame + ".vtp"));
        REQUIRE(shown.faces.size() == 2);
        for (const std::int32_t v : shown.faces[0]) {  // around the block, and not 5 km away
            CHECK(shown.vertices[static_cast<std::size_t>(v)][2] == Approx(-depth).margin(1e-15));
            const double away = (shown.vertices[static_cast<std::size_t>(v)] - middle).norm();
            CHECK((away > 2.0 && away < 10.0));
        }
        for (const std::int32_t v : shown.faces[1])  // as it is given
            CHECK((shown.vertices[static_cast<std::size_t>(v)] - Vector<3>(-0.1, 0.5, 0.5)).norm() ==
                  Approx(2.0 * std::sqrt(2.0)));
    }
    CHECK(files.table().find("block_obstacles.pvd") != std::string::npos);
}

TEST_CASE("a run that breaks off leaves its records under another name, and an earlier result is gone", "[run][files]") {
    const Folder folder;
    run::RunOptions options{.out = folder.path(), .frames = 0};
    fs::create_directories(folder.path());
    for (const char* name : {".abut.results", "summary.json", "energy.csv", "somebody_elses.csv"})
        std::ofstream(folder.path() / name) << "old";
    options.contact.compression_limit = 1e-3;
    run::ResultFiles<2> files(options, "mine", "block");
    CHECK(files.left_behind().empty());
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(test::block_on_plane(0.1), options, files)), TooDeep);
    CHECK(files.left_behind().find("energy.csv.partial") != std::string::npos);
    CHECK(fs::exists(folder.path() / "energy.csv.partial"));
    CHECK_FALSE(fs::exists(folder.path() / "energy.csv"));
    CHECK_FALSE(fs::exists(folder.path() / "summary.json"));
    CHECK(fs::exists(folder.path() / "somebody_elses.csv"));
}

TEST_CASE("files of a folder that no run has claimed are the user's: none is removed, and the run is refused by name",
          "[run][files]") {
    const Folder folder;
    const run::RunOptions options{.out = folder.path(), .frames = 0};
    for (const char* name : {"summary.json", "forces.csv", "frames/block_000007.vtu", "block_surface.pvd", "failed.svg"}) {
        fs::create_directories((folder.path() / name).parent_path());
        std::ofstream(folder.path() / name) << "mine";
        CHECK_THROWS_WITH(run::ResultFiles<2>(options, "mine", "block"),
                          Catch::Contains(name) && Catch::Contains("--out") && Catch::Contains("is there"));
        CHECK(read_text(folder.path() / name) == "mine");
        fs::remove_all(folder.path());
    }
}

TEST_CASE("a run that is asked to stop leaves all its files, and its summary says that it is not complete", "[run][files]") {
    const Folder folder;
    const run::RunOptions options{.out = folder.path(), .interval = 2, .frames = 2};
    const run::Scene<2> scene = test::block_on_plane(0.01);
    run::ResultFiles<2> files(options, "mine", "block");
    StopAt stop(3);  // of 5
    run::Observers<2> observers{files, stop};
    run::RunResult<2> result = run::simulate<2>(scene, options, observers);
    files.finish(scene, result);
    const auto summary = nlohmann::json::parse(read_text(folder.path() / "summary.json"));
    CHECK(summary["complete"] == false);
    CHECK(summary["steps"] == 3);
    CHECK(summary["time"].get<double>() == Approx(3 * result.run.dt));
    CHECK(run::closing_table("mine", scene, result).find("asked to stop") != std::string::npos);
    for (const char* name : {"energy.csv", "energy.svg", "block.pvd"}) CHECK(fs::exists(folder.path() / name));
    CHECK_FALSE(fs::exists(folder.path() / "energy.csv.partial"));
}

TEST_CASE("files of a run have their folder for themselves until they are finished", "[run][files]") {
    const Folder folder;
    const run::RunOptions options{.steps = 2, .out = folder.path(), .frames = 0};
    const run::Scene<2> scene = test::block_on_plane(0.01);
    run::ResultFiles<2> files(options, "first", "block");
    CHECK_THROWS_WITH(run::ResultFiles<2>(options, "second", "block"), Catch::Contains("first, process"));
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    CHECK_THROWS_AS(run::ResultFiles<2>(options, "second", "block"), BadInput);
    files.finish(scene, result);
    CHECK(nlohmann::json::parse(read_text(folder.path() / "summary.json"))["complete"] == true);
    CHECK_NOTHROW(run::ResultFiles<2>(options, "second", "block"));
}

TEST_CASE("a folder with a file in its place is refused as bad input, by name", "[run][files]") {
    const Folder folder;
    fs::create_directories(folder.path());
    const fs::path taken = folder.path() / "taken";
    std::ofstream(taken) << "a file";
    CHECK_THROWS_AS(run::ResultFiles<2>({.out = taken}, "mine", "block"), BadInput);
    CHECK_THROWS_WITH(run::ResultFiles<2>({.out = taken}, "mine", "block"), Catch::Contains(taken.string()));
}

TEST_CASE("the von Mises stress of pure shear is sqrt(3) tau, of a uniaxial stress that stress", "[run][files]") {
    Matrix<3> shear = Matrix<3>::Zero(), tension = Matrix<3>::Zero();
    shear(0, 1) = shear(1, 0) = 2.0;
    tension(1, 1) = -3.0;
    CHECK(run::von_mises<3>(shear, 0.0) == Approx(2.0 * std::sqrt(3.0)).epsilon(1e-14));
    CHECK(run::von_mises<3>(tension, 0.0) == Approx(3.0).epsilon(1e-14));
    const Matrix<2> pressure = Matrix<2>::Identity();  // and half of it out of the plane
    CHECK(run::von_mises<2>(pressure, 0.5) == Approx(0.5).epsilon(1e-14));
}
