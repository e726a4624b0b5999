#pragma once
#include <string>

namespace abut::examples {

/// What tells one program with two cylinders from another.
struct TwoCylinders {
    std::string program;         ///< its name, and that of its folder of results
    std::string purpose;         ///< one sentence for --help
    double offset_over_radius;   ///< default of --offset over the mean radius of the two [-]
};

/// Main function of these programs: reads the command line, makes two discs (2D) or cylinders with axes along z (3D) that
/// fly towards each other along x, and runs them. Returns the exit code.
int run_two_cylinders(int argc, char** argv, const TwoCylinders& scene);

}  // namespace abut::examples
