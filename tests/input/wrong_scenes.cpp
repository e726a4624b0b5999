#include "input/wrong_scenes.hpp"

#include <fmt/format.h>

#include "input/scenes.hpp"

namespace abut::test {
namespace {

/// Without the folder of the scene, which is another one each time.
std::string without_folder(std::string text, const std::filesystem::path& folder) {
    const std::string path = folder.string() + "/";
    for (auto found = text.find(path); found != std::string::npos; found = text.find(path)) text.erase(found, path.size());
    return text;
}

}  // namespace

std::string page_of_wrong_scenes() {
    std::string page = fmt::format(R"md(# Wrong scenes, and what is said of each

Two blocks of a scene ([scenes.md](scenes.md)) with something wrong behind its last line, 18, or set by `--set`, and what
`abut check` and `abut run` say of it. A test compares this page with that; `test_input "[.page]"` writes it. The scene:

```toml
{}```
)md",
                                   two_blocks());
    for (const WrongScene& wrong : wrong_scenes()) {
        const WrittenScene file(two_blocks(wrong.more));
        const auto checked = input::check_scene(file.path(), {.set = wrong.set});
        page += "\n```toml\n" + (wrong.more.empty() ? "" : wrong.more + "\n");
        for (const std::string& set : wrong.set) page += "# --set " + set + "\n";
        page += "```\n\n    " + without_folder(input::text_of(checked.faults), file.path().parent_path()) + "\n";
    }
    return page;
}

const std::vector<WrongScene>& wrong_scenes() {
    static const std::vector<WrongScene> scenes = {
        {"[bodies.third]\nshape = \"dsc\"\nyoung = 1\ndensity = 1",
         {},
         ".toml:20:1",
         {"bodies.third.shape is 'dsc'", "Did you mean 'disc'?"}},
        {"[bodies.third]\nyoung = 1\ndensity = 1", {}, ".toml:19:9", {"bodies.third.shape is missing", "'fan_disc'"}},
        {"[bodies.third]\nshape = \"sphere\"\nyoung = 1\ndensity = 1",
         {},
         ".toml:20:1",
         {"'sphere'", "none of its words", "'disc'"}},
        {"[bodies.third]\nshape = \"disc\"\nyoung = 1\ndensity = 1\nsize = 1",
         {},
         ".toml:19:9",
         {"radius is missing", "[m]"}},
        {"[bodies.third]\nmesh = \"nowhere.vtu\"\nyoung = 1\ndensity = 1", {}, ".toml:19:9", {"nowhere.vtu"}},
        {"[bodies.third]\nmesh = \"scene.toml\"\nyoung = 1\ndensity = 1", {}, ".toml:19:9", {"scene.toml", ".msh"}},
        {"[bodies.third]\nshape = \"disc\"\nradius = 1\nsize = 0.5\nyoung = 1\ndensity = 1\nplace = [0.5, 0.5]",
         {},
         ".toml:19:9",
         {"'left' and 'third' overlap", "m inside each other", "place"}},
        {"[bodies.third]\nsurface = \"ball.stl\"\nyoung = 1\ndensity = 1",
         {},
         ".toml:19:9",
         {"shape is missing", "'disc'"}},  // 3D only
        {"[bodies.wheel]\nshape = \"gear\"\nyoung = 1\ndensity = 1\nplace = [9, 9]\nteeth = 16\nradius = 2\nbore = 1.8",
         {},
         ".toml:19:9",
         {"the bore is 1.8 m", "below 1.6875 m", "Change bore"}},
        {"[bodies.wheel]\nshape = \"gear\"\nyoung = 1\ndensity = 1\nplace = [9, 9]\nteeth = 16\nradius = 2\nbore = "
         "1\ncells_per_tooth = 3",
         {},
         ".toml:19:9",
         {"3 cells", "even number"}},
        {"[bodies.wheel]\nshape = \"gear\"\nyoung = 1\ndensity = 1\nplace = [9, 9]\nteeth = 16\nradius = 2\nbore = "
         "1\nbacklash "
         "= 0.2",
         {},
         ".toml:19:9",
         {"the tip of a tooth", "above 0 m", "backlash"}},
        {"[bodys.left]\nyoung = 1", {}, ".toml:19:2", {"bodys is an unknown key", "'bodies'"}},
        {"cfk = 0.5", {}, ".toml:19:1", {"run.cfk is an unknown key", "'cfl'"}},
        {"cfl = 1.5", {}, ".toml:19:1", {"run.cfl is 1.5", "above 0, at most 1"}},
        {"preset = \"fats\"", {}, ".toml:19:1", {"run.preset is 'fats'", "Did you mean 'fast'?"}},
        {"cfl = true", {}, ".toml:19:1", {"run.cfl is true", "a number is needed"}},
        {"dt = -1", {}, ".toml:19:1", {"run.dt is -1 s", "above 0 s"}},
        {"integrator = \"leapfrg\"", {}, ".toml:19:1", {"'leapfrg'", "Did you mean 'leapfrog'?"}},
        {"threads = 1.5", {}, ".toml:19:1", {"run.threads is the number 1.5", "a whole number"}},
        {"restart = -2", {}, ".toml:19:1", {"run.restart is -2", "0 or more"}},
        {"allow_unstable = true", {}, ".toml", {"run.allow_unstable", "run.dt"}},
        {"integrator = \"leapfrog\"\nfilter = \"neutral\"", {}, ".toml", {"--filter neutral", "leapfrog"}},
        {"dt = 10", {}, ".toml", {"--dt", "above the stable step"}},
        {"[run]", {}, ".toml:19:", {"no TOML"}},
        {"cfl = ", {}, ".toml:19:", {"no TOML"}},
        {"cfl = 2020-01-01", {}, ".toml:19:1", {"a date"}},
        {"[contact]\nevents = \"on\"", {}, ".toml:20:1", {"contact.events is the text 'on'", "true or false"}},
        {"[contact]\nignored_pairs = [\"left\", \"right\"]", {}, ".toml:20:1", {"a list of 2", "list of pairs of names"}},
        {"[contact]\nignored_pairs = [[\"left\", \"floor\"]]",
         {},
         ".toml:20:18",
         {"'floor', which is no body", "'left', 'right'"}},
        {"[contact]\nquadrature = 4", {}, ".toml:20:1", {"contact.quadrature is 4", "0 to 3"}},
        {"[contact]\nskin = -1", {}, ".toml:20:1", {"-1 m", "0 m or above"}},
        {"[contact]\nfacing_cosine = 0.5", {}, ".toml:20:1", {"0.5", "above -1, below 0"}},
        {"[output]\nframes = [1]", {}, ".toml:20:1", {"output.frames is a list of 1", "whole number"}},
        {"[output]\nfields = [\"strain\"]", {}, ".toml:20:", {"output.fields is 'strain'", "'stress'"}},
        {"[output]\nfields = []", {}, ".toml:20:1", {"a list of 0", "a list of words such as"}},
        {"[output]\nforces = 1", {}, ".toml:20:1", {"output.forces is the number 1", "true or false"}},
        {"[output.probes.tip]\npoint = [0, 0]", {}, ".toml:19:16", {"output.probes.tip.body is missing"}},
        {"[output.probes.tip]\nbody = \"rihgt\"", {}, ".toml:19:16", {"'rihgt', which is no body", "'right'"}},
        {"[output.probes.tip]\nbody = \"left\"\npoint = [0.5, 1.5]",
         {},
         ".toml:19:16",
         {"0.5 m beside body 'left'", "0.25 m is allowed", "inside of it"}},
        {"[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 0]", {}, ".toml:19:12", {"normal is zero"}},
        {"[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1, 0]\nnormal = [0, 1]",
         {},
         ".toml:21:1",
         {"a list of 2 numbers [m]"}},
        {"[obstacles.floor]\nshape = \"box\"\nlower = [0, 0]\nupper = [1, -1]",
         {},
         ".toml:19:12",
         {"lower has to be below upper"}},
        {"[obstacles.floor]\nshape = \"polygon\"\ncorners = [[0, 0], [1, 0]]", {}, ".toml:21:1", {"3 points or more [m]"}},
        {"[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 1]\nvelocity = [0, 0]\npath = [0, \"t\"]",
         {},
         ".toml:19:12",
         {"velocity and path"}},
        {"[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 1]\npath = [0, \"x\"]",
         {},
         ".toml:23:1",
         {"path, component 2", "no name 'x'", "'t'"}},
        {"[obstacles.floor]\nshape = \"plane\"\npoint = [0.5, 0.25]\nnormal = [0, 1]\nhalf_width = 0.6",
         {},
         ".toml:19:12",
         {"'floor' and body 'left' overlap", "0.25 m inside a cell", "place"}},
        {"[obstacles.stone]\nshape = \"box\"\nlower = [-1, -1]\nupper = [1.2, 2]",
         {},
         ".toml:19:12",
         {"'stone' and body 'left' overlap", "whole body is inside"}},
        {"[obstacles.room]\nshape = \"box\"\nlower = [1.2, -1]\nupper = [3, 3]\ninside = true",
         {},
         ".toml:19:12",
         {"'room' and body 'left'", "outside of its room"}},
        {"[obstacles.pin]\nshape = \"polygon\"\ncorners = [[0.1, 0.1], [0.2, 0.1], [0.2, 0.2]]",
         {},
         ".toml:19:12",
         {"'pin' and body 'left'", "inside a cell"}},
        {"[obstacles.wheel]\nshape = \"box\"\nlower = [3, 3]\nupper = [4, 4]\nspin = 1\nrotation = \"t\"",
         {},
         ".toml:19:12",
         {"spin and rotation"}},
        {"[obstacles.wheel]\nshape = \"box\"\nlower = [3, 3]\nupper = [4, 4]\npivot = [0, 0]",
         {},
         ".toml:19:12",
         {"does not turn"}},
        {"[obstacles.wheel]\nshape = \"box\"\nlower = [3, 3]\nupper = [4, 4]\nspin = [0, 0, 1]",
         {},
         ".toml:23:1",
         {"a number [rad/s]"}},
        {"[obstacles.wheel]\nshape = \"box\"\nlower = [3, 3]\nupper = [4, 4]\nrotation = \"x\"",
         {},
         ".toml:23:1",
         {"no name 'x'", "'t'"}},
        {"[contact]\nlaw = \"reconstruction\"\n[obstacles.wheel]\nshape = \"box\"\nlower = [3, 3]\nupper = [4, 4]\nspin = 1",
         {},
         ".toml",
         {"contact.law is 'reconstruction'", "obstacles.wheel may turn", "\"automatic\""}},
        {"[contact]\nlaw = \"reconstruction\"",
         {"bodies.left.kinematics=rigid"},
         ".toml",
         {"contact.law is 'reconstruction'", "bodies.left may turn"}},
        {"kinematics = \"floating\"\n[contact]\nlaw = \"reconstruction\"", {}, ".toml", {"bodies.left may turn"}},
        {"[supports.end]\ngroup = \"left.xmin\"",
         {"bodies.left.kinematics=rigid"},
         ".toml:19:11",
         {"supports.end holds body 'left', which is rigid", "[springs.NAME]"}},
        {"kinematics = \"floating\"\n[supports.end]\ngroup = \"left.xmin\"", {}, ".toml:20:11", {"which is floating"}},
        {"[supports.end]\ngroup = \"left.xmin\"\nvalue = [\"t\", 0]",
         {"bodies.left.kinematics=finite"},
         ".toml:19:11",
         {"which is finite", "constant value"}},
        {"[tractions.wind]\ngroup = \"left.xmin\"\npressure = 1\nfollows = true",
         {"bodies.left.kinematics=finite"},
         ".toml:19:12",
         {"follows body 'left', which is finite", "Leave follows out"}},
        {"[supports.end]\ngroup = \"left.xmim\"", {}, ".toml:19:11", {"'left.xmim'", "Did you mean 'left.xmin'?"}},
        {"[supports.end]\nvalue = [0, 0]", {}, ".toml:19:11", {"supports.end.group is missing"}},
        {"[supports.end]\ngroup = \"left.xmin\"\nconstraint = \"components\"", {}, ".toml:19:11", {"components is missing"}},
        {"[supports.end]\ngroup = \"left.xmin\"\ncomponents = [\"x\"]", {}, ".toml:19:11", {"constraint = \"components\""}},
        {"[supports.end]\ngroup = \"left.xmin\"\nconstraint = \"components\"\ncomponents = [\"z\"]",
         {},
         ".toml:22:1",
         {"'z'", "'x', 'y'"}},
        {"[supports.a]\ngroup = \"left.xmin\"\n[supports.b]\ngroup = \"left.xmin\"", {}, ".toml", {"left.xmin"}},
        {"[tractions.pull]\ngroup = \"left.xmin\"\nvalue = [\"2*\", 0]", {}, ".toml:21:", {"component 1", "cannot be read"}},
        {"[tractions.pull]\ngroup = \"left.xmin\"", {}, ".toml:19:12", {"tractions.pull.value is missing", "[Pa]"}},
        {"[tractions.pull]\ngroup = \"left.xmin\"\nvalue = [1, 0]\npressure = 1", {}, ".toml:19:12", {"value and pressure"}},
        {"[tractions.pull]\ngroup = \"left.xmin\"\npressure = \"z\"", {}, ".toml:21:", {"no name 'z'", "'x', 'y'"}},
        {"[springs.a]\nfrom = {point = [0, 0]}\nto = {body = \"left\", point = [0, 0]}",
         {},
         ".toml:19:10",
         {"does nothing", "[N/m]"}},
        {"[springs.a]\nfrom = {point = [0, 0]}\nstiffness = 1", {}, ".toml:19:10", {"springs.a.to is missing"}},
        {"[springs.a]\nfrom = {point = [0, 0]}\nto = {body = \"lift\", point = [0, 0]}\nstiffness = 1",
         {},
         ".toml:21:1",
         {"springs.a.to.body is 'lift', which is no body", "Did you mean 'left'?"}},
        {"[springs.a]\nfrom = {place = [0, 0], point = [1, 1]}\nto = {body = \"left\", point = [0, 0]}\nstiffness = 1",
         {},
         ".toml:20:9",
         {"springs.a.from.place is an unknown key"}},
        {"[springs.a]\nfrom = {point = [0, 0]}\nto = {point = [0, 0], radius = -1}\nstiffness = 1",
         {},
         ".toml:21:",
         {"springs.a.to.radius is -1 m", "0 m or above"}},
        {"[moments.a]\nbody = \"left\"", {}, ".toml:19:10", {"does nothing", "[N m]"}},
        {"[moments.a]\nbody = \"leftt\"\nvalue = 1", {}, ".toml:19:10", {"moments.a.body is 'leftt'", "'left'"}},
        {"[moments.a]\nbody = \"left\"\nvalue = [0, 0, 1]",
         {},
         ".toml:21:1",
         {"moments.a.value is a list of 3", "a number [N m]"}},
        {"[tractions.pull]\ngroup = \"left.xmin\"\nvalue = [\"z\", 0]", {}, ".toml:21:", {"no name 'z'", "'x', 'y'"}},
        {"[materials.steel]\nyoung = 1", {}, ".toml:19:12", {"materials.steel.density is missing", "[kg/m^3]"}},
        {"[materials.steel]\nyoung = 1\ndensity = 1",
         {"bodies.left.material=steal"},
         "--set bodies.left.material=steal",
         {"'steal', which is no material", "Did you mean 'steel'?"}},
        {"", {"bodies.left.material=steel"}, "--set bodies.left.material=steel", {"no material", "Give [materials.steel]"}},
        {"", {"bodies.left.material=3"}, "--set bodies.left.material=3", {"bodies.left.material is the number 3", "a text"}},
        {"", {"dim=4"}, "--set dim=4", {"dim is 4", "2 to 3"}},
        {"", {"bodies.left.density=0"}, "--set bodies.left.density=0", {"0 kg/m^3", "above 0 kg/m^3"}},
        {"", {"bodies.left.densty=2"}, "--set bodies.left.densty=2", {"'density'"}},
        {"", {"bodies.left.poisson=0.5"}, "--set bodies.left.poisson=0.5", {"below 0.5"}},
        {"", {"bodies.left.young='1/0'"}, "--set bodies.left.young='1/0'", {"not finite"}},
        {"", {"bodies.left.kinematics=stiff"}, "--set bodies.left.kinematics=stiff", {"'stiff'", "'rigid'"}},
        {"", {"bodies.left=3"}, "--set bodies.left=3", {"bodies.left is the number 3", "a table is needed"}},
        {"", {"bodies.left.counts=[2, 0]"}, "--set bodies.left.counts=[2, 0]", {"counts, component 2 is 0", "1 or more"}},
        {"", {"bodies.right.place=[-0.6, 0]"}, ".toml:10:9", {"overlap", "0.1 m"}},
        {"", {"run.steps=0"}, ".toml", {"when the run ends", "run.time [s]"}},
        {"", {"density"}, "--set density", {"a key and its value"}}};
    return scenes;
}

}  // namespace abut::test
