#pragma once
// Parts that share the work of contact, as threads of this program, and results as bits.
#include <algorithm>
#include <atomic>
#include <barrier>
#include <bit>
#include <concepts>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/sharing.hpp"
#include "abut/contact/step.hpp"

namespace abut::test {

/// Where the threads meet. A thread that ends is waited for no longer; who gathers after that is told.
struct Meeting {
    explicit Meeting(int n_parts) : n(n_parts), bytes(static_cast<std::size_t>(n_parts)), barrier(n_parts) {}

    int n;
    std::vector<std::vector<std::byte>> bytes;  // of each part, in this call
    std::atomic<bool> has_lost_one = false;
    std::barrier<> barrier;
};

class ThreadPart final : public contact::Sharing {
public:
    ThreadPart(Meeting& meeting, int part) : meeting_(meeting), part_(part) {}

    [[nodiscard]] int part() const override { return part_; }
    [[nodiscard]] int n_parts() const override { return meeting_.n; }
    [[nodiscard]] std::span<const std::byte> gather(std::span<const std::byte> mine) override {
        if (n_gathers++ < sizes_.size()) sizes_[n_gathers - 1] = mine.size();
        meeting_.bytes[static_cast<std::size_t>(part_)].assign(mine.begin(), mine.end());
        meeting_.barrier.arrive_and_wait();
        if (meeting_.has_lost_one) throw std::runtime_error("a part has ended, and the others wait for it");
        all_.clear();
        for (const auto& of_part : meeting_.bytes) all_.insert(all_.end(), of_part.begin(), of_part.end());
        meeting_.barrier.arrive_and_wait();
        return all_;
    }

    std::size_t n_gathers = 0;
    /// Of this part in its first calls.
    [[nodiscard]] std::span<const std::size_t> sizes() const {
        return std::span(sizes_).first(std::min(n_gathers, sizes_.size()));
    }

private:
    Meeting& meeting_;
    int part_;
    std::vector<std::size_t> sizes_ = std::vector<std::size_t>(64);
    std::vector<std::byte> all_;
};

/// What body(part) gives on each of n parts, each a thread.
template <class Body>
auto on_parts(int n, const Body& body) {
    using Result = decltype(body(std::declval<ThreadPart&>()));
    Meeting meeting(n);
    std::vector<Result> results(static_cast<std::size_t>(n));
    std::vector<std::exception_ptr> errors(results.size());
    {
        std::vector<std::jthread> threads;
        for (int p = 0; p < n; ++p)
            threads.emplace_back([&, p] {
                ThreadPart part(meeting, p);
                try {
                    results[static_cast<std::size_t>(p)] = body(part);
                } catch (...) {
                    errors[static_cast<std::size_t>(p)] = std::current_exception();
                    meeting.has_lost_one = true;
                }
                meeting.barrier.arrive_and_drop();
            });
    }
    for (const auto& error : errors)
        if (error) std::rethrow_exception(error);
    return results;
}

/// Numbers as they are, -0 and NaN included.
class Bits {
public:
    void add(double value) { bits_.push_back(std::bit_cast<std::uint64_t>(value)); }
    template <std::integral Integer>
    void add(Integer value) {
        bits_.push_back(static_cast<std::uint64_t>(value));
    }
    void add(contact::Face face) { add(static_cast<std::int32_t>(face)); }
    template <int Rows, int Cols>
    void add(const SmallMatrix<Rows, Cols>& value) {
        for (const double number : value) add(number);
    }
    void add(const std::vector<std::byte>& bytes) { add_all(bytes); }
    void add(std::byte value) { add(static_cast<std::uint8_t>(value)); }
    template <class Values>
    void add_all(const Values& values) {
        add(values.size());
        for (const auto& value : values) add(value);
    }

    template <int Dim>
    void add(const contact::PairStep<Dim>& pair) {
        add(pair.face_1), add(pair.face_2), add(pair.normal), add(pair.gap_0), add(pair.gap_1), add(pair.area);
        add(pair.normal_force), add(pair.force), add(pair.events), add(pair.active_share), add(pair.compression);
    }
    void add(const contact::StepReport& report) {
        add(report.events), add(report.compression), add(report.most_compressed), add(report.sliding_ratio);
        add(report.slipped_pairs), add(report.slipped_compression), add(report.tilted_pairs), add(report.correction);
    }
    template <int Dim>
    void add(const contact::ContactStep<Dim>& step) {
        add_all(step.faces), add_all(step.mean_correction.values()), add_all(step.mean_gradient.values());
        add_all(step.mean_normal_force.values()), add_all(step.pairs), add(step.energy), add(step.report);
    }
    template <int Dim>
    void add(const contact::NodalStep<Dim>& step) {
        add_all(step.nodes), add_all(step.gradient), add_all(step.pairs), add(step.report);
        add(step.energy_0), add(step.energy), add(step.work);
        for (const auto& body : step.bodies) add(body.body), add(body.force), add(body.moment), add(body.work);
        for (const auto& pair : step.body_pairs)
            add(pair.body_1), add(pair.body_2), add(pair.active_pairs), add(pair.force), add(pair.normal_force);
    }
    void add(const contact::CandidateReport& report) {  // all but the times
        add(report.searches), add(report.orderings), add(report.box_pairs), add(report.neighbours), add(report.both_rigid);
        add(report.not_facing), add(report.too_far_apart), add(report.candidates), add(report.candidates_max);
        add(report.motion);
    }

    friend bool operator==(const Bits&, const Bits&) = default;

private:
    std::vector<std::uint64_t> bits_;
};

/// What a part has seen of a run.
struct PartResult {
    Bits bits;
    std::size_t n_gathers = 0;
    std::int64_t active_pairs = 0;  // the most in a step
};

}  // namespace abut::test
