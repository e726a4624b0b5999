#include "detect/shapes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "abut/mesh/surface_shapes.hpp"
#include "support/choices.hpp"

namespace abut::examples {
namespace {

using mesh::SurfaceMesh;

constexpr double most_count = 1e8;

/// The keys of one shape with their values; what is read is taken out.
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

    void take(const std::string& key, std::string& value) {
        if (const auto entry = values_.find(key); entry != values_.end()) value = values_.extract(entry).mapped();
    }
    void take(const std::string& key, double& value) {
        std::string text;
        take(key, text);
        if (!text.empty()) value = parse(key, text, {});
    }
    void take(const std::string& key, int& value) {
        std::string text;
        take(key, text);
        if (text.empty()) return;
        const double number = parse(key, text, {.above = -1.0, .below = most_count});
        if (number != std::floor(number)) refuse(fmt::format("'{}={}' is no whole number", key, text));
        value = static_cast<int>(number);
    }
    /// About how many faces are asked for; 0: not said.
    [[nodiscard]] double faces() {
        std::string text;
        take("n", text);
        return text.empty() ? 0.0 : parse("n", text, {.above = 0.0, .below = most_count});
    }
    void check_all_taken(const std::string& known) const {
        if (!values_.empty())
            refuse(fmt::format("'{}' is no key of this shape; it knows {}", values_.begin()->first, known));
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::invalid_argument(fmt::format("{}: {}. (--help lists shapes and keys.)", text_, what));
    }
    double parse(const std::string& key, const std::string& text, const Limits& limits) const {
        return parse_number(text, fmt::format("{}: {}", text_, key), limits);
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

int rounded(double value, int least) { return std::max(least, static_cast<int>(std::lround(value))); }

SurfaceMesh torus(Keys& keys) {
    mesh::TorusOptions options;
    if (const double n = keys.faces(); n > 0.0) {
        options.n_tube = rounded(std::sqrt(n / 6.0), 3);
        options.n_around = 3 * options.n_tube;
    }
    keys.take("n_around", options.n_around);
    keys.take("n_tube", options.n_tube);
    keys.take("radius", options.radius);
    keys.take("tube", options.tube_radius);
    keys.take("axis", options.axis);
    return mesh::torus_surface(options);
}

SurfaceMesh gear(Keys& keys) {
    mesh::GearOptions options;
    keys.take("teeth", options.n_teeth);
    if (const double n = keys.faces(); n > 0.0) {
        options.n_flank = rounded(std::sqrt(n / (56.0 * options.n_teeth)), 1);
        options.n_radial = rounded(1.5 * options.n_flank, 1);
        options.n_axial = 2 * options.n_flank;
    }
    keys.take("n_flank", options.n_flank);
    keys.take("n_radial", options.n_radial);
    keys.take("n_axial", options.n_axial);
    keys.take("bore", options.bore_radius);
    keys.take("root", options.root_radius);
    keys.take("tip", options.tip_radius);
    keys.take("share", options.tooth_share);
    keys.take("thickness", options.thickness);
    keys.take("turn", options.turn);
    keys.take("axis", options.axis);
    return mesh::gear_surface(options);
}

SurfaceMesh sphere(Keys& keys) {
    mesh::SphereSurfaceOptions options;
    if (const double n = keys.faces(); n > 0.0) options.n_subdivisions = rounded(std::log(n / 20.0) / std::log(4.0), 0);
    keys.take("subdivisions", options.n_subdivisions);
    keys.take("radius", options.radius);
    return mesh::sphere_surface(options);
}

SurfaceMesh sheet(Keys& keys) {
    mesh::SheetOptions options;
    if (const double n = keys.faces(); n > 0.0) options.n_x = options.n_y = rounded(std::sqrt(n / 2.0), 1);
    keys.take("n_x", options.n_x);
    keys.take("n_y", options.n_y);
    keys.take("size_x", options.size_x);
    keys.take("size_y", options.size_y);
    keys.take("amplitude", options.amplitude);
    keys.take("waves", options.n_waves);
    return mesh::sheet_surface(options);
}

SurfaceMesh barrel(Keys& keys) {
    mesh::BarrelOptions options;
    if (const double n = keys.faces(); n > 0.0) {
        options.n_side = rounded(std::sqrt(n / 20.0), 1);
        options.n_along = 2 * options.n_side;
    }
    int closed = 1;
    keys.take("n_side", options.n_side);
    keys.take("n_along", options.n_along);
    keys.take("radius", options.radius);
    keys.take("length", options.length);
    keys.take("closed", closed);
    keys.take("axis", options.axis);
    options.closed = closed != 0;
    return mesh::barrel_surface(options);
}

SurfaceMesh soup(Keys& keys) {
    mesh::RandomTrianglesOptions options;
    if (const double n = keys.faces(); n > 0.0) options.n = rounded(n, 1);
    int seed = 1;
    keys.take("seed", seed);
    keys.take("box", options.box_size);
    keys.take("size", options.size);
    options.seed = static_cast<std::uint64_t>(seed);
    options.name = "soup";
    return mesh::random_triangles(options);
}

struct Shape {
    const char* name;
    const char* keys;  ///< besides those that all shapes know
    SurfaceMesh (*make)(Keys&);
};
constexpr const char* common_keys = "n, x, y, z, flip, name";
constexpr std::array<Shape, 6> shapes = {
    {{"torus", "radius, tube, axis, n_around, n_tube", torus},
     {"gear", "teeth, bore, root, tip, share, thickness, turn, axis, n_flank, n_radial, n_axial", gear},
     {"sphere", "radius, subdivisions", sphere},
     {"sheet", "size_x, size_y, amplitude, waves, n_x, n_y", sheet},
     {"barrel", "radius, length, closed, axis, n_side, n_along", barrel},
     {"soup", "box, size, seed", soup}}};

auto find_shape(const std::string& text) {
    const std::string name = text.substr(0, text.find(':'));
    return std::ranges::find_if(shapes, [&](const Shape& shape) { return name == shape.name; });
}

void flip(SurfaceMesh& surface) {
    for (std::int32_t face = 0; face < surface.faces.size(); ++face)
        std::reverse(surface.faces.values.begin() + surface.faces.offsets[static_cast<std::size_t>(face)],
                     surface.faces.values.begin() + surface.faces.offsets[static_cast<std::size_t>(face) + 1]);
}

}  // namespace

bool is_shape(const std::string& text) { return find_shape(text) != shapes.end(); }

SurfaceMesh make_shape(const std::string& text) {
    const Shape& shape = *find_shape(text);
    Keys keys(text);
    Vector<3> moved = Vector<3>::Zero();
    int flipped = 0;
    std::string name = shape.name;
    keys.take("x", moved[0]);
    keys.take("y", moved[1]);
    keys.take("z", moved[2]);
    keys.take("flip", flipped);
    keys.take("name", name);
    SurfaceMesh surface = shape.make(keys);
    keys.check_all_taken(fmt::format("{}, {}", common_keys, shape.keys));
    for (Vector<3>& x : surface.vertices) x += moved;
    if (flipped != 0) flip(surface);
    surface.name = name;
    surface.body_names = {name};
    return surface;
}

std::string shapes_help() {
    std::string text = fmt::format("Shapes: all know {} (about n faces; flip=1 turns faces round); besides\n", common_keys);
    for (const Shape& shape : shapes) text += fmt::format("  {:<8}{}\n", shape.name, shape.keys);
    return text;
}

}  // namespace abut::examples
