#pragma once

/// What the program's exit codes say.
namespace blocklift::pipeline::exit_code {

inline constexpr int done = 0;         ///< done, and the lift passes its checks
inline constexpr int run_failed = 1;   ///< the run failed
inline constexpr int wrong_input = 2;  ///< the input is wrong; nothing was run or written
inline constexpr int lift_fails = 3;   ///< done, and the lift fails a check

}  // namespace blocklift::pipeline::exit_code
