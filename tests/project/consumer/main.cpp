// Two unit segments that face each other, 1 mm pressed together, each held by k = 1e9 N/m: contact finds the pair, moves
// its two faces half a millimetre each and returns forces that sum to zero.
#include <cmath>
#include <cstdio>

#include "abut/contact/contact.hpp"

using namespace abut;

int main() {
    contact::Surface<2> surface;
    surface.append(std::vector<Vector<2>>{{1.0, 0.0}, {0.0, 0.0}}, 0.1, 1e9, 0);
    surface.append(std::vector<Vector<2>>{{0.0, -1e-3}, {1.0, -1e-3}}, 0.1, 1e9, 1);
    contact::Contact<2> contact(surface.view(), {});
    const std::vector<Vector<2>> rest(2, Vector<2>::Zero());
    contact.search(rest, rest, [](auto) {
        return contact::FaceCoupling<2>{{0, 1, 2}, {0, 1}, {1e9 * Matrix<2>::Identity(), 1e9 * Matrix<2>::Identity()}};
    });
    contact.integrate({rest, rest, rest, rest});
    const auto force = contact.result().mean_force();
    std::printf("%zu pair, forces %g and %g N\n", contact.result().active_pairs().size(), force[0].y(), force[1].y());
    return force[0].y() < 0.0 && std::abs(force[0].y() + force[1].y()) < 1e-9 ? 0 : 1;
}
