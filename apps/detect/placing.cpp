#include "apps/detect/placing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/index.hpp"
#include "abut/base/rotation.hpp"
#include "abut/mesh/io/length_units.hpp"

namespace abut::apps {
namespace {

using mesh::SurfaceMesh;

constexpr double largest_count = 1e8;
constexpr double radian = std::numbers::pi / 180.0;

std::vector<std::string> unit_names() {
    std::vector<std::string> names;
    for (const auto& [name, length] : mesh::length_units) names.emplace_back(name);
    return names;
}

double scale_of(const Keys& keys) {
    std::string unit = "m";
    double scale = 1.0;
    keys.read("unit", unit);
    keys.read("scale", scale, {.above = 0.0});
    const auto known = std::ranges::find(mesh::length_units, unit, &Word<double>::word);
    if (known == mesh::length_units.end())
        keys.refuse(fmt::format("'{}' is no unit of length; there are {}", unit, fmt::join(unit_names(), ", ")));
    return scale * known->choice;
}

Vector<3> vector_of(const Keys& keys, const std::array<const char*, 3>& names) {
    Vector<3> vector = Vector<3>::Zero();
    for (int i = 0; i < 3; ++i) keys.read(names[at(i)], vector[i]);
    return vector;
}

void turn(SurfaceMesh& surface, const Vector<3>& degrees) {
    const double angle = degrees.norm();
    if (angle == 0.0) return;
    const Matrix<3> turned = rotation_about(Vector<3>(degrees / angle), angle * radian);
    for (auto* points : {&surface.vertices, &surface.displacement})
        for (Vector<3>& x : *points) x = turned * x;
}

void flip(SurfaceMesh& surface) {
    for (std::int32_t face = 0; face < surface.faces.size(); ++face)
        std::reverse(surface.faces.values.begin() + surface.faces.offsets[at(face)],
                     surface.faces.values.begin() + surface.faces.offsets[at(face) + 1]);
}

void give_name(SurfaceMesh& surface, const std::string& name) {
    const bool is_one = surface.body_names.size() == 1;
    for (std::string& body : surface.body_names) body = is_one ? name : fmt::format("{}.{}", name, body);
    surface.name = name;
}

}  // namespace

Keys::Keys(std::string text, std::size_t colon) : text_(std::move(text)) {
    if (colon == std::string::npos) return;
    std::size_t begin = colon + 1;
    while (begin <= text_.size()) {
        const std::size_t end = std::min(text_.find(',', begin), text_.size());
        add(text_.substr(begin, end - begin));
        begin = end + 1;
    }
}

void Keys::add(const std::string& entry) {
    const auto equals = entry.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
        refuse(fmt::format("'{}' is no key=value", entry));
    if (!values_.emplace(entry.substr(0, equals), entry.substr(equals + 1)).second)
        refuse(fmt::format("'{}' is given twice", entry.substr(0, equals)));
}

void Keys::read(const std::string& key, std::string& value) const {
    if (const auto entry = values_.find(key); entry != values_.end()) value = entry->second;
}

void Keys::read(const std::string& key, double& value, const Limits& limits) const {
    if (const auto entry = values_.find(key); entry != values_.end())
        value = parse_number(entry->second, fmt::format("{}: {}", text_, key), limits);
}

void Keys::read(const std::string& key, int& value) const {
    double number = value;
    read(key, number, {.above = -1.0, .below = largest_count});
    if (number != std::floor(number)) refuse(fmt::format("'{}={}' is no whole number", key, values_.at(key)));
    value = static_cast<int>(number);
}

void Keys::read(const std::string& key, bool& value) const {
    int number = value ? 1 : 0;
    read(key, number);
    value = number != 0;
}

void Keys::read(const std::string& key, std::uint64_t& value) const {
    int number = static_cast<int>(value);
    read(key, number);
    value = static_cast<std::uint64_t>(number);
}

void Keys::check_known(const std::vector<std::string>& known) const {
    for (const auto& [key, value] : values_)
        if (std::ranges::find(known, key) == known.end())
            refuse(fmt::format("'{}' is no key of this input; it knows {}", key, fmt::join(known, ", ")));
}

void Keys::refuse(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}. (--help lists shapes and keys.)", text_, what));
}

PlacedFile placed_file(const std::string& text) {
    const auto colon = text.rfind(':');
    std::error_code error;
    if (colon == std::string::npos || text.find('=', colon) == std::string::npos || std::filesystem::exists(text, error))
        return {text, Keys(text, std::string::npos)};
    return {text.substr(0, colon), Keys(text, colon)};
}

std::vector<std::string> placing_keys() { return {"unit", "scale", "rx", "ry", "rz", "x", "y", "z", "flip", "name"}; }

void place(SurfaceMesh& surface, const Keys& keys) {
    if (const double scale = scale_of(keys); scale != 1.0)
        for (auto* points : {&surface.vertices, &surface.displacement})
            for (Vector<3>& x : *points) x *= scale;
    turn(surface, vector_of(keys, {"rx", "ry", "rz"}));
    const Vector<3> offset = vector_of(keys, {"x", "y", "z"});
    for (Vector<3>& x : surface.vertices) x += offset;
    bool is_flipped = false;
    keys.read("flip", is_flipped);
    if (is_flipped) flip(surface);
    std::string name;
    keys.read("name", name);
    if (!name.empty()) give_name(surface, name);
}

std::string placing_help() {
    return fmt::format(
        "Inputs are placed by keys behind a colon, part.stl:unit=mm,rz=90,x=0.1 for example:\n"
        "  unit ({}), scale, rotation vector rx, ry, rz [degrees] about the origin,\n"
        "  then offset x, y, z [m]; flip=1 turns all faces round; name\n",
        fmt::join(unit_names(), ", "));
}

}  // namespace abut::apps
