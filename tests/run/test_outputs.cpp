#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/files/probe_file.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/contact_view.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using test::Folder;
using test::read_text;

/// A table by the names of its columns.
struct Csv {
    explicit Csv(const std::string& text) {
        std::istringstream lines(text);
        std::string line;
        std::getline(lines, line);
        head = line;
        for (const std::string& name : cells(line)) names.push_back(name.substr(0, name.find(" [")));
        while (std::getline(lines, line)) rows.push_back(cells(line));
    }
    static std::vector<std::string> cells(const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        return cells;
    }
    [[nodiscard]] const std::string& text(std::size_t row, const std::string& name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        REQUIRE(found != names.end());
        return rows[row][static_cast<std::size_t>(found - names.begin())];
    }
    [[nodiscard]] double number(std::size_t row, const std::string& name) const { return std::stod(text(row, name)); }

    std::string head;
    std::vector<std::string> names;  // without units
    std::vector<std::vector<std::string>> rows;
};

/// Runs a scene and gives a file that it leaves.
template <int Dim>
std::string file_of(const run::Scene<Dim>& scene, run::RunOptions options, const std::string& name,
                    run::RunResult<Dim>* result = nullptr) {
    const Folder folder;
    options.out = folder.path();
    run::ResultFiles<Dim> files(options, "outputs", "bodies");
    run::RunResult<Dim> ended = run::simulate<Dim>(scene, options, files);
    files.finish(scene, ended);
    if (result) *result = std::move(ended);
    return read_text(folder.path() / name);
}

/// Two unit squares, 1 cm apart, that meet with 0.1 m/s and rebound within 3 s.
run::Scene<2> two_blocks() {
    run::Scene<2> scene;
    const std::vector<mesh::Mesh<2>> meshes{
        mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {5, 5}, mesh::CellShape::quadrangle, "left"),
        mesh::structured_box<2>({1.01, 0.2}, {2.01, 1.2}, {6, 6}, mesh::CellShape::quadrangle, "right")};
    scene.mesh = mesh::combine<2>(meshes);
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.3, .density = 1.0});
    scene.velocity = {Vector<2>(0.1, 0.0), Vector<2>::Zero()};
    scene.time = 4.0;
    return scene;
}

}  // namespace

TEST_CASE("forces times their intervals are the change of momentum, whatever scheme takes the forces, and law",
          "[run][outputs]") {
    using run::SolidIntegrator;
    using solid::ContactLaw;
    const auto [integrator, law] =
        GENERATE(table<SolidIntegrator, ContactLaw>({{SolidIntegrator::memm, ContactLaw::reconstruction},
                                                     {SolidIntegrator::memm_async, ContactLaw::reconstruction},
                                                     {SolidIntegrator::leapfrog, ContactLaw::reconstruction},
                                                     {SolidIntegrator::memm, ContactLaw::pair_potential},
                                                     {SolidIntegrator::leapfrog, ContactLaw::pair_potential}}));
    CAPTURE(run::name_of(integrator), static_cast<int>(law));
    run::Scene<2> scene = two_blocks();
    scene.outputs = {.forces = true, .interval = 3};
    run::RunResult<2> result;
    const Csv forces(file_of<2>(scene, {.law = law, .integrator = integrator, .frames = 0}, "forces.csv", &result));
    REQUIRE(forces.rows.size() > 2);
    Vector<2> impulse = Vector<2>::Zero();
    double normal_impulse = 0.0;
    for (std::size_t row = 0; row < forces.rows.size(); ++row) {
        CHECK(forces.text(row, "body_1") == "left");
        CHECK(forces.text(row, "body_2") == "right");
        const auto steps = static_cast<int>(forces.number(row, "step")) % 3;
        const double seconds = (steps == 0 ? 3 : steps) * result.run.dt;
        impulse += seconds * Vector<2>(forces.number(row, "force_on_2_x"), forces.number(row, "force_on_2_y"));
        normal_impulse += seconds * forces.number(row, "normal_force");
    }
    const Vector<2> gained = result.bodies.end[1].mass * (result.bodies.end[1].velocity - result.bodies.start[1].velocity);
    CHECK(gained.x() > 0.05);  // they did meet
    CHECK((impulse - gained).norm() < 1e-12 * gained.norm());
    if (law == ContactLaw::reconstruction)  // normals are those at rest, along x
        CHECK(normal_impulse == Approx(impulse.x()).epsilon(1e-12));
}

/// Looks at the pairs that push each other, beside the force on each body.
struct PairWitness : run::Observer<2> {
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        std::vector<double> force(view.q.size());
        solid.force(view.q, force);
        Vector<2> on_right = Vector<2>::Zero();
        for (std::size_t i = 0; i < solid.masses().size(); ++i)
            if (solid.body_of_points()[i] == 1) on_right += as_vectors<2>(std::span<const double>(force))[i];
        const auto pairs = solid.contact_at(view.q).acting_pairs();
        most_pairs = std::max(most_pairs, pairs.size());
        for (const solid::ActingPair<2>& pair : pairs) {
            largest_force = std::max(largest_force, pair.force.norm());
            if (pair.area <= 0.0 || pair.normal.x() < 0.5) ++bad_pairs;  // from left to right
            on_right -= pair.force;
        }
        largest_difference = std::max(largest_difference, on_right.norm());
        last_pairs = pairs.size();
    }
    std::size_t most_pairs = 0, last_pairs = 0;
    int bad_pairs = 0;
    double largest_force = 0.0, largest_difference = 0.0;
};

TEST_CASE("pairs that push each other carry the whole force between two bodies, under both laws", "[run][outputs]") {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    CAPTURE(static_cast<int>(law));
    PairWitness witness;
    static_cast<void>(run::simulate<2>(two_blocks(), {.law = law}, witness));
    CHECK(witness.most_pairs > 3);
    CHECK(witness.bad_pairs == 0);
    CHECK(witness.largest_force > 1e-3);
    CHECK(witness.largest_difference < 1e-13 * static_cast<double>(witness.most_pairs));
}

TEST_CASE("frames hold as many points as there are pairs in contact, and none where pairs are not asked for",
          "[run][outputs]") {
    const Folder folder;
    run::Scene<2> scene = two_blocks();
    run::RunOptions options{.steps = 40, .out = folder.path(), .frames = 2};
    options.dt = 0.02;  // blocks meet at t = 0.1 s
    PairWitness witness;
    run::ResultFiles<2> files(options, "outputs", "bodies");
    run::Observers<2> observers{files, witness};
    run::RunResult<2> result = run::simulate<2>(scene, options, observers);
    files.finish(scene, result);
    REQUIRE(witness.last_pairs > 0);
    const std::string first = read_text(folder.path() / "frames/bodies_pairs_000000.vtp");
    const std::string last = read_text(folder.path() / "frames/bodies_pairs_000001.vtp");
    CHECK(first.find("NumberOfPoints=\"0\"") != std::string::npos);
    CHECK(last.find("NumberOfPoints=\"" + std::to_string(witness.last_pairs) + "\"") != std::string::npos);
    for (const char* name : {"body 1", "body 2", "normal", "force [N]", "normal force [N]", "gap [m]", "area [m]"})
        CHECK(last.find(std::string("Name=\"") + name + "\"") != std::string::npos);
    CHECK(files.table().find("bodies_pairs.pvd") != std::string::npos);

    scene.outputs.fields.pairs = false;
    run::ResultFiles<2> without(options, "outputs", "bodies");
    static_cast<void>(run::simulate<2>(scene, options, without));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "bodies_pairs.pvd"));
    CHECK(std::filesystem::exists(folder.path() / "bodies_surface.pvd"));
}

TEST_CASE("forces on an obstacle carry its name, and bodies that turn change numbers without changing names",
          "[run][outputs]") {
    run::Scene<2> scene = test::block_on_plane(0.05);
    const std::vector<mesh::Mesh<2>> meshes{
        mesh::structured_box<2>({3.0, 5.0}, {4.0, 6.0}, {1, 1}, mesh::CellShape::quadrangle, "far"), scene.mesh};
    scene.mesh = mesh::combine<2>(meshes);
    scene.solid.materials.assign(2, scene.solid.materials.front());
    scene.solid.kinematics = {solid::Kinematics::rigid, solid::Kinematics::floating};
    scene.velocity = {Vector<2>::Zero(), Vector<2>(0.0, -0.05)};
    scene.outputs = {.forces = true, .interval = 1, .obstacles = {"floor"}};
    run::RunResult<2> result;
    const Csv forces(file_of<2>(scene, {.frames = 0}, "forces.csv", &result));
    REQUIRE_FALSE(forces.rows.empty());
    double impulse = 0.0;
    for (std::size_t row = 0; row < forces.rows.size(); ++row) {
        CHECK(forces.text(row, "body_1") == "block");
        CHECK(forces.text(row, "body_2") == "floor");
        impulse += result.run.dt * forces.number(row, "force_on_2_y");
    }
    const double gained =
        result.bodies.end[1].mass * (result.bodies.end[1].velocity.y() - result.bodies.start[1].velocity.y());
    CHECK(gained > 0.05);
    CHECK(-impulse == Approx(gained).epsilon(1e-12));
}

TEST_CASE("a row of forces says on which body they act, and has the friction of a block that slides, and its slip",
          "[run][outputs][friction]") {
    constexpr double mu = 0.3, g = 10.0;
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {0.8, 0.4}, {8, 4}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 1e7, .poisson = 0.3, .density = 1000.0}};
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 10.0)};
    scene.solid.acceleration = {Vector<2>(0.0, -g)};
    scene.velocity = {Vector<2>(1.0, 0.0)};
    scene.outputs = {.forces = true, .interval = 200, .obstacles = {"floor"}};
    run::RunOptions options{.steps = 200, .settle = true, .frames = 0};
    options.friction.coefficient = mu;
    run::RunResult<2> result;
    const Csv forces(file_of<2>(scene, options, "forces.csv", &result));
    REQUIRE(forces.rows.size() == 1);
    CHECK(forces.text(0, "body_1") == "block");
    CHECK(forces.text(0, "body_2") == "floor");
    // The floor is pulled along by mu times the weight and pressed down by the weight, and goes back past the block, which brakes by mu g.
    // Faces tilt by the strain of the block, some weight/(E area) = 4e-4.
    const double weight = 1000.0 * 0.8 * 0.4 * g, time = forces.number(0, "time"), normal = forces.number(0, "normal_force");
    REQUIRE(mu * g * time < 0.5);
    CHECK(normal == Approx(weight).epsilon(0.05));
    CHECK(forces.number(0, "force_on_2_y") == Approx(-normal).epsilon(1e-3));
    CHECK(forces.number(0, "rubbing_force") == Approx(normal).epsilon(1e-9));
    CHECK(forces.number(0, "force_on_2_x") == Approx(forces.number(0, "friction_on_2_x")).epsilon(1e-3));
    CHECK(forces.number(0, "friction_on_2_x") == Approx(mu * normal).epsilon(0.05));
    CHECK(std::abs(forces.number(0, "friction_on_2_y")) < 1e-3 * weight);
    CHECK(forces.number(0, "slip_velocity_of_2_x") == Approx(-(1.0 - 0.5 * mu * g * time)).epsilon(0.05));
}

TEST_CASE("a probe sees an affine displacement and its stress exactly", "[run][outputs]") {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {5.0, 5.0}, {5, 5}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 2.0, .poisson = 0.25, .density = 1.0}};
    scene.velocity = {Vector<2>::Zero()};
    scene.energy_scale = {"H0", 1.0};
    scene.displacement = [](const Vector<2>& x) { return Vector<2>(0.01 * x.x() + 0.02 * x.y(), -0.03 * x.y()); };
    scene.outputs = {.probes = {{.name = "inside", .position = Vector<2>(2.1, 2.7)}, {.name = "all"}}, .interval = 2};
    const Csv probes(file_of<2>(scene, {.steps = 5, .frames = 0}, "probes.csv"));
    REQUIRE(probes.rows.size() == 4);  // steps 0, 2, 4 and the last
    CHECK(probes.text(3, "step") == "5");
    CHECK(probes.number(0, "inside.displacement_x") == Approx(0.01 * 2.1 + 0.02 * 2.7).epsilon(1e-13));
    CHECK(probes.number(0, "inside.displacement_y") == Approx(-0.03 * 2.7).epsilon(1e-13));
    const double lambda = 0.8, mu = 0.8;  // E nu/((1 + nu)(1 - 2 nu)), E/(2 (1 + nu))
    const double xx = lambda * -0.02 + 2.0 * mu * 0.01, yy = lambda * -0.02 - 2.0 * mu * 0.03, zz = lambda * -0.02,
                 xy = 2.0 * mu * 0.01;
    CHECK(probes.number(0, "inside.stress_xx") == Approx(xx).margin(1e-14));
    CHECK(probes.number(0, "inside.stress_yy") == Approx(yy).epsilon(1e-12));
    CHECK(probes.number(0, "inside.stress_zz") == Approx(zz).epsilon(1e-12));
    CHECK(probes.number(0, "inside.stress_xy") == Approx(xy).epsilon(1e-12));
    const double mises =
        std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) + 3 * xy * xy);
    CHECK(probes.number(0, "inside.von_mises") == Approx(mises).epsilon(1e-12));
    CHECK(probes.number(0, "all.displacement_x") == Approx(0.03 * 2.5).epsilon(1e-13));  // at the middle
}

TEST_CASE("heads of tables give the unit of every column that is no name, number of a step or count", "[run][outputs]") {
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.outputs = {.probes = {{.name = "all"}}, .forces = true, .obstacles = {"floor"}};
    CHECK(Csv(file_of<2>(scene, {.frames = 0}, "forces.csv")).head ==
          "step,time [s],body_1,body_2,force_on_2_x [N/m],force_on_2_y [N/m],normal_force [N/m],friction_on_2_x [N/m],"
          "friction_on_2_y [N/m],rubbing_force [N/m],slip_velocity_of_2_x [m/s],slip_velocity_of_2_y [m/s]");
    CHECK(Csv(file_of<2>(scene, {.frames = 0}, "probes.csv")).head ==
          "step,time [s],all.displacement_x [m],all.displacement_y [m],all.velocity_x [m/s],all.velocity_y [m/s],"
          "all.stress_xx [Pa],all.stress_yy [Pa],all.stress_zz [Pa],all.stress_xy [Pa],all.von_mises [Pa]");
    const Csv energies(file_of<2>(scene, {.frames = 0}, "energy.csv"));
    CHECK_THAT(energies.head, Catch::StartsWith("step,time [s],pseudo_energy [J/m],energy [J/m],kinetic [J/m]") &&
                                  Catch::Contains("linear_momentum_y [kg/s],angular_momentum [kg m/s],parasitic [m/s]"));
    const std::set<std::string> counts{"step",           "active_pairs",       "events",
                                       "restarts",       "restarts_shortened", "restarts_skipped",
                                       "sticking_faces", "sliding_faces",      "eroded_cells"};
    for (const std::string& column : Csv::cells(energies.head)) {
        CAPTURE(column);
        CHECK(column.ends_with("]") != counts.contains(column));
    }
}

TEST_CASE("a probe on a body that spins goes round with it", "[run][outputs]") {
    const auto kinematics = GENERATE(solid::Kinematics::rigid, solid::Kinematics::floating);
    run::Scene<3> scene;
    scene.mesh =
        mesh::structured_box<3>({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, {2, 2, 2}, mesh::CellShape::hexahedron, "block");
    scene.solid.materials = {{.young = 1e4, .poisson = 0.0, .density = 1.0}};
    scene.solid.kinematics = {kinematics};
    scene.velocity = {Vector<3>(0.5, 0.0, 0.0)};
    scene.spin = {AxialVector<3>(0.0, 0.0, 0.1)};
    scene.outputs = {.probes = {{.name = "corner", .position = Vector<3>(1.0, 1.0, 1.0)}}, .interval = 50};
    const Csv probes(file_of<3>(scene, {.time = 1.0, .dt = 2e-3, .frames = 0}, "probes.csv"));
    const std::size_t last = probes.rows.size() - 1;
    const double angle = 0.1, place = std::numbers::pi / 4.0 + angle, r = std::sqrt(2.0);
    // A body that deforms grows by the square of its spin: rho w^2 L^2/E of 1e-6.
    CHECK(probes.number(last, "corner.displacement_x") == Approx(0.5 + r * std::cos(place) - 1.0).margin(1e-5));
    CHECK(probes.number(last, "corner.displacement_y") == Approx(r * std::sin(place) - 1.0).margin(1e-5));
    CHECK(probes.number(last, "corner.displacement_z") ==
          Approx(0.0).margin(kinematics == solid::Kinematics::rigid ? 1e-12 : 1e-6));
}

TEST_CASE("a place beside its body is refused with the distance, one on its skin is taken", "[run][outputs]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {4.0, 2.0}, {4, 2}, mesh::CellShape::quadrangle, "block");
    const std::int32_t inside = run::cell_at<2>(mesh, 0, {3.5, 1.5});
    CHECK((mesh.cell_centroid[inside] - Vector<2>(3.5, 1.5)).norm() < 1e-14);
    CHECK(run::cell_at<2>(mesh, 0, {3.5, 2.0}) == inside);
    CHECK(run::cell_at<2>(mesh, 0, {3.5, 2.4}) == inside);
    CHECK_THROWS_WITH((run::cell_at<2>(mesh, 0, {3.5, 2.6})), Catch::Contains("0.6 m beside body 'block', 0.5 m"));
    CHECK_THROWS_AS((run::cell_at<2>(mesh, 1, {3.5, 1.5})), BadInput);
}

TEST_CASE("frames hold the fields that are asked for", "[run][outputs]") {
    const Folder folder;
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.outputs.fields = {.velocity = false, .stress = false, .von_mises = true, .pressure = false, .gap = true};
    const run::RunOptions options{.steps = 2, .out = folder.path(), .frames = 1};
    run::ResultFiles<2> files(options, "outputs", "bodies");
    static_cast<void>(run::simulate<2>(scene, options, files));
    const std::string cells = read_text(folder.path() / "frames/bodies_000000.vtu");
    const std::string surface = read_text(folder.path() / "frames/bodies_surface_000000.vtp");
    CHECK(cells.find("displacement") != std::string::npos);
    CHECK(cells.find("von Mises") != std::string::npos);
    CHECK(cells.find("velocity") == std::string::npos);
    CHECK(cells.find("stress") == std::string::npos);
    CHECK(surface.find("gap") != std::string::npos);
    CHECK(surface.find("pressure") == std::string::npos);
}
