#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace blocklift::structure {

/// The labels from, from + step, ... up to `to` that are known, ascending. A range may reach to the
/// largest number that there is: it takes no longer than looking at all that is known.
/// @param step 1 or more.
inline std::vector<long> known_labels(const std::unordered_map<long, int>& known, long from,
                                      long to, long step = 1) {
  std::vector<long> labels;
  if (to < from) return labels;
  if (static_cast<unsigned long>((to - from) / step) < known.size()) {
    for (long label = from; label <= to; label += step)
      if (known.count(label) > 0) labels.push_back(label);
    return labels;
  }
  for (const auto& entry : known)
    if (entry.first >= from && entry.first <= to && (entry.first - from) % step == 0)
      labels.push_back(entry.first);
  std::sort(labels.begin(), labels.end());
  return labels;
}

}  // namespace blocklift::structure
