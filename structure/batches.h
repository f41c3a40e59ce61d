#pragma once

#include <functional>

namespace blocklift::structure {

/// Deals batches of the numbers 0 .. count - 1 out to threads: work(first, how many), in no order.
/// The exception of the lowest batch that throws ends all and is thrown on, whatever the threads'
/// order.
/// @param threads 0: as many as the machine has.
void in_batches(int count, int batch_size, int threads,
                const std::function<void(int first, int count)>& work);

}  // namespace blocklift::structure
