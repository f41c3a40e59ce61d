#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/fields/fields.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Plate panel that is held along its edges: sides a and b, thickness t, m.
struct PanelSize {
  double a = 0;  ///< along the first in-plane axis
  double b = 0;  ///< along the second
  double thickness = 0;
};

/// How many edges lie free: of a girder's web whose lower edge nothing holds, one, for example.
struct FreeEdges {
  int along_a = 0;  ///< of the two edges of length a
  int along_b = 0;
};

/// Membrane stress of a panel. Normal stresses vary linearly across the side that they act on.
struct PanelStress {
  double s11 = 0;           ///< mean along the first axis, tension positive, Pa
  double s22 = 0;           ///< mean along the second
  double s12 = 0;           ///< mean shear
  double s11_gradient = 0;  ///< of s11 across b: it is s11 +- s11_gradient at the edges
  double s22_gradient = 0;  ///< of s22 across a
};

/// Buckling coefficient k of a panel under compression along its side `length`, spread over the
/// side `width`, the stress falling linearly from 1 at one end of the width to psi at the other;
/// sigma_E = k pi^2 E / (12 (1 - nu^2)) (t / width)^2. By the edges of `length` that lie free:
///   none: min over m of (m width / length + length / (m width))^2 (Bryan 1891), times
///     2.1 / (psi + 1.1) for psi >= 0 and (7.6 - 6.4 psi + 10 psi^2) / 4 for -1 <= psi < 0 (DNV
///       Rules for
///     ships, part 3 chapter 1 section 13); the latter for length >= width only, else that of psi =
///       0;
///   one: 0.425 + (width / length)^2; both: (width / length)^2, a wide column
///     (Timoshenko and Gere, 1961, sections 9.4 and 9.2); the larger stress all over the width.
double compression_coefficient(double length, double width, double psi, int free_edges);

/// k of a simply supported panel in shear, the shorter side being the width: 5.34 + 4 (short /
/// long)^2 (Timoshenko and Gere, 1961, section 9.7); half of it where an edge lies free, an
/// estimate.
double shear_coefficient(double a, double b, bool free_edge);

/// pi^2 E / (12 (1 - nu^2)) (t / width)^2, Pa.
double euler_stress(const Material& material, double thickness, double width);

/// Critical stress by Johnson and Ostenfeld: sigma_E up to half of the yield stress, beyond it
/// yield (1 - yield / (4 sigma_E)). For shear the yield stress is yield / sqrt(3).
double johnson_ostenfeld(double elastic, double yield);

/// How near a panel is to buckling: the factor by which its load would have to be divided,
///   eta^2 = (max(0, -s11) / s1C)^2 + (max(0, -s22) / s2C)^2 + (s12 / s12C)^2,
/// compression being that of the more compressed edge. Source: ABS, Guide for buckling and ultimate
/// strength assessment for offshore structures (2004), section 3. Under mean compression both ways
/// on four supports at least the share of it, with shear, in that of the panel's own modes
/// (Timoshenko and Gere, 1961, section 9.3): the sum of squares alone allows more than these.
struct BucklingUtilisation {
  double elastic = 0;   ///< with elastic critical stresses
  double critical = 0;  ///< with those of Johnson and Ostenfeld: the one to be checked
};
BucklingUtilisation buckling_utilisation(const PanelSize& size, const FreeEdges& free,
                                         const Material& material, const PanelStress& stress);

/// Panel of a block: a field of plate between its neighbours, its kinks and beams, of whatever
/// direction, or a piece of one that goes round a corner or a bend (find_buckling_fields). Changes
/// of thickness within it do not hold it; lugs are none.
struct Panel {
  std::string plate;  ///< name of the region that has most of it, "web_frames at x = 4 m"
  std::string group;  ///< name of that region's group
  Vector3 normal = Vector3::Zero();    ///< mean over the field, unit
  Vector3 e_1 = Vector3::Zero();       ///< along its side a: as most of its outline runs
  Vector3 e_2 = Vector3::Zero();       ///< along b, normal x e_1
  Vector3 centre_B = Vector3::Zero();  ///< of its material, m
  /// Of its bounding rectangle along e_1 and e_2; thickness of the thinnest plate of a tenth of it.
  /// A cut towards another piece of its plate holds nothing: sides across one count longer. Of a
  /// piece whose equivalent_rectangle has less than nine tenths of that area, the latter.
  PanelSize size;
  /// Of a sector of curved plating, whose sides hold nothing: length along the side a (b) over
  /// which it buckles under compression along that side, m; 0: none is curved that way.
  double arc_a = 0, arc_b = 0;
  FreeEdges free;
  /// How many fields between stiffeners the sides a and b are wide. Where stiffeners stand is not
  /// known, so that one field is taken to be as wide as their spacing; this need not be whole.
  double fields_a = 1, fields_b = 1;
  int material = 0;  ///< place in Mesh::materials, of the weakest steel of that thickness
};

/// Stiffeners that a plate carries and the mesh does not: they divide each of its panels. Those of
/// the mesh divide its fields as they stand and must not be told here: a panel past the end of a
/// beam would count as divided.
struct PlateStiffening {
  std::string group;  ///< name of the plates
  Vector3 along =
      Vector3::Zero();  ///< direction that the stiffeners run in; across a plate: none are there
  double spacing = 0;   ///< m
};

/// The panels of a block and their mean stresses for its unit loads.
class BlockPanels {
 public:
  /// @param motions freedoms x m, m and rad.
  BlockPanels(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
              const std::vector<PlateStiffening>& stiffening);

  const std::vector<Panel>& panels() const { return panels_; }
  /// Place in panels() of a shell's panel; -1: it is a lug's.
  int panel_of(int shell) const { return panel_of_shell_[shell]; }
  /// Width of a panel's fields across a direction in its plane, m; without what cuts add.
  double field_width(int panel, const Vector3& along) const;
  /// Membrane stress along a direction in a panel, mean over that half of a field which lies on the
  /// side of a place on the panel's edge, Pa; a column a motion.
  Eigen::RowVectorXd stress_beside(int panel, const Vector3& along, const Vector3& place) const;
  /// Stresses of all panels for factors of the motions.
  std::vector<PanelStress> stresses(const Eigen::VectorXd& factors) const;
  /// Of the panel, or of that field between its stiffeners which is compressed most.
  BucklingUtilisation utilisation(int panel, const PanelStress& stress) const;

  /// The largest utilisation of each panel over instants (a column of factors each).
  struct Worst {
    BucklingUtilisation utilisation;
    PanelStress stress;
    int instant = 0;
  };
  std::vector<Worst> find_worst(const Eigen::MatrixXd& factors, int threads = 0) const;

 private:
  void describe(const Mesh& mesh);
  void stiffen(const std::vector<PlateStiffening>& stiffening);
  void integrate(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions);

  std::vector<Material> materials_;
  std::vector<Panel> panels_;
  std::vector<Eigen::Vector2d> spans_;    ///< sides of each panel without what cuts add, m
  std::vector<std::vector<int>> shells_;  ///< of each panel
  std::vector<int> panel_of_shell_;
  Eigen::MatrixXd components_;  ///< rows 5 panel + (s11, s22, s12, gradients)
};

}  // namespace blocklift::structure
