// An explosion breaks a structure, and its pieces fly on: a disc of hot gas bursts in front of a plate that hangs free.
//
// Air (gamma = 1.4, 1e5 Pa, 1.2 kg/m^3) fills a channel of 0.4 m, which a brittle plate closes (20 mm, E = 10 GPa,
// nu = 0.3, 1500 kg/m^3; 5 MPa and 100 J/m^2 break it). At t = 0 a disc of gas of 20 MPa and 20 kg/m^3, 0.1 m across, is set
// free 0.1 m from the middle of the plate. The middle is thrown first. The plate bends, cracks run through it, and its pieces
// fly on with velocities of their own.
//
// The plate is made of ten grains that bonds hold together. The gas loads their fronts, and from the step in which a crack
// has opened the faces that it leaves bare (OutsideFaces::bonded): as far as a piece stands out beside its neighbour. The
// gas does not pass between pieces, so that the run ends before one has left the plate. Nothing else acts on the plate. So
// mass, energy, and momentum of gas and pieces together are exact; and cracks take their fracture energy times their area.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/step_of_breaking.hpp"
#include "abut/solid/stepped_run.hpp"
#include "cut_cell_gas.hpp"

using namespace abut;

namespace {

constexpr double height = 0.4, thickness = 0.02;                                      // of channel and plate [m]
constexpr double young = 1e10, poisson = 0.3, density = 1500.0;                       // of the plate
constexpr double strength = 5e6, fracture_energy = 100.0;                             // of its bonds
constexpr double charge_at = -0.15, charge_radius = 0.05, tube = 0.5, margin = 0.05;  // the gas may fill [-tube, margin] [m]
constexpr int n_grains = 10, faces_across = 2, faces_along = 4;                       // of each grain
constexpr int squares = 80;                                                           // of the gas, across the channel
constexpr double last_time = 1.2e-3;                                                  // [s]
const gas::State air{1.2, 0.0, 0.0, 1e5}, charge{20.0, 0.0, 0.0, 2e7};

// The plate ------------------------------------------------------------------------------------------------------------

std::string side_of(int grain, const char* side) { return "grain" + std::to_string(grain) + "." + side; }

mesh::Mesh<2> plate() {
    std::vector<mesh::Mesh<2>> grains;
    for (int k = 0; k < n_grains; ++k)
        grains.push_back(mesh::structured_box<2>({0.0, k * height / n_grains}, {thickness, (k + 1) * height / n_grains},
                                                 {faces_across, faces_along}, mesh::CellShape::quadrangle,
                                                 "grain" + std::to_string(k)));
    return mesh::combine<2>(grains);
}

solid::SolidOptions<2> options_of_plate() {
    solid::SolidOptions<2> options;
    options.materials.assign(n_grains, {.young = young, .poisson = poisson, .density = density});
    options.kinematics.assign(n_grains, solid::Kinematics::floating);
    options.contact = contact::ContactOptions{};
    for (int k = 0; k < n_grains; ++k) {
        if (k > 0)
            options.bonds.push_back(
                {.sides = {k - 1, k}, .strength = strength, .fracture_energy = fracture_energy, .of_grains = true});
        options.boundary.traction.push_back({.group = side_of(k, "xmin"), .from_outside = true});
        if (k > 0) options.boundary.traction.push_back({.group = side_of(k, "ymin"), .from_outside = true});
        if (k + 1 < n_grains) options.boundary.traction.push_back({.group = side_of(k, "ymax"), .from_outside = true});
    }
    return options;
}

/// Faces of a grain that the gas loads, from the front to the back or from below to above.
struct Side {
    std::string group;
    solid::OutsideFaces<2> faces{};     // at the last node of the plate
    std::vector<Vector<2>> place{};     // of their middles now [m]
    std::vector<Vector<2>> motion{};    // in this step of the gas [m]
    std::vector<Vector<2>> impulse{};   // of the gas in it [N s/m]
    std::vector<double> bare_to_gas{};  // share of each that the gas touches
    [[nodiscard]] std::size_t size() const { return place.size(); }
    [[nodiscard]] bool is_bonded() const {
        return std::ranges::any_of(faces.bonded, [](double share) { return share > 0.0; });
    }
};

/// A grain, and the ends of its front.
struct Grain {
    Side front, below, above;
    [[nodiscard]] gas::Point lower() const { return end_of(front.place[0], front.place[1]); }
    [[nodiscard]] gas::Point upper() const { return end_of(front.place[front.size() - 1], front.place[front.size() - 2]); }
    static gas::Point end_of(const Vector<2>& last, const Vector<2>& next) {
        const Vector<2> beyond = 1.5 * last - 0.5 * next;
        return {beyond.x(), beyond.y()};
    }
};

/// What a wall of the gas is made of: faces, and their shares in what it bears. None: it stands still.
struct Bearers {
    std::vector<std::pair<Side*, std::size_t>> faces;
    std::vector<double> shares;
    void add(Side& side, std::size_t face, double share) {
        faces.emplace_back(&side, face);
        shares.push_back(share);
    }
    [[nodiscard]] gas::Point motion() const {
        gas::Point sum{};
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (int axis = 0; axis < 2; ++axis) sum[axis] += shares[i] * faces[i].first->motion[faces[i].second][axis];
        return sum;
    }
    void push(const gas::Point& impulse) const {
        for (std::size_t i = 0; i < faces.size(); ++i)
            faces[i].first->impulse[faces[i].second] += shares[i] * Vector<2>(impulse[0], impulse[1]);
    }
};

// Both -----------------------------------------------------------------------------------------------------------------

struct Result {
    double mass = 0.0, momentum = 0.0, energy = 0.0;  // largest defects: over those of the gas, and the burst's impulse
    double by_law = 0.0;                              // what cracks have taken, over G times their area
    int broken = 0, pieces = 0;
    double fastest = 0.0, slowest = 0.0, on_bare = 0.0;  // [m/s], impulse on faces that cracks left bare [N s/m]
    std::int64_t steps = 0, gas_steps = 0, missed = 0;
};

class Blast {
public:
    Blast() : mesh_(plate()), run_(made_run()), clock_(run_), gas_(grid(), gas::Side::wall, walls_at_rest(), start) {
        for (int k = 0; k < 4; ++k) start_[k] = gas_.sum(k);
        start_energy_ = run_.memm().pseudo_energy();
    }
    [[nodiscard]] double time() const { return clock_.time(); }

    /// One step of the gas: no longer than to the next node of the plate. False: a piece is about to leave the plate.
    bool step() {
        const double d = std::min(gas_.stable_step(), clock_.time_to_node());
        for_each_side([&](Side& side) {
            side.motion = clock_.motion(side.group, d);
            side.impulse.assign(side.size(), Vector<2>::Zero());
            side.bare_to_gas.assign(side.size(), 0.0);
        });
        const std::vector<gas::Point> before = corners();
        bearers_ = bearers();
        if (bearers_.empty()) return false;
        for_each_side([](Side& side) {
            for (std::size_t i = 0; i < side.size(); ++i) side.place[i] += side.motion[i];
        });
        const std::vector<gas::Wall> walls = walls_between(before, corners());
        const std::vector<gas::Point> impulse = gas_.step(d, walls);
        for (std::size_t i = 0; i < bearers_.size(); ++i) bearers_[i].push(impulse[i]);
        for_each_side([&](Side& side) { load(side, d); });
        const std::int64_t steps = run_.memm().steps();
        clock_.advance(d);
        ++result_.gas_steps;
        if (run_.memm().steps() != steps) at_node();
        return true;
    }

    [[nodiscard]] Result result() {
        const auto bonds = run_.solid().bonds();
        double area = 0.0;
        for (std::size_t place = 0; place < bonds.places().size(); ++place)
            if (bonds.is_broken(place)) area += bonds.places()[place].area;
        for (int k = 1; k < n_grains; ++k) result_.broken += grains_[k].below.is_bonded() ? 0 : 1;
        result_.pieces = result_.broken + 1;
        result_.by_law = area > 0.0 ? 1.0 + bonds.beyond_fracture_energy() / (fracture_energy * area) : 0.0;
        const auto motions = solid::body_motions<2>(run_.memm(), run_.solid());
        const auto [slow, fast] = std::ranges::minmax(motions, {}, [](const auto& body) { return body.velocity.x(); });
        result_.slowest = slow.velocity.x();
        result_.fastest = fast.velocity.x();
        result_.steps = run_.memm().steps();
        result_.missed = run_.solid().contact().report().missed_contacts;
        return result_;
    }

private:
    static gas::Grid grid() {
        const double size = height / squares;
        const int columns = static_cast<int>(std::lround((tube + margin) / size));
        return {{margin - columns * size, 0.0}, size, columns, squares};
    }
    static gas::State start(gas::Point x) {
        return std::hypot(x[0] - charge_at, x[1] - 0.5 * height) < charge_radius ? charge : air;
    }
    solid::SteppedRun<2> made_run() {
        auto made = std::make_unique<solid::Solid<2>>(mesh_, options_of_plate());
        const std::vector<double> rest(made->size(), 0.0);
        const double step = 0.9 * solid::step_of_breaking<2>(*made).dt;
        return {std::move(made), rest, rest, step, {.restart = 20}};
    }
    std::vector<gas::Wall> walls_at_rest() {
        for (int k = 0; k < n_grains; ++k) {
            Grain& grain = grains_.emplace_back();
            grain.front.group = side_of(k, "xmin");
            if (k > 0) grain.below.group = side_of(k, "ymin");
            if (k + 1 < n_grains) grain.above.group = side_of(k, "ymax");
        }
        for_each_side([&](Side& side) {
            side.faces = clock_.faces(side.group);
            side.place = side.faces.position;
        });
        return walls_between(corners(), corners());
    }
    template <class Use>
    void for_each_side(const Use& use) {
        for (Grain& grain : grains_)
            for (Side* side : {&grain.front, &grain.below, &grain.above})
                if (!side->group.empty()) use(*side);
    }

    /// Of the front as the gas sees it, from below to above: both ends of each grain, and the middles between its faces.
    [[nodiscard]] std::vector<gas::Point> corners() const {
        std::vector<gas::Point> corners;
        for (const Grain& grain : grains_) {
            corners.push_back(grain.lower());
            for (std::size_t i = 0; i + 1 < grain.front.size(); ++i) {
                const Vector<2> between = 0.5 * (grain.front.place[i] + grain.front.place[i + 1]);
                corners.push_back({between.x(), between.y()});
            }
            corners.push_back(grain.upper());
        }
        corners.front()[1] = 0.0;
        corners.back()[1] = height;
        return corners;
    }

    /// Of the walls between these corners; none where a piece has left the plate.
    std::vector<Bearers> bearers() {
        std::vector<Bearers> bearers;
        for (int k = 0; k < n_grains; ++k) {
            Side& front = grains_[k].front;
            for (std::size_t i = 0; i < front.size(); ++i) {
                bearers.emplace_back().add(front, i, 1.0);
                front.bare_to_gas[i] = 1.0;
            }
            if (k + 1 == n_grains) break;
            const double ahead = grains_[k + 1].lower()[0] - grains_[k].upper()[0];
            if (std::abs(ahead) > 0.9 * thickness) return {};
            Bearers& between = bearers.emplace_back();
            if (grains_[k].above.is_bonded()) {
                between.add(front, front.size() - 1, 0.5);
                between.add(grains_[k + 1].front, 0, 0.5);
            } else {
                stand_out(ahead > 0.0 ? grains_[k].above : grains_[k + 1].below, std::abs(ahead), between);
            }
        }
        return bearers;
    }
    /// Faces of a crack as far as their piece stands out beside its neighbour.
    static void stand_out(Side& side, double by, Bearers& between) {
        const double width = thickness / faces_across;
        for (std::size_t i = 0; i < side.size(); ++i) {
            const double bare = std::clamp(by - static_cast<double>(i) * width, 0.0, width);
            if (i > 0 && bare == 0.0) break;
            between.add(side, i, by > 0.0 ? bare / by : 1.0);
            side.bare_to_gas[i] = bare / width;
        }
    }
    /// Those of the front, then those that close beyond the grid.
    static std::vector<gas::Wall> walls_between(const std::vector<gas::Point>& from, const std::vector<gas::Point>& to,
                                                const std::vector<Bearers>& bearers) {
        std::vector<gas::Wall> walls;
        for (std::size_t i = 0; i + 1 < from.size(); ++i)
            walls.push_back(
                {{from[i + 1], from[i]}, {to[i + 1], to[i]}, bearers.empty() ? gas::Point{} : bearers[i].motion()});
        constexpr double far = 1.0;
        const auto beyond = [](const std::vector<gas::Point>& front) {
            return std::vector<gas::Point>{front.front(),       {front.front()[0], -far},        {far, -far},
                                           {far, height + far}, {front.back()[0], height + far}, front.back()};
        };
        const std::vector<gas::Point> outer = beyond(from), outer_to = beyond(to);
        for (std::size_t i = 0; i + 1 < outer.size(); ++i)
            walls.push_back({{outer[i], outer[i + 1]}, {outer_to[i], outer_to[i + 1]}, {}});
        return walls;
    }
    [[nodiscard]] std::vector<gas::Wall> walls_between(const std::vector<gas::Point>& from,
                                                       const std::vector<gas::Point>& to) const {
        return walls_between(from, to, bearers_);
    }

    /// The gas, and the air that is behind all of the plate.
    void load(Side& side, double d) {
        std::vector<Vector<2>> traction(side.size());
        for (std::size_t i = 0; i < side.size(); ++i) {
            const double area = side.faces.area[i];
            const Vector<2> of_air = air.p * side.bare_to_gas[i] * side.faces.normal[i];
            traction[i] = side.impulse[i] / (area * d) + of_air;
            pushed_ += side.impulse[i];
            given_ += d * area * traction[i];
            work_of_air_ += area * of_air.dot(side.motion[i]);
        }
        if (&side != &grains_.front().front && side.group.find("xmin") == std::string::npos)
            for (const Vector<2>& impulse : side.impulse) result_.on_bare += impulse.norm();
        clock_.set_traction(side.group, traction);
    }

    /// Which faces are bare, and balances.
    void at_node() {
        for_each_side([&](Side& side) { side.faces = clock_.faces(side.group); });
        if (run_.memm().steps() % 10 != 0) return;
        const auto keep = [](double& largest, double defect) { largest = std::max(largest, std::abs(defect)); };
        const double of_plate = run_.memm().pseudo_energy() + run_.solid().dissipated().total() - start_energy_;
        const double scale = charge.p * 2.0 * charge_radius * time();  // of momentum
        keep(result_.mass, gas_.sum(0) / start_[0] - 1.0);
        keep(result_.energy, (gas_.sum(3) - start_[3] - work_of_air_ + of_plate) / start_[3]);
        Vector<2> momentum = -given_;
        for (const auto& body : solid::body_motions<2>(run_.memm(), run_.solid())) momentum += body.mass * body.velocity;
        keep(result_.momentum, momentum.norm() / scale);
        keep(result_.momentum, (gas_.sum(1) + pushed_.x()) / scale);
        keep(result_.momentum, (gas_.sum(2) + pushed_.y()) / scale);
    }

    mesh::Mesh<2> mesh_;
    solid::SteppedRun<2> run_;
    solid::ClockedRun<2> clock_;
    std::vector<Grain> grains_;
    std::vector<Bearers> bearers_;  // of the walls of this step
    gas::Gas gas_;
    gas::Content start_{};
    double start_energy_ = 0.0, work_of_air_ = 0.0;
    Vector<2> pushed_ = Vector<2>::Zero(), given_ = Vector<2>::Zero();  // impulses of the gas, and with those of the air
    Result result_;
};

}  // namespace

int main() {
    Blast blast;
    while (blast.time() < last_time && blast.step()) {
    }
    const Result r = blast.result();
    std::printf("%.4f ms: %d of %d cracks are open, %d pieces fly at %.2f to %.2f m/s\n", 1e3 * blast.time(), r.broken,
                n_grains - 1, r.pieces, r.slowest, r.fastest);
    std::printf("cracks took %.4f of G times their area; the gas gave faces that they left bare %.3g N s/m\n", r.by_law,
                r.on_bare);
    std::printf("mass %.1e, momentum %.1e, energy %.1e; %lld steps, %lld of the gas, %lld contacts missed\n", r.mass,
                r.momentum, r.energy, static_cast<long long>(r.steps), static_cast<long long>(r.gas_steps),
                static_cast<long long>(r.missed));
    const bool is_exact = std::max({r.mass, r.momentum, r.energy}) < 1e-12;
    return is_exact && r.missed == 0 && r.broken > 0 && r.on_bare > 0.0 && std::abs(r.by_law - 1.0) < 0.02 ? 0 : 1;
}
