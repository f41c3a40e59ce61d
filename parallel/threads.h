#pragma once

#include <functional>

/// Work that is dealt out among threads, for dynamics and structure alike.
namespace blocklift::parallel {

/// Threads that work is dealt out to where a function is not told how many: the variable
/// OMP_NUM_THREADS, which BLAS follows too, otherwise as many as the machine has.
int usable_threads();

/// Deals batches of the numbers 0 .. count - 1 out to threads: work(first, how many), in no order.
/// Where several take part, BLAS computes with one thread for each (OneBlasThread).
/// The exception of the lowest batch that throws ends all and is thrown on, whatever the threads'
/// order.
/// @param threads 0: as many as are usable.
void in_batches(int count, int batch_size, int threads,
                const std::function<void(int first, int count)>& work);

/// Two works at the same time if two threads are usable. Exceptions and BLAS as above.
void side_by_side(const std::function<void()>& first, const std::function<void()>& second);

/// Deals the numbers 0 .. count - 1 out one by one: work(i). Exceptions and threads as above.
void for_each(int count, int threads, const std::function<void(int)>& work);

}  // namespace blocklift::parallel
