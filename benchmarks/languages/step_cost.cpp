// step_cost <scene> <calls>: as step_cost.c, from C++.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
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

void run(const char* file, long calls) {
    std::ifstream scene(file, std::ios::binary);
    scene.exceptions(std::ios::failbit);
    const auto head = read_array<std::int32_t>(scene, 2);
    const auto n_nodes = static_cast<std::size_t>(head[0]), n_faces = static_cast<std::size_t>(head[1]);
    const auto corners = read_array<std::int32_t>(scene, 3 * n_faces), body = read_array<std::int32_t>(scene, n_faces);
    const auto depth = read_array<double>(scene, n_faces), stiffness = read_array<double>(scene, 2);
    std::vector<double> x[3], force(3 * n_nodes, 0.0);
    for (auto& state : x) state = read_array<double>(scene, 3 * n_nodes);
    const auto points = [&](int i) { return PointsView<3>(std::span(std::as_const(x[i]))); };

    contact::NodalContact<3> contact({points(0), {corners, {}, body, depth, stiffness}});
    contact.step(1.0, points(0), points(1));
    const std::clock_t start = std::clock();
    for (long i = 0; i < calls; ++i) contact.step(1.0, points(1), points(2)).add_force_to(std::span(force));
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%.4f %zu %.16e\n", 1e6 * seconds / static_cast<double>(calls), contact.last().pairs.size(),
                contact.last().energy);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    try {
        run(argv[1], std::atol(argv[2]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
