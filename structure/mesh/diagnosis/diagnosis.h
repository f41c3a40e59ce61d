#pragma once

#include <string>
#include <vector>

#include "structure/mesh/mass_properties.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How a finding bears on a lift.
enum class Severity {
  note,     ///< worth knowing
  warning,  ///< probably not meant
  error     ///< cannot be lifted like this
};

/// What the doctor sees of one kind.
struct Finding {
  std::string kind;  ///< such as "free edges"
  Severity severity = Severity::note;
  std::string text;  ///< one sentence with the count
  int count = 0;
  std::vector<long> labels;     ///< the user's numbers of the first ten cells or vertices
  std::vector<Vector3> places;  ///< of all of them, m
};

/// Limits beyond which a shape is called bad.
struct DiagnosisOptions {
  double duplicate_distance = 0;  ///< m; 0: a millionth of the mesh's diagonal
  double aspect_ratio = 20;       ///< longest edge over height
  double warp = 0.35;             ///< angle between a quadrangle's two triangles, rad (20 degrees)
  double least_angle = 0.35;      ///< at a corner, rad
  double greatest_angle = 2.8;    ///< rad (160 degrees)
};

struct Diagnosis {
  MeshMass mass;
  std::vector<MeshMass> groups;  ///< by group; the last is the point masses
  double plate_area = 0;         ///< m^2
  double beam_length = 0;        ///< m
  int parts = 0;                 ///< that hang together
  int free_edges = 0;
  double free_edge_length = 0;  ///< m
  std::vector<Finding> findings;

  const Finding* find(const std::string& kind) const;
};

/// Looks a mesh over before it is lifted. Kinds of findings:
///
/// "free edges", "unconnected parts", "parts that touch" (find_touching_parts), "unused vertices",
/// "duplicated vertices" (closer than the distance and joined by nothing), "duplicated shells",
/// "duplicated beams", "shells without thickness", "shells without area", "folded shells", "slender
/// shells", "warped shells", "skewed shells", "opposed normals" (of two shells that alone share an
/// edge and fold by less than 45 degrees), "vertices free to move" and "vertices free to turn"
/// (nothing that meets there resists a direction), "beams free to spin", "beams free to slide",
/// "beams by figures" (whose shear stress is an estimate: is_shear_estimated), "springs to the
/// ground" (a lifted block has none), "materials without density".
Diagnosis diagnose(const Mesh& mesh, const DiagnosisOptions& options = {});

}  // namespace blocklift::structure
