// A mesh file of Gmsh becomes a body, is looked at from its named sides, and is thrown: x'' = g, whatever it is made of.
//
// The program writes the file first: 6 x 4 quadrangles, 3 m x 2 m, one physical surface "plate", one physical curve "foot".
// rho = 2 kg/m^3, so the mass is 12 kg/m. Thrown with v = (1, 2) m/s under g = (0, -10) m/s^2 its centre is at
// v t + g t^2 / 2 from where it began: the scheme is exact for a parabola, and nothing vibrates.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "abut/mesh/io/read_mesh.hpp"
#include "abut/run/steps/simulation.hpp"

using namespace abut;

namespace {

constexpr int nx = 6, ny = 4;
constexpr double width = 3.0, height = 2.0;  // [m]

/// Format 2.2, as text: points, then lines (type 1) and quadrangles (type 3) with their physical group.
void write_plate(const std::filesystem::path& path) {
    std::ofstream file(path);
    const auto point = [](int i, int j) { return 1 + i + (nx + 1) * j; };
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"foot\"\n2 8 \"plate\"\n$EndPhysicalNames\n";
    file << "$Nodes\n" << (nx + 1) * (ny + 1) << "\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) file << point(i, j) << " " << width * i / nx << " " << height * j / ny << " 0\n";
    file << "$EndNodes\n$Elements\n" << nx + nx * ny << "\n";
    for (int i = 0; i < nx; ++i) file << 1 + i << " 1 2 7 1 " << point(i, 0) << " " << point(i + 1, 0) << "\n";
    for (int c = 0; c < nx * ny; ++c) {
        const int i = c % nx, j = c / nx;
        file << 1 + nx + c << " 3 2 8 1 " << point(i, j) << " " << point(i + 1, j) << " " << point(i + 1, j + 1) << " "
             << point(i, j + 1) << "\n";
    }
    file << "$EndElements\n";
}

/// Keeps the displacement of the centre of mass.
class Centre : public run::Observer<2> {
public:
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        mass = 0.0;
        displacement.setZero();
        for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
            mass += solid.masses()[c];
            displacement += solid.masses()[c] * as_vectors<2>(view.q)[c];
        }
        displacement /= mass;
        time = view.time;
    }
    double mass = 0.0, time = 0.0;               // [kg/m], [s]
    Vector<2> displacement = Vector<2>::Zero();  // [m]
};

}  // namespace

int main() {
    const auto path = std::filesystem::temp_directory_path() / "abut_plate.msh";
    write_plate(path);
    const Vector<2> velocity(1.0, 2.0), gravity(0.0, -10.0);
    run::Scene<2> scene;
    scene.mesh = mesh::read_mesh<2>(path);
    std::filesystem::remove(path);
    scene.solid.materials = {{.young = 1000.0, .poisson = 0.3, .density = 2.0}};
    scene.solid.acceleration = {gravity};
    scene.velocity = {velocity};
    scene.time = 0.5;
    Centre centre;
    const run::RunResult<2> result = run::simulate<2>(scene, {}, centre);

    const double foot = scene.mesh.face_measure[scene.mesh.group("foot").faces.front()] * nx;
    const Vector<2> exact = centre.time * velocity + 0.5 * centre.time * centre.time * gravity;
    std::printf("%d cells of '%s', %d steps of %.3g s\n", scene.mesh.n_cells(), scene.mesh.body_names.front().c_str(),
                static_cast<int>(result.run.steps), result.run.dt);
    std::printf("length of 'foot' %.6f m          %.6f\n", foot, width);
    std::printf("mass             %.6f kg/m      %.6f\n", centre.mass, 2.0 * width * height);
    std::printf("centre moved by  (%.9f, %.9f) m   (%.9f, %.9f)\n", centre.displacement.x(), centre.displacement.y(),
                exact.x(), exact.y());
    const bool good = std::abs(foot - width) < 1e-12 && std::abs(centre.mass - 2.0 * width * height) < 1e-12;
    return good && (centre.displacement - exact).norm() < 1e-10 ? 0 : 1;
}
