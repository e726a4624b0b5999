#pragma once
// Private to the layer.
#include "abut/run/observer.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/values/checkpoint.hpp"

namespace abut::run {

/// Takes all steps of a run, from its start or from a checkpoint on, tells the observer of them and fills in Start::result,
/// as told of `simulate`.
template <int Dim>
void take_steps(Start<Dim>& start, Observer<Dim>& observer, const Checkpoint* from);

}  // namespace abut::run
