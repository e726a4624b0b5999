// Animations: what a browser finds in the file. tests/programs/check_animation.py looks at one in a browser.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/run/files/animation.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/cell_view.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using Catch::Contains;
using nlohmann::json;

std::string between(const std::string& text, const std::string& before, const std::string& after, std::size_t from = 0) {
    const std::size_t begin = text.find(before, from);
    REQUIRE(begin != std::string::npos);
    const std::size_t end = text.find(after, begin + before.size());
    REQUIRE(end != std::string::npos);
    return text.substr(begin + before.size(), end - begin - before.size());
}

template <class Number>
std::vector<Number> unpacked(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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
    REQUIRE(bytes.size() % sizeof(Number) == 0);
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

std::vector<double> numbers(const std::string& text) {
    std::istringstream words(text);
    std::vector<double> numbers;
    for (double number; words >> number;) numbers.push_back(number);
    return numbers;
}

struct Frame {
    double time, most;
    std::vector<double> low, size, places;
    std::vector<std::uint16_t> numbers;
};

struct Film {
    json common;
    std::vector<Frame> frames;
};

Film film(const std::string& text) {
    Film film{.common = json::parse(between(text, "id=\"common\">", "</script>")), .frames = {}};
    const std::string begin = "<script type=\"text/plain\" class=\"frame\"";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
        const auto said = [&](const std::string& name) { return between(text, "data-" + name + "=\"", "\"", at); };
        film.frames.push_back({.time = std::stod(said("time")),
                               .most = std::stod(said("most")),
                               .low = numbers(said("low")),
                               .size = numbers(said("size")),
                               .places = numbers(said("places")),
                               .numbers = unpacked<std::uint16_t>(between(text, "\">", "</script>", at))});
    }
    return film;
}

/// Where vertices are, and the largest von Mises stress of cells that are drawn, at each step.
template <int Dim>
struct Seen : run::Observer<Dim> {
    struct State {
        std::vector<Vector<Dim>> position;
        double most = 0.0;
    };
    std::map<double, State> states;
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        State& state = states[run.time];
        state.position = solid.cells().vertex_displacement(run.q);
        for (std::size_t v = 0; v < state.position.size(); ++v) state.position[v] += solid.mesh().vertices[v];
        static_cast<void>(solid.potential(run.q));
        const auto add = [&](std::int32_t cell) {
            state.most =
                std::max(state.most, run::von_mises<Dim>(solid.cells().stress(cell), solid.options().materials[0].poisson));
        };
        if constexpr (Dim == 2)
            for (std::int32_t cell = 0; cell < solid.mesh().n_cells(); ++cell) add(cell);
        else
            for (const std::int32_t face : solid.mesh().boundary_faces)
                add(solid.mesh().face_cells[static_cast<std::size_t>(face)][0]);
    }
};

/// Runs a scene into an animation in a folder.
template <int Dim>
std::string animated(const run::Scene<Dim>& scene, const run::RunOptions& options, const test::Folder& folder, int n_frames,
                     double limit = run::animation_limit, run::Observer<Dim>* beside = nullptr) {
    std::filesystem::create_directories(folder.path());
    run::Animation<Dim> animation(folder.path() / run::animation_name, "mine", n_frames, limit);
    run::Observers<Dim> observers{animation};
    if (beside) observers.add(*beside);
    static_cast<void>(run::simulate<Dim>(scene, options, observers));
    animation.finish();
    return test::read_text(folder.path() / run::animation_name);
}

run::Scene<3> cube_on_plane() {
    run::Scene<3> scene;
    scene.mesh =
        mesh::structured_box<3>({0.0, 0.0, 1e-3}, {1.0, 1.0, 1.0 + 1e-3}, {3, 3, 3}, mesh::CellShape::hexahedron, "cube");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.obstacles = {contact::plane_obstacle<3>(Vector<3>::Zero(), Vector<3>::UnitZ(), 4.0)};
    scene.velocity = {Vector<3>(0.0, 0.0, -0.05)};
    scene.time = 0.5;
    return scene;
}

/// Vertices of the mesh in the order in which polygons first name them: of cells in 2D, of boundary faces in 3D.
template <int Dim>
std::vector<std::int32_t> vertices_in_order(const mesh::Mesh<Dim>& mesh) {
    std::vector<std::int32_t> order;
    const auto add = [&](auto vertices) {
        for (const std::int32_t vertex : vertices)
            if (std::ranges::find(order, vertex) == order.end()) order.push_back(vertex);
    };
    if constexpr (Dim == 2)
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) add(mesh.cell_vertices[cell]);
    else
        for (const std::int32_t face : mesh.boundary_faces) add(mesh.face_vertices[face]);
    return order;
}

template <int Dim>
void require_positions(const run::Scene<Dim>& scene) {
    const test::Folder folder;
    Seen<Dim> seen;
    const Film found = film(animated<Dim>(scene, {.steps = 16}, folder, 5, run::animation_limit, &seen));
    const std::vector<std::int32_t> order = vertices_in_order(scene.mesh);
    CHECK(found.common.at("n_vertices") == order.size());
    CHECK(found.common.at("bodies") == json(scene.mesh.body_names));
    CHECK(found.common.at("note") == "");
    REQUIRE(found.frames.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        CAPTURE(i);
        const Frame& frame = found.frames[i];
        const auto step = std::next(seen.states.begin(), static_cast<std::ptrdiff_t>(4 * i));
        CHECK(frame.time == Approx(step->first).margin(1e-12));
        CHECK(frame.most == Approx(step->second.most).margin(1e-15));
        const std::size_t n_polygons = found.common.at("n_polygons");
        REQUIRE(frame.numbers.size() == Dim * order.size() + n_polygons);
        double farthest = 0.0;
        for (std::size_t v = 0; v < order.size(); ++v)
            for (int k = 0; k < Dim; ++k) {
                const auto axis = static_cast<std::size_t>(k);
                const double x = frame.low[axis] + frame.size[axis] / 65535.0 * frame.numbers[Dim * v + axis];
                farthest = std::max(
                    farthest, std::abs(x - step->second.position[static_cast<std::size_t>(order[v])][k]) / frame.size[axis]);
            }
        CHECK(farthest < 0.51 / 65535.0);
        const auto values = frame.numbers.begin() + static_cast<std::ptrdiff_t>(Dim * order.size());
        if (frame.most > 0.0) CHECK(*std::max_element(values, frame.numbers.end()) == 65534);
    }
    CHECK(std::ranges::max(found.frames, {}, &Frame::most).most > 1e-3);  // contact strains it
}

}  // namespace

TEST_CASE("an animation holds where the bodies were at each frame to half of 1/65535 of their box, and the largest stress",
          "[run][animation]") {
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.mesh = mesh::structured_box<2>({0.0, 1e-3}, {1.0, 1.0 + 1e-3}, {4, 4}, mesh::CellShape::quadrangle, "block");
    require_positions<2>(scene);
}

TEST_CASE("the same in 3D, where boundary faces are drawn alone", "[run][animation]") {
    require_positions<3>(cube_on_plane());
}

TEST_CASE("an animation stays within its limit, says so, and still shows the first and the last step", "[run][animation]") {
    const test::Folder folder;
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.mesh = mesh::structured_box<2>({0.0, 1e-3}, {1.0, 1.0 + 1e-3}, {20, 20}, mesh::CellShape::quadrangle, "block");
    const std::string whole = animated<2>(scene, {.steps = 50}, folder, 51);
    REQUIRE(film(whole).frames.size() == 51);
    const double limit = 0.5 * static_cast<double>(whole.size());
    const std::string text = animated<2>(scene, {.steps = 50}, folder, 51, limit);
    const Film found = film(text);
    CHECK(static_cast<double>(text.size()) < limit);
    CHECK(static_cast<double>(text.size()) > 0.6 * limit);
    CHECK_THAT(found.common.at("note").get<std::string>(),
               Contains("Of the 51 frames") && Contains(std::to_string(found.frames.size()) + " are here"));
    CHECK(found.frames.front().time == 0.0);
    CHECK(found.frames.back().time == film(whole).frames.back().time);
    CHECK(film(animated<2>(scene, {.steps = 50}, folder, 51, 1.0)).frames.size() == 2);
}

TEST_CASE("an obstacle is in an animation at rest, and where it is at each frame", "[run][animation]") {
    const test::Folder folder;
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.solid.obstacles[0].path = [](double time) { return Vector<2>(3.0 * time, -time); };
    const Film found = film(animated<2>(scene, {.steps = 10}, folder, 3));
    const auto corners = unpacked<float>(found.common.at("obstacles").at(0).at("corners"));
    REQUIRE(corners.size() == 6);
    for (std::size_t i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
            CHECK(corners[3 * i + static_cast<std::size_t>(k)] ==
                  Approx(scene.solid.obstacles[0].faces[0][i][k]).margin(1e-6));
    for (const Frame& frame : found.frames) {
        const std::vector<double> expected{1, 0, 0, 0, 1, 0, 0, 0, 1, 3.0 * frame.time, -frame.time, 0};
        REQUIRE(frame.places.size() == 12);
        for (std::size_t i = 0; i < 12; ++i) CHECK(frame.places[i] == Approx(expected[i]).margin(1e-9));
    }
}

TEST_CASE("an animation asks for nothing from elsewhere, and no name breaks it", "[run][animation]") {
    const test::Folder folder;
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.title = "</script><script>alert('1')</script> & \"more\"";
    scene.mesh.body_names[0] = scene.title;
    const std::string text = animated<2>(scene, {.steps = 4}, folder, 2);
    for (const char* never : {"src=", "href=", "@import", "url(", "http:", "https:", "fetch(", "XMLHttp"})
        CHECK_THAT(text, !Contains(never));
    CHECK_THAT(text, Contains("default-src 'none'") && !Contains("<script>alert"));
    const Film found = film(text);
    CHECK(found.common.at("title") == scene.title);
    CHECK(found.common.at("bodies").at(0) == scene.title);
}

TEST_CASE("an animation changes no bit of a run", "[run][animation]") {
    const test::Folder folder;
    std::filesystem::create_directories(folder.path());
    const run::Scene<2> scene = test::block_on_plane(0.05);
    const run::RunOptions options{.interval = 3};
    run::Animation<2> animation(folder.path() / "a.html", "mine", 30);
    const run::RunResult<2> seen = run::simulate<2>(scene, options, animation), unseen = run::simulate<2>(scene, options);
    REQUIRE(seen.ledger.entries().size() == unseen.ledger.entries().size());
    for (std::size_t i = 0; i < seen.ledger.entries().size(); ++i)
        CHECK(dynamics::ledger_values(seen.ledger.entries()[i]) == dynamics::ledger_values(unseen.ledger.entries()[i]));
}
