#include "apps/detect/shapes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <variant>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {
namespace {

using mesh::SurfaceMesh;

constexpr double most_count = 1e8;

/// "shape:key=value,key=value". What is read keeps its value where its key is not given.
class Keys {
public:
    explicit Keys(std::string text) : text_(std::move(text)) {
        const auto colon = text_.find(':');
        if (colon == std::string::npos) return;
        std::size_t begin = colon + 1;
        while (begin <= text_.size()) {
            const std::size_t end = std::min(text_.find(',', begin), text_.size());
            add(text_.substr(begin, end - begin));
            begin = end + 1;
        }
    }

    void read(const std::string& key, std::string& value) const {
        if (const auto entry = values_.find(key); entry != values_.end()) value = entry->second;
    }
    void read(const std::string& key, double& value) const { read(key, value, {}); }
    void read(const std::string& key, int& value) const {
        double number = value;
        read(key, number, {.above = -1.0, .below = most_count});
        if (number != std::floor(number)) refuse(fmt::format("'{}={}' is no whole number", key, values_.at(key)));
        value = static_cast<int>(number);
    }
    void read(const std::string& key, bool& value) const {
        int number = value ? 1 : 0;
        read(key, number);
        value = number != 0;
    }
    void read(const std::string& key, std::uint64_t& value) const {
        int number = static_cast<int>(value);
        read(key, number);
        value = static_cast<std::uint64_t>(number);
    }
    /// About how many faces are asked for; 0: not said.
    [[nodiscard]] double faces() const {
        double n = 0.0;
        read("n", n, {.above = 0.0, .below = most_count});
        return n;
    }
    void check_known(const std::vector<std::string>& known) const {
        for (const auto& [key, value] : values_)
            if (std::ranges::find(known, key) == known.end())
                refuse(fmt::format("'{}' is no key of this shape; it knows {}", key, fmt::join(known, ", ")));
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw BadInput(fmt::format("{}: {}. (--help lists shapes and keys.)", text_, what));
    }
    void read(const std::string& key, double& value, const Limits& limits) const {
        if (const auto entry = values_.find(key); entry != values_.end())
            value = parse_number(entry->second, fmt::format("{}: {}", text_, key), limits);
    }
    void add(const std::string& entry) {
        const auto equals = entry.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
            refuse(fmt::format("'{}' is no key=value", entry));
        if (!values_.emplace(entry.substr(0, equals), entry.substr(equals + 1)).second)
            refuse(fmt::format("'{}' is given twice", entry.substr(0, equals)));
    }

    std::string text_;
    std::map<std::string, std::string> values_;
};

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
                if (const double n = keys.faces(); n > 0.0) {
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

std::vector<std::string> common_keys() { return {"n", "x", "y", "z", "flip", "name"}; }

auto find_shape(const std::string& text) {
    return std::ranges::find(shapes(), text.substr(0, text.find(':')), &Shape::name);
}

void flip(SurfaceMesh& surface) {
    for (std::int32_t face = 0; face < surface.faces.size(); ++face)
        std::reverse(surface.faces.values.begin() + surface.faces.offsets[static_cast<std::size_t>(face)],
                     surface.faces.values.begin() + surface.faces.offsets[static_cast<std::size_t>(face) + 1]);
}

}  // namespace

bool is_shape(const std::string& text) { return find_shape(text) != shapes().end(); }

SurfaceMesh make_shape(const std::string& text) {
    const Shape& shape = *find_shape(text);
    const Keys keys(text);
    std::vector<std::string> known = common_keys();
    known.insert(known.end(), shape.keys.begin(), shape.keys.end());
    keys.check_known(known);
    Vector<3> moved = Vector<3>::Zero();
    bool is_flipped = false;
    std::string name = shape.name;
    keys.read("x", moved[0]);
    keys.read("y", moved[1]);
    keys.read("z", moved[2]);
    keys.read("flip", is_flipped);
    keys.read("name", name);
    SurfaceMesh surface = shape.make(keys);
    for (Vector<3>& x : surface.vertices) x += moved;
    if (is_flipped) flip(surface);
    surface.name = name;
    surface.body_names = {name};
    return surface;
}

std::string shapes_help() {
    std::string text = fmt::format("Shapes: all know {} (about n faces; flip=1 turns faces round); besides\n",
                                   fmt::join(common_keys(), ", "));
    for (const Shape& shape : shapes()) text += fmt::format("  {:<8}{}\n", shape.name, fmt::join(shape.keys, ", "));
    return text;
}

}  // namespace abut::apps
