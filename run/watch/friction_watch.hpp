#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "abut/run/scene.hpp"
#include "abut/run/values/body_sliding.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// Measures by parts of a run how fully bodies that slide past each other rub: of the bodies as a whole, since single faces
/// that vibrate stick and slide in turn, each by its law, while the body glides on less than mu N. Friction and slip are
/// sums of vectors within a window, and of their parts along the slip over the windows of a part: a slip that turns takes
/// nothing from them. Windows in which bodies hardly move past each other do not count. Nor do parts in which
/// friction loses far less or more than along the slip, as where faces stick and swing, or slide to and fro, and those in
/// which a slip that has just begun or turned back stretches the springs of faces that stick, as in an oblique impact of
/// balls.
template <int Dim>
class FrictionWatch {
public:
    static constexpr std::int64_t records_per_window = 5, windows_per_part = 5;
    /// Speed past each other, over the largest in the run so far, from which on bodies slide [-].
    static constexpr double sliding_speed = 0.1;
    /// Friction of a body that slides over its limit, from which on it is right [-].
    static constexpr double enough_friction = 0.9;
    /// Loss by friction over that of full friction along the slip, in parts in which bodies slide one way [-].
    static constexpr double least_loss = 0.4, most_loss = 1.5;
    /// Work of full friction, over the largest energy of springs by which faces stick in the run, after which a slip that
    /// began or turned back slides [-]. Springs that are turned over by a steady force take 4 of it.
    static constexpr double work_of_springs = 6.0;

    /// `scene` and `options` must outlive it.
    FrictionWatch(const Scene<Dim>& scene, const RunOptions& options) : scene_(scene), options_(options) {}

    /// A record; the largest speed until then was `speed` [m/s].
    void record(const dynamics::LedgerEntry<Dim>& entry, std::span<const solid::BodyImpulse<Dim>> pairs, double speed);

    /// The pair of bodies that slid so for the longest time.
    [[nodiscard]] WeakFriction weakest() const;

    /// Memory of a checkpoint.
    static auto fields(auto& self) {
        return std::tie(self.records_, self.began_, self.dissipated_, self.work_, self.stretched_, self.pairs_);
    }

private:
    using Bodies = std::array<std::int32_t, 2>;
    /// Windows of a part in which a pair slides.
    struct Part {
        double work = 0.0;  // that full friction would have done; at the end since the slip began or turned back [J]
        double seconds = 0.0;
        double found = 0.0, limit = 0.0;  // impulse of friction along the slip, and mu times the normal one [N s]

        static auto fields(auto& self) { return std::tie(self.work, self.seconds, self.found, self.limit); }
    };
    struct Pair {
        Vector<Dim> friction = Vector<Dim>::Zero(), slip = Vector<Dim>::Zero();  // until the last window ended
        double rubbing = 0.0;                                                    // the same
        Part part;
        Vector<Dim> part_slip = Vector<Dim>::Zero();
        Vector<Dim> last_slip = Vector<Dim>::Zero();  // of the last part that slid
        double work = 0.0;                            // Part::work of that
        std::vector<Part> weak;                       // with too little friction

        static auto fields(auto& self) {
            return std::tie(self.friction, self.slip, self.rubbing, self.part, self.part_slip, self.last_slip, self.work,
                            self.weak);
        }
    };
    void end_window(std::span<const solid::BodyImpulse<Dim>> pairs, double seconds, double speed);
    void end_part(double dissipated);
    /// The least mu that laws give two bodies [-]; 0: none, or one that is not known.
    [[nodiscard]] double coefficient(Bodies bodies) const;

    const Scene<Dim>& scene_;
    const RunOptions& options_;
    std::map<Bodies, Pair> pairs_;
    std::int64_t records_ = 0;
    double began_ = 0.0;       // when the window did [s]
    double dissipated_ = 0.0;  // until the part began [J]
    double stretched_ = 0.0;   // the largest energy of springs by which faces stick, in the run [J]
    double work_ = 0.0;        // that full friction would have done in this part [J]
};

}  // namespace abut::run
