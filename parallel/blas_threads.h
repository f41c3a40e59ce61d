#pragma once

namespace blocklift::parallel {

/// While it lives OpenBLAS computes with one thread, in all threads of the process: it forms its
/// sums in another order for each number of threads, and what a motion follows from must not depend
/// on that; and its own threads stand in the way of those that call it at once.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_;  ///< threads; 0 where BLAS is another library
};

}  // namespace blocklift::parallel
