// Frequencies of the discrete operator against the exact spectrum of a uniform mesh.
//
// A plane wave along an axis of equal squares (2D) or cubes (3D) is an eigenvector of the scheme: the stiffness gives
// rho h^d omega^2 times the wave, with rho h^2 omega^2 = M sin^2 theta + 4 eta sin^6(theta/2), theta = k h,
// M = lambda + 2 mu (P) or mu (S). Expect 1e-12 of the highest in the interior of a strip held as plane_wave.hpp says.
// For nu = 0, eta = E the highest of these is 2 c/h, c = sqrt(E/rho): dt < h/c in one dimension. Cells that alternate in all
// directions go beyond it, by sqrt(d) on a large mesh: dt < h/(c sqrt d). The stable step of the library, from a Lanczos
// iteration, times 1.02, has to enclose the highest frequency of the strip.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/base/stopwatch.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/dense_stiffness.hpp"
#include "studies/scenes/plane_wave.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::spectrum_study {
namespace {

using std::numbers::pi;

const apps::Program program{.name = "spectrum",
                            .purpose = "Frequencies of the discrete operator on a uniform mesh, against their closed form.",
                            .footer = "Errors of omega^2 h^2 rho are over the largest of the curve."};

constexpr double young = 900.0, density = 1.0;  // SI; c = 30 m/s
constexpr double allowed = 1e-12;
constexpr double margin = 1.02;  // of the stable step over the Rayleigh quotient
constexpr int across = 2;        // cells
constexpr int margin_cells = 8;  // at the ends: their faces are reconstructed from up to 10 (2D) or 14 (3D) nearest cells
constexpr int points = 64;       // of the curve
constexpr int cells_of_eigenvalues = 40;  // along the strip whose highest frequency is taken from a dense matrix

struct SpectrumOptions {
    int cells = 64;
    double poisson = 0.0;
    double eta = 0.0;  // [Pa], 0: E
    std::filesystem::path out = "out/" + program.name;
};

void add_options(Flags& flags, SpectrumOptions& options) {
    flags.group("Strip");
    flags.count("--cells", options.cells, "along the strip, of size 1; two across it", 20);
    flags.number("--poisson", options.poisson, "Poisson's ratio", {.above = -1.0, .below = 0.5});
    flags.number("--eta", options.eta, "stabilisation of jumps between cells; 0: Young's modulus",
                 {.unit = "Pa", .above = 0.0, .zero = true});
    flags.out(options.out);
}

/// A strip or bar of unit squares or cubes.
template <int Dim>
struct Strip {
    mesh::Mesh<Dim> mesh;
    solid::Solid<Dim> solid;

    Strip(const SpectrumOptions& options, PlaneWave wave, int cells)
        : mesh(box_of<Dim>(Dim == 2 ? BoxCells::quadrangles : BoxCells::hexahedra, Vector<Dim>::Zero(), upper(cells), 1.0)),
          solid(mesh, solid_options(options, wave)) {}
    Strip(const Strip&) = delete;

private:
    static Vector<Dim> upper(int cells) {
        Vector<Dim> corner = Vector<Dim>::Constant(across);
        corner[0] = cells;
        return corner;
    }
    static solid::SolidOptions<Dim> solid_options(const SpectrumOptions& options, PlaneWave wave) {
        solid::SolidOptions<Dim> solid;
        solid.materials = {{.young = young, .poisson = options.poisson, .density = density, .eta = options.eta}};
        solid.boundary.dirichlet = plane_wave_sides<Dim>(wave);
        return solid;
    }
};

template <int Dim>
ChainDispersion exact(const solid::Solid<Dim>& solid, PlaneWave wave) {
    const auto& material = solid.options().materials[0];
    return {wave_modulus(wave, material), material.stabilisation(), material.density, 1.0};
}

/// Answer of the operator to a plane wave.
struct Answer {
    double square;    ///< omega^2 by the Rayleigh quotient over the cells away from the ends [1/s^2]
    double residual;  ///< largest |K q - m omega^2 q| of a cell there, over its mass and the wave's amplitude [1/s^2]
};

template <int Dim>
Answer plane_wave_answer(Strip<Dim>& strip, PlaneWave wave, double theta) {
    const auto& centre = strip.mesh.cell_centroid;
    std::vector<double> q(strip.solid.size()), product(q.size());
    const auto u = as_vectors<Dim>(std::span<double>(q)), k_u = as_vectors<Dim>(std::span<double>(product));
    for (std::size_t c = 0; c < u.size(); ++c) u[c] = std::cos(theta * centre[c][0] + 0.3) * polarisation<Dim>(wave);
    strip.solid.stiffness_product(q, product);
    const double end = strip.mesh.n_cells() / std::pow(across, Dim - 1) - margin_cells;
    const auto inside = [&](std::size_t c) { return centre[c][0] > margin_cells && centre[c][0] < end; };
    double work = 0.0, inertia = 0.0, residual = 0.0;
    for (std::size_t c = 0; c < u.size(); ++c)
        if (inside(c)) work += u[c].dot(k_u[c]), inertia += strip.solid.masses()[c] * u[c].squaredNorm();
    for (std::size_t c = 0; c < u.size(); ++c)
        if (inside(c)) residual = std::max(residual, (k_u[c] / strip.solid.masses()[c] - work / inertia * u[c]).norm());
    return {work / inertia, residual};
}

/// The curve of one wave: columns theta, computed and exact omega h/c; its largest errors go into the level.
template <int Dim>
apps::Table spectrum(Level& level, const SpectrumOptions& options, PlaneWave wave) {
    Strip<Dim> strip(options, wave, options.cells);
    const ChainDispersion dispersion = exact(strip.solid, wave);
    apps::Table table{.columns = {"theta", "computed", "exact"}, .rows = {}};
    double highest = 0.0, error = 0.0, residual = 0.0;
    for (int i = 1; i <= points; ++i) {
        const double theta = pi * i / points, square = std::pow(dispersion.frequency(theta), 2);
        const Answer answer = plane_wave_answer(strip, wave, theta);
        highest = std::max(highest, square);
        error = std::max(error, std::abs(answer.square - square));
        residual = std::max(residual, answer.residual);
        const double unit = std::sqrt(dispersion.modulus / density);
        table.rows.push_back({theta, std::sqrt(answer.square) / unit, std::sqrt(square) / unit});
    }
    for (const auto& [name, value] : {std::pair("spectrum", error), std::pair("residual of the eigenvector", residual)})
        level.quantities.at_most(fmt::format("{} of {}, largest error", name, name_of(wave)), value / highest, allowed);
    return table;
}

/// Highest frequency of the dense eigenvalue problem K x = omega^2 M x [rad/s].
template <int Dim>
double highest_frequency(solid::Solid<Dim>& solid) {
    Eigen::MatrixXd k = dense_stiffness(solid);
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(solid.inverse_mass().data(), k.rows()).cwiseSqrt();
    k = (root.asDiagonal() * k * root.asDiagonal()).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (k + k.transpose()), Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues()[k.rows() - 1]);
}

/// The stable step's frequency against the highest one of the strip, and this one against that of cells that alternate in
/// all directions, omega^2 = 4 eta/(rho h^2) (1 + (d-1)/2): they have no strain, and a jump on one side only across.
template <int Dim>
void add_stable_step(Level& level, const SpectrumOptions& options) {
    Strip<Dim> strip(options, PlaneWave::compression, cells_of_eigenvalues);
    const ChainDispersion dispersion = exact(strip.solid, PlaneWave::compression);
    const double alternating = 2.0 * std::sqrt(dispersion.eta / dispersion.density * (1.0 + 0.5 * (Dim - 1)));
    const double highest = highest_frequency(strip.solid);
    const double estimate = dynamics::stable_step(strip.solid).omega_max / margin;
    level.quantities.near("omega_max by Lanczos iteration", estimate, highest, 0.02, "rad/s");
    level.quantities.near("highest omega of the strip, of alternating cells", highest, alternating, no_target, "rad/s");
    level.quantities.push_back({.name = "stable omega below the highest",
                                .unit = "rad/s",
                                .value = std::max(0.0, highest - margin * estimate),
                                .reference = 0.0,
                                .scale = highest,
                                .allowed = 0.0});
}

template <int Dim>
void add_level(Study& study, const SpectrumOptions& options) {
    Level level{.name = fmt::format("{}D, {} cells along", Dim, options.cells)};
    {
        const Stopwatch watch(level.seconds);
        for (const PlaneWave wave : {PlaneWave::compression, PlaneWave::shear})
            study.curves.emplace_back(fmt::format("spectrum_{}_{}d", name_of(wave), Dim),
                                      spectrum<Dim>(level, options, wave));
        add_stable_step<Dim>(level, options);
    }
    study.levels.push_back(level);
}

const Picture picture{
    .name = "spectrum",
    .purpose = "Frequencies of the discrete operator and their closed form",
    .width = 1100,
    .height = 750,
    .script =
        R"gp(set title "frequencies of plane waves on a uniform mesh: computed (points), closed form (lines)" font ",15"
set xlabel "theta = k h [rad]"
set ylabel "omega h / c [-],  c = sqrt(M/rho)"
set xrange [0:pi]
set yrange [0:*]
set xtics ("0" 0, "pi/4" pi/4, "pi/2" pi/2, "3 pi/4" 3*pi/4, "pi" pi)
set key left top samplen 2
plot "spectrum_P_2d.csv" using "theta":"exact" with lines lw 2 lc rgb "#2a78d6" title "P", \
     "" using "theta":"computed" with points pt 7 ps 0.9 lc rgb "#2a78d6" title "P, squares", \
     "spectrum_P_3d.csv" using "theta":"computed" with points pt 6 ps 1.6 lc rgb "#2a78d6" title "P, cubes", \
     "spectrum_S_2d.csv" using "theta":"exact" with lines lw 2 lc rgb "#eb6834" title "S", \
     "" using "theta":"computed" with points pt 7 ps 0.9 lc rgb "#eb6834" title "S, squares", \
     "spectrum_S_3d.csv" using "theta":"computed" with points pt 6 ps 1.6 lc rgb "#eb6834" title "S, cubes", \
     x with lines lw 1 dt 2 lc rgb "#888888" title "exact medium"
)gp"};

void run_study(const SpectrumOptions& options) {
    const auto lock = prepare_study(program, options.out,
                                    {"spectrum_P_2d", "spectrum_S_2d", "spectrum_P_3d", "spectrum_S_3d"}, {"spectrum"});
    Study study{.title = "spectrum of the discrete operator on a uniform mesh",
                .reference = "rho h^2 omega^2 = M sin^2 theta + 4 eta sin^6(theta/2)"};
    add_level<2>(study, options);
    add_level<3>(study, options);
    study.pictures = {picture};
    study.options = {{"cells", options.cells}, {"poisson", options.poisson}, {"eta", options.eta}};
    report(program, options.out, study);
}

const bool is_listed = list(entry_of(program, SpectrumOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::spectrum_study
