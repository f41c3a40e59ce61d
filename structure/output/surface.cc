#include "structure/output/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "structure/index.h"
#include "structure/stress_tensor.h"
#include "structure/response/envelope.h"

namespace blocklift::structure {

namespace {

// Grid of points on a face of the unit cube; the two free axes in ascending order.
Eigen::Matrix3Xd face_points(int face, const std::array<int, 2>& parts) {
  const int normal = face / 2, u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;
  Eigen::Matrix3Xd points(3, (parts[0] + 1) * (parts[1] + 1));
  Eigen::Index q = 0;
  for (int j = 0; j <= parts[1]; ++j)
    for (int i = 0; i <= parts[0]; ++i) {
      points(normal, q) = face % 2;
      points(u, q) = static_cast<double>(i) / parts[0];
      points(v, q++) = static_cast<double>(j) / parts[1];
    }
  return points;
}

std::array<int, 2> face_parts(const HexMesh& mesh, int cell, int face, int division) {
  const int normal = face / 2, u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;
  const Eigen::Matrix3d edges = jacobian(mesh, cell, Vector3::Constant(0.5));
  const double fine = 3 * edges.colwise().norm().minCoeff();
  const auto parts = [&](int axis) { return edges.col(axis).norm() > fine ? division : 1; };
  return {parts(u), parts(v)};
}

}  // namespace

Surface::Surface(const ElasticModel& model, int largest_point_count) {
  for (const CellGroup& group : model.mesh().groups) group_names_.push_back(group.name);
  for (int division = model.space().element.degree(); division >= 1; --division) {
    build(model, division);
    if (static_cast<int>(points_.size()) <= largest_point_count) break;
  }
}

void Surface::build(const ElasticModel& model, int division) {
  points_.clear();
  quads_.clear();
  quad_groups_.clear();
  faces_.clear();
  const BlockMesh& mesh = model.mesh();
  using Key = std::tuple<int, int, std::int64_t, std::int64_t, std::int64_t>;
  std::map<Key, int> known;  // (plate, face direction, place)
  for (const auto& [cell, face] : boundary_faces(mesh)) {
    FacePatch patch{cell, face, face_parts(mesh, cell, face, division), {}};
    const Eigen::Matrix3Xd unit = face_points(face, patch.parts);
    for (Eigen::Index q = 0; q < unit.cols(); ++q) {
      const Vector3 place = position(mesh, cell, unit.col(q));
      const Key key{mesh.cell_sheet[at(cell)], face, std::llround(place.x() * 1e6),
                    std::llround(place.y() * 1e6), std::llround(place.z() * 1e6)};
      const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(points_.size()));
      if (is_new) points_.push_back(place);
      patch.points.push_back(entry->second);
    }
    // With the free axes ascending, the quadrangle's normal points along +x, -y, +z.
    const bool outwards = (face % 2 == 1) != (face / 2 == 1);
    const int row = patch.parts[0] + 1;
    for (int j = 0; j < patch.parts[1]; ++j)
      for (int i = 0; i < patch.parts[0]; ++i) {
        const auto point = [&](int a, int b) { return patch.points[at((j + b) * row + i + a)]; };
        if (outwards)
          quads_.push_back({point(0, 0), point(1, 0), point(1, 1), point(0, 1)});
        else
          quads_.push_back({point(0, 0), point(0, 1), point(1, 1), point(1, 0)});
        quad_groups_.push_back(mesh.cell_group[at(cell)]);
      }
    faces_.push_back(std::move(patch));
  }
}

std::vector<double> Surface::envelope(const UnitResponses& responses,
                                      const LoadHistory& history) const {
  const ElasticModel& model = responses.model();
  std::map<std::array<int, 3>, CellStress> samplers;  // (face, parts)
  std::vector<int> first_sample{0};                   // of each face
  for (const FacePatch& face : faces_) {
    const std::array<int, 3> key{face.face, face.parts[0], face.parts[1]};
    if (samplers.find(key) == samplers.end())
      samplers.emplace(key,
                       CellStress(model.mesh(), model.space(), face_points(face.face, face.parts)));
    first_sample.push_back(first_sample.back() + static_cast<int>(face.points.size()));
  }
  const auto stress = [&](int first, int count) {
    Eigen::MatrixXd result(6 * count, responses.count());
    auto face = std::upper_bound(first_sample.begin(), first_sample.end(), first) - 1;
    for (int done = 0; done < count; ++face) {
      const FacePatch& patch = faces_[static_cast<std::size_t>(face - first_sample.begin())];
      const int skipped = first + done - *face;
      const int taken = std::min(count - done, static_cast<int>(patch.points.size()) - skipped);
      result.middleRows(6 * done, 6 * taken) =
          samplers.at({patch.face, patch.parts[0], patch.parts[1]})
              .of_all(patch.cell, responses.displacements())
              .middleRows(6 * skipped, 6 * taken);
      done += taken;
    }
    return result;
  };
  const PointExtremes of_samples = find_von_mises_envelope(history, first_sample.back(), stress);
  std::vector<double> largest(points_.size(), 0);
  Eigen::Index sample = 0;
  for (const FacePatch& face : faces_)
    for (const int point : face.points)
      largest[at(point)] = std::max(largest[at(point)], of_samples.value[sample++]);
  return largest;
}

SurfaceField Surface::evaluate(const UnitResponses& responses, const LoadCase& load_case) const {
  const ElasticModel& model = responses.model();
  const BlockMesh& mesh = model.mesh();
  const Discretisation& space = model.space();
  const Eigen::VectorXd displacement =
      responses.without_rigid_motion(responses.displacement(load_case));
  struct Sampler {
    CellStress stress;
    Eigen::MatrixXd shapes;
  };
  std::map<std::array<int, 3>, Sampler> samplers;  // (face, parts)
  SurfaceField field;
  field.displacement.assign(points_.size(), Vector3::Zero());
  field.von_mises.assign(points_.size(), 0);
  std::vector<int> shares(points_.size(), 0);
  for (const FacePatch& patch : faces_) {
    const std::array<int, 3> key{patch.face, patch.parts[0], patch.parts[1]};
    auto found = samplers.find(key);
    if (found == samplers.end()) {
      const Eigen::Matrix3Xd unit = face_points(patch.face, patch.parts);
      found =
          samplers.emplace(key, Sampler{CellStress(mesh, space, unit), space.element.values(unit)})
              .first;
    }
    Eigen::MatrixX3d local(space.nodes_per_cell, 3);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      local.row(i) = displacement.segment<3>(3 * space.node(patch.cell, i)).transpose();
    const Eigen::MatrixX3d moved = found->second.shapes * local;
    const Eigen::VectorXd stress = found->second.stress.von_mises(patch.cell, displacement);
    for (std::size_t q = 0; q < patch.points.size(); ++q) {
      const std::size_t point = at(patch.points[q]);
      field.displacement[point] = moved.row(static_cast<Eigen::Index>(q)).transpose();
      field.von_mises[point] += stress[static_cast<Eigen::Index>(q)];
      ++shares[point];
    }
  }
  for (std::size_t p = 0; p < points_.size(); ++p) field.von_mises[p] /= shares[p];
  return field;
}

}  // namespace blocklift::structure
