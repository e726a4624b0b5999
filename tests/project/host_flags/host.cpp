// Two unit squares pressed d into each other over 0.8 m by the springs of both in series, k = 2: W = k d^2/2 0.8 = 2e-3 J
// and 0.8 k d = 0.08 N. Containers, matrices, spans and an exception cross the border between host and library.
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/nodal_contact.hpp"

using namespace abut;

int main() {
    constexpr double d = 0.05;
    std::vector<Vector<2>> x{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.2, 1.1}, {1.2, 1.1}, {1.2, 2.1}, {0.2, 2.1}};
    const std::vector<std::int32_t> nodes{0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4}, body{0, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<double> depth(8, 0.1), stiffness{3.0, 6.0};
    contact::NodalContact<2> contact(
        contact::NodalSurface<2>(x, {.nodes = nodes, .body = body, .depth = depth, .stiffness = stiffness}), {});
    std::vector<Vector<2>> pressed = x, force(8, Vector<2>::Zero());
    for (int i = 4; i < 8; ++i) pressed[i].y() -= 0.1 + d;
    contact.step(1.0, x, x);
    const contact::NodalStep<2>& step = contact.step(1.0, x, pressed, contact::TakenForce::end);
    step.add_force_to(force);
    double up = 0.0;
    for (int i = 4; i < 8; ++i) up += force[i].y();
    std::printf("W = %.17g J, %.17g N, %zu pair of %zu bytes of state\n", step.energy, up, step.pairs.size(),
                contact.state().size());
    bool good = std::abs(step.energy - 2e-3) < 1e-15 && std::abs(up - 0.08) < 1e-14 && step.pairs.size() == 1;

    pressed[5].y() = std::numeric_limits<double>::quiet_NaN();  // -ffast-math of the host does not switch the checks off
    try {
        contact.step(1.0, x, pressed);
        good = false;
    } catch (const Diverged& error) {
        std::printf("%s\n", error.what());
    }
    return good ? 0 : 1;
}
