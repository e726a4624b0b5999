#include "abut/run/report/body_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "abut/run/report/raster.hpp"
#include "abut/run/report/svg.hpp"
#include "abut/run/report/ticks.hpp"

namespace abut::run {
namespace {

using Position = Snapshot::Position;

// All in units of the drawing.
constexpr double sheet_width = 480.0, image_left = 8.0, image_right = 384.0, image_top = 26.0, below_image = 42.0;
constexpr double image_width = image_right - image_left;
constexpr double least_image_height = 130.0, most_image_height = 400.0;
constexpr double value_bar_gap = 14.0, value_bar_width = 12.0, axis_length = 16.0;
constexpr int value_levels = 32, most_values = 6;

constexpr double points_per_unit = 2.0;
constexpr double margin_of_bodies = 0.06;          // around the bodies, of their size
constexpr double strip_thickness = 8.0;            // of an obstacle in 2D [points]
constexpr double rim_line = 1.2, cell_line = 0.6;  // half the strip_thickness of lines [points]
constexpr double few_cells = 14.0;                 // size of cells from which their edges are drawn [points]
constexpr double highest_left_out = 0.02;          // part of the values
constexpr Raster::Colour grey{150, 150, 146, 255}, obstacle_grey{128, 128, 124, 200}, faint_grey{128, 128, 124, 70};

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The directions to the right, upwards and to the eye.
struct EyeView {
    std::array<Position, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

    static EyeView of_space() {
        const double turn = 0.45, rise = 0.42;  // [rad]
        const double c = std::cos(turn), s = std::sin(turn), level = std::cos(rise), up = std::sin(rise);
        return {{{{c, s, 0.0}, {-s * up, c * up, level}, {s * level, -c * level, up}}}};
    }
    [[nodiscard]] Position operator()(const Position& x) const {
        return {dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)};
    }
};

struct BodyBox {
    static constexpr double far = std::numeric_limits<double>::infinity();
    Position low{far, far, far};
    Position high{-far, -far, -far};

    void add(const Position& x) {
        for (std::size_t i = 0; i < 3; ++i)
            if (std::isfinite(x[i])) {
                low[i] = std::min(low[i], x[i]);
                high[i] = std::max(high[i], x[i]);
            }
    }
    [[nodiscard]] double size() const {
        return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], std::numeric_limits<double>::min()});
    }
};

BodyBox box_of(const std::vector<Position>& positions) {
    BodyBox box;
    for (const Position& x : positions) box.add(x);
    return box;
}

/// Bodies at all times, with obstacles that are not larger than they.
BodyBox box_of(const BodyPictures& pictures) {
    BodyBox box;
    for (const Snapshot& snapshot : pictures.snapshots)
        for (const Position& x : snapshot.position) box.add(x);
    const double size = box.size();
    BodyBox whole = box;
    for (const Snapshot& snapshot : pictures.snapshots) {
        BodyBox obstacles;
        for (const auto& face : snapshot.obstacles)
            for (const Position& x : face) obstacles.add(x);
        if (obstacles.size() > size) continue;
        whole.add(obstacles.low);
        whole.add(obstacles.high);
    }
    const double more = margin_of_bodies * whole.size();
    for (std::size_t i = 0; i < 3; ++i) {
        whole.low[i] -= more;
        whole.high[i] += more;
    }
    return whole;
}

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

/// Ordered by lightness: viridis without its darkest end, which nobody sees on a dark page.
Raster::Colour colour_of_value(double share) {
    constexpr std::array<std::array<double, 3>, 9> stops{{{69, 55, 129},
                                                          {57, 86, 140},
                                                          {45, 112, 142},
                                                          {35, 138, 141},
                                                          {31, 163, 134},
                                                          {61, 188, 116},
                                                          {122, 209, 81},
                                                          {189, 223, 38},
                                                          {253, 231, 37}}};
    const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double within = place - static_cast<double>(stop);
    Raster::Colour result{0, 0, 0, 255};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = static_cast<std::uint8_t>(std::lround((1.0 - within) * stops[stop][i] + within * stops[stop + 1][i]));
    return result;
}

Raster::Colour lit(Raster::Colour colour, double light) {
    for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<std::uint8_t>(light * colour[i]);
    return colour;
}

/// Where the colours end.
double upper_end(const BodyPictures& pictures) {
    double end = pictures.polygons.least_end;
    for (const Snapshot& snapshot : pictures.snapshots) {
        std::vector<double> values;
        for (const double value : snapshot.value)
            if (std::isfinite(value)) values.push_back(value);
        if (values.empty()) continue;
        const auto nth = values.begin() + static_cast<std::ptrdiff_t>(
                                              (1.0 - highest_left_out) * static_cast<double>(values.size() - 1) + 0.5);
        std::ranges::nth_element(values, nth);
        end = std::max(end, *nth);
    }
    return end > 0.0 ? end : 1.0;
}

double largest_value(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values)
        if (value > most) most = value;
    return most;
}

/// What all pictures of a run have in common.
class BodySheet {
public:
    explicit BodySheet(const BodyPictures& pictures)
        : in_space_(pictures.polygons.in_space),
          view_(in_space_ ? EyeView::of_space() : EyeView()),
          box_(box_of(pictures)),
          upper_(upper_end(pictures)) {
        BodyBox seen;
        if (in_space_)
            for (const Snapshot& snapshot : pictures.snapshots)
                for (const Position& x : snapshot.position) seen.add(view_(x));
        else
            seen.add(box_.low), seen.add(box_.high);
        const double more = in_space_ ? margin_of_bodies * seen.size() : 0.0;
        const std::array<double, 2> length{seen.high[0] - seen.low[0] + 2.0 * more, seen.high[1] - seen.low[1] + 2.0 * more};
        const double wide = image_width;
        height_ = std::clamp(wide * length[1] / length[0], least_image_height, most_image_height);
        scale_ = std::min(wide / length[0], height_ / length[1]);
        for (std::size_t i = 0; i < 2; ++i) middle_[i] = 0.5 * (seen.low[i] + seen.high[i]);
    }

    [[nodiscard]] bool in_space() const { return in_space_; }
    [[nodiscard]] const EyeView& view() const { return view_; }
    [[nodiscard]] const BodyBox& box() const { return box_; }
    [[nodiscard]] double upper() const { return upper_; }
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] double lower_edge() const { return image_top + height_; }
    /// Units of the drawing per metre.
    [[nodiscard]] double scale() const { return scale_; }
    /// In points of the image.
    [[nodiscard]] Raster::Corner corner(const Position& x) const {
        const Position seen = view_(x);
        const double points = points_per_unit * scale_;
        return {points_per_unit * 0.5 * image_width + points * (seen[0] - middle_[0]),
                points_per_unit * 0.5 * height_ - points * (seen[1] - middle_[1]), points * seen[2]};
    }
    [[nodiscard]] Raster image() const {
        return {static_cast<int>(points_per_unit * image_width), static_cast<int>(std::ceil(points_per_unit * height_))};
    }

private:
    bool in_space_;
    EyeView view_;
    BodyBox box_;
    double upper_;
    double height_ = 0.0;
    double scale_ = 1.0;
    std::array<double, 2> middle_{};
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
    return points_per_unit * sheet.scale() * sum / static_cast<double>(std::max<std::size_t>(1, polygons.cell.size()));
}

void draw_bodies(Raster& image, const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    const double thin = size_of_cells(sheet, polygons, snapshot) >= few_cells ? cell_line : 0.0;
    std::vector<Raster::Corner> corners;
    std::vector<double> line;
    for (std::size_t i = 0; i < polygons.cell.size(); ++i) {
        corners.clear();
        line.clear();
        for (std::size_t k = polygons.offsets[i]; k < polygons.offsets[i + 1]; ++k) {
            corners.push_back(sheet.corner(snapshot.position[static_cast<std::size_t>(polygons.corners[k])]));
            line.push_back(!polygons.is_rim.empty() && polygons.is_rim[k] != 0 ? rim_line : thin);
        }
        const double value = snapshot.value[i];
        Raster::Colour of_polygon = std::isfinite(value) ? colour_of_value(value / sheet.upper()) : grey;
        if (sheet.in_space()) of_polygon = lit(of_polygon, light_on(corners));
        image.fill(corners, of_polygon, line);
    }
}

/// The colours beside the picture_of, with their values.
Markup value_bar(const BodySheet& sheet, const std::string& name) {
    const double x = image_right + value_bar_gap, step = sheet.height() / value_levels;
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
    return result + label(name, sheet_width - 4.0, image_top - 12.0, "end");
}

/// A length of 1, 2 or 5 times a power of ten below the picture_of.
Markup length_scale(const BodySheet& sheet) {
    const Axis axis = linear_axis(0.0, image_width / sheet.scale(), 5);
    const double length = axis.ticks[1].at - axis.ticks[0].at, end = image_left + length * sheet.scale(),
                 y = sheet.lower_edge() + 14.0;
    return line("axis", image_left, y, end, y) + line("axis", image_left, y - 4.0, image_left, y + 4.0) +
           line("axis", end, y - 4.0, end, y + 4.0) + label(fmt::format("{:g} m", length), end + 6.0, y + 4.0, "start");
}

/// The directions of the axes, in 3D.
Markup directions(const BodySheet& sheet) {
    if (!sheet.in_space()) return {};
    const double x = image_right - 46.0, y = sheet.lower_edge() + 30.0;
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

Markup picture_of(const BodySheet& sheet, const BodyPolygons& polygons, const Snapshot& snapshot) {
    Raster image = sheet.image();
    draw_obstacles(image, sheet, snapshot);
    draw_bodies(image, sheet, polygons, snapshot);
    const double wide = image_width, lower = sheet.lower_edge();
    const Markup content =
        element("title", snapshot.what) +
        element("image", {{"x", shown(image_left)},
                          {"y", shown(image_top)},
                          {"width", shown(wide)},
                          {"height", shown(sheet.height())},
                          {"href", data_address(image.png())}}) +
        element("path",
                {{"class", "grid"},
                 {"fill", "none"},
                 {"d", fmt::format("M{0},{1}H{2}V{3}H{0}Z", image_left, image_top, image_left + wide, shown(lower))}}) +
        value_bar(sheet, fmt::format("{} [{}]", polygons.value_name, polygons.value_unit)) + length_scale(sheet) +
        directions(sheet);
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"viewBox", fmt::format("0 0 {:.0f} {:.1f}", sheet_width, lower + below_image)},
                    {"role", "img"}},
                   content);
}

std::string caption_of(const BodyPolygons& polygons, const Snapshot& snapshot) {
    std::string text = snapshot.what;
    if (snapshot.force > 0.0) text += fmt::format(", {:.3g} N in all", snapshot.force);
    return text + fmt::format(": t = {:.4g} s, {} up to {:.3g} {}", snapshot.time, polygons.value_name,
                              largest_value(snapshot.value), polygons.value_unit);
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
