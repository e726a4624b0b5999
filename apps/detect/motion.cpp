#include "apps/detect/motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/base/index.hpp"
#include "abut/base/input_file.hpp"
#include "abut/base/rotation.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {
namespace {

constexpr int default_steps = 10;
constexpr double radians = std::numbers::pi / 180.0;
constexpr const char* script_head = "step,body,x,y,z,rx,ry,rz";
constexpr int most_steps = 1'000'000;

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    if (text.ends_with(',')) parts.emplace_back();
    return parts;
}

bool read_whole(const std::string& text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// By name, or by number from 0.
std::int32_t find_body(const std::string& text, const Bodies& bodies, const std::string& where) {
    const auto named = std::ranges::find(bodies.names, text);
    if (named != bodies.names.end()) return static_cast<std::int32_t>(named - bodies.names.begin());
    int number = -1;
    if (read_whole(text, number) && number >= 0 && at(number) < bodies.names.size()) return number;
    std::vector<std::string> first(bodies.names.begin(),
                                   bodies.names.begin() + static_cast<long>(std::min<std::size_t>(bodies.names.size(), 10)));
    throw std::runtime_error(fmt::format("{}: there is no body '{}'. Bodies are 0 to {}: {}{}.", where, text,
                                         bodies.names.size() - 1, fmt::join(first, ", "),
                                         bodies.names.size() > first.size() ? ", ..." : ""));
}

/// Numbers that follow the body.
struct BodyNumbers {
    std::int32_t body;
    std::vector<double> values;
};

BodyNumbers parse(const std::string& option, const std::string& text, const Bodies& bodies,
                  const std::vector<std::size_t>& sizes) {
    const auto colon = text.rfind(':');
    const auto parts = split(colon == std::string::npos ? "" : text.substr(colon + 1));
    if (std::ranges::find(sizes, parts.size()) == sizes.end())
        throw std::runtime_error(fmt::format("{} {}: {} numbers follow the body; {} are needed, as --help says.", option,
                                             text, parts.size(), fmt::join(sizes, " or ")));
    BodyNumbers numbers{find_body(text.substr(0, colon), bodies, option + " " + text), {}};
    for (const std::string& part : parts) numbers.values.push_back(parse_number(part, option + " " + text, {}));
    return numbers;
}

Vector<3> vector_at(const std::vector<double>& values, std::size_t first) {
    return {values[first], values[first + 1], values[first + 2]};
}

Matrix<3> turn_about(const Vector<3>& axis, double angle) {
    return angle == 0.0 ? Matrix<3>::Identity() : Matrix<3>(rotation_about(Vector<3>(axis), angle));
}

Matrix<3> turn_of_vector(const Vector<3>& degrees) {
    const double angle = degrees.norm();
    return turn_about(angle > 0.0 ? Vector<3>(degrees / angle) : Vector<3>::UnitZ(), angle * radians);
}

std::vector<Vector<3>> centres_of(const Bodies& bodies) {
    std::vector<geometry::Box<3>> boxes(bodies.names.size());
    for (std::size_t v = 0; v < bodies.start.size(); ++v) boxes[at(bodies.vertex_body[v])].extend(bodies.start[v]);
    std::vector<Vector<3>> centres;
    for (const auto& box : boxes)
        centres.push_back(box.empty() ? Vector<3>::Zero() : Vector<3>(0.5 * (box.lower + box.upper)));
    return centres;
}

/// One line of a script.
struct ScriptRow {
    int step;
    std::int32_t body;
    std::vector<double> values;  ///< 6
};

ScriptRow parse_row(const std::string& line, const std::string& where, const Bodies& bodies) {
    static const std::vector<std::string> columns = split(script_head);
    const auto parts = split(line);
    if (parts.size() != columns.size())
        throw std::runtime_error(
            fmt::format("{}: {} columns, {} are needed: {}.", where, parts.size(), columns.size(), script_head));
    ScriptRow row{};
    if (!read_whole(parts[0], row.step) || row.step < 0 || row.step > most_steps)
        throw std::runtime_error(
            fmt::format("{}, column step: '{}' must be a whole number from 0 to {}.", where, parts[0], most_steps));
    row.body = find_body(parts[1], bodies, where + ", column body");
    for (std::size_t i = 2; i < parts.size(); ++i)
        row.values.push_back(parse_number(parts[i], fmt::format("{}, column {}", where, columns[i]), {}));
    return row;
}

std::string without_return(std::string line) {
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

}  // namespace

Motion::Motion(const DetectOptions& options, const Bodies& bodies)
    : even_(bodies.names.size()),
      scripts_(bodies.names.size()),
      centres_(centres_of(bodies)),
      deforms_(!bodies.displacement.empty()),
      largest_motion_(options.search.largest_motion) {
    for (std::size_t body = 0; body < even_.size(); ++body) even_[body].centre = centres_[body];
    for (const std::string& text : options.translations) add_translation(text, bodies);
    for (const std::string& text : options.rotations) add_rotation(text, bodies);
    if (!options.script.empty()) read_script(options.script, bodies);
    int last = 0;
    for (const Script& script : scripts_)
        if (!script.empty()) last = std::max(last, script.back().first);
    const bool moves = deforms_ || !options.translations.empty() || !options.rotations.empty();
    steps_ = options.steps > 0 ? options.steps : (last > 0 ? last : (moves ? default_steps : 0));
    if (steps_ < last)
        throw std::runtime_error(
            fmt::format("--steps {}: the script has a step {}. Give as many steps, or none.", steps_, last));
}

void Motion::add_translation(const std::string& text, const Bodies& bodies) {
    const auto [body, values] = parse("--translate", text, bodies, {3});
    even_[at(body)].shift += vector_at(values, 0);
}

void Motion::add_rotation(const std::string& text, const Bodies& bodies) {
    const auto [body, values] = parse("--rotate", text, bodies, {4, 7});
    Even& even = even_[at(body)];
    const Vector<3> axis = vector_at(values, 0);
    if (!(axis.norm() > 0.0) || !std::isfinite(axis.norm()))
        throw std::runtime_error(
            fmt::format("--rotate {}: the axis has the length {:g}; it must be above 0.", text, axis.norm()));
    if (even.angle != 0.0)
        throw std::runtime_error(fmt::format(
            "--rotate {}: body '{}' turns already. Give one rotation per body, or a script.", text, bodies.names[at(body)]));
    even.axis = axis.normalized();
    even.angle = values[3] * radians;
    if (values.size() == 7) even.centre = vector_at(values, 4);
}

namespace {

std::string script_text(const std::string& path) {
    try {
        return file_bytes(path);
    } catch (const BadInput& error) {
        throw std::runtime_error(fmt::format("--script {}: the file cannot be read: {}", path, error.what()));
    }
}

}  // namespace

void Motion::read_script(const std::string& path, const Bodies& bodies) {
    std::istringstream file(script_text(path));
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        line = without_return(line);
        const std::string where = fmt::format("{}: line {}", path, ++number);
        if (number == 1) {
            if (line != script_head)
                throw std::runtime_error(
                    fmt::format("{}: '{}' stands there; the head must be {}.", where, line, script_head));
            continue;
        }
        if (line.empty()) continue;
        const auto [step, body, values] = parse_row(line, where, bodies);
        Script& script = scripts_[at(body)];
        if (!script.empty() && script.back().first >= step)
            throw std::runtime_error(fmt::format("{}, column step: {} follows {}; the steps of a body must rise.", where,
                                                 step, script.back().first));
        script.emplace_back(step, Pose{turn_of_vector(vector_at(values, 3)), centres_[at(body)], vector_at(values, 0)});
    }
    if (std::ranges::all_of(scripts_, &Script::empty))
        throw std::runtime_error(
            fmt::format("{}: no row of numbers. Give a head, {}, and one row per step and body.", path, script_head));
}

bool Motion::only_translates() const {
    const auto turns = [](const auto& entry) { return entry.second.turned(); };
    return !deforms_ && std::ranges::all_of(even_, [](const Even& even) { return even.angle == 0.0; }) &&
           std::ranges::none_of(scripts_, [&](const Script& script) { return std::ranges::any_of(script, turns); });
}

Pose Motion::pose(std::int32_t body, int step) const {
    const double share = steps_ > 0 ? static_cast<double>(step) / steps_ : 0.0;
    const Even& even = even_[at(body)];
    const Pose evenly{turn_about(even.axis, share * even.angle), even.centre, share * even.shift};
    const Script& script = scripts_[at(body)];
    const auto next = std::ranges::upper_bound(script, step, {}, [](const auto& entry) { return entry.first; });
    if (next == script.begin()) return evenly;
    const Pose& scripted = std::prev(next)->second;
    if (!evenly.turned() && !scripted.turned()) return {evenly.turn, evenly.centre, evenly.shift + scripted.shift};
    // x -> s(e(x)), about the centre of the even motion
    const Vector<3> centre = scripted.apply(evenly.apply(evenly.centre));
    return {scripted.turn * evenly.turn, evenly.centre, centre - evenly.centre};
}

void Motion::move(Bodies& bodies, int step) const {
    const double share = steps_ > 0 ? static_cast<double>(step) / steps_ : 0.0;
    const double allowed = largest_motion_ * bodies.extent();
    std::vector<Pose> poses;
    for (std::size_t body = 0; body < bodies.names.size(); ++body)
        poses.push_back(pose(static_cast<std::int32_t>(body), step));
    for (std::size_t v = 0; v < bodies.start.size(); ++v) {
        Vector<3> x = bodies.start[v];
        if (deforms_) x += share * bodies.displacement[v];
        x = poses[at(bodies.vertex_body[v])].apply(x);
        const double moved = (x - bodies.surface.vertices[v]).norm();
        if (step > 0 && !(moved <= allowed))
            throw std::runtime_error(fmt::format(
                "step {}: a corner of body '{}' moves by {:.6g} m, {:.6g} m is allowed, {:g} times the extent of "
                "all bodies. Check the motion, take more --steps, or raise --largest-motion.",
                step, bodies.names[at(bodies.vertex_body[v])], moved, allowed, largest_motion_));
        bodies.surface.vertices[v] = x;
    }
    update_faces(bodies, step);
}

}  // namespace abut::apps
