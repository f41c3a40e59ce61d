#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/structure/hot_spot_format.h"
#include "pipeline/files/structure/padeye_format.h"
#include "structure/solver_choice.h"

namespace blocklift::pipeline {

/// A plate of a mesh of mid-surfaces.
struct PartPlate {
  Located<std::string> name;  ///< its group of surfaces
  double thickness = 0;       ///< m
};

namespace given {

/// Outer faces of a mesh that lie in a box; they become a group.
struct PartFaces {
  Located<std::string> name;
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< smallest and largest corner, m
};

/// The node at a place; it becomes a group.
struct PartPoint {
  Located<std::string> name;
  Vector3 at = Vector3::Zero();  ///< m
};

/// Where a part's mesh comes from: a file or a padeye.
struct PartMesh {
  std::optional<Located<std::string>> file;
  std::optional<Located<PadeyePart>> padeye;
  /// Of the file's coordinates, m; absent: that which a CAD file declares, else m, and doubted.
  std::optional<double> length_unit;
  int element_order = 2;
  std::optional<double> element_size;  ///< m
  int refinements = 0;                 ///< halvings of all elements
  std::vector<PartPlate> plates;       ///< none: the mesh is one of solids
  std::vector<PartFaces> faces;
  std::vector<PartPoint> points;

  /// Where the file or the padeye stands.
  const Mark& mark() const { return file ? file->mark : padeye->mark; }
};

/// How bodies of a part that share no node are joined.
struct PartJoin {
  Located<double> within;  ///< largest gap that is joined, m
};

}  // namespace given

/// A material of a part with the groups of solids that are of it.
struct PartMaterial {
  Located<std::string> name;
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  double density = 0;                        ///< kg/m^3
  double yield_stress = 0;                   ///< Pa
  std::vector<Located<std::string>> groups;  ///< none: all that no other material names
};

namespace given {

/// Components of groups that are held.
struct PartSupport {
  Located<std::string> name;
  std::vector<Located<std::string>> groups;
  std::vector<std::size_t> fixed;          ///< axes
  Vector3 displacement = Vector3::Zero();  ///< m
};

}  // namespace given

/// Rotation about a fixed axis.
struct PartRotation {
  Vector3 axis = Vector3::UnitZ();
  Vector3 point = Vector3::Zero();  ///< m
  double speed = 0;                 ///< rad/s
};

/// A pin that presses on its hole.
struct PartBearing {
  Vector3 force = Vector3::Zero();  ///< of the pin on the hole, N
  Vector3 axis = Vector3::UnitZ();  ///< of the hole
  Vector3 point = Vector3::Zero();  ///< on the axis, m
};

namespace given {

/// One load: exactly one of its kinds is given.
struct PartLoad {
  Located<std::string> name;
  std::vector<Located<std::string>> groups;
  std::optional<double> pressure;   ///< Pa
  std::optional<Vector3> traction;  ///< Pa
  std::optional<Vector3> force;     ///< N
  std::optional<PartBearing> bearing;
  std::optional<Vector3> gravity;       ///< m/s^2
  std::optional<Vector3> acceleration;  ///< of the part, m/s^2
  std::optional<PartRotation> rotation;
};

/// A point, or a line with points along it, where displacement and stress are asked for.
struct PartProbe {
  Located<std::string> name;
  std::optional<Vector3> at;  ///< m
  std::optional<Vector3> from, to;
  int points = 11;
};

}  // namespace given

/// What is looked at in a probe.
enum class PartQuantity { xx, yy, zz, xy, yz, zx, von_mises, u_x, u_y, u_z };

/// A published figure: of a point probe, or the frequency of a natural mode.
struct PartReference {
  std::optional<Located<std::string>> probe;
  std::optional<PartQuantity> quantity;  ///< of the probe
  std::optional<int> mode;               ///< from 1
  Located<Quantity> value;               ///< Pa, m for displacements, Hz for modes
  double tolerance = 0;                  ///< as a ratio of the value
};

/// Published figures and where they stand.
struct PartReferences {
  std::string source;
  /// The figures are held on the mesh as it is and after so many halvings of its elements.
  int refinements = 0;
  std::vector<PartReference> figures;
};

/// How accurate the stress shall be where it is checked.
struct CheckedStress {
  double accuracy = 0;  ///< largest estimated error of the von Mises stress, share
  std::vector<Located<std::string>> probes;  ///< point probes; none: the part's largest stress
};

/// What `blocklift stress` computes: any mesh with materials, supports, loads and probes. SI units.
struct PartFile {
  std::string name;
  std::string title;
  given::PartMesh mesh;
  std::vector<PartMaterial> materials;
  std::optional<given::PartJoin> join;  ///< none: bodies stay apart
  std::vector<given::PartSupport> supports;
  std::vector<given::PartLoad> loads;
  std::vector<given::PartProbe> probes;
  std::vector<given::HotSpot> hot_spots;
  std::optional<int> modes;  ///< natural modes asked for
  /// Largest estimated error of the stress field in the energy norm, as a share of the norm.
  std::optional<double> accuracy;
  std::optional<CheckedStress> checked_stress;
  std::optional<PartReferences> references;
  structure::SolverChoice solver;
  std::string yaml;            ///< the file as it stands
  std::filesystem::path file;  ///< where it is

  /// The mesh file's path, if there is one: relative ones count from the part's file.
  std::filesystem::path mesh_path() const;
};

/// How a quantity is called in a file: "yy", "von_mises", "u_x".
const std::string& name_of(PartQuantity quantity);

Format<PartFile> part_file_format();

/// Reads a part's file, or part.yaml in a folder; the mesh is not looked at.
/// @returns the part only if nothing is wrong with it; else the complaints are in `diagnostics`.
std::optional<PartFile> read_part_file(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
