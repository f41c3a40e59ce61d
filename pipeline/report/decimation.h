#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace blocklift::pipeline {

/// Which samples of a series a drawing needs, so that no peak is lost.
///
/// The samples are divided into `buckets` stretches of equal count (each as wide as a pixel or
/// less) and of each the smallest and the largest are kept, in order of time, together with the
/// very first and the very last. A line through the kept samples covers the same pixels as one
/// through all. NaN is never the smallest nor the largest; a bucket of NaN keeps its first sample.
///
/// @return rising indices into `values`; all of them if there are no more than 2 * buckets.
std::vector<std::size_t> indices_to_draw(std::span<const double> values, std::size_t buckets);

/// About `count` indices spread evenly over `size` samples, the first and the last among them.
std::vector<std::size_t> evenly_spread_indices(std::size_t size, std::size_t count);

}  // namespace blocklift::pipeline
