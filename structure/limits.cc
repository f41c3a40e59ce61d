#include "structure/limits.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>

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

int usable_threads() {
  if (const char* given = std::getenv("OMP_NUM_THREADS")) {
    const int threads = std::atoi(given);
    if (threads > 0) return threads;
  }
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void limit_memory(double bytes) { memory_limit = bytes; }

double memory_within_limit() {
  if (std::isinf(memory_limit)) return memory_limit;
  return std::max(0.0, memory_limit - resident_bytes());
}

}  // namespace blocklift::structure
