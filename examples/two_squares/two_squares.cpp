// Contact in a solver of one's own, in C++: two squares of four nodes each run into each other and part.
#include <cstdio>
#include <vector>

#include "abut/contact/nodal_contact.hpp"

using namespace abut;

int main() {
    // Two unit squares, 0.05 m apart; faces run so that their body lies to the left
    const std::vector<Vector<2>> rest{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.05, 0.1}, {2.05, 0.1}, {2.05, 1.1}, {1.05, 1.1}};
    const std::vector<std::int32_t> nodes{0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};  // two per face
    const std::vector<std::int32_t> body{0, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<double> depth(8, 0.5);  // [m] half the height of the element behind a face
    const std::vector<double> stiffness(2, contact::skin_stiffness(1.0, depth));  // lambda + 2 mu = 1 Pa
    contact::NodalContact<2> contact(
        {rest,
         {.nodes = nodes, .offsets = {}, .body = body, .depth = depth, .stiffness = stiffness, .shear_stiffness = {}}});

    const double mass = 0.25;                                             // [kg/m] of each node
    const double dt = contact.stable_step(std::vector(8, mass), 2.0).dt;  // 2 rad/s: the fastest swing of a square alone
    std::vector<Vector<2>> x_0 = rest, x_1 = rest, v(8, Vector<2>(0.1, 0));
    for (int n = 4; n < 8; ++n) v[n] = {-0.1, 0};
    for (int step = 0; step < 4.0 / dt; ++step) {
        std::vector<Vector<2>> force(8, Vector<2>::Zero());
        for (int n = 0; n < 8; ++n) x_1[n] = x_0[n] + dt * v[n];
        contact.step(dt, x_0, x_1, contact::TakenForce::end).add_force_to(force);  // all there is to contact
        for (int b = 0; b < 8; b += 4) {  // your elements: here springs to the mean motion
            Vector<2> mean = Vector<2>::Zero();
            for (int n = b; n < b + 4; ++n) mean += (x_1[n] - rest[n]) / 4;
            for (int n = b; n < b + 4; ++n) force[n] -= x_1[n] - rest[n] - mean;
        }
        for (int n = 0; n < 8; ++n) v[n] += dt / mass * force[n];
        x_0 = x_1;
    }
    const Vector<2> left = (v[0] + v[1] + v[2] + v[3]) / 4, right = (v[4] + v[5] + v[6] + v[7]) / 4;
    std::printf("left (%.3f, %.3f), right (%.3f, %.3f), missed contacts: %d\n", left[0], left[1], right[0], right[1],
                int(contact.report().missed_contacts));
}
