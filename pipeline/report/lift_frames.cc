#include "pipeline/report/lift_frames.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/decimation.h"
#include "structure/output/vtk_grid.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using layout::join;
using structure::VtkCell;
using structure::VtkGrid;

/// Corners of a cell of VTK, as shares of half the box.
constexpr double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// The pose in columns 0 to 6 of a row: x y z, then the quaternion w x y z.
Eigen::Isometry3d pose_of(const Array<double>& values, std::size_t row) {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.translation() << values(row, 0), values(row, 1), values(row, 2);
  X_WB.linear() = Eigen::Quaterniond(values(row, 3), values(row, 4), values(row, 5), values(row, 6))
                      .normalized()
                      .toRotationMatrix();
  return X_WB;
}

struct Body {
  std::string name;
  Array<double> boxes;
};

struct Line {
  std::string name;
  std::vector<std::string> bodies;
  Array<double> points;
  std::optional<Array<double>> tension;
};

struct MovedSurface {
  std::string body;
  Array<double> points;
  Array<std::int32_t> quads;
  Array<double> von_mises;
};

/// What moves, with its motion.
class Lift {
 public:
  explicit Lift(const ResultsReader& results) {
    const std::string history(layout::dynamic_history);
    time_ = results.read(join(history, "time"));
    for (const std::string& name : results.children(join(history, "bodies")))
      poses_.emplace(name, results.read(join(history, "bodies", name, "pose")));
    for (const std::string& name : results.children(layout::scene_bodies))
      bodies_.push_back({name, results.read(join(layout::scene_bodies, name, "boxes"))});
    for (const std::string& name : results.children(layout::scene_ropes))
      lines_.push_back(read_line(results, name));
    if (results.has(layout::surface_quads)) surface_ = read_surface(results);
  }

  std::size_t instants() const { return time_.values.size(); }
  double time(std::size_t instant) const { return time_(instant); }
  bool has_surface() const { return surface_.has_value(); }

  VtkGrid cranes(std::size_t instant) const {
    VtkGrid grid;
    std::vector<float> object, tension;
    VtkGrid::Texts names{"object_names", {}};
    const auto end_cell = [&](double newton) {
      object.push_back(static_cast<float>(names.values.size()));
      tension.push_back(static_cast<float>(newton));
    };
    for (const Body& body : bodies_) {
      if (surface_ && body.name == surface_->body) continue;
      const Eigen::Isometry3d X_WB = pose(body.name, instant);
      for (std::size_t b = 0; b < body.boxes.rows(); ++b) {
        if (body.boxes.values.empty()) break;
        add_box(X_WB, body.boxes, b, grid);
        end_cell(0);
      }
      names.values.push_back(body.name);
    }
    for (const Line& line : lines_) {
      const std::int32_t first = grid.point_count();
      for (std::size_t p = 0; p < line.bodies.size(); ++p)
        grid.add_point(pose(line.bodies[p], instant) *
                       Eigen::Vector3d(line.points(p, 0), line.points(p, 1), line.points(p, 2)));
      grid.add_cell(VtkCell::polyline, first, static_cast<int>(line.bodies.size()));
      end_cell(line.tension ? (*line.tension)(instant) : 0);
      names.values.push_back(line.name);
    }
    grid.cell_data = {{"object", std::move(object)}, {"tension", std::move(tension)}};
    grid.texts = {std::move(names)};
    return grid;
  }

  VtkGrid block(std::size_t instant) const {
    VtkGrid grid;
    const Eigen::Isometry3d X_WB = pose(surface_->body, instant);
    for (std::size_t p = 0; p < surface_->points.rows(); ++p)
      grid.add_point(X_WB * Eigen::Vector3d(surface_->points(p, 0), surface_->points(p, 1),
                                            surface_->points(p, 2)));
    grid.connectivity = surface_->quads.values;
    for (std::size_t q = 0; q < surface_->quads.rows(); ++q) {
      grid.offsets.push_back(static_cast<std::int32_t>(4 * (q + 1)));
      grid.types.push_back(static_cast<std::uint8_t>(VtkCell::quadrangle));
    }
    grid.point_data = {{"von_mises", std::vector<float>(surface_->von_mises.values.begin(),
                                                        surface_->von_mises.values.end())}};
    return grid;
  }

 private:
  static Line read_line(const ResultsReader& results, const std::string& name) {
    const std::string path = join(layout::scene_ropes, name);
    Line line{
        name, results.read_texts(join(path, "bodies")), results.read(join(path, "points")), {}};
    for (const char* const kind : {"ropes", "hoists"}) {
      const std::string tension = join(layout::dynamic_history, kind, name, "tension");
      if (results.has(tension)) line.tension = results.read(tension);
    }
    return line;
  }

  static std::optional<MovedSurface> read_surface(const ResultsReader& results) {
    const std::string history =
        join(layout::structure_group, layout::history, layout::dynamic_state, "von_mises");
    const std::string at_once =
        join(layout::structure_group, "simultaneous", layout::dynamic_state, "von_mises");
    const std::string& stress = results.has(history) ? history : at_once;
    if (!results.has(stress) || !results.has_attribute(layout::scene_lugs, "body")) return {};
    return MovedSurface{results.read_text_attribute(layout::scene_lugs, "body"),
                        results.read(layout::surface_points),
                        results.read_indices(layout::surface_quads), results.read(stress)};
  }

  static void add_box(const Eigen::Isometry3d& X_WB, const Array<double>& boxes, std::size_t b,
                      VtkGrid& grid) {
    const Eigen::Quaterniond turned(boxes(b, 6), boxes(b, 7), boxes(b, 8), boxes(b, 9));
    const Eigen::Vector3d size(boxes(b, 0), boxes(b, 1), boxes(b, 2));
    const Eigen::Vector3d centre(boxes(b, 3), boxes(b, 4), boxes(b, 5));
    const std::int32_t first = grid.point_count();
    for (const auto& corner : corners)
      grid.add_point(
          X_WB *
          (centre + turned * (0.5 * Eigen::Map<const Eigen::Vector3d>(corner).cwiseProduct(size))));
    grid.add_cell(VtkCell::hexahedron, first, 8);
  }

  Eigen::Isometry3d pose(const std::string& body, std::size_t instant) const {
    const auto found = poses_.find(body);
    if (found == poses_.end()) return Eigen::Isometry3d::Identity();  // the world
    return pose_of(found->second, instant);
  }

  Array<double> time_;
  std::map<std::string, Array<double>> poses_;
  std::vector<Body> bodies_;
  std::vector<Line> lines_;
  std::optional<MovedSurface> surface_;
};

}  // namespace

void require_frames(const fs::path& folder) {
  const ResultsReader results(folder / layout::results_file);
  if (!results.has(layout::scene_group) || !results.has(join(layout::dynamic_history, "time")))
    throw ResultsError((folder / layout::results_file).string() +
                       ": the results have nothing that moves: there are no frames of it");
}

fs::path write_lift_frames(const fs::path& folder, int frames) {
  require_frames(folder);
  const Lift lift{ResultsReader(folder / layout::results_file)};
  const fs::path place = folder / "lift-frames", aside = folder / ".lift-frames.part";
  fs::remove_all(aside);
  fs::create_directories(aside);
  std::string collection = structure::vtk_head("Collection") + "<Collection>\n";
  int number = 0;
  for (const std::size_t instant :
       evenly_spread_indices(lift.instants(), static_cast<std::size_t>(frames))) {
    const auto add = [&](const char* what, int part, const VtkGrid& grid) {
      const std::string name = fmt::format("{}-{:04}.vtu", what, number);
      structure::write_vtk_grid(aside / name, grid);
      collection += fmt::format(
          "<DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" "
          "file=\"lift-frames/{}\"/>\n",
          lift.time(instant), part, what, name);
    };
    add("cranes", 0, lift.cranes(instant));
    if (lift.has_surface()) add("block", 1, lift.block(instant));
    ++number;
  }
  fs::remove_all(place);
  fs::rename(aside, place);
  fs::path path = folder / "lift.pvd";
  write_file(path, collection + "</Collection>\n</VTKFile>\n");
  return path;
}

}  // namespace blocklift::pipeline
