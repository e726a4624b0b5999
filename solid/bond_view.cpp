// What a solid tells of its bonds.
#include "abut/solid/bond_view.hpp"

#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
std::span<const BondPlace<Dim>> BondView<Dim>::places() const {
    return solid_.bonds_->places();
}

template <int Dim>
std::span<const BondCoverage> BondView<Dim>::coverage() const {
    return solid_.bonds_->coverage();
}

template <int Dim>
bool BondView<Dim>::may_break() const {
    return solid_.bonds_->any_breaks();
}

template <int Dim>
bool BondView<Dim>::is_broken(std::size_t place) const {
    return solid_.bonds_->is_broken(place);
}

template <int Dim>
double BondView<Dim>::share(std::size_t place) const {
    return solid_.bonds_->share(place);
}

template <int Dim>
double BondView<Dim>::broken_share() const {
    double all = 0.0, broken = 0.0;
    for (std::size_t i = 0; i < solid_.bonds_->places().size(); ++i) {
        const double area = solid_.bonds_->places()[i].area;
        all += area;
        if (solid_.bonds_->is_broken(i)) broken += area;
    }
    return all > 0.0 ? broken / all : 0.0;
}

template <int Dim>
double BondView<Dim>::beyond_fracture_energy() const {
    return solid_.bonds_->beyond_law();
}

template class BondView<2>;
template class BondView<3>;

}  // namespace abut::solid
