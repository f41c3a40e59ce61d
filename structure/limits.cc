#include "structure/limits.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>

namespace blocklift::structure {

namespace {

std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};

/// Pages that the process holds in memory, bytes; 0 where it cannot be told.
double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  if (!(file >> size >> resident)) return 0;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void limit_memory(double bytes) { memory_limit = bytes; }

double memory_within_limit() {
  if (std::isinf(memory_limit)) return memory_limit;
  return std::max(0.0, memory_limit - resident_bytes());
}

}  // namespace blocklift::structure
