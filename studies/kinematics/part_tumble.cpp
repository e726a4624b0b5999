#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace tumble_part {
namespace {

template <int Dim>
void tumble(Kinematics kinematics, bool filter, const Options& options, const Sink& sink) {
    std::array<int, Dim> cells;
    cells.fill(options.quick ? 2 : Dim == 2 ? 8 : 4);
    Vector<Dim> sides = Vector<Dim>::Constant(0.7);
    sides[0] = 1.0;
    sides[Dim - 1] = Dim == 2 ? 0.7 : 0.5;
    Case<Dim> one = case_of<Dim>(Dim == 2 ? "tumbling block" : "tumbling cuboid",
                                 {turned_box<Dim>({.sides = sides, .cells = cells})}, kinematics);
    let_fall<Dim>(one, 2e-4);  // corners are pressed in by their cells at 0.06 of the wave speed, and the run is refused
    one.scene.solid.obstacles = {
        contact::plane_obstacle<Dim>(Vector<Dim>(-Vector<Dim>::Unit(Dim - 1)), Vector<Dim>::Unit(Dim - 1), 20.0)};
    if constexpr (Dim == 2)
        one.motion[0].spin = AxialVector<2>(0.02);
    else
        one.motion[0].spin = {0.01, 0.017, 0.007};
    one.scene.time = options.quick ? 200.0 : 1200.0;
    one.run.filter = filter;
    Row row = row_of<Dim>(one, run::name_of(kinematics) + (filter ? ", filter" : ""), options);
    row.quantities.at_most("H - H~", row.run->excess, filter ? 0.05 : no_target);
    row.quantities.at_most("never touches", row.run->pair_steps > 0 ? 0.0 : 1.0, 0.0);
    sink(row);
}

}  // namespace
}  // namespace tumble_part

void run_tumble(const Options& options, const Sink& sink) {
    using namespace tumble_part;
    for (const Kinematics kinematics : {Kinematics::floating, Kinematics::rigid})
        for (const bool filter : {false, true}) {
            tumble<2>(kinematics, filter, options, sink);
            tumble<3>(kinematics, filter, options, sink);
        }
}

}  // namespace abut::studies::kinematics
