#include "abut/solid/contact/corner_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/contact/frame_motion.hpp"
#include "abut/solid/operator/lanes.hpp"

namespace abut::solid {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

}  // namespace

void CornerRows::append_face(std::int32_t cell, std::size_t body, std::span<const CornerWeights> corners) {
    const auto first = std::ssize(others_);
    CornerRow row{.cell = cell, .body = static_cast<std::int32_t>(body), .first = static_cast<std::int32_t>(first)};
    for (const CornerWeights& corner : corners) {
        double amplification = corner.own;
        for (const auto& [other, norm] : corner.others) {
            amplification += norm;
            const auto at = std::find(others_.begin() + first, others_.end(), other);
            if (at == others_.end()) {
                others_.push_back(other);
                norms_.push_back(norm);
            } else {
                double& known = norms_[static_cast<std::size_t>(at - others_.begin())];
                known = std::max(known, norm);
            }
        }
        row.sum = std::max(row.sum, corner.sum);
        row.missing = std::max(row.missing, corner.missing);
        row.amplification = std::max(row.amplification, amplification);
    }
    row.last = static_cast<std::int32_t>(others_.size());
    row.norm_sum = std::accumulate(norms_.begin() + first, norms_.end(), 0.0);
    rows_.push_back(row);
}

template <int Dim>
void CornerMotion<Dim>::begin(std::vector<std::int32_t> faces, std::vector<double> radius, std::span<const Vector<Dim>> q,
                              std::span<const BodyFrame<Dim>> frames) {
    faces_ = std::move(faces);
    arm_ = std::move(radius);
    slack_.assign(faces_.size(), 0.0);
    in_space_.assign(faces_.size(), 0.0);
    in_frame_.assign(faces_.size(), 0.0);
    amplification_ = travelled_ = fastest_path_ = farthest_travelled_ = farthest_path_ = 0.0;
    farthest_ = {};
    frames_.assign(frames.begin(), frames.end());
    turn_.clear();
    for (const BodyFrame<Dim>& frame : frames) turn_.push_back(frame.turn);
    for (std::vector<double>* of_bodies : {&radius_, &path_}) of_bodies->assign(frames.size(), 0.0);
    q_.assign(q.begin(), q.end());
    p_.clear();
    arm_sum_.clear();
    body_.clear();
    amplifications_.clear();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const CornerRow& row = (*rows_)[faces_[i]];
        body_.push_back(row.body);
        amplifications_.push_back(row.amplification);
        amplification_ = std::max(amplification_, row.amplification);
        p_.push_back(in_frame(row, q, frames));
        double& of_body = radius_[row.body];
        of_body = std::max(of_body, p_.back().norm() + arm_[i]);
        const Vector<Dim> x = rest_[row.cell] + q[row.cell];
        double sum = 0.0;
        for (std::int32_t k = row.first; k < row.last; ++k) {
            const std::int32_t other = rows_->others()[k];
            sum += rows_->norms()[k] * (rest_[other] + q[other] - x).norm();
        }
        arm_sum_.push_back(sum);
    }
}

template <int Dim>
void CornerMotion<Dim>::set_slack(std::vector<double> slack) {
    for (std::size_t i = 0; i < slack.size(); ++i) in_space_[i] += slack_[i] - slack[i];
    slack_ = std::move(slack);
}

template <int Dim>
void CornerMotion<Dim>::advance(std::span<const BodyFrame<Dim>> frames, double cell_motion) {
    // Of any corner from its place in the frame where it began.
    const double deformed = farthest_.in_frame + amplification_ * (travelled_ - farthest_travelled_);
    if (std::isfinite(cell_motion) && std::isfinite(deformed)) {
        advance_paths(frames, deformed);
        travelled_ += cell_motion;
    } else {
        std::ranges::fill(in_space_, unknown);
        std::ranges::fill(in_frame_, unknown);
        farthest_ = {unknown, unknown};
    }
    frames_.assign(frames.begin(), frames.end());
}

template <int Dim>
void CornerMotion<Dim>::advance_paths(std::span<const BodyFrame<Dim>> frames, double deformed) {
    double fastest = 0.0;
    for (std::size_t body = 0; body < frames_.size(); ++body) {
        const double moved = (frames[body].centre - frames_[body].centre).norm() +
                             turned_by<Dim>(frames[body].turn - frames_[body].turn) * (radius_[body] + deformed);
        path_[body] += moved;
        fastest = larger(fastest, moved);
    }
    fastest_path_ += fastest;
}

template <int Dim>
FarthestMotion CornerMotion<Dim>::bound_of_all() const {
    FarthestMotion all;
    for (std::int32_t i = 0; i < std::ssize(faces_); ++i) {
        const auto [in_space, in_frame] = bound(i);
        all.in_space = larger(all.in_space, in_space);
        all.in_frame = larger(all.in_frame, in_frame);
    }
    return all;
}

template <int Dim>
bool CornerMotion<Dim>::is_within(const FarthestMotion& allowed) {
    const double stretched = amplification_ * (travelled_ - farthest_travelled_);
    const FarthestMotion quick{farthest_.in_space + (fastest_path_ - farthest_path_) + stretched,
                               farthest_.in_frame + stretched};
    if (quick.is_within(allowed)) return true;
    farthest_ = bound_of_all();
    farthest_travelled_ = travelled_;
    farthest_path_ = fastest_path_;
    return farthest_.is_within(allowed);
}

template <int Dim>
std::vector<std::int32_t> CornerMotion<Dim>::beyond(const FarthestMotion& allowed) const {
    std::vector<std::int32_t> beyond;
    for (std::int32_t i = 0; i < std::ssize(faces_); ++i)
        if (!bound(i).is_within(allowed)) beyond.push_back(i);
    return beyond;
}

template <int Dim>
void CornerMotion<Dim>::look(std::span<const std::int32_t> which, std::span<const Vector<Dim>> q,
                             std::span<const BodyFrame<Dim>> frames) {
    parallel_each(
        std::ssize(which),
        [&](std::ptrdiff_t k) {
            const std::int32_t i = which[k];
            const FarthestMotion found = of_face(i, q, frames);
            set_in_space(i, found.in_space);
            in_frame_[i] = found.in_frame - stretched(i);
        },
        256);
}

template <int Dim>
FarthestMotion CornerMotion<Dim>::until(std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames) const {
    FarthestMotion all;
    for (std::int32_t i = 0; i < std::ssize(faces_); ++i) {
        const auto [in_space, in_frame] = of_face(i, q, frames);
        all.in_space = larger(all.in_space, in_space - slack_[i]);
        all.in_frame = larger(all.in_frame, in_frame);
    }
    return all;
}

/// Position of the cell of a face.
template <int Dim>
Vector<Dim> CornerMotion<Dim>::in_frame(const CornerRow& row, std::span<const Vector<Dim>> q,
                                        std::span<const BodyFrame<Dim>> frames) const {
    const BodyFrame<Dim>& frame = frames[row.body];
    return frame.turn.transpose() * (rest_[row.cell] + (q[row.cell] - frame.centre));
}

template <int Dim>
FarthestMotion CornerMotion<Dim>::of_face(std::int32_t i, std::span<const Vector<Dim>> q,
                                          std::span<const BodyFrame<Dim>> frames) const {
    const CornerRow& row = (*rows_)[faces_[i]];
    const std::int32_t* const others = rows_->others().data();
    const double* const norms = rows_->norms().data();
    const Vector<Dim>*const from = q_.data(), *const to = q.data();
    const auto moved = [&](std::int32_t c) { return load_packed<Dim>(to[c]) - load_packed<Dim>(from[c]); };
    const Lanes<Dim> own = moved(row.cell);
    Lanes<Dim> squares;  // by direction
    for (std::int32_t k = row.first; k < row.last; ++k) {
        const Lanes<Dim> relative = moved(others[k]) - own;
        squares.r += norms[k] * relative.r * relative.r;
    }
    const double turned = turned_by<Dim>(frames[row.body].turn - turn_[row.body]),
                 of_own = (in_frame(row, q, frames) - p_[i]).norm(),
                 stretched = std::sqrt(row.norm_sum * unload<Dim>(squares).sum()) + turned * arm_sum_[i];
    return {std::sqrt(dot(own, own)) + turned * arm_[i] + row.missing * of_own + stretched, row.sum * of_own + stretched};
}

template class CornerMotion<2>;
template class CornerMotion<3>;

}  // namespace abut::solid
