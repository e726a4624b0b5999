// Contact detection on complex meshes: says what it found.
//
// Which faces of bodies lie opposite each other, how near, and what area they share: for surfaces and boundaries of meshes
// from files, or shapes by formula, at rest, moved, turned or deformed step by step. Of each pair with the normals n_1, n_2,
// n_1 . n_2 < --facing, seen along n = (n_1 - n_2)/|n_1 - n_2|: the area A > 0 of what the faces share, and the gap
// g = (x_2 - x_1) . n, -depth < g <= distance. It also says what is wrong with the meshes, and --verify compares the lists
// with plain loops over all pairs.
//
//   detect torus:n=4000 torus:n=4000,x=1,axis=1,tube=0.6 --distance 0.12 --verify
//
// Two interlocked tori, R = 1: every point of the one circle has the distance 1 from the other, so that between tubes of
// 0.3 and 0.6 the gap is 0.1, up to the square of the size of a face: 0.1027 is found here, 0.1008 of 16,000 faces each.
// No pair is missed.
#include "apps/detect/detect.hpp"

int main(int argc, char** argv) {
    using namespace abut::apps;
    DetectOptions options;
    return run_program(
        detect_program, argc, argv, [&](CLI::App& app) { add_options(app, options); }, [&] { detect(options); });
}
