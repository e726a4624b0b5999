#include "abut/solid/step_of_breaking.hpp"

#include <memory>
#include <utility>

#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

/// Two values that are exchanged as long as it lives.
template <class T>
class Exchanged {
public:
    Exchanged(T& a, T& b) : a_(a), b_(b) { std::swap(a_, b_); }
    Exchanged(const Exchanged&) = delete;
    Exchanged& operator=(const Exchanged&) = delete;
    ~Exchanged() { std::swap(a_, b_); }

private:
    T &a_, &b_;
};

}  // namespace

/// The operators of the cells know nothing of bonds.
template <int Dim>
dynamics::StableStep Solid<Dim>::stable_step_in_parts() {
    auto broken = std::make_unique<Bonds<Dim>>(*bodies_, ccg_, *frames_, *part_);
    broken->break_all();
    const Exchanged exchanged(bonds_, broken);
    return dynamics::stable_step(*this);
}

template <int Dim>
dynamics::StableStep step_of_breaking(Solid<Dim>& solid) {
    const dynamics::StableStep together = dynamics::stable_step(solid);
    if (!solid.bonds().may_break()) return together;
    const dynamics::StableStep of_parts = solid.stable_step_in_parts();
    return of_parts.dt < together.dt ? of_parts : together;
}

template dynamics::StableStep Solid<2>::stable_step_in_parts();
template dynamics::StableStep Solid<3>::stable_step_in_parts();
template dynamics::StableStep step_of_breaking(Solid<2>&);
template dynamics::StableStep step_of_breaking(Solid<3>&);

}  // namespace abut::solid
