#pragma once

#include <optional>

#include "dynamics/marine/loads/pressure_boxes.h"
#include "dynamics/marine/loads/surface_range.h"

namespace blocklift::dynamics {

/// A hull's surface in two parts, for the pressure of given waves.
///
/// Panels that are curved, or small, stay as they are: the pressure counts as linear over each of
/// their triangles. Flat parts are joined and divided anew into faces to the scale of the waves, on
/// which the pressure is integrated by three points a piece (calc_force of HullForce). How long a
/// face may be is what lets the water's surface sag by no more than `face_sag` of the waves'
/// amplitude between its corners, (k d)^2/8 in the mean over the energy of a sea's components. As
/// pressure vanishes at the surface, the square of this, below 1 %, is the error's share in what
/// the strip between the surface and still water adds; below, three points leave about 3e-4 (k d)^3
/// of the waves' pressure, 2e-4.
///
/// Where waves are so short that faces would be about as small as panels, all are panels.
/// Immutable.
class WaveSurface {
 public:
  struct Part {
    TriangleTree tree;
    PressureBoxes boxes;
  };
  static constexpr double face_sag = 0.08;       ///< of the amplitude
  static constexpr double box_tolerance = 2e-4;  ///< of the waves' pressure, in boxes taken whole
  /// In a sea of many components boxes of panels may leave this share of what panels leave
  /// themselves, which is (k d)^2/8 of each component, in the square mean; where that is more than
  /// `box_tolerance`.
  static constexpr double box_share = 0.25;
  static constexpr std::size_t faces_in_leaf = 4;

  WaveSurface(const Hull& hull, const WaveField& waves);

  /// Between what heights the waves stand about the hull.
  const SurfaceRange& range() const { return range_; }
  const std::optional<Part>& panels() const { return panels_; }
  const std::optional<Part>& faces() const { return faces_; }

 private:
  SurfaceRange range_;
  std::optional<Part> panels_, faces_;
};

/// Length over which the surface of these waves sags by `sag` of their amplitude, m; infinite for
/// waves without height.
double calc_sagging_length(const WaveField& waves, double sag);

}  // namespace blocklift::dynamics
