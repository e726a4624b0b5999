// forces <scene> <file>: as forces.c, from C++. Fails if the scene has no steps with contact, none without, or a missed one,
// and with friction if nothing sticks or slides.
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/nodal_contact.hpp"

using namespace abut;

namespace {

template <class T>
std::vector<T> read_array(std::istream& file, std::size_t n) {
    std::vector<T> values(n);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(n * sizeof(T)));
    return values;
}

void write_array(std::ostream& file, const std::vector<double>& values) {
    file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(double)));
}

int run(const char* scene, const char* result) {
    std::ifstream in(scene, std::ios::binary);
    std::ofstream out(result, std::ios::binary);
    in.exceptions(std::ios::failbit), out.exceptions(std::ios::failbit);
    const auto head = read_array<std::int32_t>(in, 3);
    const auto n_nodes = static_cast<std::size_t>(head[0]), n_faces = static_cast<std::size_t>(head[1]);
    const auto corners = read_array<std::int32_t>(in, 4 * n_faces), body = read_array<std::int32_t>(in, n_faces);
    const auto depth = read_array<double>(in, n_faces), stiffness = read_array<double>(in, 2);
    const auto shear_stiffness = read_array<double>(in, 2);
    const double friction = read_array<double>(in, 1).front();
    std::vector<std::int32_t> offsets;
    for (std::int32_t i = 0; i <= head[1]; ++i) offsets.push_back(4 * i);

    const auto points = [](const std::vector<double>& x) { return PointsView<3>(std::span(x)); };
    auto x_0 = read_array<double>(in, 3 * n_nodes);
    contact::NodalFaces<3> faces{corners, offsets, body, depth, stiffness};
    faces.shear_stiffness = shear_stiffness;
    contact::NodalOptions options;
    if (friction > 0.0) options.friction.laws = {{.coefficient = friction}};
    contact::NodalContact<3> contact({points(x_0), faces}, options);
    int with = 0, without = 0;
    for (std::int32_t i = 0; i < head[2]; ++i) {
        auto x_1 = read_array<double>(in, 3 * n_nodes);
        const auto& step =
            contact.step(0.01, points(x_0), points(x_1), i % 2 == 0 ? contact::TakenForce::mean : contact::TakenForce::end);
        std::vector<double> figures(3 * n_nodes, 0.0);
        step.add_force_to(std::span(figures));
        figures.insert(figures.end(),
                       {step.energy_0, step.energy, static_cast<double>(step.pairs.size()), step.report.friction.energy,
                        step.report.friction.dissipated, static_cast<double>(step.friction.size())});
        for (const auto& p : step.pairs) {
            figures.insert(figures.end(), {static_cast<double>(p.face_1), static_cast<double>(p.face_2), p.normal[0],
                                           p.normal[1], p.normal[2], p.gap_0, p.gap_1, p.area, p.normal_force, p.force[0],
                                           p.force[1], p.force[2], p.active_share, p.compression});
            for (const Vector<3>& vector : {p.friction, p.slip, p.point})
                figures.insert(figures.end(), {vector[0], vector[1], vector[2]});
        }
        for (const auto& f : step.friction)
            figures.insert(figures.end(),
                           {static_cast<double>(f.face), f.normal_force, f.force, f.limit, f.slip, f.dissipated});
        write_array(out, figures);
        ++(step.is_active() ? with : without);
        x_0 = std::move(x_1);
    }
    const auto& report = contact.report();
    std::cout << with << " steps with contact, " << without << " without, up to " << report.active_pairs_max << " pairs, "
              << report.rebuilds << " searches, " << report.missed_contacts << " missed\n";
    const bool rubs = report.sticking_faces_max > 0 && report.sliding_faces_max > 0 && report.friction_dissipated > 0.0;
    return with >= 50 && without >= 50 && report.rebuilds >= 3 && report.missed_contacts == 0 && rubs == (friction > 0.0)
               ? 0
               : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    try {
        return run(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
