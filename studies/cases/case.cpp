#include "studies/cases/case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::studies {
namespace {

template <int Dim>
std::array<double, Dim> key_of(const Vector<Dim>& x) {
    std::array<double, Dim> key;
    for (int d = 0; d < Dim; ++d) key[static_cast<std::size_t>(d)] = x[d];
    return key;
}

/// Velocities of the cells at the start [m/s], by their centroids.
template <int Dim>
std::map<std::array<double, Dim>, Vector<Dim>> velocities_at_start(const Case<Dim>& one) {
    const mesh::Mesh<Dim>& mesh = one.scene.mesh;
    const std::vector<Motion<Dim>> motion = motion_of(one);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    std::map<std::array<double, Dim>, Vector<Dim>> velocity;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<Dim>& x = mesh.cell_centroid[c];
        Vector<Dim> v = motion[static_cast<std::size_t>(mesh.cell_body[c])].at(x);
        for (int d = 0; d < Dim && one.noise > 0.0; ++d) v[d] += one.noise * noise(random);
        velocity[key_of<Dim>(x)] = v;
    }
    return velocity;
}

template <int Dim>
run::Scene<Dim> scene_of(const Case<Dim>& one) {
    run::Scene<Dim> scene = one.scene;
    scene.velocity.assign(one.motion.size(), Vector<Dim>::Zero());
    scene.added_velocity = [velocity = velocities_at_start(one)](const Vector<Dim>& x) {
        return velocity.at(key_of<Dim>(x));
    };
    return scene;
}

/// Figures of a run as it goes.
template <int Dim>
class Account : public run::Observer<Dim> {
public:
    Account(const Case<Dim>& one, const Watch<Dim>& watch) : watch_(watch) {
        const auto& kinematics = one.scene.solid.kinematics;
        is_free_ = one.is_free;
        filter_ = one.run.filter;
        turns_ = std::ranges::none_of(kinematics, [](Kinematics k) { return k == Kinematics::small; });
    }

    void begin(const run::Scene<Dim>&, const run::RunResult<Dim>& result) override {
        dt_ = result.run.dt;
        n_steps_ = result.run.steps;
    }
    void record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>&) override { ledger_.record(entry); }

    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        steps_ = run.steps;
        excess_ = std::max(excess_, excess_of(run, solid));
        if (run.steps == 0) scales_ = momentum_scales<Dim>(run, solid.rest_positions());
        report_ = solid.contact().report();
        if (watch_) watch_(run, solid);
        if (run.steps < n_steps_) return;
        for (const auto& motion : solid::body_motions<Dim>(run, solid)) velocity_.push_back(motion.velocity);
    }
    void after_step(const solid::Solid<Dim>& solid) {
        if (solid.contact().pair_potential() == nullptr) return;
        const contact::NodalStep<Dim>& step = solid.contact().pair_potential()->last();
        double forces = 0.0;
        for (const auto& pair : step.pairs) forces += pair.force.norm();
        pair_steps_ += static_cast<std::int64_t>(step.pairs.size());
        forces_ += forces;
        corrections_ += step.report.correction * forces;
    }

    [[nodiscard]] CaseResult<Dim> result() const {
        const double energy = ledger_.largest_energy();
        Figures figures{.steps = steps_,
                        .dt = dt_,
                        .scale = {"E", energy},
                        .drift = ledger_.pseudo_energy_drift() / energy,
                        .excess = excess_ / energy,
                        .parasitic = ledger_.parasitic(),
                        .momentum = is_free_ ? ledger_.momentum_drift() / scales_.linear : run::not_given,
                        .pseudo_angular =
                            is_free_ && turns_ ? ledger_.pseudo_angular_momentum_drift() / scales_.angular : run::not_given,
                        .events = report_.events,
                        .missed_contacts = report_.missed_contacts,
                        .pair_steps = pair_steps_,
                        .compression = report_.compression_max,
                        .correction = filter_         ? run::not_given
                                      : forces_ > 0.0 ? corrections_ / forces_
                                                      : 0.0,
                        .correction_max = report_.correction_max};
        return {figures, velocity_};
    }

private:
    static double excess_of(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
        double sum = 0.0;
        for (std::size_t i = 0; i < run.q.size(); ++i) {
            const double jump = run.p_after[i] - run.p_before[i];
            sum += solid.inverse_mass()[i] * jump * jump;
        }
        return 0.125 * sum;
    }

    const Watch<Dim>& watch_;
    bool is_free_, turns_, filter_;
    dynamics::Ledger<Dim> ledger_;
    contact::ContactReport report_;
    std::vector<Vector<Dim>> velocity_;
    std::int64_t steps_ = 0, n_steps_ = 0, pair_steps_ = 0;
    MomentumScales scales_;
    double dt_ = 0.0, excess_ = 0.0;
    double forces_ = 0.0, corrections_ = 0.0;
};

}  // namespace

template <int Dim>
Vector<Dim> Motion<Dim>::at(const Vector<Dim>& x) const {
    return velocity + dynamics::turning_velocity<Dim>(spin, x - *centre);
}

template <int Dim>
Case<Dim> case_of(const std::string& name, const std::vector<mesh::Mesh<Dim>>& meshes, Kinematics kinematics) {
    Case<Dim> one{.name = name};
    one.scene.mesh = meshes.size() == 1 ? meshes.front() : mesh::combine<Dim>(meshes);
    const auto n = static_cast<std::size_t>(one.scene.mesh.n_bodies());
    one.scene.solid.materials.resize(n);
    one.scene.solid.kinematics.assign(n, kinematics);
    one.motion.resize(n);
    return one;
}

template <int Dim>
void let_fall(Case<Dim>& one, double gravity) {
    one.scene.solid.acceleration.assign(one.motion.size(), -gravity * Vector<Dim>::Unit(Dim - 1));
    one.is_free = false;
}

template <int Dim>
std::vector<Motion<Dim>> motion_of(const Case<Dim>& one) {
    const mesh::Mesh<Dim>& mesh = one.scene.mesh;
    std::vector<Vector<Dim>> centre(one.motion.size(), Vector<Dim>::Zero());
    std::vector<double> measure(one.motion.size(), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        centre[body] += mesh.cell_measure[c] * mesh.cell_centroid[c];
        measure[body] += mesh.cell_measure[c];
    }
    std::vector<Motion<Dim>> motion = one.motion;
    for (std::size_t body = 0; body < motion.size(); ++body)
        if (!motion[body].centre) motion[body].centre = centre[body] / measure[body];
    return motion;
}

template <int Dim>
CaseResult<Dim> run_case(const Case<Dim>& one, const std::filesystem::path& folder, const Watch<Dim>& watch) {
    Account<Dim> account(one, watch);
    run::Scene<Dim> scene = scene_of(one);
    scene.after_step = [&](const solid::Solid<Dim>& solid, double) { account.after_step(solid); };
    run::RunOptions options = one.run;
    options.out = folder;
    run::Observers<Dim> observers{account};
    std::optional<run::ResultFiles<Dim>> files;
    if (!folder.empty()) observers.add(files.emplace(options, one.name, "bodies"));
    double seconds = 0.0, of_steps = 0.0;
    std::string ending;
    {
        const Stopwatch clock(seconds);
        try {
            run::RunResult<Dim> result = run::simulate<Dim>(scene, options, observers);
            of_steps = result.seconds.total - result.seconds.setup - result.seconds.ledger;
            if (files) files->finish(scene, result);
            of_steps -= result.seconds.output;
        } catch (const Error& error) {
            ending = error.what();
        }
    }
    CaseResult<Dim> result = account.result();
    result.figures.is_complete = ending.empty();
    result.figures.ending = ending;
    result.figures.seconds = seconds;
    result.figures.seconds_of_steps = of_steps;
    return result;
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template struct Motion<Dim>;                                                                          \
    template std::vector<Motion<Dim>> motion_of<Dim>(const Case<Dim>&);                                   \
    template Case<Dim> case_of<Dim>(const std::string&, const std::vector<mesh::Mesh<Dim>>&, Kinematics); \
    template void let_fall<Dim>(Case<Dim>&, double);                                                      \
    template CaseResult<Dim> run_case<Dim>(const Case<Dim>&, const std::filesystem::path&, const Watch<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies
