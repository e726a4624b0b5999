#include "abut/run/values/erosion_report.hpp"

#include <span>

namespace abut::run {
namespace {

/// Numbers of what is counted beside the cells.
template <int Dim, class Report, class Visit>
void for_each_number(Report& report, const Visit& visit) {
    auto& left = report.left;
    visit(left.mass), visit(left.kinetic), visit(left.potential);
    for (auto* vector : {&left.momentum, &report.impulse_of_weight})
        for (auto& x : *vector) visit(x);
    for (auto* moment : {&left.rest_angular_momentum, &left.pseudo_angular_momentum})
        for (auto& x : *moment) visit(x);
}

}  // namespace

template <int Dim>
void ErosionReport<Dim>::save(StateWriter& state) const {
    state.put(static_cast<std::uint64_t>(cells.size()));
    for (const ErodedCell& one : cells) {
        state.put(one.cell);
        state.put(one.step);
        state.put(one.time);
        state.put(static_cast<std::uint8_t>(one.reason));
    }
    for_each_number<Dim>(*this, [&](const double& value) { state.put(value); });
}

template <int Dim>
void ErosionReport<Dim>::restore(StateReader& state) {
    *this = {};
    for (auto n = state.get<std::uint64_t>(); n > 0; --n)
        cells.push_back({state.get<std::int32_t>(), state.get<std::int64_t>(), state.get<double>(),
                         static_cast<solid::LeavingReason>(state.get<std::uint8_t>())});
    left.cells = static_cast<std::int32_t>(cells.size());
    for_each_number<Dim>(*this, [&](double& value) { value = state.get<double>(); });
}

template struct ErosionReport<2>;
template struct ErosionReport<3>;

}  // namespace abut::run
