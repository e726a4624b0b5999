#pragma once
#include <vector>

#include "abut/run/steps/simulation.hpp"

/// Records of waves at some places, and the speed of a wave between two of them.
namespace abut::studies {

/// Values at equal steps of time, from t = 0 on.
struct Trace {
    double dt = 0.0;  ///< [s]
    std::vector<double> values;
};

/// The trace between two times, faded in and out by half a cosine over `taper` [s] outside of them; 0 elsewhere.
[[nodiscard]] Trace windowed(const Trace& trace, double from, double to, double taper);

/// How much later b has what a has [s]: where their correlation is largest, between samples by a parabola.
[[nodiscard]] double correlation_delay(const Trace& a, const Trace& b);

/// How much later b is in phase than a at one frequency [Hz], whole periods chosen so that it is nearest to `expected` [s].
[[nodiscard]] double phase_delay(const Trace& a, const Trace& b, double frequency, double expected);

/// Second derivative of a Gaussian, its largest value 1 at t = 0, its spectrum largest at `frequency` [Hz].
[[nodiscard]] double ricker(double t, double frequency);

/// Position where a displacement is recorded and which component.
template <int Dim>
struct Receiver {
    Vector<Dim> position;
    Vector<Dim> direction;  ///< unit
};

/// Looks on and keeps one component of the displacement of the cells that are nearest to the receivers, at every step.
template <int Dim>
class Seismograph : public run::Observer<Dim> {
public:
    explicit Seismograph(std::vector<Receiver<Dim>> receivers) : receivers_(std::move(receivers)) {}

    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override;
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>&) override;

    [[nodiscard]] std::size_t size() const { return receivers_.size(); }
    [[nodiscard]] const Trace& trace(std::size_t receiver) const { return traces_[receiver]; }
    /// Centre of the cell that was taken.
    [[nodiscard]] const Vector<Dim>& position(std::size_t receiver) const { return positions_[receiver]; }

private:
    std::vector<Receiver<Dim>> receivers_;
    std::vector<std::size_t> cells_;
    std::vector<Vector<Dim>> positions_;
    std::vector<Trace> traces_;
};

}  // namespace abut::studies
