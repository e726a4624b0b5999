#include "abut/run/values/sightings.hpp"

namespace abut::run {

template <int Dim>
void Sightings<Dim>::save(StateWriter& state) const {
    state.put(static_cast<std::uint64_t>(past_rims.size()));
    for (const PastRim& past : past_rims) {
        state.put(past.body);
        state.put(past.obstacle);
        state.put(past.time);
    }
    state.put(static_cast<std::uint64_t>(near_themselves.size()));
    for (const NearItself<Dim>& near : near_themselves) {
        state.put(near.body);
        for (const double value : {near.time, near.gap, near.gap_at_rest}) state.put(value);
        for (const double x : near.position) state.put(x);
    }
    state.put(static_cast<std::uint64_t>(looks_ended.size()));
    for (const LookEnded& ended : looks_ended) {
        state.put(ended.body);
        state.put(ended.time);
        state.put(ended.reason);
    }
}

template <int Dim>
void Sightings<Dim>::restore(StateReader& state) {
    *this = {};
    for (auto n = state.get<std::uint64_t>(); n > 0; --n)
        past_rims.push_back({state.get_text(), state.get_text(), state.get<double>()});
    for (auto n = state.get<std::uint64_t>(); n > 0; --n) {
        NearItself<Dim> near{state.get_text(), state.get<double>(), state.get<double>(), state.get<double>(),
                             Vector<Dim>::Zero()};
        for (double& x : near.position) x = state.get<double>();
        near_themselves.push_back(near);
    }
    for (auto n = state.get<std::uint64_t>(); n > 0; --n)
        looks_ended.push_back({state.get_text(), state.get<double>(), state.get_text()});
}

template struct Sightings<2>;
template struct Sightings<3>;

}  // namespace abut::run
