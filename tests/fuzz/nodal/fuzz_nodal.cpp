// The law of contact on nodes under random bodies and motions: each step gives finite numbers, forces that add up to nothing
// and W >= 0, and does the work that changes W; or it is refused with an abut::Error.
//
//     fuzz_nodal --executions 100000 --seed 1
//     fuzz_nodal --seed 1 --only 4711        one case again, with what it does
//
// A crash or a case without an end within 10 s prints its number. Ends with 1 if there was a fault.
#include <signal.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/geometry/polygon.hpp"
#include "fuzz/nodal/nodal_cases.hpp"

using namespace abut;
using namespace abut::fuzz;

namespace {

constexpr unsigned time_limit = 10;   ///< [s] for one case
constexpr double no_digits = 1e-280;  ///< what is less has lost its digits

std::array<char, 128> case_name{};  ///< for the handler, which may call next to nothing

void report_crash(int signal_number) {
    const auto say = [](const char* text) {
        if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(3);
    };
    say(signal_number == SIGALRM ? "fault: no end after 10 s: " : "fault: crash: ");
    say(case_name.data());
    say("\n");
    _exit(2);
}

/// What came of all cases.
struct Tally {
    long steps = 0, active = 0, faults = 0;
    std::map<std::string, long> refused;  ///< by kind of error
};

struct Fault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

void require_finite(double value, const char* what) {
    if (!std::isfinite(value)) throw Fault(std::string(what) + " is not finite");
}
template <int Dim>
void require_finite(const Vector<Dim>& value, const char* what) {
    if (!value.allFinite()) throw Fault(std::string(what) + " is not finite");
}

template <int Dim>
void require_numbers(const contact::NodalStep<Dim>& step) {
    for (const auto& gradient : step.gradient) require_finite<Dim>(gradient, "a gradient");
    for (const double value : {step.energy_0, step.energy}) require_finite(value, "an energy");
    require_finite(step.work, "the work");
    require_finite(step.report.compression, "the compression");
    require_finite(step.report.correction, "the correction");
    for (const auto& pair : step.pairs) {
        require_finite<Dim>(pair.normal, "the normal of a pair");
        require_finite<Dim>(pair.force, "the force of a pair");
        for (const double value :
             {pair.gap_0, pair.gap_1, pair.area, pair.normal_force, pair.active_share, pair.compression})
            require_finite(value, "a figure of a pair");
    }
    for (const auto& body : step.bodies) {
        require_finite<Dim>(body.force, "the force of a body");
        require_finite(body.moment.cwiseAbs().sum(), "the moment of a body");
        require_finite(body.work, "the work of a body");
    }
    for (const auto& bodies : step.body_pairs) require_finite<Dim>(bodies.force, "the force of a pair of bodies");
}

std::string text_of(const char* what, double value, double allowed) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(), "%s: %.3g, allowed %.3g", what, value, allowed);
    return text.data();
}

void require_at_most(double value, double allowed, const char* what) {
    if (!(value <= allowed)) throw Fault(text_of(what, value, allowed));
}

/// The least height of a face over its longest edge; 2D: the least length [m].
template <int Dim>
double least_height(const contact::Surface<Dim>& facets, const std::vector<Vector<Dim>>& x) {
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t facet = 0; facet < facets.size(); ++facet) {
        std::array<Vector<Dim>, Dim> corners;
        double longest = 0.0;
        for (int v = 0; v < Dim; ++v) corners[v] = x[static_cast<std::size_t>(facets.face_vertices[Dim * facet + v])];
        for (const auto& a : corners)
            for (const auto& b : corners) longest = std::max(longest, (b - a).norm());
        least = std::min(least, Dim == 2 ? longest : 2.0 * geometry::face_measure<Dim>(corners) / longest);
    }
    return least;
}

/// Sum of forces, sign of W; and of a mean force its work, in steps too short for a face to turn over. Rounding of positions
/// far from the origin counts.
template <int Dim>
void require_laws(const NodalCase<Dim>& scene, const contact::NodalStep<Dim>& step, const contact::Surface<Dim>& facets,
                  const std::vector<Vector<Dim>>& x_0, const std::vector<Vector<Dim>>& x_1, bool is_mean) {
    double stiffest = 0.0;
    for (const double stiffness : scene.faces.stiffness)
        if (std::isfinite(stiffness)) stiffest = std::max(stiffest, stiffness);
    Vector<Dim> sum = Vector<Dim>::Zero();
    double forces = 0.0, work = 0.0, farthest = 0.0, motion = 0.0;
    for (const auto& pair : step.pairs) forces += pair.force.cwiseAbs().sum();
    for (std::size_t i = 0; i < step.nodes.size(); ++i) {
        const auto node = static_cast<std::size_t>(step.nodes[i]);
        sum += step.gradient[i];
        forces += step.gradient[i].cwiseAbs().sum();
        work += step.gradient[i].dot(x_1[node] - x_0[node]);
        motion = std::max(motion, (x_1[node] - x_0[node]).cwiseAbs().maxCoeff());
        farthest = std::max({farthest, x_0[node].cwiseAbs().maxCoeff(), x_1[node].cwiseAbs().maxCoeff()});
    }
    const bool is_short = motion < 0.2 * least_height(facets, x_0);
    const double depth = 1e-15 * farthest;  // by which rounding of positions presses in
    const double force = depth * stiffest * std::pow(scene.size, Dim - 1);
    require_at_most(sum.cwiseAbs().sum(), (is_short ? 1e-11 : 1e-6) * (forces + force) + no_digits, "sum of forces");
    if (step.energy < 0.0 || step.energy_0 < 0.0) throw Fault(text_of("W", std::min(step.energy, step.energy_0), 0.0));
    if (is_mean && is_short)
        require_at_most(
            std::abs(work - (step.energy - step.energy_0)),
            1e-10 * (step.energy + step.energy_0 + forces * motion) + 1e-12 * forces * farthest + depth * force + no_digits,
            "work less change of W");
}

template <int Dim>
void take_steps(const NodalCase<Dim>& scene, Dice& dice, Tally& tally) {
    contact::NodalContact<Dim> contact(contact::NodalSurface<Dim>(scene.rest, scene.faces.view()), scene.options);
    std::vector<Vector<Dim>> x_0 = scene.rest;
    const int n_steps = 1 + dice.below(5);
    for (int i = 0; i < n_steps; ++i) {
        const auto x_1 = moved(scene, x_0, dice);
        const bool is_mean = !dice.one_in(3);
        try {
            const auto& step = contact.step(1.0, x_0, x_1, is_mean ? contact::TakenForce::mean : contact::TakenForce::end);
            ++tally.steps;
            tally.active += step.is_active();
            require_numbers(step);
            require_laws(scene, step, contact.surface().facets(), x_0, x_1, is_mean);
            x_0 = x_1;
        } catch (const Error& error) {
            if (error.kind() == ErrorKind::misuse) throw;
            ++tally.refused[name(error.kind())];
            continue;  // from where the refused step began
        }
        if (dice.one_in(4)) require_numbers(contact.evaluate(x_1));
        if (dice.one_in(8)) contact.restore(contact.state());
        if (dice.one_in(8)) {
            const auto stable = contact.stable_step(std::vector<double>(scene.rest.size(), 1.0), 1.0);
            if (std::isnan(stable.dt) || stable.dt < 0.0) throw Fault(text_of("stable step", stable.dt, 0.0));
        }
    }
}

void run_case(unsigned long seed, unsigned long number, Tally& tally) {
    Dice dice(seed, number);
    try {
        if (dice.one_in(3))
            take_steps(make_case<2>(dice), dice, tally);
        else
            take_steps(make_case<3>(dice), dice, tally);
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::misuse || std::strlen(error.what()) == 0) throw;
        ++tally.refused[name(error.kind())];
    }
}

int run(unsigned long n, unsigned long seed, unsigned long first) {
    for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) signal(signal_number, report_crash);
    Tally tally;
    for (unsigned long i = first; i < first + n; ++i) {
        std::snprintf(case_name.data(), case_name.size(), "--seed %lu --only %lu", seed, i);
        alarm(time_limit);
        try {
            run_case(seed, i, tally);
        } catch (const std::exception& error) {
            std::printf("fault: %s: %s\n", case_name.data(), error.what());
            ++tally.faults;
        }
    }
    std::printf("%lu cases with seed %lu: %ld steps, %ld with contact, %ld faults; refused:", n, seed, tally.steps,
                tally.active, tally.faults);
    for (const auto& [kind, count] : tally.refused) std::printf(" %s %ld", kind.c_str(), count);
    std::printf("\n");
    if (n >= 1000 && 10 * tally.active < tally.steps) {
        std::printf("fault: fewer than one step in ten has a contact: the cases try too little\n");
        return 1;
    }
    return tally.faults > 0 ? 1 : 0;
}

unsigned long number_in(const std::string& text) {
    unsigned long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::invalid_argument("'" + text + "' is no whole number of at least 0.");
    return value;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::map<std::string, std::string> options = {{"--executions", "10000"}, {"--seed", "1"}, {"--only", ""}};
        for (int i = 1; i < argc; i += 2) {
            const auto option = options.find(argv[i]);
            if (option == options.end() || i + 1 == argc)
                throw std::invalid_argument(std::string("not an option: ") + argv[i]);
            option->second = argv[i + 1];
        }
        const unsigned long seed = number_in(options["--seed"]);
        if (!options["--only"].empty()) return run(1, seed, number_in(options["--only"]));
        return run(number_in(options["--executions"]), seed, 0);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "fuzz_nodal: %s\nfuzz_nodal --executions N --seed N, or --seed N --only N\n", error.what());
        return 2;
    }
}
