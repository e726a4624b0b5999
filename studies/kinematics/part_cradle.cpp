#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/kinematics/closed_forms.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace cradle_part {
namespace {

using std::numbers::pi;

constexpr int bodies = 5;
constexpr double speed = 0.01;

/// Bodies in a row along x, the first of which comes with `speed`.
template <int Dim>
struct Cradle {
    std::string name;
    std::string body;  ///< what one of them is called
    Kinematics kinematics;
    bool apart;          ///< one contact ends before the next one begins
    double young = 1.0;  ///< [Pa]
    double gap = 0.0;    ///< from one to the next [m]
    double time = 0.0;   ///< of the run [s]
    std::vector<mesh::Mesh<Dim>> meshes{};
    std::vector<double> expected{0.0, 0.0, 0.0, 0.0, 1.0};  ///< velocities over that of the first before
    double allowed = no_target;                             ///< of each

    [[nodiscard]] std::string name_of_body(std::size_t i) const { return fmt::format("{} {}", body, i + 1); }
};

/// Rigid bodies are hard, so that they touch by nearly one face each.
template <int Dim>
Cradle<Dim> cradle_of(const std::string& name, const std::string& body, Kinematics kinematics, bool apart) {
    const bool rigid = kinematics == Kinematics::rigid;
    Cradle<Dim> cradle{.name = name, .body = body, .kinematics = kinematics, .apart = apart};
    if (rigid) cradle.young = Dim == 2 ? 100.0 : 10.0;
    const double lasts = rigid ? 3.0 : 25.0;  // longer than a contact [s]
    cradle.gap = (apart ? lasts : rigid ? 1e-3 : 0.1) * speed;
    cradle.time = bodies * cradle.gap / speed + 4.0 * lasts;
    return cradle;
}

template <int Dim>
void strike(const Cradle<Dim>& cradle, const Options& options, const Sink& sink) {
    Case<Dim> one = case_of<Dim>(cradle.name, cradle.meshes, cradle.kinematics);
    for (solid::Material& material : one.scene.solid.materials) material.young = cradle.young;
    one.motion[0].velocity = speed * Vector<Dim>::Unit(0);
    one.scene.time = cradle.time;
    one.run.filter = true;
    CaseResult<Dim> result;
    const std::string setting =
        run::name_of(cradle.kinematics) + (cradle.apart ? ", one after the other" : ", nearly touching");
    Row row = row_of<Dim>(one, setting, options, &result);
    for (std::size_t i = 0; i < result.velocity.size(); ++i)
        row.quantities.push_back(
            {.name = fmt::format("velocity of {}, over that of the first before", cradle.name_of_body(i)),
             .unit = "",
             .value = result.velocity[i][0] / speed,
             .reference = cradle.expected[i],
             .scale = 1.0,
             .allowed = cradle.allowed});
    sink(row);
}

/// Flat faces of an area that touch as a whole: a spring of both skins, each of a depth, between masses.
template <int Dim>
void expect_springs(Cradle<Dim>& cradle, double area, double depth_1, double depth_2) {
    const mesh::Mesh<Dim>& mesh = cradle.meshes.front();
    Chain chain{.mass = 0.0, .gap = cradle.gap, .speed = speed};
    for (const double measure : mesh.cell_measure) chain.mass += measure;
    const double wave_modulus = cradle.young * 0.7 / (1.3 * 0.4);  // lambda + 2 mu at nu = 0.3
    chain.stiffness = area * wave_modulus / (depth_1 + depth_2);
    cradle.expected = velocities_of(chain, cradle.time);
    cradle.allowed = 0.01;
}

void strike_discs(Kinematics kinematics, bool apart, const Options& options, const Sink& sink) {
    const int corners = 24;
    const bool rigid = kinematics == Kinematics::rigid;
    const double inner = rigid ? std::cos(pi / corners) : 1.0;
    auto cradle = cradle_of<2>("cradle", "disc", kinematics, apart);
    for (int i = 0; i < bodies; ++i) {
        const Vector<2> centre((i - 0.5 * (bodies - 1)) * (2.0 * inner + cradle.gap), 0.0);
        const std::string name = cradle.name_of_body(static_cast<std::size_t>(i));
        cradle.meshes.push_back(
            rigid ? mesh::fan_disc(centre, 1.0, corners, pi / corners, name)
                  : mesh::disc({.centre = centre, .size = options.quick ? 0.4 : 0.15, .variant = i, .name = name}));
    }
    if (rigid) expect_springs(cradle, 2.0 * std::sin(pi / corners), 0.5 * inner, 0.5 * inner);
    strike<2>(cradle, options, sink);
}

void strike_spheres(Kinematics kinematics, bool apart, const Options& options, const Sink& sink) {
    const bool rigid = kinematics == Kinematics::rigid;
    auto cradle = cradle_of<3>("spheres", "sphere", kinematics, apart);
    Ball ball;
    const double pitch = (rigid ? ball.front_distance() + ball.back_distance() : 2.0 * ball.radius) + cradle.gap;
    for (int i = 0; i < bodies; ++i) {
        ball.centre = {(i - 0.5 * (bodies - 1)) * pitch, 0.0, 0.0};
        ball.name = cradle.name_of_body(static_cast<std::size_t>(i));
        cradle.meshes.push_back(
            rigid
                ? faceted_ball(ball)
                : mesh::sphere({.centre = ball.centre, .size = options.quick ? 0.6 : 0.3, .variant = i, .name = ball.name}));
    }
    if (rigid)
        expect_springs(cradle, ball.back_area(), ball.depth() * ball.front_distance(), ball.depth() * ball.back_distance());
    strike<3>(cradle, options, sink);
}

}  // namespace
}  // namespace cradle_part

void run_cradle(const Options& options, const Sink& sink) {
    using namespace cradle_part;
    for (const Kinematics kinematics : {Kinematics::rigid, Kinematics::floating})
        for (const bool apart : {true, false}) strike_discs(kinematics, apart, options, sink);
}

void run_spheres(const Options& options, const Sink& sink) {
    using namespace cradle_part;
    for (const Kinematics kinematics : {Kinematics::rigid, Kinematics::floating})
        for (const bool apart : {true, false}) strike_spheres(kinematics, apart, options, sink);
}

}  // namespace abut::studies::kinematics
