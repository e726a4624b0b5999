#include "studies/kinematics/rows.hpp"

namespace abut::studies::kinematics {

template <int Dim>
Row row_of(const Case<Dim>& one, const std::string& setting, const Options& options, CaseResult<Dim>* result,
           const Watch<Dim>& watch) {
    Case<Dim> with_files = one;
    with_files.run.frames = options.frames;
    CaseResult<Dim> done = run_case<Dim>(with_files, options.out / folder_name(one.name + " " + setting), watch);
    Row row = studies::row_of(one.name, setting, done.figures, Dim);
    if (result != nullptr) *result = std::move(done);
    return row;
}

template Row row_of<2>(const Case<2>&, const std::string&, const Options&, CaseResult<2>*, const Watch<2>&);
template Row row_of<3>(const Case<3>&, const std::string&, const Options&, CaseResult<3>*, const Watch<3>&);

}  // namespace abut::studies::kinematics
