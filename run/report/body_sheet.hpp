#pragma once
// Private to the sources of run.
#include <array>
#include <limits>
#include <vector>

#include "abut/run/drawing/raster.hpp"
#include "abut/run/files/snapshots.hpp"

namespace abut::run {

[[nodiscard]] double dot(const Snapshot::Position& a, const Snapshot::Position& b);

/// The directions to the right, upwards and to the eye.
struct EyeView {
    std::array<Snapshot::Position, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

    static EyeView of_space();
    [[nodiscard]] Snapshot::Position operator()(const Snapshot::Position& x) const;
};

struct BodyBox {
    static constexpr double far = std::numeric_limits<double>::infinity();
    Snapshot::Position low{far, far, far};
    Snapshot::Position high{-far, -far, -far};

    /// Takes in what is finite of a position.
    void add(const Snapshot::Position& x);
    [[nodiscard]] double size() const;
};

[[nodiscard]] BodyBox box_of(const std::vector<Snapshot::Position>& positions);

/// Properties that all pictures of a run share: where a position lies on the sheet, and where the colours end. All
/// constants are in units of the drawing.
class BodySheet {
public:
    static constexpr double width = 480.0, image_left = 8.0, image_right = 384.0, image_top = 26.0;
    static constexpr double image_width = image_right - image_left;
    static constexpr double points_per_unit = 2.0;

    explicit BodySheet(const BodyPictures& pictures);

    [[nodiscard]] bool in_space() const { return in_space_; }
    [[nodiscard]] const EyeView& view() const { return view_; }
    [[nodiscard]] const BodyBox& box() const { return box_; }
    [[nodiscard]] double upper() const { return upper_; }
    [[nodiscard]] double largest_load() const { return largest_load_; }  ///< [Pa]
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] double lower_edge() const { return image_top + height_; }
    /// Units of the drawing per metre.
    [[nodiscard]] double scale() const { return scale_; }
    /// In points of the image.
    [[nodiscard]] Raster::Corner corner(const Snapshot::Position& x) const;
    [[nodiscard]] Raster image() const;

private:
    bool in_space_;
    EyeView view_;
    BodyBox box_;
    double upper_;
    double largest_load_;
    double height_ = 0.0;
    double scale_ = 1.0;
    std::array<double, 2> middle_{};
};

}  // namespace abut::run
