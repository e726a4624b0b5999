#pragma once
// Private to the sources of run.
#include "abut/run/drawing/markup.hpp"
#include "abut/run/files/snapshots.hpp"

namespace abut::run {

/// A picture of each snapshot, beside each other: all in one view and one scale of colours, which ends above all but the
/// highest two hundredths of the values of any of them. In 3D they are seen along parallel lines from in front, above
/// and the right. Nothing where there is no snapshot.
[[nodiscard]] Markup body_pictures(const BodyPictures& pictures);

}  // namespace abut::run
