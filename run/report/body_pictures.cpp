#include "abut/run/report/body_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "abut/run/drawing/colours.hpp"
#include "abut/run/drawing/raster.hpp"
#include "abut/run/drawing/svg.hpp"
#include "abut/run/drawing/ticks.hpp"
#include "abut/run/report/body_sheet.hpp"
#include "abut/run/report/mark_drawing.hpp"

namespace abut::run {
namespace {

using Position = Snapshot::Position;

// All in units of the drawing.
constexpr double below_image = 42.0;
constexpr double value_bar_gap = 14.0, value_bar_width = 12.0, axis_length = 16.0;
constexpr int value_levels = 32, most_values = 6;
constexpr std::size_t most_names = 12;
constexpr double below_a_spring = 14.0;  // a name that would hide it
constexpr double room_of_name = 12.0;    // around the name of an obstacle

constexpr double strip_thickness = 8.0;                               // of an obstacle in 2D [points]
constexpr double rim_line = 1.2, cell_line = 0.5, marked_line = 3.0;  // half the thickness of lines [points]
constexpr double few_cells = 14.0;  // size of cells from which their edges are drawn [points]
constexpr Raster::Colour grey{150, 150, 146, 255}, obstacle_grey{128, 128, 124, 200}, faint_grey{128, 128, 124, 70},
    held_orange{217, 89, 31, 255}, loaded_pink{219, 38, 128, 255};

/// The part of a polygon within a box.
std::vector<Position> clipped(std::vector<Position> corners, const BodyBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sense : {1.0, -1.0}) {
            const double limit = sense > 0.0 ? box.low[axis] : -box.high[axis];
            std::vector<Position> kept;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Position &from = corners[i], &to = corners[(i + 1) % corners.size()];
                const double a = sense * from[axis] - limit, b = sense * to[axis] - limit;
                if (a >= 0.0) kept.push_back(from);
                if ((a >= 0.0) == (b >= 0.0)) continue;
                Position cut = from;
                for (std::size_t k = 0; k < 3; ++k) cut[k] += a / (a - b) * (to[k] - from[k]);
                kept.push_back(cut);
            }
            corners = std::move(kept);
        }
    return corners;
}

Raster::Colour colour_of_value(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (value_colours.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), value_colours.size() - 2);
    const double within = place - static_cast<double>(stop);
    Raster::Colour result{0, 0, 0, 255};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = static_cast<std::uint8_t>(
            std::lround((1.0 - within) * value_colours[stop][i] + within * value_colours[stop + 1][i]));
    return result;
}

Raster::Colour lit(Raster::Colour colour, double light) {
    for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<std::uint8_t>(light * colour[i]);
    return colour;
}

double largest_value(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values)
        if (value > most) most = value;
    return most;
}

/// In units of the drawing, to the right and downwards.
struct OnPage {
    double x, y;
};

std::vector<Raster::Corner> seen_from(const BodySheet& sheet, const std::vector<Position>& corners) {
    std::vector<Raster::Corner> seen;
    for (const Position& x : corners) seen.push_back(sheet.corner(x));
    return seen;
}

/// The unit normal of a polygon in the image, > 0 towards the eye where its corners run counter-clockwise as they are seen.
Position normal_of(std::span<const Raster::Corner> corners) {
    Position sum{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
        sum[0] += a[1] * b[2] - a[2] * b[1];
        sum[1] += a[2] * b[0] - a[0] * b[2];
        sum[2] += a[0] * b[1] - a[1] * b[0];
    }
    const double length = std::max(std::sqrt(dot(sum, sum)), std::numeric_limits<double>::min());
    return {-sum[0] / length, -sum[1] / length, -sum[2] / length};  // y is downwards
}

/// Light from above, the left and the eye, on either side of a face.
double light_on(std::span<const Raster::Corner> corners) {
    const Position normal = normal_of(corners);
    const double sense = normal[2] < 0.0 ? -1.0 : 1.0;
    const Position light{-0.35, -0.6, 0.72};
    return 0.7 + 0.3 * std::max(0.0, sense * dot(normal, light));
}

/// A segment of an obstacle in 2D as a strip behind its outside, which is on its right.
void draw_strip(Raster& image, const std::vector<Raster::Corner>& segment) {
    const auto &a = segment[0], &b = segment[1];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0.0)) return;
    const double x = strip_thickness * (b[1] - a[1]) / length, y = -strip_thickness * (b[0] - a[0]) / length;
    constexpr double behind = -1.0;
    const std::array<Raster::Corner, 4> strip{
        {{a[0], a[1], behind}, {b[0], b[1], behind}, {b[0] + x, b[1] + y, behind}, {a[0] + x, a[1] + y, behind}}};
    image.fill(strip, obstacle_grey, std::array{2.0 * rim_line, 0.0, 0.0, 0.0});
}

/// In 3D obstacles are seen from their outside alone, so that none hides the bodies that lie on it; large ones are faint.
void draw_obstacles(Raster& image, const BodySheet& sheet, const Snapshot& snapshot) {
    for (const auto& face : snapshot.obstacles) {
        if (!sheet.in_space()) {
            if (face.size() == 2) draw_strip(image, seen_from(sheet, face));
            continue;
        }
        const bool is_large = box_of(face).size() > sheet.box().size();
        const std::vector<Raster::Corner> corners = seen_from(sheet, clipped(face, sheet.box()));
        if (corners.size() < 3 || !(normal_of(corners)[2] > 0.0)) continue;
        image.fill(corners, is_large ? faint_grey : lit(grey, light_on(corners)));
    }
}

/// The mean size of cells [points].
double size_of_cells(const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygons.cell.size(); ++i) {
        const auto &a = snapshot.position[static_cast<std::size_t>(polygons.corners[polygons.offsets[i]])],
                   &b = snapshot.position[static_cast<std::size_t>(polygons.corners[polygons.offsets[i] + 1])];
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
    return BodySheet::points_per_unit * sheet.scale() * sum /
           static_cast<double>(std::max<std::size_t>(1, polygons.cell.size()));
}

/// Lines along the edges of a polygon of some colour.
class EdgeLines {
public:
    explicit EdgeLines(double of_inner) : of_inner_(of_inner) {}

    void begin(std::span<const Edge> edges, const Raster::Colour& of_polygon) {
        const Raster::Colour dark = lit(of_polygon, Raster::shade_of_line);
        width_.clear();
        colour_.clear();
        for (const Edge edge : edges) {
            const bool is_marked = edge == Edge::held || edge == Edge::loaded;
            width_.push_back(is_marked ? marked_line : edge == Edge::rim ? rim_line : of_inner_);
            colour_.push_back(edge == Edge::held ? held_orange : edge == Edge::loaded ? loaded_pink : dark);
        }
    }
    [[nodiscard]] std::span<const double> width() const { return width_; }
    [[nodiscard]] std::span<const Raster::Colour> colour() const { return colour_; }

private:
    double of_inner_;
    std::vector<double> width_;
    std::vector<Raster::Colour> colour_;
};

void draw_bodies(Raster& image, const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    EdgeLines lines(size_of_cells(sheet, polygons, snapshot) >= few_cells ? cell_line : 0.0);
    std::vector<Raster::Corner> corners;
    for (std::size_t i = 0; i < polygons.cell.size(); ++i) {
        const std::size_t begin = polygons.offsets[i], n = polygons.offsets[i + 1] - begin;
        corners.clear();
        for (std::size_t k = begin; k < begin + n; ++k)
            corners.push_back(sheet.corner(snapshot.position[static_cast<std::size_t>(polygons.corners[k])]));
        const double value = snapshot.value[i];
        Raster::Colour of_polygon = std::isfinite(value) ? colour_of_value(value / sheet.upper()) : grey;
        if (sheet.in_space()) of_polygon = lit(of_polygon, light_on(corners));
        lines.begin(std::span(polygons.edges).subspan(begin, n), of_polygon);
        image.fill(corners, of_polygon, lines.width(), lines.colour());
    }
}

/// The colours beside the picture_of, with their values.
Markup value_bar(const BodySheet& sheet, const std::string& name) {
    const double x = BodySheet::image_right + value_bar_gap, step = sheet.height() / value_levels;
    Markup result;
    for (int level = 0; level < value_levels; ++level) {
        const Raster::Colour c = colour_of_value((level + 0.5) / value_levels);
        result += element("rect", {{"x", shown(x)},
                                   {"y", shown(sheet.lower_edge() - (level + 1) * step)},
                                   {"width", shown(value_bar_width)},
                                   {"height", shown(step + (level == 0 ? 0.0 : 0.5))},
                                   {"fill", fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2])}});
    }
    const Axis axis = linear_axis(0.0, sheet.upper(), most_values);
    for (const Tick& tick : axis.ticks)
        result += label(tick.label, x + value_bar_width + 5.0,
                        sheet.lower_edge() - axis.share(tick.at) * sheet.height() + 4.0, "start");
    return result + label(name, BodySheet::width - 4.0, BodySheet::image_top - 12.0, "end");
}

/// A length of 1, 2 or 5 times a power of ten below the picture_of.
Markup length_scale(const BodySheet& sheet) {
    const Axis axis = linear_axis(0.0, BodySheet::image_width / sheet.scale(), 5);
    const double length = axis.ticks[1].at - axis.ticks[0].at, end = BodySheet::image_left + length * sheet.scale(),
                 y = sheet.lower_edge() + 14.0;
    return line("axis", BodySheet::image_left, y, end, y) +
           line("axis", BodySheet::image_left, y - 4.0, BodySheet::image_left, y + 4.0) +
           line("axis", end, y - 4.0, end, y + 4.0) + label(fmt::format("{:g} m", length), end + 6.0, y + 4.0, "start");
}

/// The directions of the axes, in 3D.
Markup directions(const BodySheet& sheet) {
    if (!sheet.in_space()) return {};
    const double x = BodySheet::image_right - 46.0, y = sheet.lower_edge() + 30.0;
    Markup result;
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
        Position unit{};
        unit[i] = axis_length;
        const Position seen = sheet.view()(unit);
        result += line("axis", x, y, x + seen[0], y - seen[1]);
        result += label(names[i], x + 1.3 * seen[0], y - 1.3 * seen[1] + 4.0, "middle");
    }
    return result;
}

/// The middle of each body, of the corners of its polygons.
std::vector<Position> middles(const BodyPolygons& polygons, const Snapshot& snapshot) {
    std::vector<Position> sum(polygons.body_names.size());
    std::vector<double> n(sum.size(), 0.0);
    for (std::size_t i = 0; i < polygons.body.size(); ++i)
        for (std::size_t k = polygons.offsets[i]; k < polygons.offsets[i + 1]; ++k) {
            const auto body = static_cast<std::size_t>(polygons.body[i]);
            for (std::size_t axis = 0; axis < 3; ++axis)
                sum[body][axis] += snapshot.position[static_cast<std::size_t>(polygons.corners[k])][axis];
            n[body] += 1.0;
        }
    for (std::size_t body = 0; body < sum.size(); ++body)
        for (double& x : sum[body]) x /= std::max(n[body], 1.0);
    return sum;
}

OnPage on_page(const BodySheet& sheet, const Position& x) {
    const Raster::Corner seen = sheet.corner(x);
    return {BodySheet::image_left + seen[0] / BodySheet::points_per_unit,
            BodySheet::image_top + seen[1] / BodySheet::points_per_unit};
}

Projection projection_of(const BodySheet& sheet) {
    return {[&sheet](const Position& x) -> Position {
                const auto [right, down] = on_page(sheet, x);
                return {right, down, sheet.view()(x)[2]};
            },
            sheet.scale()};
}

/// From the middle of some corners towards the lowest one in the picture, where it is less often hidden by bodies: as
/// far as a name has room.
Position before_bodies(const BodySheet& sheet, const std::vector<Position>& corners, const Position& middle) {
    const auto height = [&](const Position& x) { return on_page(sheet, x).y; };
    const Position& lowest = *std::ranges::max_element(corners, {}, height);
    for (double share = 0.8; share > 0.1; share -= 0.1) {
        Position x = middle;
        for (std::size_t i = 0; i < 3; ++i) x[i] += share * (lowest[i] - middle[i]);
        const OnPage at = on_page(sheet, x);
        if (at.y < sheet.lower_edge() - room_of_name && at.x > BodySheet::image_left + 2.0 * room_of_name &&
            at.x < BodySheet::image_right - 2.0 * room_of_name)
            return x;
    }
    return middle;
}

/// The place of the name of each obstacle; not finite where nothing of it is seen.
std::vector<Position> places_of_obstacles(const BodySheet& sheet, const PictureMarks& marks, const Snapshot& snapshot) {
    std::vector<std::vector<Position>> seen(marks.obstacle_names.size());
    for (std::size_t face = 0; face < std::min(snapshot.obstacles.size(), marks.obstacle.size()); ++face) {
        const std::vector<Position> corners = clipped(snapshot.obstacles[face], sheet.box());
        if (corners.empty() || (sheet.in_space() && !(normal_of(seen_from(sheet, corners))[2] > 0.0))) continue;
        auto& of_obstacle = seen[static_cast<std::size_t>(marks.obstacle[face])];
        of_obstacle.insert(of_obstacle.end(), corners.begin(), corners.end());
    }
    std::vector<Position> places;
    for (const std::vector<Position>& corners : seen) {
        Position middle{};
        for (const Position& corner : corners)
            for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += corner[axis];
        for (double& x : middle) x /= static_cast<double>(corners.size());
        places.push_back(sheet.in_space() && !corners.empty() ? before_bodies(sheet, corners, middle) : middle);
    }
    return places;
}

/// Whether an end of a spring is so near that a name would hide it.
bool is_on_a_spring(const BodySheet& sheet, const PictureMarks& marks, const Snapshot& snapshot, OnPage at) {
    return std::ranges::any_of(marks.springs, [&](const auto& spring) {
        return std::ranges::any_of(spring, [&](const PictureMarks::SpringEnd& end) {
            const auto [x, y] = on_page(sheet, place_of(end, snapshot.position));
            return std::hypot(x - at.x, y - at.y) < below_a_spring;
        });
    });
}

/// Names of bodies and obstacles, where there are several, but few.
Markup names_of_all(const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    std::vector<std::string> names = polygons.body_names;
    names.insert(names.end(), polygons.marks.obstacle_names.begin(), polygons.marks.obstacle_names.end());
    if (names.size() < 2 || names.size() > most_names) return {};
    std::vector<Position> middle = middles(polygons, snapshot);
    const std::vector<Position> of_obstacles = places_of_obstacles(sheet, polygons.marks, snapshot);
    middle.insert(middle.end(), of_obstacles.begin(), of_obstacles.end());
    std::vector<PlacedName> placed;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const OnPage at = on_page(sheet, middle[i]);
        placed.push_back(
            {names[i], at.x, at.y + (is_on_a_spring(sheet, polygons.marks, snapshot, at) ? below_a_spring : 0.0)});
    }
    return drawn_names(placed, BodySheet::image_left, BodySheet::image_right, BodySheet::image_top, sheet.lower_edge());
}

Markup marks_on(const BodySheet& sheet, const PictureMarks& marks, const Snapshot& snapshot) {
    const Projection projection = projection_of(sheet);
    Markup drawn = drawn_loads(loads_at(marks, snapshot.time, snapshot.position), sheet.largest_load(), projection);
    for (const auto& [first, second] : marks.springs)
        drawn += drawn_spring({place_of(first, snapshot.position), place_of(second, snapshot.position)}, projection);
    return drawn + drawn_gravity(marks.gravity, BodySheet::image_left + 16.0, BodySheet::image_top + 16.0, projection);
}

Markup picture_of(const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    Raster image = sheet.image();
    draw_obstacles(image, sheet, snapshot);
    draw_bodies(image, sheet, polygons, snapshot);
    const double wide = BodySheet::image_width, lower = sheet.lower_edge();
    const Markup content =
        element("title", snapshot.what) +
        element("image", {{"x", shown(BodySheet::image_left)},
                          {"y", shown(BodySheet::image_top)},
                          {"width", shown(wide)},
                          {"height", shown(sheet.height())},
                          {"href", data_address(image.png())}}) +
        element("path", {{"class", "grid"},
                         {"fill", "none"},
                         {"d", fmt::format("M{0},{1}H{2}V{3}H{0}Z", BodySheet::image_left, BodySheet::image_top,
                                           BodySheet::image_left + wide, shown(lower))}}) +
        value_bar(sheet, fmt::format("{} [{}]", polygons.value_name, polygons.value_unit)) + length_scale(sheet) +
        directions(sheet) + marks_on(sheet, polygons.marks, snapshot) + names_of_all(sheet, polygons, snapshot);
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"viewBox", fmt::format("0 0 {:.0f} {:.1f}", BodySheet::width, lower + below_image)},
                    {"role", "img"}},
                   content);
}

/// Three digits, without an exponent where few zeros do.
std::string plain(double number) {
    const double size = std::abs(number);
    if (size == 0.0) return "0";
    if (size < 1e-3 || size >= 1e6) return fmt::format("{:.2e}", number);
    const double power = std::pow(10.0, 2.0 - std::floor(std::log10(size)));
    return fmt::format("{:g}", std::round(power * number) / power);
}

std::string caption_of(const BodyPolygons& polygons, const Snapshot& snapshot) {
    std::string text = snapshot.what;
    if (snapshot.force > 0.0) text += fmt::format(", {} N in all", plain(snapshot.force));
    const double largest = largest_value(snapshot.value);
    return text + fmt::format(": t = {:.4g} s, {} up to {} {}", snapshot.time, polygons.value_name,
                              plain(largest < polygons.least_end ? 0.0 : largest), polygons.value_unit);
}

}  // namespace

Markup body_pictures(const BodyPictures& pictures) {
    if (pictures.snapshots.empty() || pictures.polygons.cell.empty()) return {};
    const BodySheet sheet(pictures);
    Markup figures;
    for (const Snapshot& snapshot : pictures.snapshots)
        figures += element("figure", picture_of(sheet, pictures.polygons, snapshot) +
                                         element("figcaption", caption_of(pictures.polygons, snapshot))) +
                   "\n";
    return element("div", {{"class", "pictures"}}, figures) + "\n";
}

}  // namespace abut::run
