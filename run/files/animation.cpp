#include "abut/run/files/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/drawing/animation_page.hpp"
#include "abut/run/drawing/animation_script.hpp"
#include "abut/run/drawing/base64.hpp"
#include "abut/run/drawing/colours.hpp"
#include "abut/run/drawing/markup.hpp"
#include "abut/run/files/json.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {
namespace {

static_assert(std::endian::native == std::endian::little, "typed arrays of a browser are read as they are stored here");

using Position = Snapshot::Position;

constexpr double whole = 65535.0;      // of a box, in rounded positions
constexpr std::uint16_t none = 65535;  // stands for a value that is not there
constexpr double whole_value = 65534.0;
constexpr double size_of_head = 600.0;  // of a frame, without its obstacles [bytes], at most
constexpr double size_of_placement = 12.0 * 25.0;

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
    return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

/// As the content of an element <script>, where no text may begin a tag or a comment.
std::string for_script(const Json& json) {
    std::string text = text_of(json);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
    return text;
}

struct Box {
    static constexpr double far = std::numeric_limits<double>::infinity();
    Position low{far, far, far};
    Position high{-far, -far, -far};
};

Box box_of(const std::vector<Position>& positions) {
    Box box;
    for (const Position& x : positions)
        for (std::size_t i = 0; i < 3; ++i)
            if (std::isfinite(x[i])) {
                box.low[i] = std::min(box.low[i], x[i]);
                box.high[i] = std::max(box.high[i], x[i]);
            }
    return box;
}

/// A position that is not finite is drawn at the lower end of the box.
std::uint16_t rounded(double x, double low, double size) {
    const double share = size > 0.0 ? (x - low) / size : 0.0;
    return share > 0.0 ? static_cast<std::uint16_t>(std::lround(whole * std::min(share, 1.0))) : std::uint16_t{0};
}

std::uint16_t rounded_value(double value, double largest) {
    if (!std::isfinite(value)) return none;
    return largest > 0.0 ? static_cast<std::uint16_t>(std::lround(whole_value * value / largest)) : std::uint16_t{0};
}

/// Numbers with blanks between them.
std::string listed(std::span<const double> numbers) { return fmt::format("{:.9g}", fmt::join(numbers, " ")); }

/// A turn, by rows, and an offset.
template <int Dim>
std::vector<double> placement_numbers(const contact::Placement<Dim>& placement) {
    std::vector<double> numbers;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) numbers.push_back(i < Dim && k < Dim ? placement.turn(i, k) : i == k ? 1.0 : 0.0);
    for (const double x : in_space<Dim>(placement.offset)) numbers.push_back(x);
    return numbers;
}

/// Corners of the faces of an obstacle at rest: pairs in 2D, triangles in 3D.
template <int Dim>
std::vector<float> corners_of(const contact::RigidObstacle<Dim>& obstacle) {
    std::vector<float> numbers;
    const auto add = [&](const Vector<Dim>& corner) {
        for (const double x : in_space<Dim>(corner)) numbers.push_back(static_cast<float>(x));
    };
    for (const auto& face : obstacle.faces)
        if constexpr (Dim == 2) {
            for (const auto& corner : face) add(corner);
        } else {
            for (std::size_t i = 1; i + 1 < face.size(); ++i) add(face[0]), add(face[i]), add(face[i + 1]);
        }
    return numbers;
}

/// Part that all frames have in common.
template <int Dim>
Json common_part(const std::string& title, const Scene<Dim>& scene, const BodyPolygons& polygons, const std::string& note) {
    std::vector<std::uint32_t> counts, corners(polygons.corners.begin(), polygons.corners.end());
    for (std::size_t i = 0; i < polygons.cell.size(); ++i)
        counts.push_back(static_cast<std::uint32_t>(polygons.offsets[i + 1] - polygons.offsets[i]));
    Json obstacles = Json::array();
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i)
        obstacles.push_back(
            {{"name", name_of_obstacle(scene, i)}, {"corners", packed(corners_of(scene.solid.obstacles[i]))}});
    return {{"title", title},
            {"comment", scene.comment},
            {"note", note},
            {"dim", Dim},
            {"value", polygons.value_name},
            {"unit", polygons.value_unit},
            {"least_end", polygons.least_end},
            {"colours", value_colours},
            {"n_vertices", polygons.vertex.size()},
            {"n_polygons", polygons.cell.size()},
            {"counts", packed(counts)},
            {"corners", packed(corners)},
            {"edges", packed(polygons.edges)},
            {"body", packed(polygons.body)},
            {"bodies", polygons.body_names},
            {"obstacles", obstacles}};
}

template <int Dim>
double bytes_per_frame(const BodyPolygons& polygons, std::size_t n_obstacles) {
    const double numbers = static_cast<double>(Dim * polygons.vertex.size() + polygons.cell.size());
    return 4.0 / 3.0 * sizeof(std::uint16_t) * numbers + size_of_head + size_of_placement * static_cast<double>(n_obstacles);
}

template <int Dim>
std::string frame_of(const Snapshot& snapshot, const std::vector<contact::RigidObstacle<Dim>>& obstacles) {
    const Box box = box_of(snapshot.position);
    Position size{};
    for (std::size_t i = 0; i < 3; ++i) size[i] = std::max(0.0, box.high[i] - box.low[i]);
    double largest = 0.0;
    for (const double value : snapshot.value)
        if (std::isfinite(value)) largest = std::max(largest, value);
    std::vector<std::uint16_t> numbers;
    numbers.reserve(Dim * snapshot.position.size() + snapshot.value.size());
    for (const Position& x : snapshot.position)
        for (std::size_t i = 0; i < Dim; ++i) numbers.push_back(rounded(x[i], box.low[i], size[i]));
    for (const double value : snapshot.value) numbers.push_back(rounded_value(value, largest));
    std::vector<double> places;
    for (const auto& obstacle : obstacles)
        for (const double x : placement_numbers<Dim>(contact::placement_at<Dim>(obstacle, snapshot.time)))
            places.push_back(x);
    return fmt::format(
        "<script type=\"text/plain\" class=\"frame\" data-time=\"{:.9g}\" data-end=\"{:.6g}\" data-most=\"{:.9g}\" "
        "data-low=\"{}\" data-size=\"{}\" data-places=\"{}\">{}</script>\n",
        snapshot.time, upper_end(snapshot.value), largest, listed(box.low), listed(size), listed(places), packed(numbers));
}

}  // namespace

template <int Dim>
Animation<Dim>::Animation(std::filesystem::path path, std::string program, int n_frames, double limit)
    : file_(std::move(path)), program_(std::move(program)), n_frames_(n_frames), limit_(limit) {}

template <int Dim>
void Animation<Dim>::look_up(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    maker_.emplace(scene, result);
    obstacles_ = scene.solid.obstacles;
    n_spread_ = n_steps_ = result.run.steps;
}

template <int Dim>
void Animation<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    look_up(scene, result);
    const std::string title = scene.title.empty() ? program_ : scene.title;
    const BodyPolygons& polygons = maker_->polygons();
    const std::array page{animation_head, animation_script, animation_body};
    std::size_t common = text_of(common_part(title, scene, polygons, "")).size();
    for (const std::string_view part : page) common += part.size();
    const double fit = (limit_ - static_cast<double>(common)) / bytes_per_frame<Dim>(polygons, obstacles_.size());
    n_kept_ = std::min(n_frames_, std::max<std::int64_t>(2, static_cast<std::int64_t>(fit)));
    const std::string note = n_kept_ == n_frames_
                                 ? ""
                                 : fmt::format("Of the {} frames asked for {} are here: more would not fit in {:.3g} MB.",
                                               n_frames_, n_kept_, 1e-6 * limit_);
    file_.open();
    file_.write("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n" + element("title", title + ": animation").html());
    for (const std::string_view part : page) file_.write(part);
    file_.write("<script type=\"application/json\" id=\"common\">" + for_script(common_part(title, scene, polygons, note)) +
                "</script>\n");
}

template <int Dim>
bool Animation<Dim>::wants_sight(std::int64_t step) const {
    const std::int64_t intervals = std::max<std::int64_t>(1, n_kept_ - 1);
    const bool more = n_written_ < n_kept_ || n_steps_ > n_spread_;
    return more && step * intervals >= n_written_ * n_spread_;
}

template <int Dim>
void Animation<Dim>::see(const Sight<Dim>& sight) {
    file_.write(frame_of<Dim>(maker_->taken("", sight), obstacles_));
    ++n_written_;
}

template <int Dim>
void Animation<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    maker_->take_cells(solid.mesh(), first_cells);
}

template <int Dim>
void Animation<Dim>::save(StateWriter& state) {
    state.put(static_cast<std::uint64_t>(file_.size()));
    state.put(n_kept_);
    state.put(n_written_);
    state.put(n_spread_);
}

template <int Dim>
void Animation<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    look_up(scene, result);
    file_.go_on_after(state.get<std::uint64_t>());
    n_kept_ = state.get<std::int64_t>();
    n_written_ = state.get<std::int64_t>();
    n_spread_ = state.get<std::int64_t>();
}

template <int Dim>
void Animation<Dim>::finish() {
    file_.write("</body>\n</html>\n");
    file_.finish();
}

template class Animation<2>;
template class Animation<3>;

}  // namespace abut::run
