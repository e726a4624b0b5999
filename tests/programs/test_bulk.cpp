#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "programs/program.hpp"
#include "studies/scenes/half_plane.hpp"
#include "studies/scenes/manufactured.hpp"
#include "studies/scenes/plane_wave.hpp"

namespace {

using namespace abut;
using namespace abut::studies;
using namespace abut::test::programs;

/// The first quantity whose name begins so, on a level whose name begins so.
nlohmann::json quantity(const nlohmann::json& summary, const std::string& level, const std::string& name) {
    for (const auto& one : summary["levels"])
        for (const auto& quantity : one["quantities"])
            if (one["name"].get<std::string>().starts_with(level) && quantity["name"].get<std::string>().starts_with(name))
                return quantity;
    throw std::runtime_error("no quantity " + name + " on a level " + level);
}

double error(const nlohmann::json& summary, const std::string& level, const std::string& name) {
    return quantity(summary, level, name)["error"].get<double>();
}

void check_orders(const nlohmann::json& summary) {
    CHECK(!summary["orders_least"].empty());
    for (const auto& [name, least] : summary["orders_least"].items()) {
        INFO(name);
        CHECK(summary["orders"][name].get<double>() >= least.get<double>());
    }
}

/// -div sigma of the exact displacement by central differences of its gradient's stress.
template <int Dim>
Vector<Dim> load_by_differences(const Manufactured<Dim>& exact, const Vector<Dim>& x, double h) {
    const auto stress = [&](const Vector<Dim>& y) {
        Matrix<Dim> gradient;  // by differences, too: the displacement alone is trusted
        for (int j = 0; j < Dim; ++j)
            gradient.col(j) =
                (exact.displacement(y + h * Vector<Dim>::Unit(j)) - exact.displacement(y - h * Vector<Dim>::Unit(j))) /
                (2.0 * h);
        const Matrix<Dim> strain = 0.5 * (gradient + gradient.transpose());
        return Matrix<Dim>(exact.material.lambda() * strain.trace() * Matrix<Dim>::Identity() +
                           2.0 * exact.material.mu() * strain);
    };
    Vector<Dim> load = Vector<Dim>::Zero();
    for (int j = 0; j < Dim; ++j)
        load -= (stress(x + h * Vector<Dim>::Unit(j)).col(j) - stress(x - h * Vector<Dim>::Unit(j)).col(j)) / (2.0 * h);
    return load;
}

template <int Dim>
void check_load() {
    const auto exact = manufactured<Dim>();
    for (const double s : {-0.7, -0.1, 0.4, 0.9}) {
        Vector<Dim> x;
        for (int i = 0; i < Dim; ++i) x[i] = s * (1.0 - 0.4 * i);
        const Vector<Dim> load = exact.body_load(x);
        CHECK((load_by_differences<Dim>(exact, x, 1e-3) - load).norm() < 1e-5 * exact.material.young);
        const double h = 1e-6;
        for (int j = 0; j < Dim; ++j) {
            const Vector<Dim> slope =
                (exact.displacement(x + h * Vector<Dim>::Unit(j)) - exact.displacement(x - h * Vector<Dim>::Unit(j))) /
                (2.0 * h);
            CHECK((exact.gradient(x).col(j) - slope).norm() < 1e-8);
        }
    }
}

}  // namespace

TEST_CASE("the body load of a manufactured solution is the opposite of the divergence of its stress", "[programs][bulk]") {
    check_load<2>();
    check_load<3>();
    const auto exact = manufactured<2>();
    const double by_hand = -0.8 * (exact.material.lambda() + 3.0 * exact.material.mu());  // -a (lambda + 3 mu)
    CHECK(exact.body_load({0.3, -0.2}).x() == Approx(by_hand).epsilon(1e-14));
    CHECK(exact.body_load({0.3, -0.2}).y() == Approx(by_hand).epsilon(1e-14));
}

TEST_CASE("statics converge with order 1.8 in L2 and 0.95 in energy on quadrangles, triangles and unstructured triangles",
          "[programs][bulk]") {
    const auto outcome = run_well("study manufactured", "--cells 6 --levels 3", "manufactured_2d");
    const auto summary = read_summary(outcome);
    CHECK(summary["orders_least"].size() == 6);
    check_orders(summary);
    for (const char* file : {"values.csv", "errors.gp", "quadrangles.csv", "triangles.csv", "gmsh.csv"})
        CHECK(std::filesystem::exists(outcome.directory / file));
}

TEST_CASE("statics converge with order 1.8 in L2 and 0.95 in energy on every shape of cell in 3D", "[programs][bulk]") {
    const auto summary =
        read_summary(run_well("study manufactured", "--dim 3 --cells 3 --levels 3 --tolerance 1e-6", "manufactured_3d"));
    CHECK(summary["orders_least"].size() == 10);
    check_orders(summary);
}

TEST_CASE("affine displacements are reproduced to 1e-12 and only rigid motions cost no energy, on every shape of cell",
          "[programs][bulk]") {
    const auto outcome = run_well("study bulk_patch", "--cells 4", "bulk_patch");
    const auto summary = read_summary(outcome);
    CHECK(summary["levels"].size() == 8);
    CHECK(check_targets(outcome) ==
          8 * (2 * 2 + 2 + 1));               // displacement, stress, imposed and mixed; modes, their size; single
    for (const char* level : {"2D", "3D"}) {  // why adjacent is there for comparison only
        CHECK(error(summary, level, "stress, adjacent") > 0.1);
        CHECK(quantity(summary, level, "zero modes, adjacent")["value"] == (level[0] == '2' ? 2.0 : 3.0));
    }
}

TEST_CASE("the operator has the exact spectrum of a uniform mesh, in 2D and 3D, whatever nu and eta", "[programs][bulk]") {
    const std::string options = GENERATE("", "--poisson 0.25 --eta 300", "--poisson -0.2 --eta 2000");
    const auto outcome = run_well("study spectrum", options, "spectrum");
    CHECK(check_targets(outcome) == 2 * (2 * 2 + 2));  // 2D and 3D: two errors of P and S each; the stable step's two
    if (!options.empty()) return;
    const auto table = read_table(outcome, "spectrum_P_2d.csv");  // nu = 0, eta = E
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const double theta = table.column("theta")[i];
        const double square = std::pow(std::sin(theta), 2) + 4.0 * std::pow(std::sin(0.5 * theta), 6);
        CHECK(table.column("computed")[i] == Approx(std::sqrt(square)).epsilon(1e-12));
    }
    CHECK(table.column("computed").back() == Approx(2.0).epsilon(1e-12));  // so dt < h/c along an axis
}

TEST_CASE("the Rayleigh wave at nu = 1/4 has sqrt(2 - 2/sqrt 3) times the speed of shear", "[programs][bulk]") {
    const double shear = std::sqrt(rock().mu() / rock().density);
    CHECK(rayleigh_speed(rock()) == Approx(shear * std::sqrt(2.0 - 2.0 / std::sqrt(3.0))).epsilon(1e-14));
    CHECK(std::abs(rayleigh_speed(rock()) - 1699.8) < 0.05);
    CHECK(std::abs(wave_speed(PlaneWave::compression, rock()) - 3202.3) < 0.05);
    CHECK(std::abs(wave_speed(PlaneWave::shear, rock()) - 1848.8) < 0.05);
}

TEST_CASE("a wavelet that comes later is found to be that much later, by correlation and by phase", "[programs][bulk]") {
    const double dt = 1e-3, delay = 0.12345;
    Trace a{.dt = dt, .values = {}}, b = a;
    for (int n = 0; n < 600; ++n) {
        a.values.push_back(ricker(dt * n - 0.2, 10.0));
        b.values.push_back(ricker(dt * n - 0.2 - delay, 10.0));
    }
    CHECK(std::abs(phase_delay(a, b, 12.0, 0.13) - delay) < 1e-12);
    CHECK(std::abs(correlation_delay(a, b) - delay) < 1e-2 * dt);  // a parabola through three samples of a smooth curve
}

TEST_CASE("plane waves run as fast as the medium's within 1 % at 20 triangles, and as the scheme's at 20 squares",
          "[programs][bulk]") {
    const auto summary = read_summary(run_well("study wave_speeds", "--case plane_2d --cells 20 --levels 1", "plane_waves"));
    for (const std::string wave : {"plane P 2D ", "plane S 2D "}) {
        for (const char* cells : {"triangles", "gmsh"})
            for (const char* speed : {", phase", ", wavelet"}) CHECK(error(summary, wave, wave + cells + speed) <= 0.01);
        CHECK(error(summary, wave, wave + "quadrangles, phase of the scheme") <= 1e-3);
    }
    for (const auto& level : summary["levels"]) CHECK(level["energies"]["pseudo_energy_drift"].get<double>() <= 1e-13);
}

TEST_CASE("P, S and Rayleigh waves of a line force are within 4 % at 10 cells a wavelength: 1 % at 20, order 2",
          "[programs][bulk]") {
    const auto outcome =
        run_well("study wave_speeds", "--case half_plane --mesh triangles --cells 10 --levels 1", "half_plane");
    const auto summary = read_summary(outcome);
    for (const char* wave : {"P", "S", "R"}) CHECK(error(summary, "half plane", std::string("half plane ") + wave) <= 0.04);
    for (const auto& level : summary["levels"]) CHECK(level["energies"]["pseudo_energy_drift"].get<double>() <= 1e-13);
    CHECK(std::filesystem::exists(outcome.directory / "surface.csv"));
}
