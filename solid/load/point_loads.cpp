#include "abut/solid/load/point_loads.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
PointLoads<Dim>::PointLoads(const Bodies<Dim>& bodies, const Ccg<Dim>& ccg, const RankPart<Dim>& part)
    : PointLoads(bodies, part, HeldPlaces<Dim>(bodies, ccg, part)) {}

template <int Dim>
PointLoads<Dim>::PointLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part, HeldPlaces<Dim> places)
    : springs_(bodies, places, held_), tractions_(bodies, places, held_), moments_(bodies, part) {
    held_ = held_points(part);
}

/// Points of all places, which are by their numbers among these from here on.
template <int Dim>
HeldPoints<Dim> PointLoads<Dim>::held_points(const RankPart<Dim>& part) {
    std::vector<HeldPlace<Dim>*> places = springs_.places();
    const std::vector<HeldPlace<Dim>*> of_tractions = tractions_.places();
    places.insert(places.end(), of_tractions.begin(), of_tractions.end());
    std::vector<std::int32_t> numbers;
    for (const HeldPlace<Dim>* place : places) numbers.insert(numbers.end(), place->points.begin(), place->points.end());
    sort_unique(numbers);
    for (HeldPlace<Dim>* place : places)
        for (std::int32_t& point : place->points)
            point = static_cast<std::int32_t>(std::ranges::lower_bound(numbers, point) - numbers.begin());
    return HeldPoints<Dim>(std::move(numbers), part);
}

template <int Dim>
bool PointLoads<Dim>::any() const {
    return std::ranges::any_of(loads_, [](const PointLoad<Dim>* load) { return load->any(); });
}

template <int Dim>
bool PointLoads<Dim>::do_work() const {
    return std::ranges::any_of(loads_, [](const PointLoad<Dim>* load) { return load->does_work(); });
}

template <int Dim>
bool PointLoads<Dim>::damp() const {
    return std::ranges::any_of(loads_, [](const PointLoad<Dim>* load) { return load->damps(); });
}

template <int Dim>
double PointLoads<Dim>::energy(std::span<const Vector<Dim>> q) const {
    if (std::ranges::none_of(loads_, [](const PointLoad<Dim>* load) { return load->is_in_potential(); })) return 0.0;
    const auto held = held_.take({q});
    double energy = 0.0;
    for (const PointLoad<Dim>* load : loads_) energy += load->energy({q, held[0]});
    return energy;
}

template <int Dim>
void PointLoads<Dim>::add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt,
                          contact::TakenForce take, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force, double& work) {
    const auto held = held_.take({q_0, q_1});
    for (PointLoad<Dim>* load : loads_) load->add({{q_0, held[0]}, {q_1, held[1]}, time, dt, take, turn_of}, force, work);
}

template <int Dim>
void PointLoads<Dim>::set_rates(std::span<const Vector<Dim>> q, std::span<const Vector<Dim>> v) {
    if (!damp()) return;
    const auto held = held_.take({q, v});
    for (PointLoad<Dim>* load : loads_) load->set_rates({q, held[0]}, {v, held[1]});
}

template <int Dim>
void PointLoads<Dim>::add_at(std::span<const Vector<Dim>> q, double time, const TurnOf<Dim>& turn_of,
                             std::span<Vector<Dim>> force) const {
    const auto held = held_.take({q});
    for (const PointLoad<Dim>* load : loads_) load->add_at({q, held[0]}, time, turn_of, force);
}

template <int Dim>
void PointLoads<Dim>::add_stiffness(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> product) const {
    if (std::ranges::none_of(loads_, [](const PointLoad<Dim>* load) { return load->is_in_potential(); })) return;
    const auto held = held_.take({q});
    for (const PointLoad<Dim>* load : loads_) load->add_stiffness({q, held[0]}, product);
}

template <int Dim>
void PointLoads<Dim>::save(StateWriter& state) const {
    for (const PointLoad<Dim>* load : loads_) load->save(state);
}

template <int Dim>
void PointLoads<Dim>::restore(StateReader& state) {
    for (PointLoad<Dim>* load : loads_) load->restore(state);
}

template <int Dim>
void PointLoads<Dim>::take_over(const PointLoads& before) {
    for (std::size_t i = 0; i < loads_.size(); ++i) loads_[i]->take_over(*before.loads_[i]);
}

template class PointLoads<2>;
template class PointLoads<3>;

}  // namespace abut::solid
