// An explosion on a structure: a charge of hot gas bursts in a channel, bends a clamped plate, and the plate hits a block.
//
// Air (gamma = 1.4, 1e5 Pa, 1.2 kg/m^3) fills a channel of 0.4 m. A clamped plate of laminate closes it (20 mm, E = 10 GPa,
// nu = 0.3, 1500 kg/m^3). At t = 0 a layer of gas of 1 MPa and 4 kg/m^3 is set free 0.5 m from it. The exact Riemann problem
// gives the shock, Rankine and Hugoniot its reflection: p_5 = 1.1712 MPa on a rigid wall. The plate then bends under
// p_5 - p_0 - Z v, Z = rho a behind the reflected shock. Euler and Bernoulli's modes, damped by Z, give its deflection w in
// closed form: it closes a gap of 2 mm and hits a free block after 0.3145 ms. They leave out shear and rotary inertia, with
// which it takes 0.3186 ms (Timoshenko's beam, by finite differences).
//
// The gas is two-dimensional (cut_cell_gas.hpp: fixed squares, cut by the plate) and chooses each of its steps; the solid
// keeps its own (solid::ClockedRun). Both book the same impulse and the same work. So mass, momentum and energy of gas and
// solids are exact, except what the half-cells behind the loaded faces store, which goes as h and is printed. Neutral
// restarts keep the answer of the gas out of the alternating mode. Clamps take momentum, so that of the gas is compared with
// the impulses on its walls; with the argument `free` there are no clamps, the plate flies as Taylor's does, and momentum is
// that of gas, plate and block. With `round` the charge is a disc, for which there is no closed form.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"
#include "cut_cell_gas.hpp"
#include "exact_gas.hpp"

using namespace abut;

namespace {

constexpr double height = 0.4, thickness = 0.02, gap = 2e-3, depth = 0.1;  // of channel, plate, gap and block [m]
constexpr double young = 1e10, poisson = 0.3, density = 1500.0;            // of both bodies
constexpr double tube = 0.78, charge_at = -0.5, margin = 0.02;             // the gas may fill [-tube, margin] [m]
constexpr int restart_period = 20;                                         // steps of the solid
const gas::State air{1.2, 0.0, 0.0, 1e5}, charge{4.0, 0.0, 0.0, 1e6};

// Theory -------------------------------------------------------------------------------------------------------------

/// The load on the plate: the shock that comes, and its reflection.
struct Load {
    double arrival, p, impedance;  // [s], [Pa], [kg/m^2/s]
};

Load load_of_layer() {
    const gas::Middle middle = gas::middle_of(charge, air);
    const gas::State behind = gas::right_wave(air, middle, 0.0);
    const double speed = behind.rho * behind.u / (behind.rho - air.rho), p = gas::reflected(behind.p, air.p);
    const gas::State reflected = gas::right_wave({behind.rho, 0.0, 0.0, behind.p}, {p, 0.0}, 0.0);
    return {-charge_at / speed, p, reflected.rho * reflected.sound()};
}

/// Motion of the plate: deflection of its middle [m], and mean velocity [m/s].
struct Motion {
    double middle, velocity;
};

/// A time t > 0 after its load has come; without clamps it flies as Taylor's plate does.
Motion theory(const Load& load, bool clamped, double t) {
    const double mass = density * thickness, push = (load.p - air.p) / mass, rate = load.impedance / mass;
    const double terminal = push / rate, flying = terminal * (1.0 - std::exp(-rate * t));
    if (!clamped) return {terminal * t - flying / rate, flying};
    const double bending = young / (1.0 - poisson * poisson) * std::pow(thickness, 3) / 12.0;
    Motion sum{};
    for (int n = 1; n <= 19; n += 2) {  // the others are odd about the middle
        double beta = (n + 0.5) * std::numbers::pi;
        for (int k = 0; k < 20; ++k) beta += (std::cos(beta) - 1.0 / std::cosh(beta)) / std::sin(beta);  // cos cosh = 1
        const double s = (std::cosh(beta) - std::cos(beta)) / (std::sinh(beta) - std::sin(beta)), half = 0.5 * beta;
        const double middle = std::cosh(half) - std::cos(half) - s * (std::sinh(half) - std::sin(half)),
                     mean = 4.0 * s / beta;
        const double omega = std::pow(beta / height, 2) * std::sqrt(bending / mass);
        const double damped = std::sqrt(omega * omega - 0.25 * rate * rate), decay = std::exp(-0.5 * rate * t);
        const double swing = decay * std::sin(damped * t) / damped;
        sum.middle += middle * mean * push / (omega * omega) * (1.0 - decay * std::cos(damped * t) - 0.5 * rate * swing);
        sum.velocity += mean * mean * push * swing;
    }
    return sum;
}

double time_of_touch(const Load& load, bool clamped) {
    double low = 0.0, high = 1e-3;
    while (high - low > 1e-12) {
        const double t = 0.5 * (low + high);
        (theory(load, clamped, t).middle < gap ? low : high) = t;
    }
    return low;
}

// Solids -------------------------------------------------------------------------------------------------------------

/// n cells across the plate, and others in the block.
mesh::Mesh<2> plate_and_block(int n) {
    const double start = thickness + gap;
    return mesh::combine<2>(std::vector<mesh::Mesh<2>>{
        mesh::structured_box<2>({0.0, 0.0}, {thickness, height}, {n, 20 * n}, mesh::CellShape::quadrangle, "plate"),
        mesh::structured_box<2>({start, 0.25 * height}, {start + depth, 0.75 * height}, {4 * n, 8 * n + 1},
                                mesh::CellShape::quadrangle, "block")});
}

solid::SolidOptions<2> options_of_solids(bool clamped) {
    solid::SolidOptions<2> options;
    options.materials.assign(2, {.young = young, .poisson = poisson, .density = density});
    options.contact = contact::ContactOptions{};
    if (clamped)
        for (const char* end : {"plate.ymin", "plate.ymax"})
            options.boundary.dirichlet.push_back({.group = end, .constraint = solid::Constraint::full});
    options.boundary.traction = {{.group = "plate.xmin", .from_outside = true}};
    return options;
}

/// The front of the plate as the gas sees it, through the middles of its faces. Behind it all is solid.
class Front {
public:
    Front(const solid::OutsideFaces<2>& faces, bool clamped) : place_(faces.position), clamped_(clamped) {}

    /// One wall per face, from below to above, then those that close beyond the grid. The faces move.
    std::vector<gas::Wall> move(const std::vector<Vector<2>>& motion) {
        const std::vector<gas::Point> before = corners();
        for (std::size_t face = 0; face < place_.size(); ++face) place_[face] += motion[face];
        const std::vector<gas::Point> after = corners();
        std::vector<gas::Wall> walls;
        for (std::size_t face = 0; face < place_.size(); ++face)
            walls.push_back(
                {{before[face + 1], before[face]}, {after[face + 1], after[face]}, {motion[face].x(), motion[face].y()}});
        const auto beyond = [](const std::vector<gas::Point>& front) {
            constexpr double far = 1.0;
            return std::vector<gas::Point>{front.front(),       {front.front()[0], -far},        {far, -far},
                                           {far, height + far}, {front.back()[0], height + far}, front.back()};
        };
        const std::vector<gas::Point> from = beyond(before), to = beyond(after);
        for (std::size_t k = 0; k + 1 < from.size(); ++k) walls.push_back({{from[k], from[k + 1]}, {to[k], to[k + 1]}, {}});
        return walls;
    }
    [[nodiscard]] double middle() const {
        const std::size_t half = place_.size() / 2;
        return 0.5 * (place_[half - 1].x() + place_[half].x());
    }

private:
    [[nodiscard]] std::vector<gas::Point> corners() const {
        const std::size_t n = place_.size();
        const auto end = [&](const Vector<2>& last, const Vector<2>& next) {
            return clamped_ ? 0.0 : 1.5 * last.x() - 0.5 * next.x();
        };
        std::vector<gas::Point> corners{{end(place_[0], place_[1]), 0.0}};
        for (std::size_t face = 0; face + 1 < n; ++face) {
            const Vector<2> between = 0.5 * (place_[face] + place_[face + 1]);
            corners.push_back({between.x(), between.y()});
        }
        corners.push_back({end(place_[n - 1], place_[n - 2]), height});
        return corners;
    }
    std::vector<Vector<2>> place_;
    bool clamped_;
};

// Both ---------------------------------------------------------------------------------------------------------------

struct Result {
    double pressure_error = 0.0;    // mean of |p - (p_5 - Z v)| over p_5, from 0.1 ms after the shock to the touch
    double deflection_error = 0.0;  // largest, in the same time, over the gap
    double touch = 0.0;             // time of it after the shock has come [s]
    double highest = 0.0;           // mean pressure on the plate [Pa]
    double block = 0.0;             // velocity of the block at the end [m/s]
    double mass = 0.0, momentum_x = 0.0, momentum_y = 0.0, energy = 0.0;  // defects, over what there is in the gas (y: as x)
    double of_all = 0.0;               // of momentum of gas, plate and block: without clamps
    double stored = 0.0;               // what half-cells store, over the work on the plate
    double drift = 0.0, excess = 0.0;  // of H~ less work, and H - H~, over that work
    std::int64_t steps = 0, gas_steps = 0, events = 0, missed = 0;
};

class Blast {
public:
    Blast(int n, bool clamped, bool round)
        : mesh_(plate_and_block(n)),
          bodies_(solids(clamped)),
          clock_(bodies_),
          faces_(clock_.faces("plate.xmin")),
          front_(faces_, clamped),
          gas_(grid(n), gas::Side::wall, front_.move(at_rest()), [round](gas::Point x) { return start(x, round); }),
          load_(load_of_layer()),
          clamped_(clamped) {
        for (int k = 0; k < 4; ++k) start_[k] = gas_.sum(k);
        ledger_.record(dynamics::measure(bodies_.memm(), bodies_.solid()));
    }
    [[nodiscard]] double time() const { return clock_.time(); }
    [[nodiscard]] double since_arrival() const { return clock_.time() - load_.arrival; }

    /// One step of the gas: no longer than to the next node of the solid, where the motion of its faces is known.
    void step() {
        const double d = std::min(gas_.stable_step(), clock_.time_to_node());
        const std::vector<Vector<2>> motion = clock_.motion("plate.xmin", d);
        const std::vector<gas::Point> impulse = gas_.step(d, front_.move(motion));
        std::vector<Vector<2>> traction(motion.size());
        double force = 0.0;
        for (std::size_t face = 0; face < motion.size(); ++face) {
            const Vector<2> pushed(impulse[face][0], impulse[face][1]);
            traction[face] = pushed / (faces_.area[face] * d) + air.p * faces_.normal[face];  // air is behind the plate, too
            pushed_ += pushed;
            given_ += d * faces_.area[face] * traction[face];
            swept_ -= faces_.area[face] * faces_.normal[face].dot(motion[face]);
            force += pushed.x() / d;
        }
        clock_.set_traction("plate.xmin", traction);
        const std::int64_t steps = bodies_.memm().steps();
        clock_.advance(d);
        ++result_.gas_steps;
        compare(force / height, d);
        if (bodies_.memm().steps() != steps && steps % 10 == 9) balance();
    }

    [[nodiscard]] Result result() {
        const solid::OutsideWork work = bodies_.solid().outside_work(bodies_.memm().q());
        result_.energy /= start_[3];
        result_.stored = work.changes / work.steps;
        result_.drift = ledger_.pseudo_energy_drift() / work.steps;
        result_.excess = ledger_.energy_excess() / work.steps;
        result_.pressure_error /= compared_;
        result_.block = solid::body_motions<2>(bodies_.memm(), bodies_.solid())[1].velocity.x();
        result_.steps = bodies_.memm().steps();
        result_.events = bodies_.solid().contact().report().events;
        result_.missed = bodies_.solid().contact().report().missed_contacts;
        return result_;
    }

private:
    static gas::Grid grid(int n) {
        const double size = height / (40 * n);
        const int columns = static_cast<int>(std::lround((tube + margin) / size));
        return {{margin - columns * size, 0.0}, size, columns, 40 * n};
    }
    static gas::State start(gas::Point x, bool round) {
        const bool inside = round ? std::hypot(x[0] - charge_at, x[1] - 0.5 * height) < 0.1 : x[0] < charge_at;
        return inside ? charge : air;
    }
    [[nodiscard]] std::vector<Vector<2>> at_rest() const {
        return std::vector<Vector<2>>(faces_.area.size(), Vector<2>::Zero());
    }
    solid::SteppedRun<2> solids(bool clamped) {
        auto made = std::make_unique<solid::Solid<2>>(mesh_, options_of_solids(clamped));
        const std::vector<double> rest(made->size(), 0.0);
        const double step = 0.9 * dynamics::stable_step(*made).dt;
        return {std::move(made), rest, rest, step, {.restart = restart_period}};
    }

    /// With theory, until the plate touches.
    void compare(double pressure, double d) {
        result_.highest = std::max(result_.highest, pressure);
        if (result_.touch == 0.0 && bodies_.solid().contact().report().events > 0) result_.touch = since_arrival();
        if (since_arrival() < 1e-4 || result_.touch > 0.0) return;
        const auto [middle, velocity] = theory(load_, clamped_, since_arrival());
        result_.deflection_error = std::max(result_.deflection_error, std::abs(front_.middle() - middle) / gap);
        result_.pressure_error += d * std::abs(pressure - (load_.p - load_.impedance * velocity)) / load_.p;
        compared_ += d;
    }

    /// Mass, momentum and energy, at a node of the solid.
    void balance() {
        ledger_.record(dynamics::measure(bodies_.memm(), bodies_.solid()));
        const solid::OutsideWork work = bodies_.solid().outside_work(bodies_.memm().q());
        const double of_solids = ledger_.entries().back().pseudo_energy + work.held - work.changes;
        const auto keep = [](double& largest, double defect) { largest = std::max(largest, std::abs(defect)); };
        const double scale = charge.p * height * time();  // of momentum
        keep(result_.mass, gas_.sum(0) / start_[0] - 1.0);
        keep(result_.momentum_x, (gas_.sum(1) + pushed_.x()) / scale);
        keep(result_.momentum_y, (gas_.sum(2) + pushed_.y()) / scale);
        keep(result_.energy, gas_.sum(3) - start_[3] + air.p * swept_ + of_solids);
        Vector<2> momentum = Vector<2>::Zero();
        for (const auto& body : solid::body_motions<2>(bodies_.memm(), bodies_.solid()))
            momentum += body.mass * body.velocity;
        keep(result_.of_all, (momentum - given_).norm() / scale);
    }

    mesh::Mesh<2> mesh_;
    solid::SteppedRun<2> bodies_;
    solid::ClockedRun<2> clock_;
    solid::OutsideFaces<2> faces_;  // at the start
    Front front_;
    gas::Gas gas_;
    Load load_;
    bool clamped_;
    dynamics::Ledger<2> ledger_;
    gas::Content start_{};
    Vector<2> pushed_ = Vector<2>::Zero(),
              given_ = Vector<2>::Zero();  // impulses of the gas, and less those of the air behind
    double swept_ = 0.0, compared_ = 0.0;  // [m^2], [s]
    Result result_;
};

Result run(int n, bool clamped, bool round) {
    Blast blast(n, clamped, round);
    while (blast.since_arrival() < 0.8e-3) blast.step();
    return blast.result();
}

// Figures beside theory ------------------------------------------------------------------------------------------------

/// What is asked for, and what theory says of it.
struct Question {
    bool clamped, round;
    Load load;     // of a layer
    double touch;  // time of it after the shock has come [s]
};

/// Without clamps that of all that moves.
double momentum_of(const Question& question, const Result& result) {
    return question.clamped ? result.momentum_x : result.of_all;
}
double lateness(const Question& question, const Result& result) { return result.touch / question.touch - 1.0; }

void print_theory(const Question& question) {
    const Load& load = question.load;
    if (question.round)
        std::printf("a shock from a layer would be there %.4f ms after the burst\n\n", 1e3 * load.arrival);
    else
        std::printf("theory: p_5 = %.4f MPa, %.4f ms after the burst; the plate touches the block %.4f ms later\n\n",
                    1e-6 * load.p, 1e3 * load.arrival, 1e3 * question.touch);
    std::printf(
        "  h/plate  p        w        touch     highest p  block    mass     momentum         energy   stored    H~-work  "
        "H-H~     steps of gas events missed\n");
}

void print_row(const Question& question, int n, const Result& r) {
    if (question.round)
        std::printf("  1/%-3d    touch %.3f ms after that", n, 1e3 * r.touch);
    else
        std::printf("  1/%-3d    %.1e  %.1e  %+.1e", n, r.pressure_error, r.deflection_error, lateness(question, r));
    std::printf("  %.3f MPa  %.2f m/s  %.1e  %.1e %.1e  %.1e  %+.1e  %.1e  %.1e  %lld %lld %lld %lld\n", 1e-6 * r.highest,
                r.block, r.mass, momentum_of(question, r), r.momentum_y, r.energy, r.stored, r.drift, r.excess,
                static_cast<long long>(r.steps), static_cast<long long>(r.gas_steps), static_cast<long long>(r.events),
                static_cast<long long>(r.missed));
}

bool is_good(const Question& question, const Result& r) {
    const bool is_exact = std::max({r.mass, momentum_of(question, r), r.momentum_y, r.energy, r.drift}) < 1e-12;
    const bool is_near_theory =
        r.pressure_error < 5e-3 && r.deflection_error < 0.08 && std::abs(lateness(question, r)) < 0.04;
    return is_exact && r.missed == 0 && r.block > 0.0 && (question.round || is_near_theory);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string variant = argc > 1 ? argv[1] : "";
    if (!variant.empty() && variant != "free" && variant != "round") {
        std::fprintf(stderr, "blast_on_plate: '%s' is not known; there are free, round\n", variant.c_str());
        return 2;
    }
    const bool clamped = variant != "free";
    const Load load = load_of_layer();
    const Question question{clamped, variant == "round", load, time_of_touch(load, clamped)};
    print_theory(question);
    bool good = true;
    for (const int n : variant.empty() ? std::vector{2, 3} : std::vector{2}) {
        const Result result = run(n, clamped, question.round);
        print_row(question, n, result);
        good = good && is_good(question, result);
    }
    return good ? 0 : 1;
}
