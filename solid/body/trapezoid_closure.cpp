#include "abut/solid/body/trapezoid_closure.hpp"

#include <array>
#include <cmath>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {
namespace {

/// sum m v'.v' over sum m v.v up to which v' is what rounding leaves of a rigid motion.
constexpr double no_deformation = 1e-24;

/// Numbers that are summed over the cells of a body.
template <int n>
struct Sums {
    std::array<double, n> values{};

    Sums& operator+=(const Sums& other) {
        for (int i = 0; i < n; ++i) values[i] += other.values[i];
        return *this;
    }
    [[nodiscard]] double* data() { return values.data(); }
    [[nodiscard]] const double* data() const { return values.data(); }
    [[nodiscard]] std::size_t size() const { return n; }
};

/// Sums of arms x in the middle of a step, motions w in it, and StepDefect.
template <int Dim>
class StepSums {
public:
    static constexpr int n_axial = Dim * (Dim - 1) / 2;
    enum {
        mass,
        energy_defect,
        rounding,
        of_x,
        of_w = of_x + Dim,
        of_xx = of_w + Dim,
        of_xw = of_xx + Dim * Dim,
        of_moment = of_xw + n_axial,
        n = of_moment + n_axial
    };
    using Values = Sums<n>;

    [[nodiscard]] static Values of(double m, const Vector<Dim>& x, const Vector<Dim>& w, const StepDefect<Dim>& defect) {
        Values sums;
        auto& of = sums.values;
        of[mass] = m;
        of[energy_defect] = defect.energy;
        of[rounding] = defect.rounding;
        const AxialVector<Dim> turning = moment<Dim>(x, w);
        for (int j = 0; j < Dim; ++j) {
            of[of_x + j] = m * x[j];
            of[of_w + j] = m * w[j];
            for (int i = 0; i < Dim; ++i) of[of_xx + Dim * j + i] = m * x[j] * x[i];
        }
        for (int k = 0; k < n_axial; ++k) {
            of[of_xw + k] = m * turning[k];
            of[of_moment + k] = defect.moment[k];
        }
        return sums;
    }
    explicit StepSums(const Values& values) : values_(values) {}

    /// 0 where it is what rounding leaves: over a motion that is nearly none, that would be a force.
    [[nodiscard]] double energy() const { return std::abs(of(energy_defect)) > of(rounding) ? of(energy_defect) : 0.0; }
    [[nodiscard]] Vector<Dim> centre() const { return vector(of_x) / of(mass); }
    [[nodiscard]] Vector<Dim> motion() const { return vector(of_w) / of(mass); }
    // About the centre
    [[nodiscard]] Matrix<Dim> second_moment() const {
        return Matrix<Dim>(values_.data() + of_xx) - of(mass) * centre() * centre().transpose();
    }
    [[nodiscard]] AxialVector<Dim> turning() const {
        return axial_vector(of_xw) - of(mass) * moment<Dim>(centre(), motion());
    }
    [[nodiscard]] AxialVector<Dim> moment_of_gradient() const { return axial_vector(of_moment); }

private:
    [[nodiscard]] double of(int i) const { return values_.values[static_cast<std::size_t>(i)]; }
    [[nodiscard]] Vector<Dim> vector(int i) const { return Vector<Dim>(values_.data() + i); }
    [[nodiscard]] AxialVector<Dim> axial_vector(int i) const { return AxialVector<Dim>(values_.data() + i); }

    Values values_;
};

}  // namespace

template <int Dim>
TrapezoidClosure<Dim>::TrapezoidClosure(const Bodies<Dim>& bodies, const RankPart<Dim>& part, const Ccg<Dim>& ccg)
    : bodies_(bodies), part_(part), ccg_(ccg) {
    if (!bodies.any_finite()) return;
    const mesh::Mesh<Dim>& mesh = bodies.deformable();
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        const auto [first, last] = cells_of_body(mesh, body);
        bool is_held = false;
        for (std::int32_t cell = first; cell < last; ++cell) is_held = is_held || !ccg.prescribed_faces_of(cell).empty();
        is_held = part.any(is_held);
        if (properties_of(bodies.deformable_options().kinematics[static_cast<std::size_t>(body)]).finite_strains)
            closed_.push_back({static_cast<std::size_t>(body), is_held});
    }
}

template <int Dim>
void TrapezoidClosure<Dim>::add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                std::span<Vector<Dim>> force) const {
    if (closed_.empty()) return;
    const std::vector<Vector<Dim>> origins_0 = part_.of_first_cells(q_0), origins_1 = part_.of_first_cells(q_1);
    for (const ClosedBody& body : closed_)
        add_to_body(body, origins_0[body.number], origins_1[body.number], q_0, q_1, force);
}

/// Displacements enter by their differences to those of the first cell: a body far from where it began loses no digits.
template <int Dim>
void TrapezoidClosure<Dim>::add_to_body(const ClosedBody& body, const Vector<Dim>& origin_0, const Vector<Dim>& origin_1,
                                        std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                        std::span<Vector<Dim>> force) const {
    const std::span<const Vector<Dim>> rest = bodies_.rest();
    const std::span<const double> masses = bodies_.masses();
    const auto arm = [&](std::int32_t c) -> Vector<Dim> {
        return rest[c] + 0.5 * ((q_0[c] - origin_0) + (q_1[c] - origin_1));
    };
    const auto motion = [&](std::int32_t c) -> Vector<Dim> { return (q_1[c] - origin_1) - (q_0[c] - origin_0); };
    const StepSums<Dim> sums(part_.sum_of_body(body.number, typename StepSums<Dim>::Values{}, [&](std::int32_t c) {
        const Vector<Dim> x = arm(c), w = motion(c);
        return StepSums<Dim>::of(masses[c], x, w, ccg_.step_defect(c, x));
    }));

    // A held body moves by w + origin_1 - origin_0, another by w' = w - mean - spin × r.
    const Vector<Dim> centre = sums.centre();
    const Vector<Dim> mean = body.is_held ? Vector<Dim>(origin_0 - origin_1) : sums.motion();
    Matrix<Dim> spin = Matrix<Dim>::Zero(), turn = Matrix<Dim>::Zero();
    if (!body.is_held) {
        const Matrix<Dim> second_moment = sums.second_moment();
        spin = hat<Dim>(spin_of<Dim>(second_moment, sums.turning()));
        turn = hat<Dim>(spin_of<Dim>(second_moment, sums.moment_of_gradient()));
    }
    const auto deformation = [&](std::int32_t c, const Vector<Dim>& r) -> Vector<Dim> {
        return motion(c) - mean - spin * r;
    };
    // Of v', of what turns, and v.v
    const std::array<double, 3> powers =
        part_
            .sum_of_body(body.number, Sums<3>{},
                         [&](std::int32_t c) {
                             const Vector<Dim> r = arm(c) - centre, w = motion(c) - mean;
                             const double m = masses[c];
                             return Sums<3>{{m * deformation(c, r).dot(w), m * (turn * r).dot(w), m * w.squaredNorm()}};
                         })
            .values;
    const bool deforms = powers[0] > no_deformation * powers[2];
    const double share = deforms ? (sums.energy() - powers[1]) / powers[0] : 0.0;
    part_.each_cell_of_body(body.number, [&](std::ptrdiff_t i) {
        const auto c = static_cast<std::int32_t>(i);
        const Vector<Dim> r = arm(c) - centre;
        force[c] += masses[c] * (turn * r + share * deformation(c, r));
    });
}

template class TrapezoidClosure<2>;
template class TrapezoidClosure<3>;

}  // namespace abut::solid
