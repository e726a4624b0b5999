#pragma once
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace abut {

template <int Rows, int Cols>
class SmallMatrix;
template <int N>
class DiagonalMatrix;

namespace detail {

/// A matrix stores its columns, a column its numbers.
template <int Rows, int Cols>
struct MatrixItem {
    using type = SmallMatrix<Rows, 1>;
};
template <int Rows>
struct MatrixItem<Rows, 1> {
    using type = double;
};

/// Storage of a matrix without numbers.
template <class Item>
struct NoItems {
    constexpr Item& operator[](std::ptrdiff_t) const noexcept { __builtin_unreachable(); }
    constexpr bool operator==(const NoItems&) const = default;
};

constexpr bool fits(int size_at_compile_time, int size) { return size_at_compile_time < 0 || size_at_compile_time == size; }

/// Matrices and expressions of the library Eigen, whose headers are not needed here.
template <class Expression, int Rows, int Cols>
concept EigenExpression = std::is_class_v<typename Expression::PlainObject> && fits(Expression::RowsAtCompileTime, Rows) &&
    fits(Expression::ColsAtCompileTime, Cols);

}  // namespace detail

/// Matrix or vector of fixed size: packed doubles, column after column, without an alignment demand. Its members have the
/// names of Eigen's and return values: each operation is carried out at once, and sums run from left to right.
/// `Vector<3> v;` leaves the numbers unset, `Vector<3>{}` sets them to 0.
template <int Rows, int Cols>
class SmallMatrix {
    static_assert(Rows >= 0 && Cols >= 0);
    using Item = typename detail::MatrixItem<Rows, Cols>::type;
    static constexpr bool is_column = Cols == 1, is_vector = Rows == 1 || Cols == 1, is_square = Rows == Cols;
    template <int N>
    static constexpr bool is_column_of = Cols == 1 && Rows == N;
    template <int N>
    static constexpr bool has_rows = Cols != 1 && Rows == N;
    static constexpr int n_items = is_column ? Rows : Cols, n_entries = Rows * Cols;
    static constexpr int n_stored = n_items > 0 ? n_items : 1, n_in_row = Cols > 0 ? Cols : 1, n_rows = Rows > 0 ? Rows : 1;
    using RowValues = double[n_in_row];

    /// The numbers, column after column.
    [[nodiscard]] constexpr double& flat(int k) noexcept {
        if constexpr (is_column)
            return items_[k];
        else
            return items_[k / n_rows].items_[k % n_rows];
    }
    [[nodiscard]] constexpr double flat(int k) const noexcept {
        if constexpr (is_column)
            return items_[k];
        else
            return items_[k / n_rows].items_[k % n_rows];
    }

public:
    static constexpr int RowsAtCompileTime = Rows, ColsAtCompileTime = Cols, SizeAtCompileTime = Rows * Cols;

    SmallMatrix() = default;
    SmallMatrix(const SmallMatrix&) = default;
    SmallMatrix& operator=(const SmallMatrix&) & = default;  // not to a copy such as m.row(0)
    constexpr explicit SmallMatrix(double x) noexcept requires is_column_of<1> : items_{x} {}
    constexpr SmallMatrix(double x, double y) noexcept requires is_column_of<2> : items_{x, y} {}
    constexpr SmallMatrix(double x, double y, double z) noexcept requires is_column_of<3> : items_{x, y, z} {}
    /// Rows of a matrix: `Matrix<2>{{a, b}, {c, d}}`.
    constexpr SmallMatrix(const RowValues& row_0, const RowValues& row_1) noexcept requires has_rows<2> {
        set_row(0, row_0);
        set_row(1, row_1);
    }
    constexpr SmallMatrix(const RowValues& row_0, const RowValues& row_1,
                          const RowValues& row_2) noexcept requires has_rows<3> {
        set_row(0, row_0);
        set_row(1, row_1);
        set_row(2, row_2);
    }
    /// A matrix of these columns.
    template <class... Columns>
    [[nodiscard]] static constexpr SmallMatrix from_columns(const Columns&... columns) noexcept {
        static_assert(!is_column && sizeof...(Columns) == Cols);
        SmallMatrix result;
        int j = 0;
        ((result.items_[j++] = columns), ...);
        return result;
    }
    /// Copies of Rows * Cols numbers, column after column.
    explicit SmallMatrix(const double* values) noexcept {
        double* const to = data();
#pragma GCC unroll 16
        for (int i = 0; i < Rows * Cols; ++i) to[i] = values[i];
    }
    constexpr SmallMatrix(const DiagonalMatrix<Rows>& diagonal) noexcept requires is_square : SmallMatrix(Zero()) {
        for (int i = 0; i < Rows; ++i) (*this)(i, i) = diagonal.values()[i];
    }
    template <detail::EigenExpression<Rows, Cols> Expression>
    SmallMatrix(const Expression& expression) {
        const auto& values = expression.eval();
        assert(values.rows() == Rows && values.cols() == Cols);
        for (int j = 0; j < Cols; ++j)
            for (int i = 0; i < Rows; ++i) (*this)(i, j) = values.coeff(i, j);
    }

    [[nodiscard]] static constexpr SmallMatrix Constant(double value) noexcept {
        SmallMatrix result;
        if constexpr (is_column) {
#pragma GCC unroll 16
            for (int i = 0; i < n_items; ++i) result.items_[i] = value;
        } else {
#pragma GCC unroll 16
            for (int j = 0; j < n_items; ++j) result.items_[j] = Item::Constant(value);
        }
        return result;
    }
    [[nodiscard]] static constexpr SmallMatrix Zero() noexcept { return Constant(0.0); }
    [[nodiscard]] static constexpr SmallMatrix Ones() noexcept { return Constant(1.0); }
    [[nodiscard]] static constexpr SmallMatrix Identity() noexcept {
        static_assert(is_square);
        SmallMatrix result;
#pragma GCC unroll 16
        for (int j = 0; j < Cols; ++j)
#pragma GCC unroll 16
            for (int i = 0; i < Rows; ++i) result(i, j) = i == j ? 1.0 : 0.0;
        return result;
    }
    [[nodiscard]] static constexpr SmallMatrix Unit(std::ptrdiff_t axis) noexcept {
        static_assert(is_column);
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < Rows; ++i) result.items_[i] = i == axis ? 1.0 : 0.0;
        return result;
    }
    [[nodiscard]] static constexpr SmallMatrix UnitX() noexcept { return Unit(0); }
    [[nodiscard]] static constexpr SmallMatrix UnitY() noexcept { return Unit(1); }
    [[nodiscard]] static constexpr SmallMatrix UnitZ() noexcept { return Unit(2); }
    constexpr void setZero() & noexcept { *this = Zero(); }
    constexpr void setConstant(double value) & noexcept { *this = Constant(value); }
    constexpr void setIdentity() & noexcept { *this = Identity(); }

    [[nodiscard]] static constexpr std::ptrdiff_t rows() noexcept { return Rows; }
    [[nodiscard]] static constexpr std::ptrdiff_t cols() noexcept { return Cols; }
    [[nodiscard]] static constexpr std::ptrdiff_t size() noexcept { return Rows * Cols; }
    [[nodiscard]] double* data() noexcept { return reinterpret_cast<double*>(&items_); }
    [[nodiscard]] const double* data() const noexcept { return reinterpret_cast<const double*>(&items_); }
    [[nodiscard]] double* begin() noexcept { return data(); }
    [[nodiscard]] double* end() noexcept { return data() + size(); }
    [[nodiscard]] const double* begin() const noexcept { return data(); }
    [[nodiscard]] const double* end() const noexcept { return data() + size(); }

    [[nodiscard]] constexpr double& operator()(std::ptrdiff_t i, std::ptrdiff_t j) noexcept {
        assert(0 <= i && i < Rows && 0 <= j && j < Cols);
        if constexpr (is_column)
            return items_[i];
        else
            return items_[j].items_[i];
    }
    [[nodiscard]] constexpr double operator()(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return const_cast<SmallMatrix&>(*this)(i, j);
    }
    [[nodiscard]] constexpr double& operator[](std::ptrdiff_t i) noexcept {
        static_assert(is_vector);
        return is_column ? (*this)(i, 0) : (*this)(0, i);
    }
    [[nodiscard]] constexpr double operator[](std::ptrdiff_t i) const noexcept {
        static_assert(is_vector);
        return const_cast<SmallMatrix&>(*this)[i];
    }
    [[nodiscard]] constexpr double& x() noexcept { return (*this)[0]; }
    [[nodiscard]] constexpr double& y() noexcept { return (*this)[1]; }
    [[nodiscard]] constexpr double& z() noexcept { return (*this)[2]; }
    [[nodiscard]] constexpr double x() const noexcept { return (*this)[0]; }
    [[nodiscard]] constexpr double y() const noexcept { return (*this)[1]; }
    [[nodiscard]] constexpr double z() const noexcept { return (*this)[2]; }
    /// The only number of a matrix of one row and one column.
    [[nodiscard]] constexpr double value() const noexcept {
        static_assert(Rows == 1 && Cols == 1);
        return items_[0];
    }

    [[nodiscard]] constexpr SmallMatrix<Rows, 1>& col(std::ptrdiff_t j) & noexcept {
        assert(0 <= j && j < Cols);
        if constexpr (is_column)
            return *this;
        else
            return items_[j];
    }
    [[nodiscard]] constexpr const SmallMatrix<Rows, 1>& col(std::ptrdiff_t j) const& noexcept {
        return const_cast<SmallMatrix&>(*this).col(j);
    }
    [[nodiscard]] constexpr SmallMatrix<Rows, 1> col(std::ptrdiff_t j) && noexcept { return col(j); }
    [[nodiscard]] constexpr SmallMatrix<1, Cols> row(std::ptrdiff_t i) const noexcept {
        SmallMatrix<1, Cols> result;
#pragma GCC unroll 16
        for (int j = 0; j < Cols; ++j) result[j] = (*this)(i, j);
        return result;
    }
    /// The first N numbers of a vector.
    template <int N>
    [[nodiscard]] constexpr SmallMatrix<N, 1> head() const noexcept {
        static_assert(is_column && N <= Rows);
        return segment<N>(0);
    }
    template <int N>
    [[nodiscard]] constexpr SmallMatrix<N, 1> tail() const noexcept {
        static_assert(is_column && N <= Rows);
        return segment<N>(Rows - N);
    }
    template <int N>
    [[nodiscard]] constexpr SmallMatrix<N, 1> segment(std::ptrdiff_t first) const noexcept {
        static_assert(is_column && N <= Rows);
        SmallMatrix<N, 1> result;
#pragma GCC unroll 16
        for (int i = 0; i < N; ++i) result[i] = (*this)[first + i];
        return result;
    }
    template <int M, int N>
    [[nodiscard]] constexpr SmallMatrix<M, N> topLeftCorner() const noexcept {
        static_assert(M <= Rows && N <= Cols);
        SmallMatrix<M, N> result;
#pragma GCC unroll 16
        for (int j = 0; j < N; ++j) result.col(j) = col(j).template head<M>();
        return result;
    }
    template <int N>
    [[nodiscard]] constexpr SmallMatrix<Rows, N> leftCols() const noexcept {
        return topLeftCorner<Rows, N>();
    }
    template <int N>
    [[nodiscard]] constexpr SmallMatrix<Rows, N> rightCols() const noexcept {
        SmallMatrix<Rows, N> result;
#pragma GCC unroll 16
        for (int j = 0; j < N; ++j) result.col(j) = col(Cols - N + j);
        return result;
    }
    [[nodiscard]] constexpr SmallMatrix<Rows, 1> diagonal() const noexcept {
        static_assert(is_square);
        SmallMatrix<Rows, 1> result;
#pragma GCC unroll 16
        for (int i = 0; i < Rows; ++i) result[i] = (*this)(i, i);
        return result;
    }
    /// This vector on the diagonal of a matrix.
    [[nodiscard]] constexpr DiagonalMatrix<Rows> asDiagonal() const noexcept {
        static_assert(is_column);
        return DiagonalMatrix<Rows>(*this);
    }
    [[nodiscard]] constexpr SmallMatrix<Cols, Rows> transpose() const noexcept {
        static_assert(Rows > 0);
        SmallMatrix<Cols, Rows> result;
#pragma GCC unroll 16
        for (int j = 0; j < Cols; ++j)
#pragma GCC unroll 16
            for (int i = 0; i < Rows; ++i) result(j, i) = (*this)(i, j);
        return result;
    }

    constexpr SmallMatrix& operator+=(const SmallMatrix& other) & noexcept {
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) items_[i] += other.items_[i];
        return *this;
    }
    constexpr SmallMatrix& operator-=(const SmallMatrix& other) & noexcept {
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) items_[i] -= other.items_[i];
        return *this;
    }
    constexpr SmallMatrix& operator*=(double factor) & noexcept {
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) items_[i] *= factor;
        return *this;
    }
    constexpr SmallMatrix& operator/=(double divisor) & noexcept {
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) items_[i] /= divisor;
        return *this;
    }
    [[nodiscard]] constexpr SmallMatrix operator-() const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) result.items_[i] = -items_[i];
        return result;
    }
    [[nodiscard]] friend constexpr SmallMatrix operator+(const SmallMatrix& a, const SmallMatrix& b) noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) result.items_[i] = a.items_[i] + b.items_[i];
        return result;
    }
    [[nodiscard]] friend constexpr SmallMatrix operator-(const SmallMatrix& a, const SmallMatrix& b) noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) result.items_[i] = a.items_[i] - b.items_[i];
        return result;
    }
    [[nodiscard]] friend constexpr SmallMatrix operator*(double factor, const SmallMatrix& a) noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) result.items_[i] = factor * a.items_[i];
        return result;
    }
    [[nodiscard]] friend constexpr SmallMatrix operator*(const SmallMatrix& a, double factor) noexcept { return factor * a; }
    [[nodiscard]] friend constexpr SmallMatrix operator/(const SmallMatrix& a, double divisor) noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int i = 0; i < n_items; ++i) result.items_[i] = a.items_[i] / divisor;
        return result;
    }
    [[nodiscard]] friend constexpr bool operator==(const SmallMatrix& a, const SmallMatrix& b) noexcept {
        for (int i = 0; i < n_items; ++i)
            if (!(a.items_[i] == b.items_[i])) return false;
        return true;
    }

    /// Sum of the products of equal entries, of two vectors or two matrices.
    [[nodiscard]] constexpr double dot(const SmallMatrix& other) const noexcept {
        if constexpr (n_entries == 0) {
            return 0.0;
        } else {
            double result = flat(0) * other.flat(0);
#pragma GCC unroll 16
            for (int k = 1; k < n_entries; ++k) result += flat(k) * other.flat(k);
            return result;
        }
    }
    [[nodiscard]] constexpr double squaredNorm() const noexcept { return dot(*this); }
    [[nodiscard]] double norm() const noexcept { return std::sqrt(squaredNorm()); }
    /// The norm where squares could overflow or underflow.
    [[nodiscard]] double stableNorm() const noexcept {
        constexpr double highest = std::numeric_limits<double>::max();
        const double largest = cwiseAbs().maxCoeff();
        if (!(largest > 0.0 && largest <= highest)) return norm();
        const double factor = std::fmin(1.0 / largest, highest);
        return (factor < highest ? largest : 1.0 / highest) * (factor * *this).norm();
    }
    /// A vector without length is returned as it is.
    [[nodiscard]] SmallMatrix normalized() const noexcept {
        const double squared = squaredNorm();
        return squared > 0.0 ? *this / std::sqrt(squared) : *this;
    }
    void normalize() & noexcept { *this = normalized(); }
    [[nodiscard]] SmallMatrix stableNormalized() const noexcept {
        const SmallMatrix scaled = *this / cwiseAbs().maxCoeff();
        const double squared = scaled.squaredNorm();
        return squared > 0.0 ? scaled / std::sqrt(squared) : *this;
    }
    void stableNormalize() & noexcept { *this = stableNormalized(); }
    [[nodiscard]] constexpr SmallMatrix cross(const SmallMatrix& other) const noexcept {
        static_assert(is_column && Rows == 3);
        return {items_[1] * other.items_[2] - items_[2] * other.items_[1],
                items_[2] * other.items_[0] - items_[0] * other.items_[2],
                items_[0] * other.items_[1] - items_[1] * other.items_[0]};
    }
    /// A unit vector at right angles to this one.
    [[nodiscard]] SmallMatrix unitOrthogonal() const noexcept {
        static_assert(is_column && Rows == 3);
        const double small = 1e-12 * std::abs(items_[2]);
        if (std::abs(items_[0]) > small || std::abs(items_[1]) > small) {
            const double factor = 1.0 / std::sqrt(items_[0] * items_[0] + items_[1] * items_[1]);
            return {-items_[1] * factor, items_[0] * factor, 0.0};
        }
        const double factor = 1.0 / std::sqrt(items_[1] * items_[1] + items_[2] * items_[2]);
        return {0.0, -items_[2] * factor, items_[1] * factor};
    }

    [[nodiscard]] constexpr double trace() const noexcept {
        static_assert(is_square);
        return diagonal().sum();
    }
    [[nodiscard]] constexpr double determinant() const noexcept {
        static_assert(is_square && Rows >= 1 && Rows <= 3);
        const SmallMatrix& m = *this;
        if constexpr (Rows == 1)
            return m(0, 0);
        else if constexpr (Rows == 2)
            return m(0, 0) * m(1, 1) - m(1, 0) * m(0, 1);
        else
            return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
                   m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
    }
    /// By cofactors; numbers that are not finite if the determinant is 0.
    [[nodiscard]] constexpr SmallMatrix inverse() const noexcept {
        static_assert(is_square && Rows >= 1 && Rows <= 3);
        const SmallMatrix& m = *this;
        SmallMatrix result;
        if constexpr (Rows == 1) {
            result(0, 0) = 1.0 / m(0, 0);
        } else if constexpr (Rows == 2) {
            const double factor = 1.0 / determinant();
            result(0, 0) = m(1, 1) * factor;
            result(1, 0) = -m(1, 0) * factor;
            result(0, 1) = -m(0, 1) * factor;
            result(1, 1) = m(0, 0) * factor;
        } else {
            const SmallMatrix<3, 1> yz = m.col(1).cross(m.col(2)), zx = m.col(2).cross(m.col(0)),
                                    xy = m.col(0).cross(m.col(1));
            const double factor = 1.0 / yz.dot(m.col(0));
#pragma GCC unroll 3
            for (int j = 0; j < 3; ++j) {
                result(0, j) = yz[j] * factor;
                result(1, j) = zx[j] * factor;
                result(2, j) = xy[j] * factor;
            }
        }
        return result;
    }

    [[nodiscard]] constexpr double sum() const noexcept {
        if constexpr (n_entries == 0) {
            return 0.0;
        } else {
            double result = flat(0);
#pragma GCC unroll 16
            for (int k = 1; k < n_entries; ++k) result += flat(k);
            return result;
        }
    }
    [[nodiscard]] constexpr double prod() const noexcept {
        double result = flat(0);
#pragma GCC unroll 16
        for (int k = 1; k < n_entries; ++k) result *= flat(k);
        return result;
    }
    [[nodiscard]] constexpr double mean() const noexcept { return sum() / size(); }
    [[nodiscard]] constexpr double maxCoeff() const noexcept {
        static_assert(Rows > 0);
        double result = flat(0);
#pragma GCC unroll 16
        for (int k = 1; k < n_entries; ++k) result = result < flat(k) ? flat(k) : result;
        return result;
    }
    [[nodiscard]] constexpr double minCoeff() const noexcept {
        static_assert(Rows > 0);
        double result = flat(0);
#pragma GCC unroll 16
        for (int k = 1; k < n_entries; ++k) result = flat(k) < result ? flat(k) : result;
        return result;
    }
    /// The largest number and its first index.
    template <class Index>
    constexpr double maxCoeff(Index* index) const noexcept {
        static_assert(is_column);
        *index = 0;
        for (int i = 1; i < Rows; ++i)
            if (items_[*index] < items_[i]) *index = i;
        return items_[*index];
    }
    template <class Index>
    constexpr double minCoeff(Index* index) const noexcept {
        static_assert(is_column);
        *index = 0;
        for (int i = 1; i < Rows; ++i)
            if (items_[i] < items_[*index]) *index = i;
        return items_[*index];
    }

    [[nodiscard]] constexpr SmallMatrix cwiseProduct(const SmallMatrix& other) const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = flat(k) * other.flat(k);
        return result;
    }
    [[nodiscard]] constexpr SmallMatrix cwiseQuotient(const SmallMatrix& other) const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = flat(k) / other.flat(k);
        return result;
    }
    [[nodiscard]] constexpr SmallMatrix cwiseMin(const SmallMatrix& other) const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = other.flat(k) < flat(k) ? other.flat(k) : flat(k);
        return result;
    }
    [[nodiscard]] constexpr SmallMatrix cwiseMax(const SmallMatrix& other) const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = flat(k) < other.flat(k) ? other.flat(k) : flat(k);
        return result;
    }
    [[nodiscard]] constexpr SmallMatrix cwiseMin(double value) const noexcept { return cwiseMin(Constant(value)); }
    [[nodiscard]] constexpr SmallMatrix cwiseMax(double value) const noexcept { return cwiseMax(Constant(value)); }
    /// `function` of each number.
    template <class Function>
    [[nodiscard]] constexpr SmallMatrix unaryExpr(Function function) const {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = function(flat(k));
        return result;
    }
    [[nodiscard]] SmallMatrix cwiseAbs() const noexcept {
        SmallMatrix result;
#pragma GCC unroll 16
        for (int k = 0; k < n_entries; ++k) result.flat(k) = std::abs(flat(k));
        return result;
    }

    /// Whether no number exceeds the tolerance. Without one, 1e-12.
    [[nodiscard]] bool isZero(double tolerance = 1e-12) const noexcept {
        for (int k = 0; k < n_entries; ++k)
            if (!(std::abs(flat(k)) <= tolerance)) return false;
        return true;
    }
    /// Whether the two differ by at most `tolerance` times the smaller of their norms.
    [[nodiscard]] bool isApprox(const SmallMatrix& other, double tolerance = 1e-12) const noexcept {
        return (*this - other).squaredNorm() <= tolerance * tolerance * std::fmin(squaredNorm(), other.squaredNorm());
    }
    [[nodiscard]] bool isIdentity(double tolerance = 1e-12) const noexcept {
        static_assert(is_square);
        return (*this - Identity()).isZero(tolerance);
    }
    [[nodiscard]] constexpr bool allFinite() const noexcept {
        for (int k = 0; k < n_entries; ++k)
            if (!(flat(k) - flat(k) == 0.0)) return false;
        return true;
    }

private:
    template <int, int>
    friend class SmallMatrix;
    template <int M, int N, int K>
    friend constexpr SmallMatrix<M, K> operator*(const SmallMatrix<M, N>& a, const SmallMatrix<N, K>& b) noexcept;

    constexpr void set_row(int i, const RowValues& numbers) noexcept {
        for (int j = 0; j < Cols; ++j) (*this)(i, j) = numbers[j];
    }

    std::conditional_t<n_items == 0, detail::NoItems<Item>, Item[n_stored]> items_;
};

template <int M, int N, int K>
[[nodiscard]] constexpr SmallMatrix<M, K> operator*(const SmallMatrix<M, N>& a, const SmallMatrix<N, K>& b) noexcept {
    if constexpr (N == 0) {
        return SmallMatrix<M, K>::Zero();
    } else if constexpr (K == 1) {
        SmallMatrix<M, 1> result = a.col(0) * b.items_[0];
#pragma GCC unroll 16
        for (int i = 1; i < N; ++i) result += a.col(i) * b.items_[i];
        return result;
    } else {
        SmallMatrix<M, K> result;
#pragma GCC unroll 16
        for (int k = 0; k < K; ++k) result.items_[k] = a * b.items_[k];
        return result;
    }
}

/// A matrix with numbers on its diagonal alone: `v.asDiagonal()`.
template <int N>
class DiagonalMatrix {
public:
    constexpr explicit DiagonalMatrix(const SmallMatrix<N, 1>& values) noexcept : values_(values) {}

    [[nodiscard]] constexpr const SmallMatrix<N, 1>& values() const noexcept { return values_; }

    template <int Cols>
    [[nodiscard]] friend constexpr SmallMatrix<N, Cols> operator*(const DiagonalMatrix& a,
                                                                  const SmallMatrix<N, Cols>& b) noexcept {
        SmallMatrix<N, Cols> result;
#pragma GCC unroll 16
        for (int j = 0; j < Cols; ++j) result.col(j) = a.values_.cwiseProduct(b.col(j));
        return result;
    }
    template <int Rows>
    [[nodiscard]] friend constexpr SmallMatrix<Rows, N> operator*(const SmallMatrix<Rows, N>& a,
                                                                  const DiagonalMatrix& b) noexcept {
        SmallMatrix<Rows, N> result;
#pragma GCC unroll 16
        for (int j = 0; j < N; ++j) result.col(j) = a.col(j) * b.values_[j];
        return result;
    }

private:
    SmallMatrix<N, 1> values_;
};

}  // namespace abut
