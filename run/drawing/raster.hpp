#pragma once
// Private to the sources of run.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut::run {

/// Polygons as an image of points: of those that cover a point the nearest one is seen. Its size does not depend on how many
/// polygons there are.
class Raster {
public:
    using Corner = std::array<double, 3>;        ///< x to the right, y downwards [points]; the greater the third, the nearer
    using Colour = std::array<std::uint8_t, 4>;  ///< red, green, blue, opacity

    /// Light of a line that has no colour of its own, over that of its polygon.
    static constexpr double shade_of_line = 0.55;

    /// Transparent as long as nothing is drawn. Both are > 0.
    Raster(int width, int height);

    /// A convex polygon, or one that its first corner sees all of. Points within `line[i]` of the edge from corner i to the
    /// next have the colour `of_line[i]`, or where there is none are darker [points]; empty: no lines. Of polygons as
    /// near the one drawn first is seen. One with a corner that is not finite is left out, and so is what lies outside
    /// the image.
    void fill(std::span<const Corner> corners, const Colour& colour, std::span<const double> line = {},
              std::span<const Colour> of_line = {});

    [[nodiscard]] Colour at(int x, int y) const { return colour_[index(x, y)]; }
    /// The bytes of a PNG file.
    [[nodiscard]] std::string png() const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
    }
    void fill_triangle(const std::array<Corner, 3>& corners, const Colour& colour, const std::array<double, 3>& line,
                       const std::array<Colour, 3>& of_line);

    std::size_t width_;
    std::size_t height_;
    std::vector<Colour> colour_;
    std::vector<double> depth_;
};

/// "data:image/png;base64,...": an image as an address that needs no file.
[[nodiscard]] std::string data_address(const std::string& png);

}  // namespace abut::run
