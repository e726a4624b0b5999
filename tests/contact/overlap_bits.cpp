// Overlaps of 100,000 pairs of all kinds, to the last bit: `overlap_bits write FILE` keeps them, `overlap_bits compare FILE`
// ends with 1 and says where they differ from those in FILE. Built twice, for two kinds of processors.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "abut/contact/overlap/overlaps.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using geometry::AreaMethod;
using geometry::IndexPair;

namespace {

using Lines = std::vector<std::string>;

std::string exact_text(double value) {
    char text[40];
    std::snprintf(text, sizeof text, " %a", value);
    return text;
}

template <int Dim>
std::string exact_text(const Vector<Dim>& vector) {
    std::string text;
    for (const double value : vector) text += exact_text(value);
    return text;
}

/// What is cut, then what comes of it.
template <int Dim>
void append(const std::string& name, const contact::Surface<Dim>& surface, const std::vector<Vector<Dim>>& u,
            std::span<const IndexPair> pairs, AreaMethod method, Lines& lines) {
    for (std::int32_t f = 0; f < surface.size(); ++f) {
        std::string line = name + ", face " + std::to_string(f) + ":" + exact_text(u[f]) + exact_text(surface.normal[f]);
        for (const std::int32_t v : surface.view().vertices_of(f)) line += exact_text(surface.vertices[v]);
        lines.push_back(line);
    }
    std::size_t n_polygons = 0;
    for (const auto& overlap : contact::find_overlaps<Dim>(surface.view(), u, pairs, method).found) {
        const std::string pair = std::to_string(overlap.face_1) + " " + std::to_string(overlap.face_2);
        lines.push_back(name + ", overlap of " + pair + ": area" + exact_text(overlap.area) + ", normal" +
                        exact_text(overlap.normal) + ", gap" + exact_text(overlap.gap) + ", gradient" +
                        exact_text(overlap.area_gradient));
        if (++n_polygons > 500) continue;
        std::string line = name + ", polygon of " + pair + ":";
        for (const auto& p : contact::overlap_polygon<Dim>(surface.view(), u, {overlap.face_1, overlap.face_2}))
            line += exact_text(p);
        lines.push_back(line);
    }
}

contact::Surface<3> random_triangles(std::mt19937& random, int faces_per_body) {
    contact::Surface<3> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < faces_per_body; ++i) {
            const Vector<3> centre(uniform(random, -1, 1), uniform(random, -1, 1), 0.0);
            std::array<Vector<3>, 3> corners;
            for (int k = 0; k < 3; ++k) {
                const double angle = (body == 0 ? 1 : -1) * (2.0 * k + uniform(random, 0, 1));
                corners[k] = centre + Vector<3>(std::cos(angle), std::sin(angle), uniform(random, -0.1, 0.1));
            }
            surface.append(corners, 0.3, i % 7 == 3 ? rigid : 1.0, body);
        }
    return surface;
}

/// Two inclined sheets that match except for rounding, one above the other.
contact::Surface<3> matching_sheets() {
    const auto height = [](double x, double y) { return 0.3 * x + 0.17 * y; };
    contact::Surface<3> surface = sheet(9, 0, true, height);
    const auto above = sheet(9, 1, false, [&](double x, double y) { return height(x, y) + 0.013; });
    for (std::int32_t f = 0; f < above.size(); ++f) {
        std::vector<Vector<3>> corners;
        for (const std::int32_t v : above.view().vertices_of(f)) corners.push_back(above.vertices[v]);
        surface.append(corners, above.cell_depth[f], above.stiffness[f], 1);
    }
    return surface;
}

template <int Dim>
void append_polygons(std::mt19937& random, Lines& lines) {
    const auto surface = random_surface<Dim>(random, 40);
    const auto u = random_displacement(random, surface, 0.3);
    append<Dim>(std::to_string(Dim) + "D", surface, u, all_pairs(surface), AreaMethod::fast, lines);
}

Lines all_lines() {
    Lines lines;
    std::mt19937 random(1);
    const auto triangles = random_triangles(random, 300);
    const auto u = random_displacement(random, triangles, 0.3);
    const auto pairs = all_pairs(triangles);
    append<3>("triangles", triangles, u, pairs, AreaMethod::fast, lines);
    append<3>("triangles, exact", triangles, u, std::span(pairs).first(1000), AreaMethod::exact, lines);
    const auto sheets = matching_sheets();
    append<3>("sheets", sheets, at_rest(sheets), all_pairs(sheets), AreaMethod::fast, lines);
    append_polygons<2>(random, lines);
    append_polygons<3>(random, lines);
    return lines;
}

int compare(const Lines& lines, std::istream& expected) {
    std::string line;
    std::size_t n = 0, different = 0;
    for (; std::getline(expected, line); ++n) {
        if (n < lines.size() && lines[n] == line) continue;
        if (++different <= 10) std::cout << line << "\n" << (n < lines.size() ? lines[n] : "nothing") << "\n\n";
    }
    std::cout << different << " of " << n << " lines differ; " << lines.size() << " were expected to be there\n";
    return different == 0 && n == lines.size() && n > 10'000 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string task = argc == 3 ? argv[1] : "";
    if (task == "compare") {
        std::ifstream file(argv[2]);
        return compare(all_lines(), file);
    }
    if (task != "write") {
        std::cerr << "usage: overlap_bits write|compare FILE\n";
        return 2;
    }
    std::ofstream file(argv[2]);
    for (const std::string& line : all_lines()) file << line << "\n";
    return file.flush() ? 0 : 1;
}
