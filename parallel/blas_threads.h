#pragma once

namespace blocklift::parallel {

/// While it lives OpenBLAS computes with one thread, in all threads of the process: it forms its
/// sums in another order for each number of threads, and what a motion follows from must not depend
/// on that; and its own threads stand in the way of those that call it at once. Several may live at
/// once, in any threads: OpenBLAS has its threads again when the last is gone.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

}  // namespace blocklift::parallel
