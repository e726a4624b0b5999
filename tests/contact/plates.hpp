#pragma once
// Two plates that are pressed together, slide and part: the scene of the tests of steps and of what pairs remember.
#include <cmath>
#include <numbers>
#include <vector>

#include "abut/contact/contact.hpp"
#include "contact/surfaces.hpp"

namespace abut::test {

/// Two plates of tiles, one over the other: body 0 looks up, body 1 down, tiles shifted against each other by half a tile.
template <int Dim>
contact::Surface<Dim> plates(int n = 5) {
    contact::Surface<Dim> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < n; ++i)
            surface.append(tile<Dim>((i + 0.3 * body) * axis<Dim>(0), (body == 0 ? 1.0 : -1.0) * up<Dim>(), 0.5), 0.2,
                           1.0 + body, body);
    return surface;
}

/// Body 1 pressed in by `depth` and slid by `slip`, body 0 bent a little, so that pairs open and close one by one.
template <int Dim>
std::vector<Vector<Dim>> moved(const contact::Surface<Dim>& surface, double depth, double slip) {
    std::vector<Vector<Dim>> u;
    for (std::int32_t f = 0; f < surface.size(); ++f)
        u.push_back(surface.body[f] == 0 ? Vector<Dim>(0.03 * f * up<Dim>())
                                         : Vector<Dim>(slip * axis<Dim>(0) - depth * up<Dim>()));
    return u;
}

/// A host whose faces answer to their own displacement, driven along a given path.
template <int Dim>
const contact::ContactStep<Dim>& drive(contact::Contact<Dim>& contact, const std::vector<Vector<Dim>>& u_0,
                                       const std::vector<Vector<Dim>>& u_1) {
    return contact.step(1.0, {.displacement_0 = u_0,
                              .displacement_1 = u_1,
                              .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size(), 2.0); },
                              .gradients_of =
                                  [](auto listed, auto y_0, auto y_1) {
                                      for (std::size_t i = 0; i < listed.size(); ++i)
                                          y_0[i] = y_1[i] = 0.1 * static_cast<double>(i) * Vector<Dim>::Ones();
                                  }});
}

/// The path of the plates: down to deeper than D = 0.4, sliding, and up again.
template <int Dim>
std::vector<std::vector<Vector<Dim>>> path_of_plates(const contact::Surface<Dim>& surface) {
    std::vector<std::vector<Vector<Dim>>> states;
    for (int i = 0; i <= 60; ++i) {
        const double t = i / 60.0;
        states.push_back(moved(surface, -0.1 + 0.7 * std::sin(std::numbers::pi * t), 1.7 * t));
    }
    return states;
}

/// Faces may be pressed in deeper than they are admitted.
inline contact::ContactOptions deep(double skin = 0.1) {
    contact::ContactOptions options;
    options.compression_limit = 10.0;
    options.search.skin = skin;
    return options;
}

}  // namespace abut::test
