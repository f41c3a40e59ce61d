#pragma once

namespace blocklift::structure {

/// While it lives OpenBLAS computes with one thread: it forms its sums in another order for each
/// number of threads, and what a motion follows from must not depend on that.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_;  ///< threads; 0 where BLAS is another library
};

/// Sets what the process may use in all, bytes, from now on; infinity to begin with.
void limit_memory(double bytes);
/// What is left of that limit, bytes, by what the process holds now; never negative.
double memory_within_limit();

}  // namespace blocklift::structure
