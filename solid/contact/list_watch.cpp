#include "abut/solid/contact/list_watch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace abut::solid {

template <int Dim>
void ListWatch<Dim>::set_searched(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, double time,
                                  std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    has_searched_ = true;
    u_.assign(q_0.begin(), q_0.end());
    load_ = load_0;
    time_ = time;
    static_cast<void>(measure(q_1, load_1));
    swept_end_.assign(q_1.begin(), q_1.end());
}

template <int Dim>
bool ListWatch<Dim>::is_end_of_search(std::span<const Vector<Dim>> q) const {
    return ranks_.largest(std::ranges::equal(q, swept_end_) ? 0.0 : 1.0) == 0.0;
}

template <int Dim>
double ListWatch<Dim>::motion_until(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!has_searched_) return std::numeric_limits<double>::infinity();
    return ranks_.largest(ccg_.motion_bound(u_, load_, q, load));
}

template <int Dim>
double ListWatch<Dim>::measure(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    travelled_ = 0.0;
    return measured_ = motion_until(q, load);
}

template <int Dim>
std::optional<double> ListWatch<Dim>::add_step(double cell_motion) {
    travelled_ += cell_motion;
    if (!std::exchange(is_at_last_end_, false) || ccg_.load_varies()) return std::nullopt;
    return measured_ + amplification_ * travelled_;
}

template class ListWatch<2>;
template class ListWatch<3>;

}  // namespace abut::solid
