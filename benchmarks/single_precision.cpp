// What steps in single precision cost in energy, momentum and motion, beside the same run in double.
//
// Scenes: two discs, and two cylinders of tetrahedra, R = 1, at 0.05 each against the other (c near 1), 0.8 off centre, that
// meet, slip and part, with the defaults of all options; and a body that vibrates freely for a long time, from displacements of
// 1e-3 at random. Both runs take their steps in turn, ten each. Expected: in double H~ and momentum to round-off; in single H~ to
// 1e-5 of K0, no contact missed in either, velocities after the impact that differ by less than the mesh is wrong by.
// What this cannot see: a drift that takes more steps to show than were made.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <random>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using solid::Precision;

struct Choices {
    double size_2d = 0.05, size_3d = 0.15;
    double end = 12.0;
    int long_steps = 100000;
    int threads = 1;
    std::string json;
};

constexpr int turn = 10;  // steps
constexpr double offset = 0.8, gap = 0.02, speed = 0.05;
const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};

mesh::Mesh<2> round_body(double size, int variant, const Vector<2>& centre) {
    return mesh::disc({.centre = centre, .size = size, .variant = variant});
}
mesh::Mesh<3> round_body(double size, int variant, const Vector<3>& centre) {
    return mesh::cylinder({.centre = centre, .length = 0.8, .size = size, .variant = variant});
}

template <int Dim>
mesh::Mesh<Dim> two_bodies(double size) {
    Vector<Dim> centre = Vector<Dim>::Zero();
    centre[0] = 0.5 * (std::sqrt(4.0 - offset * offset) + gap);
    centre[1] = 0.5 * offset;
    return mesh::combine<Dim>(
        std::vector<mesh::Mesh<Dim>>{round_body(size, 0, Vector<Dim>(-centre)), round_body(size, 1, centre)});
}

template <int Dim>
solid::SolidOptions<Dim> options(Precision precision, int n_bodies) {
    solid::SolidOptions<Dim> made;
    made.materials.assign(static_cast<std::size_t>(n_bodies), material);
    made.precision = precision;
    if (n_bodies > 1) made.contact = contact::ContactOptions{};
    return made;
}

/// A run with its ledger and the processor time of its steps.
template <int Dim>
class Run {
public:
    Run(const mesh::Mesh<Dim>& mesh, Precision precision, const std::vector<Vector<Dim>>& velocity, double displaced,
        double cfl)
        : solid_(mesh, options<Dim>(precision, static_cast<int>(velocity.size()))),
          memm_(solid_, at_random(solid_.size(), displaced), solid::uniform_momentum<Dim>(solid_, velocity),
                cfl * dynamics::stable_step(solid_).dt) {
        record();
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    void steps(int n, benchmark::Clock clock) {
        seconds_ += benchmark::seconds_of(
            [&] {
                for (int i = 0; i < n; ++i) memm_.step();
            },
            clock);
    }
    void record() { ledger_.record(dynamics::measure(memm_, solid_)); }

    [[nodiscard]] double time() const { return memm_.time(); }
    [[nodiscard]] double dt() const { return memm_.dt(); }
    [[nodiscard]] std::vector<solid::BodyMotion<Dim>> motions() const { return solid::body_motions<Dim>(memm_, solid_); }

    /// Over the energy and the momentum that a run is measured with.
    [[nodiscard]] nlohmann::json figures(double energy, double momentum) const {
        const contact::ContactReport report = solid_.contact().report();
        return {{"seconds", seconds_},
                {"steps", memm_.steps()},
                {"pseudo_energy_drift", ledger_.pseudo_energy_drift() / energy},
                {"energy_drift", ledger_.energy_drift() / energy},
                {"parasitic", ledger_.parasitic() / speed},
                {"momentum_drift", ledger_.momentum_drift() / momentum},
                {"rest_angular_momentum_drift", ledger_.rest_angular_momentum_drift() / momentum},
                {"events", report.events},
                {"missed_contacts", report.missed_contacts}};
    }
    [[nodiscard]] const dynamics::LedgerEntry<Dim>& first() const { return ledger_.entries().front(); }

private:
    static std::vector<double> at_random(std::size_t n, double size) {
        std::mt19937_64 generator(1);
        std::uniform_real_distribution<double> value(-size, size);
        std::vector<double> field(n, 0.0);
        if (size > 0.0)
            for (double& x : field) x = value(generator);
        return field;
    }

    solid::Solid<Dim> solid_;
    dynamics::Memm<solid::Solid<Dim>> memm_;
    dynamics::Ledger<Dim> ledger_;
    double seconds_ = 0.0;
};

/// Along the line of centres at the start.
template <int Dim>
double restitution(const std::vector<solid::BodyMotion<Dim>>& motions) {
    Vector<Dim> line = Vector<Dim>::Zero();
    line[0] = std::sqrt(4.0 - offset * offset);
    line[1] = offset;
    line.normalize();
    return (motions[1].velocity - motions[0].velocity).dot(line) / (2.0 * speed * line[0]);
}

void print(const std::string& name, const nlohmann::json& figures) {
    const auto value = [&](const char* key) { return figures.at(key).template get<double>(); };
    fmt::print("  {:<7} H~ {:.1e}, H {:.1e}, |e|/m v {:.2g}, momentum {:.1e}, J {:.1e}, {} events, {} missed, {:.2f} s\n",
               name, value("pseudo_energy_drift"), value("energy_drift"), value("parasitic"), value("momentum_drift"),
               value("rest_angular_momentum_drift"), figures.at("events").get<std::int64_t>(),
               figures.at("missed_contacts").get<std::int64_t>(), value("seconds"));
}

template <int Dim>
nlohmann::json impact(double size, const Choices& choices) {
    const auto mesh = two_bodies<Dim>(size);
    const std::vector<Vector<Dim>> velocity{speed * Vector<Dim>::Unit(0), -speed * Vector<Dim>::Unit(0)};
    Run<Dim> in_double(mesh, Precision::double_precision, velocity, 0.0, 0.9);
    Run<Dim> in_single(mesh, Precision::single_precision, velocity, 0.0, 0.9);
    const benchmark::Clock clock = benchmark::clock_for(choices.threads);
    while (in_double.time() < choices.end)
        for (Run<Dim>* run : {&in_double, &in_single}) {
            run->steps(turn, clock);
            run->record();
        }
    const double energy = in_double.first().kinetic, momentum = in_double.motions()[0].mass * speed;
    nlohmann::json result{{"dim", Dim},
                          {"cells", mesh.n_cells()},
                          {"double", in_double.figures(energy, momentum)},
                          {"single", in_single.figures(energy, momentum)}};
    const auto a = in_double.motions(), b = in_single.motions();
    result["double"]["restitution"] = restitution<Dim>(a);
    result["single"]["restitution"] = restitution<Dim>(b);
    result["velocity_difference"] = (a[0].velocity - b[0].velocity).norm() / speed;
    fmt::print("impact in {}D, {} cells, {} steps; restitution {:.8f} and {:.8f}, velocity differs by {:.1e} of the speed\n",
               Dim, mesh.n_cells(), result["double"]["steps"].get<std::int64_t>(), restitution<Dim>(a), restitution<Dim>(b),
               result["velocity_difference"].get<double>());
    print("double", result["double"]);
    print("single", result["single"]);
    return result;
}

/// The largest |H~ - H~0| up to powers of ten of the steps.
nlohmann::json vibration(const Choices& choices) {
    const auto mesh = mesh::disc({.radius = 1.0, .size = 0.2});
    Run<2> in_double(mesh, Precision::double_precision, {Vector<2>::Zero()}, 1e-3, 0.9);
    Run<2> in_single(mesh, Precision::single_precision, {Vector<2>::Zero()}, 1e-3, 0.9);
    const double energy = in_double.first().pseudo_energy;
    const double momentum = std::sqrt(2.0 * energy * in_double.motions()[0].mass);
    nlohmann::json results;
    int next = 100;
    fmt::print("free vibration, {} cells\n", mesh.n_cells());
    for (int steps = turn; steps <= choices.long_steps; steps += turn) {
        for (Run<2>* run : {&in_double, &in_single}) {
            run->steps(turn, benchmark::clock_for(choices.threads));
            run->record();
        }
        if (steps != next && steps != choices.long_steps) continue;
        next *= 10;
        results.push_back(
            {{"double", in_double.figures(energy, momentum)}, {"single", in_single.figures(energy, momentum)}});
        fmt::print(" {} steps\n", steps);
        print("double", results.back()["double"]);
        print("single", results.back()["single"]);
    }
    return results;
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Steps in single precision against those in double: energy, momentum, motion.");
    options.add("--size-2d", choices.size_2d, "edge lengths of the cells of the discs [m]; 0: leaves them out");
    options.add("--size-3d", choices.size_3d, "of the cylinders");
    options.add("--end", choices.end, "of the impacts [s]").positive();
    options.add("--long-steps", choices.long_steps, "of the free vibration").not_negative();
    options.add("--threads", choices.threads).positive();
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    nlohmann::json result = benchmark::circumstances(argc, argv);
    if (choices.size_2d > 0.0) result["impacts"].push_back(impact<2>(choices.size_2d, choices));
    if (choices.size_3d > 0.0) result["impacts"].push_back(impact<3>(choices.size_3d, choices));
    result["vibration"] = vibration(choices);
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
