#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/input/read_settings.hpp"
#include "input/scenes.hpp"

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

namespace {

/// A scene of two blocks with lines behind it and values set, and the keys of it that nothing can read.
struct Idle {
    std::string more;
    std::vector<std::string> set;
    std::vector<std::string> keys;
};

std::vector<std::string> faults_of(const std::string& more, const std::vector<std::string>& set,
                                   const std::function<void(run::RunOptions&)>& options = {}) {
    const WrittenScene file(two_blocks(more));
    std::vector<std::string> texts;
    for (const input::Fault& fault : input::check_scene(file.path(), {.set = set, .options = options}).faults)
        texts.push_back(fault.text);
    return texts;
}

/// In the order of `keys`: each fault says of one that it has no effect.
bool says_of_each(const std::vector<std::string>& faults, const std::vector<std::string>& keys) {
    return std::ranges::all_of(keys, [&](const std::string& key) {
        return std::ranges::any_of(faults,
                                   [&](const std::string& text) { return text.starts_with(key + " has no effect"); });
    });
}

}  // namespace

TEST_CASE("a key that nothing reads is refused by its name, and those beside it are not", "[input][idle]") {
    const std::vector<Idle> all = {
        // of materials: what the law, the kinematics or the temperature of the body does not ask for
        {"", {"bodies.left.hardening=1"}, {"bodies.left.hardening"}},
        {"", {"bodies.left.hardening_table=[[0, 1], [1, 2]]"}, {"bodies.left.hardening_table"}},
        {"", {"bodies.left.young_2=1", "bodies.left.axis_1=[0, 1]"}, {"bodies.left.young_2", "bodies.left.axis_1"}},
        {"", {"bodies.left.thermal_expansion=1e-5"}, {"bodies.left.thermal_expansion"}},
        {"",
         {"bodies.left.kinematics=rigid", "bodies.left.law=neo_hookean", "bodies.left.stiffness_damping=1e-3",
          "bodies.left.mass_damping=1", "bodies.left.eta=2", "bodies.left.temperature_rise=3", "bodies.left.self=true"},
         {"bodies.left.law", "bodies.left.stiffness_damping", "bodies.left.mass_damping", "bodies.left.eta",
          "bodies.left.temperature_rise", "bodies.left.self"}},
        {"[materials.brass]\nyoung = 1\ndensity = 1\nthermal_expansion = 1e-5", {}, {"materials.brass"}},
        {"[materials.brass]\nyoung = 1\ndensity = 1\nthermal_expansion = 1e-5\n[bodies.third]\nshape = \"disc\"\nradius = "
         "1\n"
         "size = 0.5\nplace = [9, 9]\nmaterial = \"brass\"\ndensity = 2",
         {},
         {"materials.brass.thermal_expansion", "materials.brass.density"}},
        // of contact
        {"[contact]\ndecay_speed = 1\nfriction = 0.3", {}, {"contact.decay_speed"}},
        {"[contact]\nrelaxation_time = 1", {}, {"contact.relaxation_time"}},
        {"[laboratory]\nself_contact_rings = 2", {}, {"laboratory.self_contact_rings"}},
        {"kinematics = \"rigid\"\n[contact]\nself = true", {}, {"contact.self"}},
        {"[contact]\nenabled = false\nfriction = 0.3\nskin = 1\n[[contact.pairs]]\nbodies = [\"left\", \"right\"]\n"
         "friction = 0.1\n[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 1]\n[output]\nforces = true",
         {},
         {"contact.friction", "contact.skin", "contact.pairs", "obstacles", "output.forces"}},
        {"[[contact.pairs]]\nbodies = [\"left\", \"right\"]\ninterference_time = 1e-3\nfriction = 0.1",
         {},
         {"contact.pairs[0].interference_time"}},
        {"[contact]\nlaw = \"pair_potential\"\n[laboratory]\nquadrature = 1", {}, {"laboratory.quadrature"}},
        {"[contact]\nlaw = \"pair_potential\"\n[laboratory]\ncorners = \"fixed\"", {}, {"laboratory.corners"}},
        {"kinematics = \"finite\"\n[laboratory]\nfree_faces = \"extrapolate\"", {}, {"laboratory.free_faces"}},
        {"[laboratory]\ncorners = \"fixed\"", {}, {"laboratory.corners"}},
        // of the run and its files
        {"steps = 3\ntime = 1", {}, {"run.steps"}},
        {"dt = 1e-3\ncfl = 0.5", {}, {"run.cfl"}},
        {"[laboratory]\nlevels = 3\ngauge = 2", {}, {"laboratory.levels", "laboratory.gauge"}},
        {"integrator = \"leapfrog\"\nrestart = 10\nfilter = \"neutral\"", {}, {"run.restart", "run.filter"}},
        {"[laboratory]\nmean_force = \"trapezoid\"", {}, {"laboratory.mean_force"}},
        {"rebalance_above = 2", {}, {"run.rebalance_above"}},
        {"[output]\nframes = 0\nformat = \"xdmf\"\nfields = [\"stress\"]", {}, {"output.format", "output.fields"}},
        // of bonds and springs
        {"[[bonds]]\nbodies = [\"left\", \"right\"]\nfracture_energy = 1",
         {"bodies.right.place=[-0.5, 0]"},
         {"bonds[0].fracture_energy"}},
        {"integrator = \"leapfrog\"\n[[bonds]]\nbodies = [\"left\", \"right\"]\nstrength = 1\nfracture_energy = 1e-3",
         {"bodies.right.place=[-0.5, 0]"},
         {"bonds[0].strength"}},
        {"[springs.a]\nfrom = {point = [0, 0], radius = 1}\nto = {body = \"left\", point = [0, 0]}\nstiffness = 1",
         {},
         {"springs.a.from.radius"}}};
    for (const Idle& idle : all) {
        CAPTURE(idle.more, idle.set);
        const std::vector<std::string> faults = faults_of(idle.more, idle.set);
        CAPTURE(faults);
        CHECK(says_of_each(faults, idle.keys));
        CHECK(faults.size() == idle.keys.size());
    }
}

TEST_CASE("with what reads them the same keys are in order", "[input][idle]") {
    const std::vector<std::pair<std::string, std::vector<std::string>>> all = {
        {"", {"bodies.left.law=j2", "bodies.left.yield_stress=1", "bodies.left.hardening=1"}},
        {"", {"bodies.left.thermal_expansion=1e-5", "bodies.left.temperature_rise=3"}},
        {"[materials.brass]\nyoung = 1\ndensity = 1\nthermal_expansion = 1e-5\n[bodies.third]\nshape = \"disc\"\nradius = "
         "1\nsize = 0.5\nplace = [9, 9]\nmaterial = \"brass\"\ntemperature_rise = 1",
         {}},
        {"[contact]\ndecay_speed = 1\nfriction = 0.3\nsliding_friction = 0.2\nrelaxation_time = 1", {}},
        {"[contact]\nself = true\nlaw = \"reconstruction\"\n[laboratory]\nself_contact_rings = 2", {}},
        {"[contact]\nself = true", {}},
        {"[contact]\nenabled = false\n[laboratory]\nfree_faces = \"extrapolate\"",
         {}},  // of all free faces, whatever touches them
        {"[[contact.pairs]]\nbodies = [\"left\", \"right\"]\ninterference = \"resolve\"\ninterference_time = 1e-3", {}},
        {"integrator = \"memm_async\"\n[contact]\nlaw = \"reconstruction\"\n[laboratory]\nlevels = 3", {}},
        {"[laboratory]\nmean_force = \"trapezoid\"", {"bodies.left.kinematics=finite"}},
        {"[output]\nframes = 3\nformat = \"xdmf\"\nfields = [\"stress\"]\nforces = true\nsample_interval = 3", {}},
        {"[[bonds]]\nbodies = [\"left\", \"right\"]\nfracture_energy = 1\nstrength = 1e-3",
         {"bodies.right.place=[-0.5, 0]"}}};
    for (const auto& [more, set] : all) {
        CAPTURE(more, set);
        const std::vector<std::string> faults = faults_of(more, set);
        CAPTURE(faults);
        CHECK(faults.empty());
    }
}

TEST_CASE("0, false and the default ask for nothing, and a sweep may go through 0", "[input][idle]") {
    CHECK(faults_of("[laboratory]\nquadrature = 0\n[contact]\nself = false\nfriction = 0\nrelaxation_time = 1", {}).empty());
    CHECK(faults_of("", {"bodies.left.hardening=0", "bodies.left.law=st_venant_kirchhoff"}).empty());
    CHECK(faults_of("[contact]\nfriction = 0.3\nrelaxation_time = 1", {"contact.friction=0"}).empty());
}

TEST_CASE("a key of the file may be idle by what replaces others of it, and a key that replaces one may not",
          "[input][idle]") {
    const std::string rubs = "[contact]\nfriction = 0.3";
    CHECK(faults_of(rubs, {"contact.enabled=false"}).empty());
    CHECK(faults_of("cfl = 0.5", {"run.dt=1e-3"}).empty());
    CHECK(faults_of("cfl = 0.5", {"run.dt=1e-3", "run.cfl=0.4"}).size() == 1);
    CHECK(faults_of(rubs, {"contact.enabled=false", "contact.skin=1"}).size() == 1);
    // One that is idle in the file itself stays so.
    CHECK(faults_of("[contact]\nrelaxation_time = 1", {"run.cfl=0.5"}).size() == 1);
    const auto ends_later = [](run::RunOptions& options) { options.cfl = 0.4; };
    CHECK(faults_of("[contact]\nrelaxation_time = 1", {}, ends_later).size() == 1);
    CHECK(faults_of("[output]\nformat = \"xdmf\"", {}, [](run::RunOptions& options) { options.frames = 0; }).empty());
}

TEST_CASE("a key that is set takes the place of its alternative in the file: steps of time, cfl of dt, and back",
          "[input][idle]") {
    const auto options_of = [](const std::string& more, const std::vector<std::string>& set) {
        const WrittenScene file(two_blocks(more));
        const input::ReadSettings read = input::read_settings(file.path(), {.set = set});
        CAPTURE(input::text_of(read.faults));
        CHECK(read.faults.empty());
        return read.settings.options;
    };
    const run::RunOptions steps = options_of("time = 2", {"run.steps=7"}), time = options_of("", {"run.time=2"});
    CHECK(steps.steps == 7);
    CHECK(std::isnan(steps.time));
    CHECK(time.steps == 0);
    CHECK(time.time == 2.0);
    const run::RunOptions cfl = options_of("dt = 1e-3", {"run.cfl=0.4"}), dt = options_of("cfl = 0.4", {"run.dt=1e-3"});
    CHECK(cfl.cfl == 0.4);
    CHECK(std::isnan(cfl.dt));
    CHECK(dt.dt == 1e-3);
    CHECK(dt.cfl == run::RunOptions{}.cfl);
}

TEST_CASE("all scenes that Abut brings along have no key that nothing reads", "[input][idle]") {
    int n = 0;
    for (const auto& entry : std::filesystem::directory_iterator(ABUT_SOURCE "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        const input::ReadSettings read = input::read_settings(entry.path(), {});
        CAPTURE(input::text_of(read.faults));
        CHECK(read.faults.empty());
        ++n;
    }
    CHECK(n > 20);
}
