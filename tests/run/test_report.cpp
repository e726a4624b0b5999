#include <expat.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "abut/run/drawing/cell_map.hpp"
#include "abut/run/drawing/markup.hpp"
#include "abut/run/drawing/plot.hpp"
#include "abut/run/drawing/ticks.hpp"
#include "abut/run/report/report.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/report/watched.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/warnings.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using Catch::Contains;
using nlohmann::json;

/// A document as XML: a strict parser takes it or not.
pugi::xml_document parsed(const std::string& text) {
    const std::string doctype = "<!DOCTYPE html>";
    REQUIRE(text.starts_with(doctype));
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> strict(XML_ParserCreate("UTF-8"), XML_ParserFree);
    REQUIRE(XML_Parse(strict.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK);
    pugi::xml_document document;
    REQUIRE(document.load_string(text.c_str() + doctype.size()));
    return document;
}

/// Texts of all elements of a tag, in order, or what an attribute of them says.
std::vector<std::string> all(const pugi::xml_document& document, const std::string& tag, const char* attribute = nullptr) {
    std::vector<std::string> texts;
    for (const auto& found : document.select_nodes(("//" + tag).c_str()))
        texts.emplace_back(attribute ? found.node().attribute(attribute).value() : found.node().text().get());
    return texts;
}

/// The figures of a report by their place in the summary.
std::map<std::string, json> figures(const pugi::xml_document& root) {
    std::map<std::string, json> result;
    const auto ids = all(root, "data", "id"), values = all(root, "data", "value");
    for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = json::parse(values[i]);
    CHECK(result.size() == ids.size());  // each place once
    return result;
}

json at_path(const json& summary, std::string path) {
    std::ranges::replace(path, '.', '/');
    return summary.at(json::json_pointer("/" + path));
}

struct Finished {
    run::Scene<2> scene;
    run::RunResult<2> result;
};

Finished finished(run::RunOptions options = {}, run::Scene<2> scene = test::block_on_plane(0.01)) {
    auto result = run::simulate<2>(scene, options);
    return {std::move(scene), std::move(result)};
}

std::string report_of(const Finished& run, const std::string& program = "mine") {
    return run::report_html(program, run.scene, run.result, {{"summary.json", "all figures"}});
}

}  // namespace

TEST_CASE("a report holds the figures of its summary, each at its place", "[run][report]") {
    Finished run = finished();
    run.result.watch.findings = {{"bounce", "how it bounces [-]", 0.7531}, {"unknown", "not known [m]", {}}};
    const json summary = json::parse(run::summary_json("mine", run.scene, run.result));
    const auto root = parsed(report_of(run));
    const auto held = figures(root);
    for (const auto& [path, value] : held) {
        CAPTURE(path);
        CHECK(value == at_path(summary, path));
    }
    for (const char* path : {"pseudo_energy_drift",
                             "energy_drift",
                             "energy_excess_max",
                             "parasitic_max",
                             "events",
                             "missed_contacts",
                             "steps",
                             "dt",
                             "cells",
                             "bodies.0.name",
                             "bodies.0.mass",
                             "bodies.0.velocity_final",
                             "bodies.0.rotation_final",
                             "compression_max",
                             "seconds.total",
                             "seconds.contact",
                             "options.cfl",
                             "options.skin",
                             "bounce",
                             "unknown"})
        CHECK(held.contains(path));
    CHECK(held.at("pseudo_energy_drift") == run.result.ledger.pseudo_energy_drift());
    const auto texts = all(root, "data");
    CHECK(std::ranges::count(texts, "0.7531") == 1);
}

TEST_CASE("a report is a page by itself: no script, nothing from elsewhere", "[run][report]") {
    const std::string text = report_of(finished());
    for (const char* never : {"<script", "src=", "@import", "url(", "javascript:"}) CHECK_THAT(text, !Contains(never));
    const auto root = parsed(text);
    CHECK(all(root, "a", "href") == std::vector<std::string>{"./summary.json"});
    for (const std::string tag : {"svg", "path", "line", "html"})
        for (const auto& space : all(root, tag, "xmlns"))
            CHECK((space.empty() || space.starts_with("http://www.w3.org/")));  // names, which nobody fetches
}

TEST_CASE("whatever a run is called, its report is well-formed and says it", "[run][report]") {
    const std::string name = "<b>&\"'</title> \xC3\xA9";
    Finished run = finished();
    run.scene.mesh.body_names[0] = name;
    const auto root = parsed(run::report_html(name, run.scene, run.result, {{"a b#%.csv", name}}));
    CHECK(all(root, "h1") == std::vector<std::string>{name});
    CHECK(figures(root).at("bodies.0.name") == name);
    const auto texts = all(root, "data");
    CHECK(std::ranges::count(texts, name) == 1);
    CHECK(all(root, "a", "href") == std::vector<std::string>{"./a%20b%23%25.csv"});
    CHECK(run::Markup("\x01\x1F\t").html() == "\xEF\xBF\xBD\xEF\xBF\xBD\t");  // what XML has no place for
}

TEST_CASE("title and comment of a scene head its report and are in the summary, and nothing is there without them",
          "[run][report]") {
    Finished run = finished();
    const json plain = json::parse(run::summary_json("mine", run.scene, run.result));
    CHECK((!plain.contains("title") && !plain.contains("comment")));
    run.scene.title = "A block <of rubber> & a plane";
    run.scene.comment = "It falls.\nIt bounces.";
    const json summary = json::parse(run::summary_json("mine", run.scene, run.result));
    CHECK(summary.at("title") == run.scene.title);
    CHECK(summary.at("comment") == run.scene.comment);
    const auto root = parsed(report_of(run));
    CHECK(all(root, "h1/data") == std::vector{run.scene.title});
    CHECK(all(root, "head/title") == std::vector{run.scene.title + ": report of a run"});
    CHECK(all(root, "p[@class='comment']/data") == std::vector{run.scene.comment});
}

TEST_CASE("a report says whether the run came to its end, and all that warns", "[run][report]") {
    Finished run = finished({.cfl = 0.2});  // with 0.9 the H - H~ of so few cells warns
    CHECK_THAT(report_of(run), Contains("came to its end") && Contains("class=\"good\"") && !Contains("<h2>Warnings"));
    run.result.run.complete = false;
    CHECK_THAT(report_of(run), Contains("asked to stop at t = ") && Contains("class=\"attention\""));
    run.result.run.complete = true;
    run.result.contact.report.missed_contacts = 3;
    run.result.contact.report.sliding_ratio_max = 7.0;
    const auto root = parsed(report_of(run));
    const auto items = all(root, "li");
    const auto warnings = run::warnings_after(run.result);
    REQUIRE(warnings.size() >= 2);
    for (const auto& warning : warnings) CHECK(std::ranges::count(items, warning.text) == 1);
    CHECK_THAT(report_of(run), Contains("3 contacts were missed") && Contains("2 warnings."));
}

TEST_CASE("settings that are not as by default come with their default", "[run][report]") {
    const auto row_of = [](const std::string& text, const std::string& setting) {
        const auto begin = text.find("<tr><td>" + setting + "</td>");
        REQUIRE(begin != std::string::npos);
        return text.substr(begin, text.find("</tr>", begin) - begin);
    };
    const std::string plain = report_of(finished()), changed = report_of(finished({.cfl = 0.5}));
    const auto details = [](const std::string& text) { return text.find("<details>"); };
    CHECK(plain.find("<td>cfl</td>") > details(plain));
    CHECK(changed.find("<td>cfl</td>") < details(changed));
    CHECK_THAT(row_of(changed, "cfl"), Contains(">0.5</data>") && Contains("<td>0.9</td>"));
}

TEST_CASE("a run leaves its report beside the summary, and the next one removes it first", "[run][report]") {
    const test::Folder folder;
    const run::RunOptions options{.out = folder.path() / "out", .frames = 2};
    const run::Scene<2> scene = test::block_on_plane(0.01);
    run::ResultFiles<2> files(options, "mine", "block");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const auto root = parsed(test::read_text(options.out / "report.html"));
    for (const std::string& file : all(root, "a")) CHECK(std::filesystem::exists(options.out / file));
    CHECK(all(root, "a").size() >= 4);
    const auto summary = json::parse(test::read_text(options.out / "summary.json"));
    for (const auto& [path, value] : figures(root)) CHECK(value == at_path(summary, path));
    const run::ResultFiles<2> next(options, "mine", "block");
    CHECK_FALSE(std::filesystem::exists(options.out / "report.html"));
}

TEST_CASE("ticks are 1, 2 or 5 times a power of ten apart and within the axis", "[run][report]") {
    const auto [least, greatest] =
        GENERATE(table<double, double>({{0.0, 1.0}, {-3e-7, 1e-7}, {1e6, 1.5e6}, {0.0, 7.3}, {2.0, 2.0}, {0.0, 0.0}}));
    CAPTURE(least, greatest);
    const run::Axis axis = run::linear_axis(least, greatest, 8);
    CHECK(axis.lower <= least);
    CHECK(axis.upper >= greatest);
    REQUIRE(axis.ticks.size() >= 2);
    CHECK(axis.ticks.size() <= 8);
    const double step = axis.ticks[1].at - axis.ticks[0].at;
    const double factor = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    CHECK(std::min({std::abs(factor - 1.0), std::abs(factor - 2.0), std::abs(factor - 5.0)}) < 1e-6);
    for (const run::Tick& tick : axis.ticks) {
        CHECK(axis.share(tick.at) >= 0.0);
        CHECK(axis.share(tick.at) <= 1.0);
        CHECK(std::stod(tick.label) == Approx(tick.at).epsilon(1e-5).margin(1e-5 * step));
    }
}

TEST_CASE("a logarithmic axis ends at whole decades, and zero is at its lower end", "[run][report]") {
    const run::Axis axis = run::logarithmic_axis(3e-16, 2e-4, 1e-18, 7);
    CHECK(axis.lower == Approx(1e-16));
    CHECK(axis.upper == Approx(1e-3));
    CHECK(axis.ticks.size() <= 8);
    CHECK(axis.share(std::sqrt(1e-16 * 1e-3)) == Approx(0.5));
    CHECK(axis.share(0.0) == 0.0);
    CHECK(axis.share(-1.0) == 0.0);
    CHECK(run::logarithmic_axis(0.0, 0.0, 1e-18, 7).lower == Approx(1e-18));
}

TEST_CASE("a curve of a million points is drawn by few, its greatest and least values among them", "[run][report]") {
    std::vector<double> x(1000000), y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i), y[i] = std::sin(1e-3 * x[i]);
    y[123456] = 7.0;
    y[654321] = -7.0;
    const auto kept = run::thinned(x, y, 500);
    CHECK(kept.size() <= 2000);
    CHECK(std::ranges::is_sorted(kept));
    for (const std::size_t i : {0, 123456, 654321, 999999}) CHECK(std::ranges::count(kept, i) == 1);
}

TEST_CASE("places on a drawing are proportional to values, and a gap interrupts a curve", "[run][report]") {
    const run::Plot plot{.title = "t",
                         .x_label = "x",
                         .y_label = "y",
                         .x = {0.0, 1.0, 2.0, 3.0},
                         .curves = {{"c", "ink", {0.0, 1.0, std::nan(""), 3.0}}}};
    const auto root = parsed("<!DOCTYPE html>" + run::drawing(plot).html());
    std::string path = all(root, "path", "d").at(0);
    CHECK(std::ranges::count(path, 'M') == 2);
    for (char& c : path) c = c == 'M' || c == 'L' || c == ',' ? ' ' : c;
    std::istringstream numbers(path);
    std::vector<double> places;
    for (double value = 0.0; numbers >> value;) places.push_back(value);
    REQUIRE(places.size() == 6);
    CHECK(places[4] - places[0] == Approx(3.0 * (places[2] - places[0])).margin(0.2));
    CHECK(places[5] - places[1] == Approx(3.0 * (places[3] - places[1])).margin(0.2));
    CHECK(places[5] < places[1]);  // upwards
}

TEST_CASE("a picture is a file of its own: well-formed, with its style, and its plots below each other", "[run][report]") {
    const run::Plot plot{
        .title = "t", .x_label = "x < 1", .y_label = "y", .x = {0.0, 1.0}, .curves = {{"c", "ink", {0.0, 1.0}}}};
    const auto root = parsed("<!DOCTYPE html>" + run::drawing_file("a & b", std::array{plot, plot}));
    CHECK(all(root, "path", "d").size() == 2);
    CHECK(all(root, "style").size() == 1);
    const auto shifts = all(root, "g", "transform");
    REQUIRE(shifts.size() == 2);
    CHECK(shifts[0] != shifts[1]);
}

TEST_CASE("a map of cells is as long along both axes, and shows the highest value of points in one place", "[run][report]") {
    run::CellMap map{.title = "a & b",
                     .subtitle = "c",
                     .x_label = "x [m]",
                     .y_label = "y [m]",
                     .value_label = "v",
                     .position = {{0.0, 0.0}, {4.0, 0.0}, {0.0, 1.0}, {4.0, 0.0}},
                     .value = {1.0, 1.0, 1.0, 100.0},
                     .lower = 1.0,
                     .upper = 100.0,
                     .rings = {{0.0, 0.0}, {4.0, 0.0}, {0.0, 1.0}}};
    const auto root = parsed("<!DOCTYPE html>" + run::drawing_file(map));
    const auto x = all(root, "circle", "cx"), y = all(root, "circle", "cy");
    REQUIRE(x.size() == 3);
    CHECK(std::stod(x[1]) - std::stod(x[0]) == Approx(4.0 * (std::stod(y[0]) - std::stod(y[2]))).margin(0.3));
    CHECK(std::stod(y[0]) == std::stod(y[1]));
    const auto dots = all(root, "path", "d");
    REQUIRE(dots.size() == 2);  // two colours, and not the low point below the high one
    CHECK(std::ranges::count(dots[0], 'M') == 2);
    CHECK(std::ranges::count(dots[1], 'M') == 1);
}

namespace {

/// Points of the curve of a style in a figure, in units of the drawing.
std::vector<std::pair<double, double>> points_of(const std::string& html, const std::string& style) {
    pugi::xml_document root;
    REQUIRE(root.load_string(("<figures>" + html + "</figures>").c_str()));
    const auto curve = root.select_node(("//path[@class='curve " + style + "']").c_str()).node();
    REQUIRE(curve);
    std::vector<std::pair<double, double>> points;
    std::string text = curve.attribute("d").value();
    std::ranges::replace_if(
        text, [](char c) { return c == ',' || c == 'M' || c == 'L'; }, ' ');
    std::istringstream numbers(text);
    for (double x, y; numbers >> x >> y;) points.emplace_back(x, y);
    REQUIRE(points.size() > 2);
    return points;
}

}  // namespace

TEST_CASE("forces of a table are drawn to scale, and are 0 where there is no row", "[run][report]") {
    const test::Folder folder;
    std::filesystem::create_directories(folder.path());
    const auto path = folder.path() / "forces.csv";
    std::string table = "step,time,body_1,body_2,force_on_2_x,force_on_2_y,normal_force\n";
    for (int step = 1; step <= 60; ++step)
        table += std::to_string(step) + "," + std::to_string(0.1 * step) + ",a,b,0,-1," + (step <= 30 ? "3" : "1.5") + "\n";
    test::write_text(path, table);
    const std::string html = run::force_pictures(path, {.steps = 90, .interval = 1, .dt = 0.1}).html();
    const auto points = points_of(html, "ink");
    const double left = points.front().first, right = points.back().first;
    double high = 0.0, middle = 0.0, low = 0.0;
    for (const auto& [x, y] : points) {
        const double share = (x - left) / (right - left);
        (share < 0.32 ? high : share > 0.35 && share < 0.65 ? middle : low) = y;
    }
    CHECK(middle - high == Approx(low - middle).epsilon(0.01));
    CHECK(low - high > 50.0);
    CHECK_THAT(html, Contains("'a'") && Contains("'b'"));
}

TEST_CASE("of very many forces the means are drawn", "[run][report]") {
    const test::Folder folder;
    std::filesystem::create_directories(folder.path());
    const auto path = folder.path() / "forces.csv";
    std::string table = "step,time,body_1,body_2,force_on_2_x,force_on_2_y,normal_force\n";
    for (int step = 1; step <= 20000; step += 2)  // every other row is not there: 0
        table += std::to_string(step) + "," + std::to_string(step) + ",a,b,0,-1,2\n";
    test::write_text(path, table);
    const auto points = points_of(run::force_pictures(path, {.steps = 20000, .interval = 1, .dt = 1.0}).html(), "ink");
    for (const auto& [x, y] : points) CHECK(y == Approx(points.front().second).margin(0.11));
}

TEST_CASE("a report draws the forces and probes that a scene asks for, and says of what the bodies are", "[run][report]") {
    const test::Folder folder;
    const run::RunOptions options{.out = folder.path() / "out", .frames = 0};
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.outputs.forces = true;
    scene.outputs.probes = {{.name = "=tip, \"left\"", .body = 0, .position = Vector<2>(0.1, 0.9)},
                            {.name = "whole", .body = 0}};
    run::ResultFiles<2> files(options, "mine", "block");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const auto root = parsed(test::read_text(options.out / "report.html"));
    std::vector<std::string> captions = all(root, "figcaption");
    const auto has = [&](const std::string& text) {
        return std::ranges::any_of(captions,
                                   [&](const std::string& caption) { return caption.find(text) != std::string::npos; });
    };
    CHECK(has("Force of 'block' on 'obstacle_0'"));
    for (const std::string probe : {"=tip, \"left\"", "whole"}) {
        CHECK(has("Displacement at '" + probe + "'"));
        CHECK(has("von Mises stress at '" + probe + "'"));
    }
    const auto cells = all(root, "td");
    const auto body = std::ranges::find(cells, "block");
    REQUIRE(body != cells.end());
    CHECK(std::vector<std::string>(body, body + 5) ==
          std::vector<std::string>{"block", "1", "0", "1", "1"});  // c = sqrt(E/rho)
}

TEST_CASE("a report names what is bonded, up to which stress, and what broke has taken", "[run][report]") {
    const std::array<mesh::Mesh<2>, 2> blocks = {
        mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, mesh::CellShape::quadrangle, "left"),
        mesh::structured_box<2>({1.0, 0.0}, {2.0, 1.0}, {3, 3}, mesh::CellShape::quadrangle, "right")};
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(blocks);
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    scene.velocity = {Vector<2>(-0.1, 0.0), Vector<2>(0.1, 0.0)};
    scene.time = 1.0;
    const auto report_with = [&](double strength) {
        scene.solid.bonds = {{.sides = {0, 1}, .strength = strength}};
        return parsed(report_of(finished({}, scene)));
    };
    const auto cell_behind_names = [](const pugi::xml_document& root) {
        const auto cells = all(root, "td");
        const auto names = std::ranges::find(cells, "'left', 'right'");
        REQUIRE(names != cells.end());
        return *(names + 1);
    };
    const auto broken = report_with(0.01), whole = report_with(std::numeric_limits<double>::infinity());
    CHECK(cell_behind_names(broken) == "0.01 Pa");
    CHECK(figures(broken).at("bonds.dissipated") > 0.0);
    CHECK(cell_behind_names(whole) == "for ever");
    CHECK_FALSE(figures(whole).contains("bonds.dissipated"));
    CHECK(std::ranges::count(all(parsed(report_of(finished())), "h2"), "Bonds") == 0);
}
