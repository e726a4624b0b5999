// Pictures of bodies in reports: what they show is measured in their points.
#include <expat.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "abut/run/drawing/raster.hpp"
#include "abut/run/report/body_pictures.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using Catch::Contains;

struct Image {
    int width = 0;
    int height = 0;
    std::vector<run::Raster::Colour> points;

    [[nodiscard]] const run::Raster::Colour& at(int x, int y) const {
        return points[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[place + i]);
    return number;
}

/// A PNG of 8 bits each of red, green, blue and opacity, whose rows are stored as they are or as differences to the one above.
Image decoded(const std::string& png) {
    REQUIRE(png.starts_with("\x89PNG\r\n\x1A\n"));
    Image image;
    std::string packed;
    bool ends = false;
    for (std::size_t at = 8; at < png.size();) {
        const std::size_t size = number_at(png, at);
        const std::string kind = png.substr(at + 4, 4), content = png.substr(at + 8, size);
        const std::string checked = kind + content;
        REQUIRE(crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())) ==
                number_at(png, at + 8 + size));
        if (kind == "IHDR") {
            image.width = static_cast<int>(number_at(content, 0));
            image.height = static_cast<int>(number_at(content, 4));
            REQUIRE(content.substr(8) == std::string("\x08\x06\x00\x00\x00", 5));
        }
        if (kind == "IDAT") packed += content;
        ends = kind == "IEND";
        at += size + 12;
    }
    REQUIRE(ends);
    const auto row = static_cast<std::size_t>(4 * image.width + 1);
    std::string rows(row * static_cast<std::size_t>(image.height), '\0');
    uLongf size = rows.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) == Z_OK);
    REQUIRE(size == rows.size());
    for (int y = 0; y < image.height; ++y) {
        const std::size_t begin = static_cast<std::size_t>(y) * row;
        REQUIRE((rows[begin] == 0 || rows[begin] == 2));
        for (int x = 0; x < image.width; ++x) {
            run::Raster::Colour point{};
            for (std::size_t i = 0; i < 4; ++i) {
                const auto above = rows[begin] == 2 && y > 0 ? image.at(x, y - 1)[i] : std::uint8_t{0};
                point[i] = static_cast<std::uint8_t>(rows[begin + 1 + 4 * static_cast<std::size_t>(x) + i] + above);
            }
            image.points.push_back(point);
        }
    }
    return image;
}

std::string from_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    REQUIRE(text.size() % 4 == 0);
    std::string bytes;
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        REQUIRE(letters.find(c) != std::string::npos);
        bits = bits << 6 | static_cast<std::uint32_t>(letters.find(c));
        n_bits += 6;
        if (n_bits >= 8) bytes.push_back(static_cast<char>(bits >> (n_bits -= 8) & 0xFF));
    }
    return bytes;
}

/// All images of a piece of a page.
std::vector<Image> images(const std::string& html) {
    std::vector<Image> found;
    const std::string before = "href=\"data:image/png;base64,";
    for (std::size_t at = html.find(before); at != std::string::npos; at = html.find(before, at + 1)) {
        const std::size_t begin = at + before.size();
        found.push_back(decoded(from_base64(html.substr(begin, html.find('"', begin) - begin))));
    }
    return found;
}

void require_well_formed(const std::string& page) {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> strict(XML_ParserCreate("UTF-8"), XML_ParserFree);
    REQUIRE(XML_Parse(strict.get(), page.data(), static_cast<int>(page.size()), XML_TRUE) == XML_STATUS_OK);
}

/// What is drawn, or of it what is of some colour: how many points, and the middle of them.
struct Patch {
    int n = 0;
    double x = 0.0;
    double y = 0.0;
};

template <class Belongs>
Patch patch(const Image& image, const Belongs& belongs) {
    Patch patch;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (belongs(image.at(x, y))) {
                ++patch.n;
                patch.x += x;
                patch.y += y;
            }
    if (patch.n > 0) patch.x /= patch.n, patch.y /= patch.n;
    return patch;
}

Patch drawn(const Image& image) {
    return patch(image, [](const run::Raster::Colour& colour) { return colour[3] > 0; });
}

/// Unit squares: in 2D at (x, 0), in 3D upright and facing a viewer in front, at a depth y.
run::BodyPictures squares(bool in_space, const std::vector<double>& value, const std::vector<std::vector<double>>& places) {
    run::BodyPictures pictures{.polygons = {.in_space = in_space, .value_name = "speed", .value_unit = "m/s"},
                               .snapshots = {}};
    for (std::size_t i = 0; i < value.size(); ++i) {
        for (int corner = 0; corner < 4; ++corner)
            pictures.polygons.corners.push_back(static_cast<std::int32_t>(4 * i) + corner);
        pictures.polygons.offsets.push_back(4 * (i + 1));
        pictures.polygons.cell.push_back(static_cast<std::int32_t>(i));
        pictures.polygons.edges.insert(pictures.polygons.edges.end(), 4, in_space ? run::Edge::inner : run::Edge::rim);
    }
    for (const auto& at : places) {
        run::Snapshot snapshot{.what = "a < b", .value = value};
        for (const double place : at)
            for (const auto& [a, b] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 1.0), std::pair(0.0, 1.0)})
                snapshot.position.push_back(in_space ? run::Snapshot::Position{a, place, b}
                                                     : run::Snapshot::Position{place + a, b, 0.0});
        pictures.snapshots.push_back(snapshot);
    }
    return pictures;
}

double brightness(const run::Raster::Colour& colour) { return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]; }

}  // namespace

TEST_CASE("a polygon covers the points whose middle is in it, the nearest one is seen, and a PNG holds them",
          "[run][report]") {
    run::Raster raster(20, 10);
    const run::Raster::Colour red{200, 0, 0, 255}, blue{0, 0, 200, 255};
    using Corners = std::array<run::Raster::Corner, 4>;
    const Corners near{{{2.0, 3.0, 1.0}, {8.0, 3.0, 1.0}, {8.0, 7.0, 1.0}, {2.0, 7.0, 1.0}}};
    Corners far = near;
    for (auto& corner : far) corner[0] += 3.0, corner[2] = 0.0;
    SECTION("the near one first") {
        raster.fill(near, red);
        raster.fill(far, blue);
    }
    SECTION("the far one first") {
        raster.fill(far, blue);
        raster.fill(near, red);
    }
    Corners lost = near;
    lost[2][1] = std::nan("");
    raster.fill(lost, blue);
    raster.fill(Corners{{{-1e9, -5.0, 9.0}, {1e9, -5.0, 9.0}, {1e9, -1.0, 9.0}, {-1e9, -1.0, 9.0}}}, blue);  // outside
    const Image image = decoded(raster.png());
    CHECK(image.width == 20);
    CHECK(image.height == 10);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool in_rows = y >= 3 && y < 7;
            const auto expected = in_rows && x >= 2 && x < 8    ? red
                                  : in_rows && x >= 8 && x < 11 ? blue
                                                                : run::Raster::Colour{};
            CHECK(image.at(x, y) == expected);
        }
}

TEST_CASE("in all pictures of a run a body is as large, and where it has moved to", "[run][report]") {
    const auto found = images(run::body_pictures(squares(false, {1.0}, {{0.0}, {2.0}})).html());
    REQUIRE(found.size() == 2);
    const Patch first = drawn(found[0]), second = drawn(found[1]);
    const double side = std::sqrt(first.n);
    CHECK(second.n == Approx(first.n).epsilon(0.01));
    CHECK(second.x - first.x == Approx(2.0 * side).epsilon(0.01));
    CHECK(second.y == Approx(first.y).margin(0.5));
    CHECK(3.0 * side < found[0].width);
    CHECK(3.0 * side > 0.8 * found[0].width);
}

TEST_CASE("of two values the higher one is the lighter, and a body without value is grey", "[run][report]") {
    const auto image =
        images(run::body_pictures(squares(false, {0.0, 0.5, 1.0, std::nan("")}, {{0.0, 2.0, 4.0, 6.0}})).html()).at(0);
    std::vector<run::Raster::Colour> middle;
    for (const double x : {0.5, 2.5, 4.5, 6.5})  // of 7 m about the middle of the picture
        middle.push_back(
            image.at(static_cast<int>(0.5 * image.width + (x - 3.5) * std::sqrt(drawn(image).n / 4.0)), image.height / 2));
    CHECK(brightness(middle[0]) < brightness(middle[1]));
    CHECK(brightness(middle[1]) < brightness(middle[2]));
    CHECK(std::abs(middle[3][0] - middle[3][2]) < 10);
}

TEST_CASE("stresses of rounding have the colour of none", "[run][report]") {
    run::BodyPictures pictures = squares(false, {0.0, 1e-17}, {{0.0, 2.0}});
    pictures.polygons.least_end = 1e-9;
    const auto image = images(run::body_pictures(pictures).html()).at(0);
    std::vector<run::Raster::Colour> found;
    for (const auto& point : image.points)
        if (point[3] > 0 && std::ranges::find(found, point) == found.end()) found.push_back(point);
    CHECK(found.size() == 2);  // of squares and of their rims
}

TEST_CASE("in space a face hides what is behind it, in whatever order they come", "[run][report]") {
    const auto front_first = images(run::body_pictures(squares(true, {1.0, 0.0}, {{0.0, 0.05}})).html()).at(0);
    const auto back_first = images(run::body_pictures(squares(true, {0.0, 1.0}, {{0.05, 0.0}})).html()).at(0);
    CHECK(front_first.points == back_first.points);
    const auto is_yellow = [](const run::Raster::Colour& c) { return c[3] > 0 && c[0] > 2 * c[2]; };
    const auto is_violet = [](const run::Raster::Colour& c) { return c[3] > 0 && c[2] > c[1]; };
    const int front = patch(front_first, is_yellow).n, behind = patch(front_first, is_violet).n;
    CHECK(behind > 0);
    CHECK(front > 10 * behind);  // of the other one only what sticks out, about 0.05 of it
}

TEST_CASE("an obstacle is drawn as far as its picture goes", "[run][report]") {
    for (const bool in_space : {false, true}) {
        run::BodyPictures pictures = squares(in_space, {1.0}, {{0.0}});
        const int without = drawn(images(run::body_pictures(pictures).html()).at(0)).n;
        if (in_space)
            pictures.snapshots[0].obstacles = {{{-1e4, -1e4, 0.0}, {1e4, -1e4, 0.0}, {1e4, 1e4, 0.0}, {-1e4, 1e4, 0.0}}};
        else
            pictures.snapshots[0].obstacles = {{{-1e4, 0.0, 0.0}, {1e4, 0.0, 0.0}}};
        const Image image = images(run::body_pictures(pictures).html()).at(0);
        const Patch with = drawn(image);
        CHECK(with.n > without);
        CHECK(with.n < image.width * image.height / 1.1);
    }
}

TEST_CASE("faces that are held have orange edges, those under a traction pink ones", "[run][report]") {
    for (const bool in_space : {false, true}) {
        run::BodyPictures pictures = squares(in_space, {1.0}, {{0.0}});
        const auto marks = [&](run::Edge edge, run::Raster::Colour colour) {
            pictures.polygons.edges[0] = edge;
            const Image image = images(run::body_pictures(pictures).html()).at(0);
            return patch(image, [&](const run::Raster::Colour& point) { return point == colour; }).n;
        };
        const run::Raster::Colour orange{217, 89, 31, 255}, pink{219, 38, 128, 255};
        CHECK(marks(run::Edge::inner, orange) == 0);
        CHECK(marks(run::Edge::held, orange) > 100);
        CHECK(marks(run::Edge::held, pink) == 0);
        CHECK(marks(run::Edge::loaded, pink) > 100);
    }
}

TEST_CASE("bodies have their names in a picture where there are several, each once, and none lies on another",
          "[run][report]") {
    const auto names = [](std::vector<double> places) {
        run::BodyPictures pictures = squares(false, {1.0, 1.0}, {places});
        pictures.polygons.body = {0, 1};
        pictures.polygons.body_names = {"left < 1", "right"};
        const std::string html = run::body_pictures(pictures).html();
        require_well_formed(html);
        return std::pair(html.find(">left &lt; 1</text>") != std::string::npos,
                         html.find(">right</text>") != std::string::npos);
    };
    CHECK(names({0.0, 2.0}) == std::pair(true, true));
    CHECK(names({0.0, 0.01}) == std::pair(true, false));
}

namespace {

/// How often a text is there.
std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
    return n;
}

/// The numbers of a path of a style, the first of a page.
std::vector<double> path_numbers(const std::string& html, const std::string& style) {
    const std::string before = "class=\"" + style + "\" d=\"";
    const std::size_t begin = html.find(before);
    REQUIRE(begin != std::string::npos);
    std::string path = html.substr(begin + before.size(), html.find('"', begin + before.size()) - begin - before.size());
    for (char& c : path)
        if (std::string("MLZ,").find(c) != std::string::npos) c = ' ';
    std::istringstream words(path);
    std::vector<double> numbers;
    for (double number = 0.0; words >> number;) numbers.push_back(number);
    return numbers;
}

}  // namespace

TEST_CASE(
    "an arrow shows a traction at its face: it presses on it or pulls at it, turns with it where it follows, and half the "
    "traction is half as long",
    "[run][report]") {
    run::BodyPictures pictures = squares(false, {1.0}, {{0.0}});
    // The left edge, from (0, 1) to (0, 0).
    run::PictureMarks::LoadedFace face{.corners = {3, 0},
                                       .at_rest = {{0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}},
                                       .normal = {-1.0, 0.0, 0.0},
                                       .traction = [](double) {
                                           return run::PictureMarks::Position{2.0, 0.0, 0.0};
                                       }};
    const auto ends = [&] {  // tail, neck and tip
        pictures.polygons.marks.loaded = {face};
        return path_numbers(run::body_pictures(pictures).html(), "load");
    };
    const std::vector<double> pressing = ends();
    CHECK(pressing[0] < pressing[4]);
    CHECK(pressing[1] == pressing[5]);
    face.traction = [](double) { return run::PictureMarks::Position{-2.0, 0.0, 0.0}; };
    const std::vector<double> pulling = ends();
    CHECK(pulling[0] == pressing[4]);
    CHECK(pulling[4] == pressing[0]);

    // The square has turned by a quarter, counter-clockwise: its left edge is below, and the arrow points down.
    pictures.snapshots[0].position = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}};
    const std::vector<double> fixed = ends();
    CHECK(fixed[1] == fixed[5]);
    face.follows = true;
    const std::vector<double> followed = ends();
    CHECK(followed[0] == Approx(followed[4]));
    CHECK(followed[5] > followed[1] + 10.0);

    face.follows = false;
    pictures.snapshots = squares(false, {1.0}, {{0.0}, {0.0}}).snapshots;
    pictures.snapshots[1].time = 1.0;
    face.traction = [](double time) { return run::PictureMarks::Position{time > 0.0 ? 4.0 : 2.0, 0.0, 0.0}; };
    const std::vector<double> half = ends();
    CHECK(half[4] - half[0] == Approx(0.5 * (pressing[4] - pressing[0])).margin(0.2));
}

TEST_CASE("in space an arrow on a face that is not seen is left out", "[run][report]") {
    for (const double side : {-1.0, 1.0}) {
        run::BodyPictures pictures = squares(true, {1.0}, {{0.0}});
        pictures.polygons.marks.loaded = {{.corners = {0, 1, 2, 3},
                                           .at_rest = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
                                           .normal = {0.0, side, 0.0},
                                           .traction = [](double) {
                                               return run::PictureMarks::Position{0.0, 1.0, 0.0};
                                           }}};
        const std::string html = run::body_pictures(pictures).html();
        CHECK(count_of(html, "class=\"load\"") == (side < 0.0 ? 1 : 0));  // the viewer stands in front, where y < 0
    }
}

TEST_CASE("springs are zigzags between places of bodies and of the ground, and hinges rings", "[run][report]") {
    run::BodyPictures pictures = squares(false, {1.0}, {{0.0}});
    const run::PictureMarks::SpringEnd ground{.fixed = {3.0, 0.5, 0.0}};
    const run::PictureMarks::SpringEnd middle_of_right{.held = {{1, 0.5}, {2, 0.5}}};
    pictures.polygons.marks.springs = {{middle_of_right, ground}};
    pictures.snapshots[0].obstacles = {{{3.0, 0.0, 0.0}, {3.0, 1.0, 0.0}}};  // so that the ground is in the picture
    const std::vector<double> zigzag = path_numbers(run::body_pictures(pictures).html(), "spring");
    const std::size_t n = zigzag.size();
    const double scale = zigzag[n - 2] - zigzag[0];  // of 2 m
    CHECK(zigzag[1] == zigzag[n - 1]);
    CHECK(scale > 100.0);
    pictures.snapshots[0].position[1][0] = pictures.snapshots[0].position[2][0] = 2.0;  // of 1 m now
    const std::vector<double> shorter = path_numbers(run::body_pictures(pictures).html(), "spring");
    CHECK(shorter[shorter.size() - 2] - shorter[0] == Approx(0.5 * scale).margin(0.2));
    pictures.polygons.marks.springs = {{middle_of_right, middle_of_right}};
    const std::string hinge = run::body_pictures(pictures).html();
    require_well_formed(hinge);
    CHECK(count_of(hinge, "<circle class=\"spring\"") == 1);
}

TEST_CASE("the pictures of a scene have its tractions, springs, gravity and names of obstacles", "[run][report]") {
    const test::Folder folder;
    const run::RunOptions options{.steps = 3, .out = folder.path() / "out", .frames = 0};
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.solid.boundary.traction.push_back({.group = "ymax", .value = {0.0, -1e-4}});
    scene.solid.springs.push_back(
        {.first = {.body = 0, .position = {0.5, 0.5}}, .second = {.position = {0.5, 0.9}}, .stiffness = 1e-3});
    scene.solid.acceleration = {{0.0, -1e-4}};
    scene.outputs.obstacles = {"a < b"};
    run::ResultFiles<2> files(options, "mine", "block");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const std::string report = test::read_text(options.out / "report.html");
    require_well_formed(report);
    const std::size_t n_pictures = images(report).size();
    CHECK(n_pictures >= 2);
    CHECK(count_of(report, "class=\"load\"") % n_pictures == 0);
    CHECK(count_of(report, "class=\"load\"") > 0);
    CHECK(count_of(report, "class=\"spring\"") == n_pictures);
    CHECK(count_of(report, ">gravity</text>") == n_pictures);
    CHECK(count_of(report, ">a &lt; b</text>") == n_pictures);
}

TEST_CASE(
    "a report shows the bodies at the start, in the middle, near the largest force and at the end, also without frames",
    "[run][report]") {
    const test::Folder folder;
    const run::RunOptions options{.out = folder.path() / "out", .frames = 0};
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.mesh = mesh::structured_box<2>({0.0, 1e-3}, {1.0, 1.0 + 1e-3}, {8, 8}, mesh::CellShape::quadrangle, "block");
    run::ResultFiles<2> files(options, "mine", "block");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const std::string report = test::read_text(options.out / "report.html");
    require_well_formed(report);
    CHECK_THAT(report, !Contains("<script") && Contains("At the start") && Contains("In the middle") &&
                           Contains("Near the largest contact force") && Contains("At the end"));
    CHECK(report.find("href=\"http") == std::string::npos);
    const auto found = images(report);
    REQUIRE(found.size() == 4);
    // Stress comes with contact: the block is of one dark colour before, and has lighter ones then.
    const auto is_light = [](const run::Raster::Colour& c) { return c[3] == 255 && brightness(c) > 150.0; };
    CHECK(patch(found[0], is_light).n == 0);
    CHECK(std::max(patch(found[1], is_light).n, patch(found[2], is_light).n) > 1000);
}

TEST_CASE("the end of a run that was asked to stop is in its report", "[run][report]") {
    struct Stop : run::Observer<2> {
        [[nodiscard]] bool asks_to_stop() const override { return true; }
    } stop;
    const test::Folder folder;
    const run::RunOptions options{.out = folder.path() / "out", .frames = 0};
    const run::Scene<2> scene = test::block_on_plane(0.05);
    run::ResultFiles<2> files(options, "mine", "block");
    run::Observers<2> both{files, stop};
    run::RunResult<2> result = run::simulate<2>(scene, options, both);
    files.finish(scene, result);
    CHECK(images(test::read_text(options.out / "report.html")).size() == 2);
}

TEST_CASE("pictures change no bit of a run", "[run][report]") {
    const test::Folder folder;
    const run::RunOptions options{.out = folder.path() / "out", .interval = 3, .frames = 0};
    const run::Scene<2> scene = test::block_on_plane(0.05);
    run::ResultFiles<2> files(options, "mine", "block");
    const run::RunResult<2> seen = run::simulate<2>(scene, options, files), unseen = run::simulate<2>(scene, options);
    REQUIRE(seen.ledger.entries().size() == unseen.ledger.entries().size());
    for (std::size_t i = 0; i < seen.ledger.entries().size(); ++i)
        CHECK(dynamics::ledger_values(seen.ledger.entries()[i]) == dynamics::ledger_values(unseen.ledger.entries()[i]));
}
