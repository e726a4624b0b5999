#include "apps/abut/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "abut/base/error.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

const Topic scene{
    "scene", "Scenes",
    R"(A scene is a TOML file: what there is, table by table. `abut new NAME` writes one to start from, `abut keys`
prints all keys with units and defaults, `abut check FILE` says all that is wrong with one.

  dim = 2               2, plane strain, or 3
  gravity = [0, -10]    of all bodies
  [bodies.NAME]         shape, mesh file or surface; material; place; velocity
  [[patterns]]          copies of a body in rows, grids, rings and tables
  [[symmetry]]          a plane of which the scene is one half
  [obstacles.NAME]      rigid: plane, box, polygon; at rest or moving
  [supports.NAME]       a group of boundary faces that is held or moved
  [tractions.NAME]      a force per area on a group
  [run]                 end, step, scheme
  [contact]             law and its settings
  [output]              folder, records, frames

Nothing in a file is ignored: an unknown key is an error. The command line stands above the file: options of
`abut run`, and --set bodies.NAME.density=2 for every key.)"};

const Topic units{"units", "Units",
                  R"(All is in SI: m, kg, s, Pa, J, and rad for angles. In 2D masses, forces and energies are per metre of
thickness.

A value may have a unit, young = "210 GPa", velocity = ["3 m/s", 0], spin = "1200 rpm", --time "5 ms", which must
be of the dimension that `abut keys` tells; a formula with a unit stands in parentheses, "(2*pi*3) deg". A number
without a unit is in SI.

Other consistent units work as well, since nothing but ratios matters: mm, tonne and s go with MPa and mJ.
Files of surfaces in millimetres have the key unit = "mm".

Numbers may be formulas in quotes, "sqrt(2)/2"; where a value may vary they know t [s], those of supports,
tractions and temperature_rise also x, y, z [m].)"};

const Topic materials{
    "materials", "Materials",
    R"(A body is linear elastic: `young` [Pa], `poisson` and `density` [kg/m^3], plane strain in 2D. A body that
bends (kinematics = "finite") is of St. Venant and Kirchhoff's material: linear elastic in the strain of
Green, good for strains up to 0.2. Beyond, `law` = "neo_hookean" or "mooney_rivlin" are rubber, the latter with
`second_share`; at small strains all are the same. `law` = "j2" is metal: beyond `yield_stress` it flows, hardens by
`hardening`, `saturation` and `kinematic_hardening`, and remembers. `mass_damping` and
`stiffness_damping` are Rayleigh's, `linear_viscosity` and `quadratic_viscosity` are for shocks. What all of these
dissipate is booked. `law` = "orthotropic" has other moduli along three axes, which `axis_angle` or `axis_1` and
`axis_2` lay. `thermal_expansion` acts with `temperature_rise` of a body. A rigid body uses its density alone.
Bodies share those of [materials.NAME]; some are known by their names, material = "steel S235": `abut materials`.

Poisson's ratio is below 0.5: an incompressible body has no stable explicit step. `eta` [Pa] is the stiffness
against jumps between cells, Young's modulus by default.)"};

const Topic contact{"contact", "Contact",
                    R"(Bodies touch each other and obstacles, with friction where `friction` is given, for all or in
[[contact.pairs]] for two. Forces derive from one potential, so that a pseudo-energy is conserved to round-off through
impact, slip and release; what friction takes is booked, and with `settle` a run begins at rest.

  law = "pair_potential"   half the cells behind both faces are springs in series; for all bodies
  law = "reconstruction"   faces move to where their tractions balance; for bodies that do not turn
  law = "automatic"        the first; what the second alone has is refused without it: overlap, weighting, area,
                           quadrature, facing_cosine, memm_async

A run reports the deepest contact |g|/D over the depth D of cells, and warns above 0.3; it stops at
compression_limit. Contacts missed must be 0. `--lab events=off` and `--lab overlap=frozen` are cheaper and let the
pseudo-energy drift.)"};

const Topic kinematics{"kinematics", "Kinematics",
                       R"(How a body may move, body by body or for all of them by --kinematics:

  small      it does not turn: above 0.1 rad it would grow; the cheapest
  floating   in a frame that turns with it, strains are small
  finite     it bends and turns
  rigid      it does not deform
  automatic  small, floating or rigid for each body by a pilot run with rigid ones (--kinematics alone)

Bodies that turn take contact by the pair potential.)"};

const Topic output{"output", "Results",
                   R"(A run leaves in its folder, out/SCENE or what --out says:

  report.html          for people: verdict, pictures, bodies, warnings, settings
  summary.json         for programs: all figures and the options as they were used
  energy.csv           energies and momenta, a row per record (--interval)
  energy.svg           their picture
  animation.html       the run as a film, in any browser (--animation 100)
  bodies.pvd           cells over time for ParaView (--frames), bodies_surface.pvd boundary faces,
                       bodies_pairs.pvd pairs of faces in contact. The frames that they list are in
                       the folder frames; with --format xdmf
                       bodies.xmf and bodies_surface.xmf, all frames in bodies.h5
  view_in_paraview.py  opens them with sensible views: paraview --script=...

`abut info FOLDER` says what is in one. While a run goes on, and after one that failed, energy.csv is called
energy.csv.partial and there is no summary. A folder belongs to one run at a time.

--quiet says nothing but errors. --json prints a line of JSON for each thing that happens: start, warning,
progress, record, end, error.)"};

const Topic exit_codes{"exit-codes", "Exit codes",
                       R"(  0    good: the run came to its end, the scene has no fault, help was printed
  1    an error, with a message on standard error that says where, how much, how much is allowed and
       what to do: a command line, a file or a scene that is wrong; a folder that another run has; a
       run that diverges or presses faces in too deep
  2    of `abut diff`: the two runs differ
  130  ended by SIGINT (Ctrl-C) after a whole step; all files are finished, "complete" is false in
       summary.json
  143  the same by SIGTERM
  129  the same by SIGHUP: the terminal is gone

A second signal, half a second later or more, ends a run at once, as SIGKILL does; energy.csv.partial
then holds the records so far.)"};

constexpr std::size_t entry_indent = 2;

const std::array<Topic, 7> all = {scene, units, materials, contact, kinematics, output, exit_codes};

}  // namespace

std::span<const Topic> topics() { return all; }

std::vector<TopicPart> parts_of(const Topic& topic) {
    std::vector<TopicPart> parts;
    std::istringstream lines(topic.text);
    bool open = false;  // the part before may go on
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin == entry_indent) {
            const std::size_t gap = std::min(line.find("  ", begin), line.size());
            parts.push_back(
                {line.substr(begin, gap - begin), line.substr(std::min(line.find_first_not_of(' ', gap), line.size()))});
        } else if (begin != std::string::npos && open) {
            parts.back().text += " " + line.substr(begin);
        } else if (begin != std::string::npos) {
            parts.push_back({std::nullopt, line});
        }
        open = begin != std::string::npos;
    }
    return parts;
}

std::string topic_list() {
    std::string text;
    for (const Topic& topic : all) text += fmt::format("  {:<14}{}\n", topic.name, topic.title);
    return text;
}

std::string topic_text(const std::string& name, std::size_t width) {
    const auto found = std::ranges::find(all, name, &Topic::name);
    if (found == all.end()) throw BadInput(fmt::format("help {}: there is no such topic. `abut help` lists all.", name));
    std::size_t column = 0;
    const auto parts = parts_of(*found);
    for (const TopicPart& part : parts) column = std::max(column, part.entry ? part.entry->size() + 2 : 0);
    std::string text = found->title + "\n";
    bool in_list = false;
    for (const TopicPart& part : parts) {
        if (!part.entry || !in_list) text += "\n";
        in_list = part.entry.has_value();
        text += wrapped(in_list ? fmt::format("  {:<{}}{}", *part.entry, column, part.text) : part.text, width) + "\n";
    }
    return text;
}

}  // namespace abut::apps
