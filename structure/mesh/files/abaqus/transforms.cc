// Systems of axes at nodes, and normals that are given there.

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

class Transforms {
 public:
  explicit Transforms(AbaqusModel& model) : model_(model) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes) {
      scope_ = &scope;
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "TRANSFORM")
          model_.guarded(*block, [&] { add_transform(*block); });
        else if (block->name == "NORMAL")
          model_.guarded(*block, [&] { look_at_normals(*block); });
    }
  }

 private:
  // *NORMAL / element or set, node or set, direction. Plates have the normals of their surfaces; a
  // beam's cross-section would turn with its own.
  void look_at_normals(const AbaqusBlock& block) {
    model_.for_lines(block, [&](const Fields& fields) {
      for (const int e : model_.elements_of(*scope_, fields[0])) {
        const AbaqusDeckElement& element = model_.elements[e];
        if (element.kind == AbaqusKind::beam)
          throw CardError{fmt::format(
              "the normal of beam {} is to be given by its *BEAM SECTION (n1)", element.label)};
      }
    });
    model_.log.leave_out("*NORMAL", "plates have the normals of their surfaces");
  }

  // *TRANSFORM, NSET = , TYPE = R | C | S / two points
  void add_transform(const AbaqusBlock& block) {
    const std::string type = block.value("TYPE");
    if (block.data.empty()) throw CardError{"two points are due"};
    const Fields fields = block.data.front().fields();
    const double length = model_.units.length;
    std::array<Vector3, 2> points;
    for (std::size_t p = 0; p < 2; ++p)
      points[p] = length * Vector3(abaqus_real(fields, 3 * p, "coordinate"),
                                   abaqus_real(fields, 3 * p + 1, "coordinate"),
                                   abaqus_real(fields, 3 * p + 2, "coordinate"));
    const auto to_world = [&](const Vector3& point) -> Vector3 {
      return scope_->turn * point + length * scope_->shift;
    };
    LocalSystem system;
    if (type.empty() || type == "R") {
      const Vector3 third = points[0].cross(points[1]);
      if (!(third.norm() > 0)) throw CardError{"the two directions are one"};
      system.axes.col(0) = (scope_->turn * points[0]).normalized();
      system.axes.col(2) = (scope_->turn * third).normalized();
      system.axes.col(1) = system.axes.col(2).cross(system.axes.col(0));
    } else if (type == "C") {
      const Vector3 axis = to_world(points[1]) - to_world(points[0]);
      if (!(axis.norm() > 0)) throw CardError{"the axis has no length"};
      const Vector3 across = axis.unitOrthogonal();
      system = system_through(SystemKind::cylindrical, to_world(points[0]), to_world(points[1]),
                              to_world(points[0]) + across);
    } else {
      throw CardError{fmt::format("TYPE = {} is not known; R and C are", type)};
    }
    for (const int node : model_.nodes_of(*scope_, block.required("NSET")))
      model_.axes_of[node] = system.axes_at(model_.place(node));
  }

  AbaqusModel& model_;
  const AbaqusScope* scope_ = nullptr;
};

}  // namespace

void read_abaqus_transforms(AbaqusModel& model) { Transforms(model).read(); }

}  // namespace blocklift::structure
