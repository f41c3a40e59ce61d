// Fatigue by an installed structure library: the range after which a detail category is named is
// borne two million times, so that a million such cycles do half of the damage.
#include <cmath>
#include <cstdio>

#include "structure/practice/fatigue.h"

int main() {
  using namespace blocklift::structure;
  const FatigueCurve curve = fatigue_curve("D");
  const double sum = damage({{.range = curve.class_range, .mean = 0, .count = 1e6}}, curve);
  std::printf("damage %.6f, reference 0.5\n", sum);
  return std::abs(sum - 0.5) < 1e-3 ? 0 : 1;
}
