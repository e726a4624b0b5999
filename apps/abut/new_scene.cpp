#include "apps/abut/commands.hpp"

namespace abut::apps {

const std::string& new_scene() {
    static const std::string text =
        R"toml(# A disc falls on a block that stands on a floor. Units are SI; every number may be a formula, "sqrt(2)/2", or have a unit, "25 mm".
#   abut check SCENE     what is wrong, and what a run would take
#   abut run SCENE       runs it; --set bodies.ball.density=2 changes any value for one run
#   abut keys            all keys, with units and defaults
#   abut materials       those that are known by name: material = "steel S235"

dim = 2                  # 2, plane strain, or 3
gravity = [0, -10]       # [m/s^2]
# energy_scale = 1.0     # [J] what energies are measured with; by default the largest one of the run so far

[bodies.ball]            # the name is yours; groups of boundary faces are "ball.boundary"
shape = "disc"           # or fan_disc, box, structured_box; mesh = "FILE.msh" in place of shape reads a file
radius = 0.2             # [m]
size = 0.05              # [m] edge length of cells
place = [0, 1.0]         # [m] its centre
density = 1000           # [kg/m^3]
young = 1e6              # [Pa]
poisson = 0.3
kinematics = "small"     # "floating" where it turns, "finite" where it bends, "rigid" where it does not deform
velocity = [0, -1]       # [m/s] at the start; spin = 3 [rad/s] turns it
# stiffness_damping = 1e-5 # [s] where it rubs: abut check says how much, for this mesh

[bodies.block]
shape = "structured_box"
lower = [-0.5, 0.005]    # [m]
upper = [0.5, 0.305]
counts = [11, 4]
density = 2000
young = 2e6

[obstacles.floor]        # rigid; it may move: velocity = [0, 0.1], or path = ["0.1*sin(t)", 0]
shape = "plane"          # or box, polygon
point = [0, 0]
normal = [0, 1]          # the side where bodies are
# half_width = 2         # [m]; without it there is no end

# [supports.left]        # holds a group of boundary faces, or moves it
# group = "block.xmin"
# constraint = "normal"  # a roller; "full" by default
# value = ["0.01*t", 0]  # [m], formulas in t, x, y, z

# [tractions.top]
# group = "block.ymax"
# value = [0, -100]      # [Pa], formulas too

[run]
time = 0.3               # [s] or steps = 1000
cfl = 0.9                # step over the stable step
# filter = "neutral"
# settle = true          # bodies that stand begin at rest under their weight; give it where they rub

# [contact]
# friction = 0.3         # with it bodies that vibrate need stiffness_damping, see above
# law = "reconstruction" # automatic: "pair_potential"; this one for bodies that do not turn alone

[output]
frames = 21              # for ParaView
forces = true            # forces.csv: between bodies, and on the floor
# out = "out/mine"       # out/<scene> by default
# [output.probes.top]    # probes.csv: a point of a body
# body = "block"
# point = [0, 0.3]       # [m] at rest
)toml";
    return text;
}

}  // namespace abut::apps
