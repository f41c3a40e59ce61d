#pragma once

#include <array>

namespace blocklift::structure {

/// Where a square of plating lies. At corners (lugs' roots, toes, corners of openings) linear
/// elasticity knows no limit of the stress: what is felt there belongs to the square's size.
enum class SquareSite {
  field,          ///< away from corners
  corner,         ///< near a corner, in the plate's own material
  welded_corner,  ///< near a corner, with a side on a joint with another plate or a stiffener
};

inline constexpr std::array<SquareSite, 3> square_sites{SquareSite::field, SquareSite::corner,
                                                        SquareSite::welded_corner};

/// "away from corners", "at corners", "at corners beside welds".
constexpr const char* words_of(SquareSite site) {
  switch (site) {
    case SquareSite::field:
      return "away from corners";
    case SquareSite::corner:
      return "at corners";
    case SquareSite::welded_corner:
      return "at corners beside welds";
  }
  return "";
}

/// One value of each site.
template <class Value>
class BySite {
 public:
  Value& operator[](SquareSite site) { return values_[static_cast<std::size_t>(site)]; }
  const Value& operator[](SquareSite site) const { return values_[static_cast<std::size_t>(site)]; }

 private:
  std::array<Value, square_sites.size()> values_{};
};

}  // namespace blocklift::structure
