#pragma once
#include <cstddef>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::dynamics {

/// Search for the highest mode of W K x = lambda x, with W diagonal: the inverse mass, or that times squares of steps. Each
/// iteration takes one product with K, and the largest Rayleigh quotient over x, its residual and the last direction: the
/// locally optimal conjugate gradients of A. V. Knyazev, SIAM J. Sci. Comput. 23 (2001) 517-541, with one vector. It is
/// where a power iteration is after several times as many products, and goes on from where it is when W changes. The bits
/// do not depend on the number of threads.
class ModeSearch {
public:
    using Product = std::function<void(std::span<const double> x, std::span<double> product)>;

    /// From a fixed random start. `stiffness` sets product = K x, n numbers each.
    ModeSearch(std::size_t n, Product stiffness);

    /// Gives W (n) [1/kg, or times s^2]; 0 holds a degree of freedom. To be called before `iterate`, and whenever W changes:
    /// the count begins again then. Throws BadInput if nothing is free.
    void set_weights(std::span<const double> weights);
    void iterate();
    /// Begins again from another random field, at the next `set_weights`: parts of a system that know nothing of each other
    /// are forgotten where the search has followed the others for long.
    void restart();

    [[nodiscard]] double quotient() const { return quotient_; }  ///< Rayleigh quotient of x, a lower bound of lambda
    [[nodiscard]] double change() const { return change_; }      ///< relative, in the last iteration
    [[nodiscard]] int iterations() const { return iterations_; }
    [[nodiscard]] std::span<const double> x() const { return x_.vector; }                    ///< x . W^-1 x = 1
    [[nodiscard]] double image(std::size_t i) const { return weights_[i] * x_.product[i]; }  ///< (W K x)_i

private:
    struct Direction {
        std::vector<double> vector, product;  ///< of K with it
    };
    void set_residual();
    void step_to_largest();
    void combine(const Vector<3>& c, const Vector<3>& d);

    Product stiffness_;
    std::minstd_rand random_{1};
    std::vector<double> weights_, masses_;  ///< 1/W, 0 where held
    Direction x_, residual_, last_;
    double quotient_ = 0.0, change_ = 0.0;
    int iterations_ = 0;
    Matrix<3> stiffness_of_ = Matrix<3>::Zero();  ///< products u_i . K u_j of x, residual and last direction
    Matrix<3> mass_of_ = Matrix<3>::Identity();   ///< the same with W^-1
    bool has_last_ = false;
};

}  // namespace abut::dynamics
