// Files with several bodies, tables of each; shapes that are too large; inputs that are no files.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::WrittenScene;

/// Two triangles apart, each in a group.
const char* const pair_msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"projectile\"\n2 2 \"target\"\n$EndPhysicalNames\n"
    "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 5 0 0\n5 6 0 0\n6 5 1 0\n$EndNodes\n"
    "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 2 2 4 5 6\n$EndElements\n";

/// A scene of that pair; `tables` stands behind the keys of its table.
class PairScene {
public:
    explicit PairScene(const std::string& tables)
        : written_(
              "dim = 2\nrun.steps = 1\nenergy_scale = 1\n" +
              (tables.find("lead") == std::string::npos ? std::string() : "[materials.lead]\nyoung = 7\ndensity = 8\n") +
              "[bodies.pair]\nmesh = \"pair.msh\"\n" + tables) {
        std::ofstream(written_.path().parent_path() / "pair.msh") << pair_msh;
    }
    [[nodiscard]] run::Scene<2> scene() const { return input::SceneFile(written_.path()).scene<2>(); }
    [[nodiscard]] std::string faults() const { return input::text_of(input::check_scene(written_.path()).faults); }

private:
    WrittenScene written_;
};

}  // namespace

TEST_CASE("bodies of one file have a table each, over the keys of the table around them", "[input][bodies]") {
    const PairScene pair(
        "young = 1\ndensity = 2\n[bodies.pair.projectile]\nvelocity = [3, 0]\nkinematics = \"floating\"\n"
        "[bodies.pair.target]\nyoung = 4\nspin = 5\n");
    const auto scene = pair.scene();
    REQUIRE(scene.mesh.body_names == std::vector<std::string>{"pair.projectile", "pair.target"});
    const auto& materials = scene.solid.materials;
    CHECK(materials[0].young == 1.0);
    CHECK(materials[1].young == 4.0);
    CHECK(materials[0].density == 2.0);
    CHECK(materials[1].density == 2.0);
    CHECK(scene.velocity[0] == Vector<2>(3, 0));
    CHECK(scene.velocity[1] == Vector<2>(0, 0));
    CHECK(scene.solid.kinematics == std::vector<solid::Kinematics>{solid::Kinematics::floating, solid::Kinematics::small});
    REQUIRE(scene.spin.size() == 2);
    CHECK(scene.spin[0] == decltype(scene.spin)::value_type(0 * scene.spin[1]));
}

TEST_CASE("where every body of a file has a material of its own, the table around them needs none", "[input][bodies]") {
    const PairScene pair("[bodies.pair.projectile]\nmaterial = \"lead\"\n[bodies.pair.target]\nyoung = 1\ndensity = 1\n");
    const auto materials = pair.scene().solid.materials;
    CHECK(materials[0].young == 7.0);
    CHECK(materials[1].density == 1.0);
    CHECK(PairScene("[bodies.pair.projectile]\nmaterial = \"lead\"\n")
              .faults()
              .find("body 'pair.target' has no material. Give young and density, or material, in [bodies.pair.target].") !=
          std::string::npos);
}

TEST_CASE("a table of a body that the file does not have is a fault, and so is a key that is none of a body in a file",
          "[input][bodies]") {
    CHECK(PairScene("young = 1\ndensity = 1\n[bodies.pair.targett]\nyoung = 2\n")
              .faults()
              .find("bodies.pair.targett: pair.msh has no body of this name. Did you mean") != std::string::npos);
    CHECK(PairScene("young = 1\ndensity = 1\n[bodies.pair.target]\nplace = [1, 0]\n")
              .faults()
              .find("bodies.pair.target.place is an unknown key.") != std::string::npos);
}

TEST_CASE("a shape with too many cells is a fault of the scene before anything is made, unless most_cells allows it",
          "[input][bodies]") {
    const auto faults_with = [](const std::string& keys) {
        const WrittenScene written("dim = 2\nrun.steps = 1\nenergy_scale = 1\n[bodies.a]\nyoung = 1\ndensity = 1\n" + keys);
        return input::text_of(input::check_scene(written.path()).faults);
    };
    const auto said = faults_with("shape = \"gear\"\nteeth = 12\nradius = 1\nbore = 0.4\ncells_per_tooth = 2000000000\n");
    CHECK(said.find("a: its sizes make about ") != std::string::npos);
    CHECK(said.find(" cells, at most 50000000 are made. Lower cells_per_tooth") != std::string::npos);
    const std::string square = "shape = \"structured_box\"\nlower = [0, 0]\nupper = [1, 1]\ncounts = [10, 10]\n";
    CHECK(faults_with(square + "most_cells = 99\n").find("a: its sizes make about 100 cells, at most 99 are made.") !=
          std::string::npos);
    CHECK(faults_with(square + "most_cells = 100\n").empty());
}

TEST_CASE("a scene that is a pipe, a device or a folder is refused", "[input][bodies]") {
    const WrittenScene written("");
    const auto folder = written.path().parent_path();
    REQUIRE(mkfifo((folder / "pipe.toml").c_str(), 0600) == 0);
    std::filesystem::create_symlink("/dev/zero", folder / "zero.toml");
    std::filesystem::create_directory(folder / "folder.toml");
    for (const auto& [name, kind] :
         {std::pair{"pipe.toml", "is a pipe"}, {"zero.toml", "is a device"}, {"folder.toml", "is a folder"}}) {
        const auto faults = input::text_of(input::check_scene(folder / name).faults);
        CHECK(faults.find(std::string(name)) != std::string::npos);
        CHECK(faults.find(kind) != std::string::npos);
        CHECK(faults.find("a file is needed") != std::string::npos);
    }
}
