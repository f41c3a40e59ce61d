#pragma once

#include <filesystem>

namespace blocklift::pipeline::test {

/// Writes results of a load of 8 t that hangs level on two upright slings, 4 m to both sides of its
/// frame's origin, for 60 s: R1 bears 60 %, so that the centre of mass is at y = 0.8 m (R1 is at
/// +4 m). From 10 s on both swing by 5 % with a period of 4 s and 1 % of critical damping.
void write_sample_lift(const std::filesystem::path& folder);

/// Tension of R1 of these results in motion, N.
double sample_tension(double time);

}  // namespace blocklift::pipeline::test
