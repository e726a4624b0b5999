#include "studies/nodal/rows.hpp"

namespace abut::studies::turning {
namespace {

constexpr double angular_allowed = 1e-14;        // of J~, over sum |x × p|
constexpr double noisy_angular_allowed = 3e-14;  // where H - H~ says that the grid vibrates
constexpr double noise = 1e-3;

}  // namespace

std::string name_of(const run::RunOptions& run) {
    std::string name = dynamics::name_of(run.integrator);
    if (run.filter) name += ", filter";
    if (run.restart > 0) name += fmt::format(", restart {}", run.restart);
    return name;
}

template <int Dim>
Row row_of(Case<Dim> one, const run::RunOptions& run, const std::string& setting, const Options& options,
           CaseResult<Dim>* result, const Watch<Dim>& watch, int records) {
    one.run = run;
    const std::filesystem::path folder = options.out / folder_name(one.name + " " + setting);
    CaseResult<Dim> done = nodal::run_case<Dim>(one, folder, watch, records);
    const Laws laws{.pseudo = run.integrator == Scheme::memm,
                    // Linear strain keeps no angular momentum.
                    .turns = one.scene.solid.kinematics.front() == Kinematics::finite,
                    .angular = done.figures.excess > noise ? noisy_angular_allowed : angular_allowed};
    Row row = studies::row_of(one.name, setting, done.figures, Dim, laws);
    if (result != nullptr) *result = std::move(done);
    return row;
}

#define ABUT_INSTANTIATE(Dim)                                                                                         \
    template Row row_of<Dim>(Case<Dim>, const run::RunOptions&, const std::string&, const Options&, CaseResult<Dim>*, \
                             const Watch<Dim>&, int);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::turning
