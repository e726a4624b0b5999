#include "apps/detect/options.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "abut/contact/option_table.hpp"
#include "apps/detect/placing.hpp"
#include "apps/detect/shapes.hpp"
#include "apps/support/command_line.hpp"
#include "apps/support/contact_choices.hpp"

namespace abut::apps {
namespace {

using mesh::UnusableFaces;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

const Choices<UnusableFaces> policies = {{"fail", UnusableFaces::fail}, {"skip", UnusableFaces::skip}};
const Limits length{.unit = "m", .above = 0.0};

/// An option of searches that runs have as well, as their table has it except for what `differ` changes.
void add_of_search(CommandParser& parser, DetectOptions& options, const char* name,
                   const std::function<void(OptionFacts&)>& differ) {
    BoundOption option = bound(named(contact::search_options(), name), options.search);
    OptionFacts facts = *option.facts;
    facts.group = "Contact";
    differ(facts);
    option.facts = &facts;
    add_option(parser, option);
}

void add_bodies(CommandParser& parser, DetectOptions& options) {
    parser.texts("mesh", options.inputs, "files (.obj .off .ply .stl .vtp .vtu .msh) or shapes (see below), each a body")
        .takes("FILE|SHAPE ...")
        .required();
    parser.flag("--connected", options.connected, "every connected part a body, whatever a file says")
        .by_default("off")
        .group("Bodies");
    add_choice(parser, "--unusable", options.unusable, "faces that cannot be used end the run, or are left out and counted",
               policies)
        .group("Bodies");
    add_number(parser, "--planarity-tolerance", options.planarity_tolerance,
               "how far a corner may lie off the plane of its face, over the size of the face: beyond it polygons are cut "
               "into triangles, and cells are refused",
               {.above = 0.0, .zero = true})
        .group("Bodies");
    parser.flag("--self-intersections", options.self_intersections, "look for them in every surface as it comes")
        .by_default("off")
        .group("Bodies");
}

/// One text an occurrence; what follows is not its own.
void add_repeated(CommandParser& parser, const char* name, std::vector<std::string>& values, const char* type,
                  const char* help) {
    parser.texts(name, values, help).takes(type).one_at_a_time().group("Motion");
}

void add_motion(CommandParser& parser, DetectOptions& options) {
    add_repeated(parser, "--translate", options.translations, "BODY:X,Y,Z",
                 "moves a body (name, or number from 0) over the whole run [m]; by default at rest");
    add_repeated(parser, "--rotate", options.rotations, "BODY:AX,AY,AZ,DEG[,CX,CY,CZ]",
                 "turns it over the whole run, before it is moved; by default not; centre: that of its box");
    parser
        .text("--script", options.script,
              "CSV step,body,x,y,z,rx,ry,rz: place from the start [m] and rotation vector [degrees] about the centre "
              "of its box; by default none")
        .takes("FILE")
        .group("Motion");
    parser
        .text("--displacement", options.displacement,
              "point array of .vtp and .vtu files, the displacement over the whole run; by default none")
        .takes("NAME")
        .group("Motion");
    add_count(parser, "--steps", options.steps,
              "equal parts of the run, the start comes before; 0: 10, the last of the script, or none at rest", 0)
        .group("Motion");
    add_of_search(parser, options, "largest_motion", [](OptionFacts& facts) { facts.group = "Motion"; });
}

void add_search(CommandParser& parser, DetectOptions& options) {
    const auto grouped = [](Flag option) { option.group("Contact"); };
    grouped(add_number(parser, "--distance", options.distance,
                       "overlaps up to this gap are kept; by default half the mean size of a face, sqrt(area)", length));
    grouped(add_number(parser, "--depth", options.depth,
                       "overlaps with a gap of minus this or deeper are not; by default as --distance", length));
    grouped(parser.flag("--self", options.search.self_contact, "also pairs within a body").by_default("off"));
    add_of_search(parser, options, "self_contact_rings", [](OptionFacts& facts) { facts.name = "rings"; });
    add_of_search(parser, options, "facing_cosine", [](OptionFacts& facts) {
        facts.name = "facing";
        facts.limits.below = 0.0;
        facts.limits.remedy = "Faces beyond a right angle share no plane.";
    });
    const std::string& of_area = named(contact::contact_options(), "area").help;
    grouped(add_choice(parser, "--area", options.area, of_area, areas));
    add_of_search(parser, options, "broad_phase", [](OptionFacts&) {});
    grouped(add_number(parser, "--skin", options.skin,
                       "how far two faces may move together before candidates are searched again; by default chosen as the "
                       "run goes, next to nothing where bodies turn, deform or rest",
                       length));
    grouped(add_number(parser, "--max-pairs", options.max_pairs, "candidates at most; by default 250 million",
                       {.above = 0.0, .below = 4294967295.0, .closed = true}));
    grouped(add_number(parser, "--max-memory", options.max_memory, "of a search, by default all there is",
                       {.unit = "MB", .above = 0.0}));
}

void add_verification(CommandParser& parser, DetectOptions& options) {
    parser.flag("--verify", options.verify, "check every step against all pairs; one missed ends in exit code 1")
        .by_default("off")
        .group("Verification");
    add_number(parser, "--verify-tests", options.verify_tests,
               "pairs tested per step; with more, a sample of faces against all", {.above = 0.0})
        .group("Verification");
    add_count(parser, "--verify-samples", options.verify_samples, "faces of that sample; 0: as --verify-tests allows", 0)
        .group("Verification");
    add_count(parser, "--seed", options.seed, "of the sample", 0).group("Verification");
}

void add_output(CommandParser& parser, DetectOptions& options) {
    add_out(parser, options.out);
    parser.flag("--no-files", options.no_files, "print only").by_default("off").group("Output");
    add_count(parser, "--write-every", options.write_every, "steps between those whose pairs are written; 0: the last only",
              0)
        .group("Output");
    add_count(parser, "--threads", options.threads, "threads; 0: all. The results do not depend on it", 0).group("Output");
}

nlohmann::ordered_json number_or_null(double value) {
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

}  // namespace

const Program detect_program{
    .name = "abut detect",
    .purpose = "Contact detection on complex meshes: says what it found.",
    .footer =
        placing_help() + shapes_help() +
        "Example, interlocked tori 0.1 apart: abut detect torus:n=4000 torus:n=4000,x=1,axis=1,tube=0.6 --distance 0.12\n"
        "Ctrl-C ends a run after its present step; its files are complete until there."};

DetectOptions::DetectOptions()
    : distance(not_given), depth(not_given), skin(not_given), max_memory(not_given), max_pairs(not_given) {}

void add_options(CommandParser& parser, DetectOptions& options) {
    add_bodies(parser, options);
    add_motion(parser, options);
    add_search(parser, options);
    add_verification(parser, options);
    add_output(parser, options);
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
            {"largest_motion", options.search.largest_motion},
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
