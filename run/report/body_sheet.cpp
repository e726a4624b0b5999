#include "abut/run/report/body_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "abut/run/drawing/colours.hpp"
#include "abut/run/files/picture_marks.hpp"

namespace abut::run {
namespace {

constexpr double least_image_height = 130.0, most_image_height = 400.0;
constexpr double margin_of_bodies = 0.06;  // around the bodies, of their size

/// Bodies at all times, with obstacles that are not larger than they.
BodyBox box_of(const BodyPictures& pictures) {
    BodyBox box;
    for (const Snapshot& snapshot : pictures.snapshots)
        for (const Snapshot::Position& x : snapshot.position) box.add(x);
    const double size = box.size();
    BodyBox whole = box;
    for (const Snapshot& snapshot : pictures.snapshots) {
        BodyBox obstacles;
        for (const auto& face : snapshot.obstacles)
            for (const Snapshot::Position& x : face) obstacles.add(x);
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

/// The value at which the colours end.
double end_of_colours(const BodyPictures& pictures) {
    double end = pictures.polygons.least_end;
    for (const Snapshot& snapshot : pictures.snapshots) end = std::max(end, upper_end(snapshot.value));
    return end > 0.0 ? end : 1.0;
}

/// The largest load of all times [Pa].
double largest_load_of(const BodyPictures& pictures) {
    double largest = 0.0;
    for (const Snapshot& snapshot : pictures.snapshots)
        for (const PictureMarks::Load& load : loads_at(pictures.polygons.marks, snapshot.time, snapshot.position))
            largest = std::max(largest, std::sqrt(dot(load.traction, load.traction)));
    return largest;
}

}  // namespace

double dot(const Snapshot::Position& a, const Snapshot::Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

EyeView EyeView::of_space() {
    const double turn = 0.45, rise = 0.42;  // [rad]
    const double c = std::cos(turn), s = std::sin(turn), level = std::cos(rise), up = std::sin(rise);
    return {{{{c, s, 0.0}, {-s * up, c * up, level}, {s * level, -c * level, up}}}};
}

Snapshot::Position EyeView::operator()(const Snapshot::Position& x) const {
    return {dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)};
}

void BodyBox::add(const Snapshot::Position& x) {
    for (std::size_t i = 0; i < 3; ++i)
        if (std::isfinite(x[i])) {
            low[i] = std::min(low[i], x[i]);
            high[i] = std::max(high[i], x[i]);
        }
}

double BodyBox::size() const {
    return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], std::numeric_limits<double>::min()});
}

BodyBox box_of(const std::vector<Snapshot::Position>& positions) {
    BodyBox box;
    for (const Snapshot::Position& x : positions) box.add(x);
    return box;
}

BodySheet::BodySheet(const BodyPictures& pictures)
    : in_space_(pictures.polygons.in_space),
      view_(in_space_ ? EyeView::of_space() : EyeView()),
      box_(box_of(pictures)),
      upper_(end_of_colours(pictures)),
      largest_load_(largest_load_of(pictures)) {
    BodyBox seen;
    if (in_space_)
        for (const Snapshot& snapshot : pictures.snapshots)
            for (const Snapshot::Position& x : snapshot.position) seen.add(view_(x));
    else
        seen.add(box_.low), seen.add(box_.high);
    const double more = in_space_ ? margin_of_bodies * seen.size() : 0.0;
    const std::array<double, 2> length{seen.high[0] - seen.low[0] + 2.0 * more, seen.high[1] - seen.low[1] + 2.0 * more};
    const double wide = image_width;
    height_ = std::clamp(wide * length[1] / length[0], least_image_height, most_image_height);
    scale_ = std::min(wide / length[0], height_ / length[1]);
    for (std::size_t i = 0; i < 2; ++i) middle_[i] = 0.5 * (seen.low[i] + seen.high[i]);
}

Raster::Corner BodySheet::corner(const Snapshot::Position& x) const {
    const Snapshot::Position seen = view_(x);
    const double points = points_per_unit * scale_;
    return {points_per_unit * 0.5 * image_width + points * (seen[0] - middle_[0]),
            points_per_unit * 0.5 * height_ - points * (seen[1] - middle_[1]), points * seen[2]};
}

Raster BodySheet::image() const {
    return {static_cast<int>(points_per_unit * image_width), static_cast<int>(std::ceil(points_per_unit * height_))};
}

}  // namespace abut::run
