#pragma once
// Surfaces made by hand for the tests of the contact layer.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::test {

inline constexpr double rigid = std::numeric_limits<double>::infinity();

inline double uniform(std::mt19937& random, double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
}

template <int Dim>
Vector<Dim> random_vector(std::mt19937& random, double size) {
    Vector<Dim> v;
    for (int i = 0; i < Dim; ++i) v[i] = uniform(random, -size, size);
    return v;
}

template <int Dim>
Vector<Dim> axis(int i) {
    return Vector<Dim>::Unit(i);
}
template <int Dim>
Vector<Dim> up() {
    return axis<Dim>(Dim - 1);
}

/// A square (3D) or segment (2D) about `centre` that looks along `normal`, `half` wide on either side of its centre.
template <int Dim>
std::vector<Vector<Dim>> tile(const Vector<Dim>& centre, const Vector<Dim>& normal, double half) {
    const geometry::PlaneFrame<Dim> frame(normal.normalized());
    const Vector<Dim> a = half * frame.tangents().col(0);
    if constexpr (Dim == 2) {
        return {centre - a, centre + a};
    } else {
        const Vector<3> b = half * frame.tangents().col(1);
        return {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
    }
}

/// A flat polygon of 3 to 6 corners (3D) or a segment (2D), about `centre`, looking along `normal`.
template <int Dim>
std::vector<Vector<Dim>> random_face(std::mt19937& random, const Vector<Dim>& centre, const Vector<Dim>& normal,
                                     double radius) {
    const geometry::PlaneFrame<Dim> frame(normal.normalized());
    if constexpr (Dim == 2) {
        const Vector<2> along = frame.tangents();
        return {centre - uniform(random, 0.4, 1.0) * radius * along, centre + uniform(random, 0.4, 1.0) * radius * along};
    } else {
        const int corners = std::uniform_int_distribution<int>(3, 6)(random);
        std::vector<Vector<3>> face;
        for (int i = 0; i < corners; ++i) {
            const double angle = (i + uniform(random, 0.0, 0.6)) * 2.0 * std::numbers::pi / corners;
            face.push_back(centre +
                           radius * (std::cos(angle) * frame.tangents().col(0) + std::sin(angle) * frame.tangents().col(1)));
        }
        return face;
    }
}

/// Body 0 below, faces looking up; body 1 above, looking down; every normal up to `tilt` away from the vertical, every
/// face somewhere over a common ground, and some near sharp edges. Not a closed surface: contact asks for none.
template <int Dim>
contact::Surface<Dim> random_surface(std::mt19937& random, int faces_per_body, double tilt = 0.3, double ground = 1.0) {
    contact::Surface<Dim> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < faces_per_body; ++i) {
            Vector<Dim> normal = (body == 0 ? 1.0 : -1.0) * up<Dim>();
            for (int j = 0; j + 1 < Dim; ++j) normal[j] = uniform(random, -tilt, tilt);
            Vector<Dim> centre = random_vector<Dim>(random, ground);
            centre[Dim - 1] *= 0.1;
            surface.append(random_face<Dim>(random, centre, normal, uniform(random, 0.3, 0.8)), uniform(random, 0.3, 0.8),
                           uniform(random, 1.0, 10.0), body);
        }
    for (std::int32_t face = 0; face < surface.size(); ++face)
        surface.steps_to_sharp_edge.push_back(
            static_cast<std::uint8_t>((7 * face / 3) % (contact::far_from_sharp_edge + 1)));
    return surface;
}

/// A sheet of 2 n^2 triangles over the unit square, its vertices at z = height(x, y); looks up.
template <class Height>
contact::Surface<3> sheet(int n, std::int32_t body, bool looks_up, const Height& height) {
    contact::Surface<3> surface;
    const auto point = [&](int i, int j) {
        const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
        return Vector<3>(x, y, height(x, y));
    };
    const auto add = [&](Vector<3> a, Vector<3> b, const Vector<3>& c) {
        if (!looks_up) std::swap(a, b);
        surface.append(std::array{a, b, c}, 0.3 / n, 1.0, body);
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            add(point(i, j), point(i + 1, j), point(i, j + 1));
            add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
    return surface;
}

/// Displacements of all faces of a random surface: body 1 comes down by about `approach`, every face on its own path.
template <int Dim>
std::vector<Vector<Dim>> random_displacement(std::mt19937& random, const contact::Surface<Dim>& surface, double size,
                                             double approach = 0.0) {
    std::vector<Vector<Dim>> u;
    for (std::int32_t f = 0; f < surface.size(); ++f) {
        u.push_back(random_vector<Dim>(random, size));
        u.back()[Dim - 1] *= 0.3;
        if (surface.body[f] == 1) u.back()[Dim - 1] -= approach;
    }
    return u;
}

/// All pairs of faces of different bodies.
template <int Dim>
std::vector<geometry::IndexPair> all_pairs(const contact::Surface<Dim>& surface) {
    std::vector<geometry::IndexPair> pairs;
    for (std::int32_t i = 0; i < surface.size(); ++i)
        for (std::int32_t j = i + 1; j < surface.size(); ++j)
            if (surface.body[i] != surface.body[j]) pairs.push_back({i, j});
    return pairs;
}

template <int Dim>
std::vector<Vector<Dim>> at_rest(const contact::Surface<Dim>& surface) {
    return std::vector<Vector<Dim>>(static_cast<std::size_t>(surface.size()), Vector<Dim>::Zero());
}

/// Faces that answer only to their own displacement, with `stiffness` times the identity.
template <int Dim>
contact::FaceCoupling<Dim> uncoupled(std::size_t n, double stiffness = 1.0) {
    contact::FaceCoupling<Dim> coupling;
    for (std::size_t f = 0; f < n; ++f) {
        coupling.columns.push_back(static_cast<std::int32_t>(f));
        coupling.blocks.push_back(stiffness * Matrix<Dim>::Identity());
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

/// A host that moves the faces of a Contact directly; every face answers to its own displacement alone.
template <int Dim>
class Mover {
public:
    Mover(contact::Surface<Dim> surface, const contact::ContactOptions& options)
        : surface_(std::move(surface)), contact(surface_.view(), options), u_(at_rest(surface_)) {}

    void search(const std::vector<Vector<Dim>>& u) { search(u, u); }
    void search(const std::vector<Vector<Dim>>& u_0, const std::vector<Vector<Dim>>& u_1) {
        u_ = u_0;
        contact.search(u_0, u_1, [](std::span<const contact::Face> faces) { return uncoupled<Dim>(faces.size()); });
    }

    /// One step from where the faces are to u; true if anything was active.
    bool move_to(const std::vector<Vector<Dim>>& u) {
        std::vector<Vector<Dim>> u_0, u_1;
        for (const contact::Face f : contact.faces()) {
            u_0.push_back(u_[static_cast<std::size_t>(f)]);
            u_1.push_back(u[static_cast<std::size_t>(f)]);
        }
        const std::vector<Vector<Dim>> y(u_0.size(), Vector<Dim>::Ones());
        contact.integrate(1.0, {u_0, u_1, y, y});
        u_ = u;
        return !contact.last().pairs.empty();
    }

private:
    contact::Surface<Dim> surface_;

public:
    contact::Contact<Dim> contact;

private:
    std::vector<Vector<Dim>> u_;
};

}  // namespace abut::test
