#pragma once

#include <vector>

#include "dynamics/simulation/history.h"

namespace blocklift::pipeline {

/// The path along which a rope is drawn: its points, and between them the edges that it touches in
/// at least half of the samples, each where it does so on average.
std::vector<dynamics::BodyPoint> drawn_path(const dynamics::LiftSystem& system, std::size_t rope,
                                            const dynamics::History& history);

}  // namespace blocklift::pipeline
