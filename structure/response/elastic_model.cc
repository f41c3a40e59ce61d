#include "structure/response/elastic_model.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/system/linear_solver.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

// The stiffness alone, from below: a cell brings 6 p^2 unknowns, each coupled with half a cell's on
// one side of the diagonal, 16 bytes an entry. Asked before any of it is made; the factor, known
// later, is larger.
void require_memory(const Mesh& mesh, const Resolution& resolution) {
  double cells = 0;
  for (const Shell& shell : mesh.shells) {
    double divisions = 1;
    if (resolution.largest_edge)
      divisions = std::max(1.0, longest_edge(mesh, shell) /
                                    resolution.largest_edge(position(mesh, shell, {0.5, 0.5})));
    cells += std::pow(4.0, std::ceil(std::log2(divisions) - 1e-9));
  }
  const double p = resolution.degree, unknowns = 6 * p * p * cells;
  const double bytes = 16 * unknowns * 3 * (p + 1) * (p + 1);
  if (const double available = memory_for(bytes); bytes > available)
    throw NotEnoughMemory(fmt::format(
        "{:.3g} shells of degree {} make about {:.2g} unknowns, whose stiffness needs "
        "more than {:.3g} GB; {:.3g} GB are free; use larger elements or a lower element degree",
        cells, resolution.degree, unknowns, bytes / 1e9, available / 1e9));
}

/// Cells over which a lug's force is spread.
std::vector<int> cells_of_lug(const Space& space, const LiftingPoint& point) {
  if (point.shells.empty()) return cells_of_region(space, point.region);
  std::vector<char> carries(space.mesh().shells.size(), 0);
  for (const int shell : point.shells) carries[shell] = 1;
  std::vector<int> cells;
  for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
    if (carries[space.shells()[cell].shell] != 0) cells.push_back(static_cast<int>(cell));
  return cells;
}

/// Unit forces at a pin that is rigidly joined with its vertex.
Eigen::MatrixXd forces_at_vertex(const Space& space, const LiftingPoint& point) {
  const int node = space.node_of_vertex(point.vertex);
  if (node < 0)
    throw ModelError(fmt::format("lug {} is at a vertex that nothing uses", point.name));
  const Vector3 arm = point.p_BPin - space.nodes().col(node);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(space.freedoms(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 force = Vector3::Unit(axis);
    loads.block<3, 1>(6 * static_cast<Eigen::Index>(node), axis) = force;
    loads.block<3, 1>(6 * static_cast<Eigen::Index>(node) + 3, axis) = arm.cross(force);
  }
  return loads;
}

}  // namespace

ElasticModel::~ElasticModel() = default;

ElasticModel::ElasticModel(Mesh mesh, const Resolution& resolution,
                           std::optional<double> total_mass,
                           std::optional<Vector3> centre_of_mass_B)
    : ElasticModel(std::make_shared<const Mesh>(std::move(mesh)), resolution, total_mass,
                   std::move(centre_of_mass_B)) {}

ElasticModel::ElasticModel(std::shared_ptr<const Mesh> mesh, const Resolution& resolution,
                           std::optional<double> total_mass,
                           std::optional<Vector3> centre_of_mass_B)
    : mesh_(std::move(mesh)),
      resolution_(resolution),
      stated_mass_(total_mass),
      stated_centre_B_(std::move(centre_of_mass_B)) {
  require_memory(*mesh_, resolution_);
  space_ = std::make_shared<const Space>(*mesh_, resolution_);
  find_inertia();
  lug_loads_.resize(freedoms(), 3 * lug_count());
  const Eigen::Matrix<double, 6, 3> forces = Eigen::Matrix<double, 6, 3>::Identity();
  for (int lug = 0; lug < lug_count(); ++lug) {
    const LiftingPoint& point = mesh_->lifting_points[lug];
    lug_loads_.middleCols<3>(3 * lug) =
        point.vertex >= 0
            ? forces_at_vertex(*space_, point)
            : spread_wrenches(*space_, cells_of_lug(*space_, point), point.p_BPin, forces);
  }
}

void ElasticModel::find_inertia() {
  const Matter matter(*space_);
  mass_ = find_mass_properties(matter, stated_mass_ ? &*stated_mass_ : nullptr,
                               stated_centre_B_ ? &*stated_centre_B_ : nullptr);
  inertia_loads_ = structure::inertia_loads(matter, mass_);
}

std::unique_ptr<ElasticModel> ElasticModel::with_mass(
    std::optional<double> total_mass, std::optional<Vector3> centre_of_mass_B) const {
  std::unique_ptr<ElasticModel> other(new ElasticModel(*this));
  other->stated_mass_ = total_mass;
  other->stated_centre_B_ = std::move(centre_of_mass_B);
  other->find_inertia();
  return other;
}

std::unique_ptr<ElasticModel> ElasticModel::with(const Resolution& resolution) const {
  return std::unique_ptr<ElasticModel>(
      new ElasticModel(mesh_, resolution, stated_mass_, stated_centre_B_));
}

std::vector<int> cells_of_region(const Space& space, int region) {
  std::vector<int> cells;
  for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
    if (space.mesh().shells[space.shells()[cell].shell].region == region)
      cells.push_back(static_cast<int>(cell));
  return cells;
}

}  // namespace blocklift::structure
