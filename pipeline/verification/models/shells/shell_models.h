#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"
#include "structure/space/space.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure::examples {

/// Surface over the unit square.
using Chart = std::function<Vector3(double xi, double eta)>;
using Selects = std::function<bool(const Vector3&)>;

/// Steel without a name of its own: 210 GPa, 0.3, 7850 kg/m^3.
Material plain_steel();

/// A mesh with one material, one thickness and one region, and no shells yet.
Mesh empty_mesh(const Material& material, double thickness);

/// Adds `m` x `n` shells over a chart, curved of an order (1: bilinear) and of a section; vertices
/// that lie where the mesh has one already are that one.
void add_sheet(Mesh& mesh, const Chart& chart, int m, int n, int order = 1, int section = 0);

/// One sheet.
Mesh sheet_mesh(const Chart& chart, int m, int n, double thickness, const Material& material,
                int order = 1);

/// MacNeal and Harder's patch (1985, figure 2): 0.24 x 0.12 m in five distorted quadrangles.
Mesh macneal_patch(double thickness, const Material& material);

/// Adds hexahedra, quadratic, between the planes of a grid wherever `fills` a cell by its middle.
/// Each list of planes ascends, m.
void add_hexahedra(Mesh& mesh, const std::vector<double>& x, const std::vector<double>& y,
                   const std::vector<double>& z, const Selects& fills);

/// Every second shell, or all, as two triangles (flat meshes).
void divide_into_triangles(Mesh& mesh, bool all);

/// Adds a vertex (or finds the one that lies there) and returns it.
int vertex_at(Mesh& mesh, const Vector3& place);

/// Adds beams along the vertices that lie on the way from a to b, all of one section.
void add_beams(Mesh& mesh, const Vector3& a, const Vector3& b, int section, const Vector3& axis_2,
               const Vector3& offset = Vector3::Zero());

/// Holds freedoms of all nodes that a place selects; those that are sums of others follow by
/// themselves.
void hold(const Space& space, const Selects& selects, const std::vector<int>& components,
          std::vector<FixedUnknown>& fixed);

/// The same at a motion (displacement, rotation) that depends on the place.
using Motion = std::function<Eigen::Matrix<double, 6, 1>(const Vector3&)>;
void hold_at(const Space& space, const Selects& selects, const Motion& motion,
             const std::vector<int>& components, std::vector<FixedUnknown>& fixed);

/// Motion of all freedoms under a load vector (six a node).
Eigen::VectorXd solve(const Space& space, const Eigen::VectorXd& load,
                      const std::vector<FixedUnknown>& fixed);

/// Load vector of a force per area of the plates' mid-surfaces.
using ForceField = std::function<Vector3(const Vector3&)>;
Eigen::VectorXd area_load(const Space& space, const ForceField& force_per_area);

/// Load vector of the weight of shells, beams and solids in a gravity along -z, m/s^2.
Eigen::VectorXd weight_load(const Space& space, double gravity);

/// Load vector of a force per length on the cells' edges all of whose nodes are selected.
Eigen::VectorXd edge_load(const Space& space, const Selects& selects,
                          const ForceField& force_per_length);

/// Node nearest to a place.
int nearest_node(const Space& space, const Vector3& place);

/// Displacement of that node, m.
Vector3 displacement_at(const Space& space, const Eigen::VectorXd& motion, const Vector3& place);

/// Stress along the world's axes at a point of a shell's cell, at a height z above its mid-surface,
/// Pa: membrane and bending parts.
Eigen::Matrix3d shell_stress(const Space& space, int cell, const Eigen::Vector2d& xi, double z,
                             const Eigen::VectorXd& motion);

/// The mean of shell_stress over the cells that have a corner at a place.
Eigen::Matrix3d stress_at(const Space& space, const Eigen::VectorXd& motion, const Vector3& place,
                          double z);

}  // namespace blocklift::structure::examples
