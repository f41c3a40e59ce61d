#include "structure/output/vtu.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "structure/formulation/beam.h"
#include "structure/formulation/solid.h"
#include "structure/mesh/solid_shape.h"
#include "structure/output/divided_cell.h"
#include "structure/output/vtk_grid.h"
#include "structure/stress/beam_stress.h"
#include "structure/stress/shell_stress.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

struct Content {
  VtkGrid grid;
  std::vector<float> displacement, von_mises, top, bottom, membrane, thickness;
  std::vector<std::int32_t> group, material, plate;
};

class Collector {
 public:
  Collector(const Space& space, const Eigen::VectorXd& motion, const CellHeat* heat)
      : space_(space), motion_(motion), heat_(heat) {}

  Content collect() {
    add_shells();
    for (int cell = 0; cell < static_cast<int>(space_.beams().size()); ++cell) add_beam(cell);
    for (int solid = 0; solid < static_cast<int>(space_.mesh().solids.size()); ++solid)
      add_solid(solid);
    return std::move(content_);
  }

 private:
  void add_shells() {
    const int parts = space_.degree();
    const Eigen::Matrix2Xd unit = divided_square(parts);
    const auto squares = squares_of_division(parts);
    Eigen::MatrixXd shapes(unit.cols(), space_.nodes_per_shell());
    for (Eigen::Index q = 0; q < unit.cols(); ++q)
      shapes.row(q) = space_.shell_values(unit.col(q)).transpose();
    const auto cells = static_cast<int>(space_.shells().size());
    const Eigen::MatrixXd stress = stresses_of_cells(space_, unit, 0, cells, motion_, heat_);
    for (int cell = 0; cell < cells; ++cell) {
      const auto first = content_.grid.point_count();
      const Eigen::MatrixXd local = motions_of_cell(space_, cell, motion_);
      const Eigen::MatrixXd moved =
          shapes * local.reshaped(6, local.size() / 6).topRows<3>().transpose();
      const auto rows = stress.col(0).segment(shell_stress_rows * unit.cols() * cell,
                                              shell_stress_rows * unit.cols());
      for (Eigen::Index q = 0; q < unit.cols(); ++q)
        add_point(space_.place(cell, unit.col(q)), moved.row(q).transpose(),
                  plate_von_mises(rows.segment<shell_stress_rows>(shell_stress_rows * q)));
      const Shell& shell = space_.mesh().shells[space_.shells()[cell].shell];
      const ShellSection& section = space_.mesh().section_of(shell);
      for (const std::array<int, 4>& corners : squares) {
        add_corners(first, corners);
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (const int corner : corners) middle += 0.25 * unit.col(corner);
        const ShellCell& located = space_.shells()[cell];
        add_cell(shell.region, section.material,
                 thickness_at(space_.mesh(), shell, located.origin + located.size * middle));
      }
    }
  }

  void add_beam(int cell) {
    const BeamCell& located = space_.beams()[cell];
    const Beam& beam = space_.mesh().beams[located.beam];
    for (int i = 0; i <= located.degree; ++i) {
      const double xi = static_cast<double>(i) / located.degree;
      const double largest = largest_von_mises(beam_stresses(space_, cell, xi, motion_, heat_));
      add_point(beam_point(space_, cell, xi).place,
                beam_motion_at(space_, cell, xi, motion_, heat_).displacement,
                {std::abs(beam_stress_at_centroid(space_, cell, xi, motion_, heat_)[0]), largest,
                 largest});
      if (i == 0) continue;
      const auto last = content_.grid.point_count() - 1;
      content_.grid.add_cell(VtkCell::line, last - 1, 2);
      add_cell(beam.region, space_.mesh().section_of(beam).material, 0);
    }
  }

  void add_solid(int number) {
    const Solid& solid = space_.mesh().solids[number];
    const Eigen::VectorXd stress = solid_corner_stresses(space_, number, motion_, heat_);
    const auto first = content_.grid.point_count();
    const int corners = topology_of(solid.shape).corners;
    for (int corner = 0; corner < corners; ++corner) {
      const Eigen::Index node = space_.solid_nodes(number)[corner];
      const double here = von_mises(Stress(stress.segment<6>(6L * corner)));
      add_point(space_.nodes().col(node), motion_.segment<3>(6 * node), {here, here, here});
    }
    // VTK's wedges begin with the triangle whose normal points out.
    static constexpr std::array<std::int32_t, 6> wedge{0, 2, 1, 3, 5, 4};
    for (int corner = 0; corner < corners; ++corner)
      content_.grid.connectivity.push_back(first + (corners == 6 ? wedge[corner] : corner));
    content_.grid.end_cell(corners == 4   ? VtkCell::tetrahedron
                           : corners == 5 ? VtkCell::pyramid
                           : corners == 6 ? VtkCell::wedge
                                          : VtkCell::hexahedron);
    add_cell(solid.region, solid.material, 0);
  }

  void add_point(const Vector3& place, const Vector3& moved, const PlateVonMises& stress) {
    content_.grid.add_point(place);
    for (const double component : moved)
      content_.displacement.push_back(static_cast<float>(component));
    content_.von_mises.push_back(static_cast<float>(stress.largest()));
    content_.top.push_back(static_cast<float>(stress.top));
    content_.bottom.push_back(static_cast<float>(stress.bottom));
    content_.membrane.push_back(static_cast<float>(stress.membrane));
  }

  // Where a triangle's edge is a point, two corners lie there: the cell has three.
  void add_corners(std::int32_t first, const std::array<int, 4>& corners) {
    const auto place = [&](int corner) {
      const auto start = content_.grid.points.begin() + 3 * (first + corner);
      return std::array<float, 3>{start[0], start[1], start[2]};
    };
    const bool is_triangle = place(corners[2]) == place(corners[3]);
    for (std::size_t i = 0; i < (is_triangle ? 3 : 4); ++i)
      content_.grid.connectivity.push_back(first + corners[i]);
    content_.grid.end_cell(is_triangle ? VtkCell::triangle : VtkCell::quadrangle);
  }

  void add_cell(int region, int material, double thickness) {
    content_.group.push_back(space_.mesh().regions[region].group);
    content_.material.push_back(material);
    content_.plate.push_back(region);
    content_.thickness.push_back(static_cast<float>(thickness));
  }

  const Space& space_;
  const Eigen::VectorXd& motion_;
  const CellHeat* heat_;
  Content content_;
};

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

}  // namespace

// deal.II's DataOut has neither names as field data nor lines and squares in one piece.
void write_vtu(const std::string& path, const ElasticModel& model, const std::string& name,
               const Eigen::VectorXd& motion, const CellHeat* heat) {
  const Mesh& mesh = model.mesh();
  Content content = Collector(model.space(), motion, heat).collect();
  VtkGrid& grid = content.grid;
  grid.texts = {{"load_case", {name}},
                {"group_names", names_of(mesh.groups)},
                {"material_names", names_of(mesh.materials)},
                {"plate_names", names_of(mesh.regions)}};
  grid.scalars = "von_mises";
  grid.vectors = "displacement";
  grid.point_data = {{"displacement", std::move(content.displacement), 3},
                     {"von_mises", std::move(content.von_mises)},
                     {"von_mises_top", std::move(content.top)},
                     {"von_mises_bottom", std::move(content.bottom)},
                     {"von_mises_membrane", std::move(content.membrane)}};
  grid.cell_data = {{"group", std::move(content.group)},
                    {"material", std::move(content.material)},
                    {"plate", std::move(content.plate)},
                    {"thickness", std::move(content.thickness)}};
  write_vtk_grid(path, grid);
}

void write_vtu(const std::string& path, const UnitResponses& responses, const LoadCase& load_case) {
  write_vtu(path, responses.model(), load_case.name,
            responses.without_rigid_motion(responses.displacement(load_case)));
}

}  // namespace blocklift::structure
