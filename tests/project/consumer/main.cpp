// Two unit segments that face each other, pressed d = 1 mm into each other, each held by a spring k = 1e9 N/m: contact finds
// the pair and moves its faces d/2 each. The springs then hold V = k d^2 / 4, so the forces are dV/dd = k d / 2 = 5e5 N.
#include <cmath>
#include <cstdio>
#include <vector>

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
    const contact::ContactStep<2>& step = contact.integrate(1.0, {rest, rest, rest, rest});
    const auto dV = step.mean_gradient.values();
    std::printf("%zu pair, dV/du = %g and %g N, k depth / 2 = %g N\n", step.pairs.size(), dV[0].y(), dV[1].y(), 5e5);
    return std::abs(dV[0].y() - 5e5) < 1e-6 && std::abs(dV[1].y() + 5e5) < 1e-6 ? 0 : 1;
}
