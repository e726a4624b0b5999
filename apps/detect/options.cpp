#include "apps/detect/options.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/detect/shapes.hpp"
#include "apps/support/command_line.hpp"
#include "apps/support/contact_choices.hpp"

namespace abut::apps {
namespace {

using mesh::UnusableFaces;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

const Choices<UnusableFaces> policies = {{"fail", UnusableFaces::fail}, {"skip", UnusableFaces::skip}};
const Limits length{.unit = "m", .above = 0.0};

void add_bodies(CLI::App& app, DetectOptions& options) {
    app.add_option("mesh", options.inputs, "files (.obj .off .ply .stl .vtp .vtu .msh) or shapes (see below), each a body")
        ->type_name("FILE|SHAPE ...")
        ->required();
    app.add_flag("--connected", options.connected, "every connected part a body, whatever a file says")
        ->default_str("off")
        ->group("Bodies");
    add_choice(app, "--unusable", options.unusable, "faces that cannot be used end the run, or are left out and counted",
               policies)
        ->group("Bodies");
    add_number(app, "--planarity-tolerance", options.planarity_tolerance,
               "how far a corner may lie off the plane of its face, over the size of the face: beyond it polygons are cut "
               "into triangles, and cells are refused",
               {.above = 0.0, .zero = true})
        ->group("Bodies");
    app.add_flag("--self-intersections", options.self_intersections, "look for them in every surface as it comes")
        ->default_str("off")
        ->group("Bodies");
}

/// One text an occurrence; what follows is not its own.
void add_repeated(CLI::App& app, const char* name, std::vector<std::string>& values, const char* type, const char* help) {
    app.add_option(name, values, help)->type_name(type)->allow_extra_args(false)->group("Motion");
}

void add_motion(CLI::App& app, DetectOptions& options) {
    add_repeated(app, "--translate", options.translations, "BODY:X,Y,Z",
                 "moves a body (name, or number from 0) over the whole run [m]; by default at rest");
    add_repeated(app, "--rotate", options.rotations, "BODY:AX,AY,AZ,DEG[,CX,CY,CZ]",
                 "turns it over the whole run, before it is moved; by default not; centre: that of its box");
    app.add_option("--script", options.script,
                   "CSV step,body,x,y,z,rx,ry,rz: place from the start [m] and rotation vector [degrees] about the centre "
                   "of its box; by default none")
        ->type_name("FILE")
        ->group("Motion");
    app.add_option("--displacement", options.displacement,
                   "point array of .vtp and .vtu files, the displacement over the whole run; by default none")
        ->type_name("NAME")
        ->group("Motion");
    add_count(app, "--steps", options.steps,
              "equal parts of the run, the start comes before; 0: 10, the last of the script, or none at rest", 0)
        ->group("Motion");
    add_number(app, "--largest-motion", options.largest_motion,
               "farther than this times the extent of all bodies no corner may move in a step", {.above = 0.0})
        ->group("Motion");
}

void add_search(CLI::App& app, DetectOptions& options) {
    const auto grouped = [](CLI::Option* option) { return option->group("Contact"); };
    grouped(add_number(app, "--distance", options.distance,
                       "overlaps up to this gap are kept; by default half the mean size of a face, sqrt(area)", length));
    grouped(add_number(app, "--depth", options.depth,
                       "overlaps with a gap of minus this or deeper are not; by default as --distance", length));
    grouped(app.add_flag("--self", options.search.self_contact, "also pairs within a body")->default_str("off"));
    grouped(add_count(app, "--rings", options.search.self_contact_rings,
                      "of --self: faces within so many steps over common corners are left out", 0));
    grouped(
        add_number(app, "--facing", options.search.facing_cosine,
                   "faces look at each other where the product of their normals is below this",
                   {.above = -1.0, .below = 0.0, .closed = true, .remedy = "Faces beyond a right angle share no plane."}));
    grouped(add_choice(app, "--area", options.area, "arithmetic of areas: filtered doubles or CGAL's exact numbers", areas));
    grouped(add_choice(app, "--broad-phase", options.search.broad_phase, "what finds boxes that overlap; all find the same",
                       broad_phases));
    grouped(add_number(app, "--skin", options.skin,
                       "how far two faces may move together before candidates are searched again; by default chosen as the "
                       "run goes, next to nothing where bodies turn, deform or rest",
                       length));
    grouped(add_number(app, "--max-pairs", options.max_pairs, "candidates at most; by default 250 million",
                       {.above = 0.0, .below = 4294967295.0, .closed = true}));
    grouped(add_number(app, "--max-memory", options.max_memory, "of a search, by default all there is",
                       {.unit = "MB", .above = 0.0}));
}

void add_verification(CLI::App& app, DetectOptions& options) {
    app.add_flag("--verify", options.verify, "check every step against all pairs; one missed ends in exit code 1")
        ->default_str("off")
        ->group("Verification");
    add_number(app, "--verify-tests", options.verify_tests,
               "pairs tested per step; with more, a sample of faces against all", {.above = 0.0})
        ->group("Verification");
    add_count(app, "--verify-samples", options.verify_samples, "faces of that sample; 0: as --verify-tests allows", 0)
        ->group("Verification");
    add_count(app, "--seed", options.seed, "of the sample", 0)->group("Verification");
}

void add_output(CLI::App& app, DetectOptions& options) {
    app.add_option("--out", options.out, "folder of all results; made if it is not there")
        ->type_name("DIR")
        ->capture_default_str()
        ->group("Output");
    app.add_flag("--no-files", options.no_files, "print only")->default_str("off")->group("Output");
    add_count(app, "--write-every", options.write_every, "steps between those whose pairs are written; 0: the last only", 0)
        ->group("Output");
    add_count(app, "--threads", options.threads, "threads; 0: all. The results do not depend on it", 0)->group("Output");
}

nlohmann::ordered_json number_or_null(double value) {
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

}  // namespace

const Program detect_program{
    .name = "abut detect",
    .purpose = "Contact detection on complex meshes: says what it found.",
    .footer =
        shapes_help() +
        "Example, interlocked tori 0.1 apart: abut detect torus:n=4000 torus:n=4000,x=1,axis=1,tube=0.6 --distance 0.12\n"
        "Ctrl-C ends a run after its present step; its files are complete until there."};

DetectOptions::DetectOptions()
    : distance(not_given), depth(not_given), skin(not_given), max_memory(not_given), max_pairs(not_given) {}

void add_options(CLI::App& app, DetectOptions& options) {
    add_bodies(app, options);
    add_motion(app, options);
    add_search(app, options);
    add_verification(app, options);
    add_output(app, options);
}

nlohmann::ordered_json to_json(const DetectOptions& options) {
    return {{"inputs", options.inputs},
            {"connected", options.connected},
            {"unusable", name_of(policies, options.unusable)},
            {"planarity_tolerance", options.planarity_tolerance},
            {"self_intersections", options.self_intersections},
            {"translate", options.translations},
            {"rotate", options.rotations},
            {"script", options.script},
            {"displacement", options.displacement},
            {"steps", options.steps},
            {"largest_motion", options.largest_motion},
            {"distance", number_or_null(options.distance)},
            {"depth", number_or_null(options.depth)},
            {"self", options.search.self_contact},
            {"rings", options.search.self_contact_rings},
            {"facing", options.search.facing_cosine},
            {"area", name_of(areas, options.area)},
            {"broad_phase", name_of(broad_phases, options.search.broad_phase)},
            {"skin", number_or_null(options.skin)},
            {"max_pairs", number_or_null(options.max_pairs)},
            {"max_memory", number_or_null(options.max_memory)},
            {"threads", options.threads},
            {"verify", options.verify},
            {"verify_tests", options.verify_tests},
            {"verify_samples", options.verify_samples},
            {"seed", options.seed},
            {"out", options.out.string()},
            {"write_every", options.write_every}};
}

}  // namespace abut::apps
