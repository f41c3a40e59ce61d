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

// By threads of the standard library and not TBB's, which deal.II brings: the caller says how many
// there are, the exception that is thrown on does not depend on their order, and the dynamics need
// nothing that the structure's libraries bring.
void in_batches(int count, int batch_size, int threads,
                const std::function<void(int first, int count)>& work) {
  if (threads <= 0) threads = usable_threads();
  threads = std::min(threads, (count + batch_size - 1) / batch_size);
  // Not for some of the works alone: sums would depend on what goes on beside them, and when.
  std::optional<OneBlasThread> for_each_of_several;
  if (threads > 1) for_each_of_several.emplace();
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

void side_by_side(const std::function<void()>& first, const std::function<void()>& second) {
  in_batches(2, 1, 0, [&](int which, int) { which == 0 ? first() : second(); });
}

void for_each(int count, int threads, const std::function<void(int)>& work) {
  in_batches(count, 1, threads, [&](int i, int) { work(i); });
}

}  // namespace blocklift::parallel
