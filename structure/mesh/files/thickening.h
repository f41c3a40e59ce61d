#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/abaqus_file.h"

namespace blocklift::structure {

/// Mid-surfaces of flat or gently curved plates, meshed with quadrangles that share nodes where
/// plates meet; any unit of length.
struct PlateMesh {
  struct Plate {
    std::string name;
    double thickness = 0;  ///< half of it on each side of the mid-surface
  };
  struct Quadrangle {
    std::array<int, 4> nodes{};  ///< in turn; the normal follows from them by the right hand
    int plate = 0;
  };
  std::vector<Plate> plates;
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Quadrangle> quadrangles;
  std::map<std::string, std::vector<int>> node_sets;
};

/// Thickens mid-surfaces into a conforming mesh of hexahedra (wedges where three plates meet at odd
/// angles), with nothing counted twice where plates meet.
///
/// Each side of each quadrangle has a node at each corner; sides that face one another across an
/// edge share it, which makes mitres of folds. Where a plate runs on past others that stand on it
/// (a T- or cross-joint), a strip of the others' thickness is cut out of it, and carried on
/// straight through the mesh to the plate's edge so that the mesh conforms; the strips and what
/// lies between the plates become columns of their own. A node lies where the faces of its plates
/// meet (least squares; least distance from the mid-surface's node where these leave a freedom).
///
/// Element sets: each plate's name (a column belongs to the thickest plate at it). Surfaces: "NAME
/// +" and "NAME -", the sides that the mid-surface's normal points to and away from. Node sets: all
/// nodes that come from those of the set.
/// @throws ModelError naming the places that cannot be thickened: five or more faces about a joint,
///   plates that meet at a sharper angle than their elements allow, joints that end within a plate
///   whose mesh does not run on straight, crossings that are neither cubes nor wedges.
AbaqusMesh thicken(const PlateMesh& mesh);

}  // namespace blocklift::structure
