#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/kinematics/rows.hpp"

namespace abut::studies::kinematics {
namespace {

constexpr int discs = 5;
constexpr double speed = 0.01;

/// `apart`: one contact ends before the next one begins.
void strike(Kinematics kinematics, bool apart, const Options& options, const Sink& sink) {
    const double gap = apart ? 0.25 : 1e-3;
    const int corners = 48;
    const bool rigid = kinematics == Kinematics::rigid;
    const double inner = rigid ? std::cos(std::numbers::pi / corners) : 1.0;
    std::vector<mesh::Mesh<2>> meshes;
    for (int i = 0; i < discs; ++i) {
        const Vector<2> centre(i * (2.0 * inner + gap), 0.0);
        const std::string name = fmt::format("disc {}", i + 1);
        meshes.push_back(
            rigid ? mesh::fan_disc(centre, 1.0, corners, std::numbers::pi / corners, name)
                  : mesh::disc({.centre = centre, .size = options.quick ? 0.4 : 0.15, .variant = i, .name = name}));
    }
    Case<2> one = case_of<2>("cradle", meshes, kinematics);
    one.motion[0].velocity = {speed, 0.0};
    one.scene.time = discs * gap / speed + 100.0;
    one.run.filter = true;
    CaseResult<2> result;
    const std::string setting = name_of(kinematics) + (apart ? ", one after the other" : ", nearly touching");
    Row row = row_of<2>(one, setting, options, &result);
    const bool is_ideal = rigid && apart;
    for (std::size_t i = 0; i < result.velocity.size(); ++i)
        row.quantities.push_back({.name = fmt::format("velocity of disc {}, over that of the first before", i + 1),
                                  .unit = "",
                                  .value = result.velocity[i].x() / speed,
                                  .reference = i + 1 == discs ? 1.0 : 0.0,
                                  .scale = 1.0,
                                  .allowed = is_ideal ? 0.01 : no_target});
    sink(row);
}

}  // namespace

void run_cradle(const Options& options, const Sink& sink) {
    for (const Kinematics kinematics : {Kinematics::rigid, Kinematics::floating})
        for (const bool apart : {true, false}) strike(kinematics, apart, options, sink);
}

}  // namespace abut::studies::kinematics
