#include "parallel/threads.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "parallel/blas_threads.h"

namespace blocklift::parallel {

int usable_threads() {
  if (const char* given = std::getenv("OMP_NUM_THREADS")) {
    const int threads = std::atoi(given);
    if (threads > 0) return threads;
  }
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

namespace {

void deal_out(int count, int batch_size, int threads,
              const std::function<void(int first, int count)>& work) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  int failed = count;  // first number of the lowest batch that has failed
  std::mutex failing;
  const auto run = [&] {
    int first = 0;
    try {
      for (first = next.fetch_add(batch_size); first < count; first = next.fetch_add(batch_size))
        work(first, std::min(batch_size, count - first));
    } catch (...) {
      // Batches below this one have all been dealt out before it: the lowest that fails is always
      // known.
      const std::lock_guard lock(failing);
      if (first < failed) {
        failed = first;
        failure = std::current_exception();
      }
      next = count;
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(run);
  run();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

void in_batches(int count, int batch_size, int threads,
                const std::function<void(int first, int count)>& work) {
  if (threads <= 0) threads = usable_threads();
  threads = std::min(threads, (count + batch_size - 1) / batch_size);
  std::optional<OneBlasThread> for_each_of_several;
  if (threads > 1) for_each_of_several.emplace();
  deal_out(count, batch_size, threads, work);
}

void side_by_side(const std::function<void()>& first, const std::function<void()>& second) {
  deal_out(2, 1, std::min(2, usable_threads()),
           [&](int which, int) { which == 0 ? first() : second(); });
}

void for_each(int count, int threads, const std::function<void(int)>& work) {
  in_batches(count, 1, threads, [&](int i, int) { work(i); });
}

}  // namespace blocklift::parallel
