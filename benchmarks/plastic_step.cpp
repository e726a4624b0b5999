// One evaluation of the mean force of a step with metal that yields, against the elastic one on the same mesh and the same motion.
//
// A free body without contact goes to and fro between two states, so that with `flows` every cell inside flows in each step, as it turns
// back by three yield strains, and without it none does. Elastic is St. Venant and Kirchhoff's material, of finite bodies neo-Hookean's
// (`rubber`) beside it. Before it is timed each body keeps V + D - W over a step to 1e-10 of the work. One thread, processor time. Expected of
// `small` bodies: at most 1.3 times the elastic step.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/solid.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

struct Choices {
    int cells = 20000;
    int repetitions = 9;
    int threads = 1;
    std::string json;
};

constexpr double yield = 1e-3;

solid::Material material_of(solid::MaterialLaw law) {
    solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0, .law = law};
    if (law == solid::MaterialLaw::j2) material.flow.yield_stress = yield;
    return material;
}

/// A body that goes to and fro.
template <int Dim>
class Shaken {
public:
    Shaken(const mesh::Mesh<Dim>& mesh, solid::MaterialLaw law, solid::Kinematics kinematics, double strain)
        : solid_(mesh, options_of(law, kinematics)), here_(solid_.size(), 0.0), there_(here_.size()), force_(here_.size()) {
        for (std::size_t i = 0; i < here_.size(); i += Dim) {
            const Vector<Dim>& x = solid_.rest_positions()[i / Dim];
            there_[i] = strain * x[0];  // a stretch that keeps the volume, with a wave of as much strain
            there_[i + 1] = strain * (0.1 * std::sin(10.0 * x[0]) - x[1]);
        }
        step();
        step();
        require_balance();
    }

    void step() {
        solid_.mean_force(here_, there_, time_, 1.0, force_);
        time_ += 1.0;
        std::swap(here_, there_);
    }
    [[nodiscard]] double dissipated() const { return solid_.dissipated().total(); }

private:
    static solid::SolidOptions<Dim> options_of(solid::MaterialLaw law, solid::Kinematics kinematics) {
        solid::SolidOptions<Dim> options;
        options.materials = {material_of(law)};
        options.kinematics = {kinematics};
        return options;
    }
    void require_balance() {
        const double before = solid_.potential(here_) + dissipated();
        const std::vector<double> from = here_;
        step();
        double work = 0.0, size = 0.0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            work += force_[i] * (here_[i] - from[i]);
            size += std::abs(force_[i] * (here_[i] - from[i]));
        }
        benchmark::require_small("V + D - W of a step",
                                 std::abs(solid_.potential(here_) + dissipated() - before + work) / size, 1e-10);
    }

    solid::Solid<Dim> solid_;
    std::vector<double> here_, there_, force_;
    double time_ = 0.0;
};

template <int Dim>
void measure(const std::string& shape, const mesh::Mesh<Dim>& mesh, solid::Kinematics kinematics, const Choices& choices,
             nlohmann::json& results) {
    const bool is_finite = solid::properties_of(kinematics).finite_strains;
    struct Case {
        const char* name;
        solid::MaterialLaw law;
        double strain;
    };
    std::vector<Case> cases{{"elastic", solid::MaterialLaw::st_venant_kirchhoff, 3.0 * yield}};
    if (is_finite) cases.push_back({"rubber", solid::MaterialLaw::neo_hookean, 3.0 * yield});
    cases.push_back({"j2, none flows", solid::MaterialLaw::j2, 0.1 * yield});
    cases.push_back({"j2, flows", solid::MaterialLaw::j2, 3.0 * yield});
    std::vector<std::unique_ptr<Shaken<Dim>>> bodies;
    std::vector<std::function<void()>> works;
    const int steps = std::max(2, 2 * (400000 / mesh.n_cells() / 2));
    for (const Case& one : cases) {
        bodies.push_back(std::make_unique<Shaken<Dim>>(mesh, one.law, kinematics, one.strain));
        const double dissipated = bodies.back()->dissipated();
        if ((dissipated > 0.0) != (one.law == solid::MaterialLaw::j2 && one.strain > yield))
            throw std::runtime_error(fmt::format("{}, {}: D is {:g}", shape, one.name, dissipated));
        works.push_back([body = bodies.back().get(), steps] {
            for (int i = 0; i < steps; ++i) body->step();
        });
    }
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads), works);
    const std::string_view moves = solid::properties_of(kinematics).name;
    fmt::print("{:<12} {:<9}", shape, moves);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double least = samples[i].least() / steps / mesh.n_cells() * 1e9;
        const double ratio = samples[i].least() / samples[0].least();
        fmt::print("  {} {:.0f} ns ({:.2f})", cases[i].name, least, ratio);
        results.push_back({{"shape", shape},
                           {"kinematics", moves},
                           {"law", cases[i].name},
                           {"cells", mesh.n_cells()},
                           {"ns_a_cell", least},
                           {"over_elastic", ratio}});
    }
    fmt::print("\n");
}

template <int Dim>
void measure_shapes(const std::vector<std::pair<std::string, mesh::CellShape>>& shapes, int split, const Choices& choices,
                    nlohmann::json& results) {
    for (const auto& [name, shape] : shapes) {
        const int of_brick = shape == mesh::CellShape::triangle ? 2 : shape == mesh::CellShape::tetrahedron ? split : 1;
        const int n = std::max(2, static_cast<int>(std::lround(std::pow(choices.cells / of_brick, 1.0 / Dim))));
        std::array<int, Dim> counts;
        counts.fill(n);
        const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts, shape);
        for (const solid::Kinematics kinematics :
             {solid::Kinematics::small, solid::Kinematics::floating, solid::Kinematics::finite})
            measure<Dim>(name, mesh, kinematics, choices, results);
    }
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Steps of metal that yields against elastic ones");
    options.add("--cells", choices.cells, "About how many, of each shape");
    options.add("--repetitions", choices.repetitions, "Of each timing");
    options.add("--threads", choices.threads, "That Abut may use");
    options.add("--json", choices.json, "File for the results");
    if (const auto code = options.parse(argc, argv)) return *code;
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    nlohmann::json results = nlohmann::json::array();
    measure_shapes<2>({{"triangles", mesh::CellShape::triangle}, {"quadrangles", mesh::CellShape::quadrangle}}, 2, choices,
                      results);
    measure_shapes<3>({{"tetrahedra", mesh::CellShape::tetrahedron}, {"hexahedra", mesh::CellShape::hexahedron}}, 6, choices,
                      results);
    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["results"] = results;
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, &run); }
