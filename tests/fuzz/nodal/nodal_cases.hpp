#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/nodal_faces.hpp"

namespace abut::fuzz {

/// Numbers of one case, all from its seed.
class Dice {
public:
    Dice(std::uint64_t seed, std::uint64_t number) : random_(seed * 0x9E3779B97F4A7C15u + number) {}

    [[nodiscard]] double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }
    /// 10^from to 10^to
    [[nodiscard]] double power(double from, double to);
    [[nodiscard]] int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    [[nodiscard]] bool one_in(int n) { return below(n) == 0; }
    template <class Value>
    [[nodiscard]] Value any_of(std::initializer_list<Value> values) {
        return values.begin()[below(static_cast<int>(values.size()))];
    }

private:
    std::mt19937_64 random_;
};

/// Bodies that touch, match, degenerate or are out of all proportion, in any unit and turned freely.
template <int Dim>
struct NodalCase {
    std::vector<Vector<Dim>> rest;
    contact::NodalFaceArrays<Dim> faces;
    contact::NodalOptions options;
    double size = 1.0;  ///< of a body, more or less [m]
};
template <int Dim>
[[nodiscard]] NodalCase<Dim> make_case(Dice& dice);

/// Where the nodes go in a step: nowhere, by rounding, together, each by itself, onto each other, or far away.
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> moved(const NodalCase<Dim>& scene, const std::vector<Vector<Dim>>& x, Dice& dice);

}  // namespace abut::fuzz
