// A weak shock throws a plate that several ranks share out (Taylor 1941): each loads the faces that it has.
//
// A shock that raises the pressure by dp = 100 Pa meets a plate of m = 0.5 kg/m^2 that may fly. Linear acoustics: a wall
// with the speed v feels 2 dp - Z v, Z = rho a of the gas. So v = 2 dp/Z (1 - exp(-t/T)) with T = m/Z. The fluid answers
// face by face and chooses steps of its own; the plate is elastic, and keeps its step. The work that the fluid gives,
// summed over all faces and steps in the order of one rank, is that of the plate to round-off. Every digit printed but
// those of the last line is that of one rank.
//
//   mpirun -n 4 shock_on_ranks
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/ranks/point_ranks.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/part/share_out.hpp"

using namespace abut;
using V = Vector<2>;

constexpr const char* wet = "xmin";                               // side of the plate
constexpr double dp = 100.0, impedance = 410.0;                   // [Pa], [Pa s/m]
constexpr double thickness = 0.01, height = 0.3, density = 50.0;  // [m], [m], [kg/m^3]
constexpr double response = density * thickness / impedance;      // T [s]
constexpr solid::Material foam{.young = 1e8, .poisson = 0.0, .density = density};

/// Pressure on faces that move so far in d, as tractions along x.
std::vector<V> tractions(const std::vector<V>& motion, double d) {
    std::vector<V> values;
    for (const V& of_face : motion) values.emplace_back(2.0 * dp - impedance * of_face[0] / d, 0.0);
    return values;
}

struct Figures {
    double speed_error = 0.0;  // largest of all faces and steps, over the last speed
    double given = 0.0;        // work [J]
    double work = 0.0;         // of the plate [J]
    int fluid_steps = 0;
};

Figures throw_plate(solid::SteppedRun<2>& run) {
    solid::ClockedRun<2> clock(run);
    const auto here = run.solid().outside(wet);
    const double end = 1.2 * response, last_speed = 2.0 * dp / impedance * (1.0 - std::exp(-1.2));
    Figures figures;
    while (clock.time() < end || clock.time() > run.memm().time()) {  // ends at a node, where the work is known
        const double asked = (0.3 + 0.2 * (figures.fluid_steps++ % 4)) * run.memm().dt();  // as a gas might
        const double d = std::min(asked, clock.time_to_node());
        const std::vector<V> motion = clock.motion(wet, d), load = tractions(motion, d);
        const std::vector<double> area = clock.faces(wet).area;
        const double exact = 2.0 * dp / impedance * (1.0 - std::exp(-(clock.time() + 0.5 * d) / response));
        std::vector<double> work;
        for (std::size_t i = 0; i < motion.size(); ++i) work.push_back(area[i] * load[i].dot(motion[i]));
        for (const double of_face : here.gather(work)) figures.given += of_face;
        for (const V& of_face : here.gather(motion))
            figures.speed_error = std::max(figures.speed_error, std::abs(of_face[0] / d - exact) / last_speed);
        clock.set_traction(wet, load);
        clock.advance(d);
    }
    figures.work = run.solid().outside_work(run.memm().q()).steps;
    return figures;
}

/// Every rank has the whole mesh, and makes its part of it.
bool run(const ranks::Communicator& all) {
    const mesh::Mesh<2> whole =
        mesh::structured_box<2>({0.0, 0.0}, {thickness, height}, {6, 180}, mesh::CellShape::quadrangle, "plate");
    solid::SolidOptions<2> options;
    options.materials = {foam};
    options.boundary.traction = {{.group = wet, .from_outside = true}};
    const std::vector<int> owner = ranks::partition<2>(all, whole.cell_centroid);
    const mesh::MeshPart<2> part = solid::part_of<2>(whole, owner, all.rank(), options.kinematics);
    const solid::PartPoints its = solid::points_of<2>(part, options.kinematics);
    const ranks::PointRanks points(all, ranks::shared_points(all, 2, its.n_points, its.number, its.owner));
    auto plate = std::make_unique<solid::Solid<2>>(part.mesh, options, points);
    const std::vector<double> rest(2 * plate->rest_positions().size(), 0.0);
    const double dt = 0.8 * dynamics::stable_step(*plate).dt;
    const std::size_t n_wet = plate->outside(wet).faces().size();
    solid::SteppedRun<2> stepped(std::move(plate), rest, rest, dt, {.restart = 20});
    const Figures f = throw_plate(stepped);
    if (all.rank() == 0) {
        std::printf("%d steps of the plate, %d of the fluid\n", static_cast<int>(stepped.memm().steps()), f.fluid_steps);
        std::printf("speed of the faces: off by %.17g of the last one\n", f.speed_error);
        std::printf("work: %.17g J are given, %.17g J taken, they differ by %.2g\n", f.given, f.work,
                    std::abs(f.work / f.given - 1.0));
        std::printf("rank 0 of %d has %d of %d faces\n", all.size(), static_cast<int>(n_wet),
                    static_cast<int>(stepped.solid().outside(wet).n_all()));
    }
    return f.speed_error < 0.02 && std::abs(f.work - f.given) < 1e-12 * f.given;
}

int main(int argc, char** argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    bool holds = false;
    {
        const ranks::Communicator all(MPI_Comm_c2f(MPI_COMM_WORLD));
        holds = run(all);
    }
    MPI_Finalize();
    return holds ? 0 : 1;
}
