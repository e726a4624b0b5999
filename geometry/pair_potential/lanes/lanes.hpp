#pragma once
// Private to the layer. Nothing here may come from the standard library: these headers are compiled for several processors
// (steps_by_4.cpp), and an inline function of that kind would be shared between them.

namespace abut::geometry::lanes {

/// N numbers that go through the same operations side by side. Each operation rounds as that of one double does, so that
/// results do not depend on N.
template <int N>
struct Lanes {
    typedef double Values __attribute__((vector_size(8 * N)));
    typedef long long Flags __attribute__((vector_size(8 * N)));

    Lanes() = default;
    Lanes(double all) : v(all - Values{}) {}
    explicit Lanes(const Values& values) : v(values) {}

    friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
    friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
    friend Lanes operator-(const Lanes& a) { return Lanes(-a.v); }

    Values v;
};

/// True or false in each lane.
template <int N>
struct LaneFlags {
    typename Lanes<N>::Flags v;

    friend LaneFlags operator&(const LaneFlags& a, const LaneFlags& b) { return {a.v & b.v}; }
    friend LaneFlags operator|(const LaneFlags& a, const LaneFlags& b) { return {a.v | b.v}; }
    friend LaneFlags operator^(const LaneFlags& a, const LaneFlags& b) { return {a.v ^ b.v}; }
};
template <int N>
LaneFlags<N> operator<(const Lanes<N>& a, const Lanes<N>& b) {
    return {a.v < b.v};
}
template <int N>
LaneFlags<N> operator>(const Lanes<N>& a, const Lanes<N>& b) {
    return {a.v > b.v};
}
template <int N>
LaneFlags<N> operator<=(const Lanes<N>& a, const Lanes<N>& b) {
    return {a.v <= b.v};
}
template <int N>
LaneFlags<N> operator>=(const Lanes<N>& a, const Lanes<N>& b) {
    return {a.v >= b.v};
}
/// True where the first is true and the second is not.
template <int N>
LaneFlags<N> without(const LaneFlags<N>& a, const LaneFlags<N>& b) {
    return {a.v & ~b.v};
}
template <int N>
LaneFlags<N> negated(const LaneFlags<N>& a) {
    return {~a.v};
}
template <int N>
Lanes<N> select(const LaneFlags<N>& flags, const Lanes<N>& where_true, const Lanes<N>& where_false) {
    return Lanes<N>(flags.v ? where_true.v : where_false.v);
}
template <int N>
Lanes<N> square_root(const Lanes<N>& a) {
    Lanes<N> root;
    for (int i = 0; i < N; ++i) root.v[i] = __builtin_sqrt(a.v[i]);
    return root;
}
template <int N>
Lanes<N> magnitude(const Lanes<N>& a) {
    using Flags = typename Lanes<N>::Flags;
    return Lanes<N>((typename Lanes<N>::Values)((Flags)a.v & ~((Flags{} + 1) << 63)));
}
template <int N>
double lane(const Lanes<N>& a, int i) {
    return a.v[i];
}
template <int N>
void set_lane(Lanes<N>& a, int i, double value) {
    a.v[i] = value;
}
template <int N>
bool lane(const LaneFlags<N>& a, int i) {
    return a.v[i] != 0;
}

// One lane. These and the helpers of one pair in lane_gauss.hpp are static: each source has its own.
static inline double select(bool flag, double where_true, double where_false) { return flag ? where_true : where_false; }
static inline bool without(bool a, bool b) { return a && !b; }
static inline bool negated(bool a) { return !a; }
static inline double square_root(double a) { return __builtin_sqrt(a); }
static inline double magnitude(double a) { return __builtin_fabs(a); }
static inline double lane(double a, int) { return a; }
static inline bool lane(bool a, int) { return a; }
static inline void set_lane(double& a, int, double value) { a = value; }

template <class T>
struct LanesOf;
template <>
struct LanesOf<double> {
    static constexpr int count = 1;
    using Flags = bool;
};
template <int N>
struct LanesOf<Lanes<N>> {
    static constexpr int count = N;
    using Flags = LaneFlags<N>;
};
template <class T>
using FlagsOf = typename LanesOf<T>::Flags;

/// a where it is smaller than b, else b.
template <class T>
T lower(const T& a, const T& b) {
    return select(a < b, a, b);
}
template <class T>
T higher(const T& a, const T& b) {
    return select(a > b, a, b);
}

/// A vector of Dim components.
template <class T, int Dim>
struct LaneVector {
    T c[Dim];

    LaneVector& operator+=(const LaneVector& a) {
        for (int d = 0; d < Dim; ++d) c[d] = c[d] + a.c[d];
        return *this;
    }
    LaneVector& operator-=(const LaneVector& a) {
        for (int d = 0; d < Dim; ++d) c[d] = c[d] - a.c[d];
        return *this;
    }
    friend LaneVector operator+(LaneVector a, const LaneVector& b) { return a += b; }
    friend LaneVector operator-(LaneVector a, const LaneVector& b) { return a -= b; }
    friend LaneVector operator*(const T& factor, const LaneVector& a) {
        LaneVector product;
        for (int d = 0; d < Dim; ++d) product.c[d] = factor * a.c[d];
        return product;
    }
};
template <class T, int Dim>
LaneVector<T, Dim> no_vector() {
    LaneVector<T, Dim> zero;
    for (int d = 0; d < Dim; ++d) zero.c[d] = T(0.0);
    return zero;
}
template <class T, int Dim>
T dot(const LaneVector<T, Dim>& a, const LaneVector<T, Dim>& b) {
    T sum = a.c[0] * b.c[0];
    for (int d = 1; d < Dim; ++d) sum = sum + a.c[d] * b.c[d];
    return sum;
}
template <class T, int Dim>
T norm(const LaneVector<T, Dim>& a) {
    return square_root(dot(a, a));
}
template <class T>
T cross(const LaneVector<T, 2>& a, const LaneVector<T, 2>& b) {
    return a.c[0] * b.c[1] - a.c[1] * b.c[0];
}
template <class T>
LaneVector<T, 3> cross(const LaneVector<T, 3>& a, const LaneVector<T, 3>& b) {
    return {a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2], a.c[0] * b.c[1] - a.c[1] * b.c[0]};
}
template <class T, int Dim>
LaneVector<T, Dim> select(const FlagsOf<T>& flags, const LaneVector<T, Dim>& where_true,
                          const LaneVector<T, Dim>& where_false) {
    LaneVector<T, Dim> selected;
    for (int d = 0; d < Dim; ++d) selected.c[d] = select(flags, where_true.c[d], where_false.c[d]);
    return selected;
}

/// The corners of a pair: Dim of face 1, then Dim of face 2.
template <class T, int Dim>
struct LaneCorners {
    LaneVector<T, Dim> at[2 * Dim];
};

}  // namespace abut::geometry::lanes
