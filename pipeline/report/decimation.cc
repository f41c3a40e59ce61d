#include "pipeline/report/decimation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace blocklift::pipeline {

std::vector<std::size_t> indices_to_draw(std::span<const double> values, std::size_t buckets) {
  const std::size_t size = values.size();
  std::vector<std::size_t> kept;
  if (size <= 2 * buckets || buckets == 0) {
    kept.resize(size);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  kept.push_back(0);
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    const std::size_t begin = bucket * size / buckets;
    const std::size_t end = (bucket + 1) * size / buckets;
    std::size_t smallest = begin;
    std::size_t largest = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (std::isnan(values[smallest]) || values[i] < values[smallest]) smallest = i;
      if (std::isnan(values[largest]) || values[i] > values[largest]) largest = i;
    }
    kept.push_back(std::min(smallest, largest));
    kept.push_back(std::max(smallest, largest));
  }
  kept.push_back(size - 1);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

std::vector<std::size_t> evenly_spread_indices(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices;
  if (size <= count || count < 2) {
    indices.resize(size);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
  }
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * (size - 1) / (count - 1));
  return indices;
}

}  // namespace blocklift::pipeline
