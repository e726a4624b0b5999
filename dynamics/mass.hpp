#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abut::dynamics {

class Ranks;

/// An entry of a sparse matrix; entries with the same row and column add up.
struct MatrixEntry {
    std::int32_t row;
    std::int32_t column;
    double value;
};

/// The inverse of a sparse, symmetric positive definite mass matrix, as its Cholesky factors: the consistent mass of finite
/// elements, say. A diagonal mass is a plain array of 1/m instead, and costs no solve.
class InverseMass {
public:
    /// Both triangles of M [kg], (n, n). Throws BadInput if an entry is out of range or not finite, or if M is
    /// not symmetric and positive definite.
    InverseMass(std::size_t n, std::span<const MatrixEntry> mass);
    ~InverseMass();
    InverseMass(InverseMass&&) noexcept;
    InverseMass& operator=(InverseMass&&) noexcept;

    [[nodiscard]] std::size_t size() const;
    /// v = M^-1 p, both (n): [m/s] from [kg m/s]; v must not be p.
    void apply(std::span<const double> p, std::span<double> v) const;
    /// The entries of M, each row and column once.
    [[nodiscard]] std::vector<MatrixEntry> mass() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// result = a + s M^-1 p for both kinds of mass; result may be a.
void add_scaled_velocity(std::span<const double> a, double s, std::span<const double> inverse_mass,
                         std::span<const double> p, std::span<double> result);
void add_scaled_velocity(std::span<const double> a, double s, const InverseMass& inverse_mass, std::span<const double> p,
                         std::span<double> result);

/// a . M^-1 b, summed in a fixed order for any number of threads.
[[nodiscard]] double mass_product(std::span<const double> a, std::span<const double> inverse_mass,
                                  std::span<const double> b);
[[nodiscard]] double mass_product(std::span<const double> a, const InverseMass& inverse_mass, std::span<const double> b);
/// a . M^-1 b over the values of all ranks, the arrays being those of this one (n_owned, dimension).
[[nodiscard]] double mass_product_over(const Ranks& ranks, std::span<const double> a, std::span<const double> inverse_mass,
                                       std::span<const double> b);

/// The entries of M for both kinds.
[[nodiscard]] std::vector<MatrixEntry> mass_entries(std::span<const double> inverse_mass);
[[nodiscard]] std::vector<MatrixEntry> mass_entries(const InverseMass& inverse_mass);

/// result = a + s v, element by element; result may be a or v.
void add_scaled(std::span<const double> a, double s, std::span<const double> v, std::span<double> result);
/// a . b, summed in a fixed order for any number of threads.
[[nodiscard]] double dot_product(std::span<const double> a, std::span<const double> b);
/// a . b over the values of all ranks, the arrays being those of this one (n_owned, dimension).
[[nodiscard]] double dot_product_over(const Ranks& ranks, std::span<const double> a, std::span<const double> b);

}  // namespace abut::dynamics
