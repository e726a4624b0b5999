#include "abut/run/drawing/raster.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string_view>

#include "abut/run/drawing/base64.hpp"

namespace abut::run {
namespace {

using Corner = Raster::Corner;

constexpr int compression_level = 6;

/// Twice the area of a triangle, > 0 where c is on the right of the line from a to b as it is seen.
double twice_area(const Corner& a, const Corner& b, const Corner& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

struct Span {
    int begin;
    int end;
};

/// Points of 0 .. n - 1 whose middle lies between two places.
Span points_between(double low, double high, std::size_t n) {
    const auto within = [n](double point) { return static_cast<int>(std::clamp(point, 0.0, static_cast<double>(n))); };
    return {within(std::ceil(low - 0.5)), within(std::floor(high - 0.5) + 1.0)};
}

Raster::Colour darkened(Raster::Colour colour) {
    for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<std::uint8_t>(Raster::shade_of_line * colour[i]);
    return colour;
}

void append_number(std::string& bytes, std::uint32_t number) {
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(number >> shift & 0xFF));
}

void append_chunk(std::string& png, std::string_view kind, const std::string& content) {
    append_number(png, static_cast<std::uint32_t>(content.size()));
    const std::size_t begin = png.size();
    png.append(kind).append(content);
    append_number(png, static_cast<std::uint32_t>(
                           crc32(0, reinterpret_cast<const Bytef*>(&png[begin]), static_cast<uInt>(png.size() - begin))));
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string result(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                  compression_level) != Z_OK)
        throw std::bad_alloc();
    result.resize(size);
    return result;
}

}  // namespace

Raster::Raster(int width, int height)
    : width_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(height)),
      colour_(width_ * height_, Colour{}),
      depth_(width_ * height_, -std::numeric_limits<double>::infinity()) {}

void Raster::fill(std::span<const Corner> corners, const Colour& colour, std::span<const double> line,
                  std::span<const Colour> of_line) {
    for (const Corner& corner : corners)
        if (!std::ranges::all_of(corner, [](double x) { return std::isfinite(x); })) return;
    const Colour dark = darkened(colour);
    const auto line_of = [line](std::size_t edge) { return line.empty() ? 0.0 : line[edge]; };
    const auto colour_of = [&](std::size_t edge) { return of_line.empty() ? dark : of_line[edge]; };
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const std::size_t last = i + 1;
        fill_triangle({corners[0], corners[i], corners[i + 1]}, colour,
                      {i == 1 ? line_of(0) : 0.0, line_of(i), i + 2 == corners.size() ? line_of(last) : 0.0},
                      {colour_of(0), colour_of(i), colour_of(last)});
    }
}

void Raster::fill_triangle(const std::array<Corner, 3>& corners, const Colour& colour, const std::array<double, 3>& line,
                           const std::array<Colour, 3>& of_line) {
    const auto& [a, b, c] = corners;
    const double area = twice_area(a, b, c);
    if (area == 0.0) return;
    std::array<double, 3> near{};  // a line in parts of the height over its edge
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner &from = corners[i], &to = corners[(i + 1) % 3];
        near[i] = line[i] * std::hypot(to[0] - from[0], to[1] - from[1]) / std::abs(area);
    }
    const auto [low_x, high_x] = std::minmax({a[0], b[0], c[0]});
    const auto [low_y, high_y] = std::minmax({a[1], b[1], c[1]});
    const Span columns = points_between(low_x, high_x, width_), rows = points_between(low_y, high_y, height_);
    for (int y = rows.begin; y < rows.end; ++y)
        for (int x = columns.begin; x < columns.end; ++x) {
            const Corner middle{x + 0.5, y + 0.5, 0.0};
            const double of_a = twice_area(b, c, middle) / area, of_b = twice_area(c, a, middle) / area,
                         of_c = twice_area(a, b, middle) / area;
            if (of_a < 0.0 || of_b < 0.0 || of_c < 0.0) continue;
            const double depth = of_a * a[2] + of_b * b[2] + of_c * c[2];
            if (!(depth > depth_[index(x, y)])) continue;
            depth_[index(x, y)] = depth;
            colour_[index(x, y)] = of_c < near[0]   ? of_line[0]
                                   : of_a < near[1] ? of_line[1]
                                   : of_b < near[2] ? of_line[2]
                                                    : colour;
        }
}

std::string Raster::png() const {
    constexpr char difference_to_above = 2;
    std::string rows;
    rows.reserve(height_ * (4 * width_ + 1));
    for (std::size_t y = 0; y < height_; ++y) {
        rows.push_back(difference_to_above);
        for (std::size_t x = 0; x < width_; ++x)
            for (std::size_t i = 0; i < 4; ++i) {
                const int above = y == 0 ? 0 : colour_[(y - 1) * width_ + x][i];
                rows.push_back(static_cast<char>(colour_[y * width_ + x][i] - above));
            }
    }
    std::string header;
    append_number(header, static_cast<std::uint32_t>(width_));
    append_number(header, static_cast<std::uint32_t>(height_));
    header += std::string("\x08\x06\x00\x00\x00", 5);  // 8 bits each of red, green, blue and opacity
    std::string result = "\x89PNG\r\n\x1A\n";
    append_chunk(result, "IHDR", header);
    append_chunk(result, "IDAT", deflated(rows));
    append_chunk(result, "IEND", "");
    return result;
}

std::string data_address(const std::string& png) { return "data:image/png;base64," + base64(png); }

}  // namespace abut::run
