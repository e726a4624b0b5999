// abut.h in a host of C++17: an exception of its callback becomes a status.
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "abut.h"

int main() {
    double nodes[8] = {1, 0, 0, 0, 0, 0.1, 1, 0.1};
    const int32_t corners[4] = {0, 1, 2, 3}, body[2] = {0, 1};
    const double depth[2] = {0.1, 0.1}, stiffness[2] = {3.0, 3.0};
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = 2, faces.nodes = corners, faces.n_nodes = 4, faces.body = body;
    faces.depth = depth, faces.stiffness = stiffness, faces.n_bodies = 2;
    abut_options options;
    abut_options_init(&options);
    options.wanted = [](int32_t, int32_t, void*) -> int { throw std::runtime_error("of the host"); };
    abut_contact* contact = nullptr;
    abut_error error = ABUT_ERROR_INIT;
    const abut_array x = {nodes, 4, 2, 1}, nothing = {nullptr, 0, 0, 0};
    if (abut_create(2, x, &faces, &options, &contact, &error) != ABUT_OK) return 1;
    const int status = abut_step(contact, 1.0, x, x, ABUT_MEAN, nothing, nullptr, &error);
    std::puts(error.message);
    abut_destroy(contact);
    return status == ABUT_CALLBACK && std::isnan(error.value) ? 0 : 1;
}
