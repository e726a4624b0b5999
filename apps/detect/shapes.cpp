#include "apps/detect/shapes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>
#include <vector>

#include "abut/mesh/shapes/surface_shapes.hpp"
#include "apps/detect/placing.hpp"

namespace abut::apps {
namespace {

using mesh::SurfaceMesh;

constexpr double most_count = 1e8;

/// About how many faces are asked for; 0: not said.
double faces_wanted(const Keys& keys) {
    double n = 0.0;
    keys.read("n", n, {.above = 0.0, .below = most_count});
    return n;
}

/// A key and the argument of the library that it sets.
template <class Options>
struct Argument {
    const char* key;
    std::variant<double Options::*, int Options::*, bool Options::*, std::uint64_t Options::*> member;
};

struct Shape {
    std::string name;
    std::vector<std::string> keys;  ///< besides those that all shapes know
    std::function<SurfaceMesh(const Keys&)> make;
};

/// `choose` sets the counts that give about n faces. A count that is given by its own key has the last word.
template <class Options>
Shape shape(const char* name, SurfaceMesh (*make)(const Options&), void (*choose)(Options&, double n),
            const std::vector<Argument<Options>>& arguments) {
    std::vector<std::string> names;
    for (const Argument<Options>& argument : arguments) names.emplace_back(argument.key);
    return {name, names, [=](const Keys& keys) {
                Options options;
                options.name = name;
                const auto read_all = [&] {
                    for (const Argument<Options>& argument : arguments)
                        std::visit([&](auto member) { keys.read(argument.key, options.*member); }, argument.member);
                };
                read_all();
                if (const double n = faces_wanted(keys); n > 0.0) {
                    choose(options, n);
                    read_all();
                }
                return make(options);
            }};
}

int rounded(double value, int least) { return std::max(least, static_cast<int>(std::lround(std::min(value, most_count)))); }

void choose_counts(mesh::TorusOptions& options, double n) {
    options.n_tube = rounded(std::sqrt(n / 6.0), 3);
    options.n_around = 3 * options.n_tube;
}
void choose_counts(mesh::GearOptions& options, double n) {
    options.n_flank = rounded(std::sqrt(n / (56.0 * options.n_teeth)), 1);
    options.n_radial = rounded(1.5 * options.n_flank, 1);
    options.n_axial = 2 * options.n_flank;
}
void choose_counts(mesh::SphereSurfaceOptions& options, double n) {
    options.n_subdivisions = rounded(std::log(n / 20.0) / std::log(4.0), 0);
}
void choose_counts(mesh::SheetOptions& options, double n) { options.n_x = options.n_y = rounded(std::sqrt(n / 2.0), 1); }
void choose_counts(mesh::BarrelOptions& options, double n) {
    options.n_side = rounded(std::sqrt(n / 20.0), 1);
    options.n_along = 2 * options.n_side;
}
void choose_counts(mesh::RandomTrianglesOptions& options, double n) { options.n = rounded(n, 1); }

/// A function, for --help asks for it before main begins.
const std::vector<Shape>& shapes() {
    using Torus = mesh::TorusOptions;
    using Gear = mesh::GearOptions;
    using Sphere = mesh::SphereSurfaceOptions;
    using Sheet = mesh::SheetOptions;
    using Barrel = mesh::BarrelOptions;
    using Soup = mesh::RandomTrianglesOptions;
    static const std::vector<Shape> table = {
        shape<Torus>("torus", mesh::torus_surface, choose_counts,
                     {{"radius", &Torus::radius},
                      {"tube", &Torus::tube_radius},
                      {"axis", &Torus::axis},
                      {"n_around", &Torus::n_around},
                      {"n_tube", &Torus::n_tube}}),
        shape<Gear>("gear", mesh::gear_surface, choose_counts,
                    {{"teeth", &Gear::n_teeth},
                     {"bore", &Gear::bore_radius},
                     {"root", &Gear::root_radius},
                     {"tip", &Gear::tip_radius},
                     {"share", &Gear::tooth_share},
                     {"thickness", &Gear::thickness},
                     {"turn", &Gear::turn},
                     {"axis", &Gear::axis},
                     {"n_flank", &Gear::n_flank},
                     {"n_radial", &Gear::n_radial},
                     {"n_axial", &Gear::n_axial}}),
        shape<Sphere>("sphere", mesh::sphere_surface, choose_counts,
                      {{"radius", &Sphere::radius}, {"subdivisions", &Sphere::n_subdivisions}}),
        shape<Sheet>("sheet", mesh::sheet_surface, choose_counts,
                     {{"size_x", &Sheet::size_x},
                      {"size_y", &Sheet::size_y},
                      {"amplitude", &Sheet::amplitude},
                      {"waves", &Sheet::n_waves},
                      {"n_x", &Sheet::n_x},
                      {"n_y", &Sheet::n_y}}),
        shape<Barrel>("barrel", mesh::barrel_surface, choose_counts,
                      {{"radius", &Barrel::radius},
                       {"length", &Barrel::length},
                       {"closed", &Barrel::closed},
                       {"axis", &Barrel::axis},
                       {"n_side", &Barrel::n_side},
                       {"n_along", &Barrel::n_along}}),
        shape<Soup>("soup", mesh::random_triangles, choose_counts,
                    {{"box", &Soup::box_size}, {"size", &Soup::size}, {"seed", &Soup::seed}})};
    return table;
}

auto find_shape(const std::string& text) {
    return std::ranges::find(shapes(), text.substr(0, text.find(':')), &Shape::name);
}

}  // namespace

bool is_shape(const std::string& text) { return find_shape(text) != shapes().end(); }

SurfaceMesh make_shape(const std::string& text) {
    const Shape& shape = *find_shape(text);
    const Keys keys(text, text.find(':'));
    std::vector<std::string> known = placing_keys();
    known.emplace_back("n");
    known.insert(known.end(), shape.keys.begin(), shape.keys.end());
    keys.check_known(known);
    SurfaceMesh surface = shape.make(keys);
    surface.name = shape.name;
    surface.body_names = {shape.name};
    place(surface, keys);
    return surface;
}

std::string shapes_help() {
    std::string text = "Shapes: all know n, about how many faces; besides\n";
    for (const Shape& shape : shapes()) text += fmt::format("  {:<8}{}\n", shape.name, fmt::join(shape.keys, ", "));
    return text;
}

}  // namespace abut::apps
