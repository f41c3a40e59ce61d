#pragma once

#include <functional>

namespace blocklift::dynamics {

/// Calls work(i) for 0 <= i < count, shared out among threads (0: one a core). The first exception
/// thrown by any of them is thrown on.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

}  // namespace blocklift::dynamics
