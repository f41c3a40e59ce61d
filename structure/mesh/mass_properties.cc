#include "structure/mesh/mass_properties.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "structure/mesh/beam_lines.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Mass, first and second moments about the origin.
struct MassSum {
  double mass = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum m x x^T
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();     ///< inertia of point masses about themselves

  void add(double m, const Vector3& place) {
    mass += m;
    first += m * place;
    second += m * place * place.transpose();
  }
  MeshMass properties() const {
    MeshMass result;
    result.mass = mass;
    if (!(mass > 0)) return result;
    result.centre = first / mass;
    const Eigen::Matrix3d about = second - mass * result.centre * result.centre.transpose();
    result.inertia = about.trace() * Eigen::Matrix3d::Identity() - about + own;
    return result;
  }
};

/// A place on a shell and its two tangents.
struct SurfacePlace {
  Vector3 point, along_xi, along_eta;
};

SurfacePlace on_bilinear(const Mesh& mesh, const Shell& shell, double xi, double eta) {
  const auto vertex = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[shell.vertices[i]];
  };
  const Vector3 low = vertex(1) - vertex(0), high = vertex(3) - vertex(2);
  const Vector3 start = vertex(2) - vertex(0);
  return {vertex(0) + xi * low + eta * (start + xi * (high - low)), low + eta * (high - low),
          start + xi * (high - low)};
}

SurfacePlace on_curved(const Eigen::Matrix3Xd& points, double xi, double eta) {
  const int count = static_cast<int>(std::lround(std::sqrt(static_cast<double>(points.cols()))));
  const auto lagrange = [&](double x) {
    Eigen::MatrixXd values(count, 2);  // and derivatives
    for (int i = 0; i < count; ++i) {
      double value = 1, slope = 0;
      for (int j = 0; j < count; ++j) {
        if (j == i) continue;
        const double factor = (x * (count - 1) - j) / (i - j);
        slope = slope * factor + value * (count - 1.0) / (i - j);
        value *= factor;
      }
      values.row(i) << value, slope;
    }
    return values;
  };
  const Eigen::MatrixXd u = lagrange(xi), v = lagrange(eta);
  SurfacePlace place{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const Vector3 point = points.col(j * count + i);
      place.point += u(i, 0) * v(j, 0) * point;
      place.along_xi += u(i, 1) * v(j, 0) * point;
      place.along_eta += u(i, 0) * v(j, 1) * point;
    }
  return place;
}

/// Visits the points of Gauss' rule with the area that each stands for and the normal there.
template <typename Visit>
void integrate(const Mesh& mesh, const Shell& shell, const Visit& visit) {
  static const double half = 0.5 / std::sqrt(3.0), wide = 0.5 * std::sqrt(0.6);
  const bool is_curved = shell.curvature >= 0;
  const std::array<double, 3> points =
      is_curved ? std::array{0.5 - wide, 0.5, 0.5 + wide} : std::array{0.5 - half, 0.5 + half, 0.0};
  const std::array<double, 3> weights =
      is_curved ? std::array{5.0 / 18, 8.0 / 18, 5.0 / 18} : std::array{0.5, 0.5, 0.0};
  const std::size_t count = is_curved ? 3 : 2;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const SurfacePlace place =
          is_curved ? on_curved(mesh.curved_shells[shell.curvature], points[i], points[j])
                    : on_bilinear(mesh, shell, points[i], points[j]);
      const Vector3 normal = place.along_xi.cross(place.along_eta);
      const double size = normal.norm();
      visit(weights[i] * weights[j] * size, Eigen::Vector2d(points[i], points[j]), place.point,
            size > 0 ? Vector3(normal / size) : normal);
    }
}

std::vector<MassSum> sums_by_group(const Mesh& mesh) {
  std::vector<MassSum> sums(mesh.groups.size() + 1);
  const auto of_region = [&](int region) -> MassSum& { return sums[mesh.regions[region].group]; };
  for (const Shell& shell : mesh.shells) {
    if (shell.section < 0) continue;
    const ShellSection& section = mesh.section_of(shell);
    MassSum& sum = of_region(shell.region);
    integrate(
        mesh, shell,
        [&](double part, const Eigen::Vector2d& xi, const Vector3& point, const Vector3& normal) {
          const double mass = part * mass_per_area(mesh, shell, thickness_at(mesh, shell, xi));
          sum.add(mass, point + section.offset * normal);
        });
  }
  const BeamLines lines(mesh);
  for (const Beam& beam : mesh.beams)
    for (const BeamLines::Part& part : lines.centroid_parts(beam))
      of_region(beam.region)
          .add(mass_per_length(mesh, section_at(mesh, beam, part.share)) * part.length, part.place);
  for (const Solid& solid : mesh.solids) {
    const ElementKind& kind = topology_of(solid.shape).kind;
    const Eigen::Matrix3Xd places = places_of(mesh, solid);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const Eigen::Matrix3d jacobian = places * kind.gradients.middleRows<3>(3 * q).transpose();
      of_region(solid.region)
          .add(kind.weights[q] * jacobian.determinant() * mesh.materials[solid.material].density,
               places * kind.values.row(q).transpose());
    }
  }
  for (const PointMass& mass : mesh.masses) {
    sums.back().add(mass.mass, mesh.vertices[mass.vertex] + mass.offset);
    sums.back().own += mass.inertia;
  }
  return sums;
}

}  // namespace

double mass_per_area(const Mesh& mesh, const Shell& shell, double thickness) {
  return mesh.material_of(shell).density * thickness + mesh.section_of(shell).mass_per_area;
}

double mass_per_length(const Mesh& mesh, const BeamSection& section) {
  return mesh.materials[section.material].density * section.area + section.mass_per_length;
}

MeshMass mass_properties(const Mesh& mesh) {
  MassSum all;
  for (const MassSum& sum : sums_by_group(mesh)) {
    all.mass += sum.mass;
    all.first += sum.first;
    all.second += sum.second;
    all.own += sum.own;
  }
  return all.properties();
}

std::vector<MeshMass> mass_by_group(const Mesh& mesh) {
  std::vector<MeshMass> groups;
  for (const MassSum& sum : sums_by_group(mesh)) groups.push_back(sum.properties());
  return groups;
}

double area(const Mesh& mesh, const Shell& shell) {
  double sum = 0;
  integrate(mesh, shell, [&](double part, const Eigen::Vector2d&, const Vector3&, const Vector3&) {
    sum += part;
  });
  return sum;
}

}  // namespace blocklift::structure
