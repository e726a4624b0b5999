#!/bin/bash
# Boost.odeint: velocity_verlet after a body was moved, and with damping
# Packages of Debian 12: libboost1.74-dev=1.74.0+ds1-21. Needs g++.
# Guess: do_step takes a state, a time and a step, and its result depends on these alone. A force that depends on velocity, such as
#   damping, is let in, since it is an argument, and the order stays 2.
# Seen: the stepper keeps the acceleration of its last step. Once a state is set, as after a restart or for a second body, its next
#   step takes the old one, without a word: an oscillator that is put to x = 3 moves by 0.003 for 0.015. reset() cures it. With damping
#   the order is 1.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libboost1.74-dev=1.74.0+ds1-21
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'C'
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>
using Values = std::vector<double>;
using State = std::pair<Values, Values>;  // x and v
using Stepper = boost::numeric::odeint::velocity_verlet<Values>;

struct Oscillator {
    double damping;
    void operator()(const Values& x, const Values& v, Values& a, double) const { a[0] = -x[0] - damping * v[0]; }
};

double after_one(const Oscillator& oscillator, int n_steps) {  // x(1) from x = 1 at rest
    Stepper stepper;
    State state{{1.0}, {0.0}};
    for (int i = 0; i < n_steps; ++i) stepper.do_step(oscillator, state, double(i) / n_steps, 1.0 / n_steps);
    return state.first[0];
}

int main() {
    const Oscillator free{0.0}, damped{1.0};
    Stepper used, reset, fresh;
    State earlier{{1.0}, {0.0}}, same{{1.0}, {0.0}};
    for (int i = 0; i < 10; ++i) {
        used.do_step(free, earlier, 0.1 * i, 0.1);
        reset.do_step(free, same, 0.1 * i, 0.1);
    }
    reset.reset();
    for (auto [name, stepper] : {std::pair{"used", &used}, {"reset", &reset}, {"fresh", &fresh}}) {
        State moved{{3.0}, {0.0}};
        stepper->do_step(free, moved, 1.0, 0.1);
        std::printf("%s: from x = 3 at rest to x = %.4f, v = %.4f\n", name, moved.first[0], moved.second[0]);
    }
    const double w = std::sqrt(0.75);
    const double exact = std::cos(1.0), exact_damped = std::exp(-0.5) * (std::cos(w) + std::sin(w) / (2.0 * w));
    const auto order = [](double coarse, double fine) { return std::log2(std::abs(coarse / fine)); };
    std::printf("order without damping %.1f, with damping %.1f\n", order(after_one(free, 40) - exact, after_one(free, 80) - exact),
                order(after_one(damped, 40) - exact_damped, after_one(damped, 80) - exact_damped));
}
C
g++ -std=c++17 -O1 -isystem "$work/usr/include" a.cpp -o a
./a | tee output
diff output - <<'C'
used: from x = 3 at rest to x = 2.9973, v = -0.1769
reset: from x = 3 at rest to x = 2.9850, v = -0.2993
fresh: from x = 3 at rest to x = 2.9850, v = -0.2993
order without damping 2.0, with damping 1.0
C
