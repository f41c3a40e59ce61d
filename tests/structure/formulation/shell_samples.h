#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"
#include "structure/space/space.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure::samples {

/// Surface over the unit square.
using Chart = std::function<Vector3(double xi, double eta)>;

/// `m` x `n` shells over a chart, curved of an order (1: bilinear).
Mesh mesh_of(const Chart& chart, int m, int n, double thickness, const Material& material,
             int order = 1);

Material steel();

/// Holds freedoms of all nodes that a place selects.
void hold(const Space& space, const std::function<bool(const Vector3&)>& selects,
          const std::vector<int>& components, std::vector<FixedUnknown>& fixed);

/// Motion of all freedoms under a load vector (six a node).
Eigen::VectorXd solve(const Space& space, const Eigen::VectorXd& load,
                      const std::vector<FixedUnknown>& fixed);

/// Load vector of a pressure (per area, along a direction).
Eigen::VectorXd area_load(const Space& space,
                          const std::function<Vector3(const Vector3& place)>& force_per_area);

/// Node nearest to a place.
int nearest_node(const Space& space, const Vector3& place);

}  // namespace blocklift::structure::samples
