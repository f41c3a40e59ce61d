// A part's file and its mesh become a model.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pipeline/part/part_assessment.h"
#include "pipeline/part/part_padeye.h"
#include "structure/error.h"
#include "structure/mesh/files/cad_unit.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/mesh/quarter_points.h"
#include "structure/system/linear_solver.h"

namespace blocklift::pipeline {

namespace {

using structure::PartGroup;
using structure::PartModel;

/// Puts the parts of a file and its mesh together; complains at the places of names.
class ModelMaker {
 public:
  ModelMaker(const PartFile& file, const std::optional<structure::SizeField>& sizes,
             Diagnostics& diagnostics)
      : file_(file), sizes_(sizes), diagnostics_(diagnostics) {}

  PartModel make() {
    try {
      model_.mesh =
          file_.mesh.padeye ? structure::make_part_mesh(part_padeye_mesh(file_).mesh) : read_mesh();
    } catch (const structure::ModelError& error) {
      diagnostics_.error(file_.mesh.mark(), error.what());
      return {};
    }
    check_choices();
    doubt_size();
    take_materials();
    take_supports();
    take_loads();
    if (!diagnostics_.has_errors()) join_bodies();
    return std::move(model_);
  }

 private:
  structure::PartMesh read_mesh() {
    structure::PartReading reading;
    reading.length_unit = file_.mesh.length_unit.value_or(0);
    reading.element_order = file_.mesh.element_order;
    reading.element_size = file_.mesh.element_size.value_or(0);
    reading.refinements = file_.mesh.refinements;
    reading.memory = structure::available_memory();
    reading.sizes = sizes_;
    for (const PartPlate& plate : file_.mesh.plates)
      reading.plates[plate.name.value] = plate.thickness;
    for (const given::PartFaces& faces : file_.mesh.faces)
      reading.faces.push_back({faces.name.value, faces.from, faces.to});
    for (const given::PartPoint& point : file_.mesh.points)
      reading.points.push_back({point.name.value, point.at});
    return structure::read_part_mesh(file_.mesh_path().string(), reading);
  }

  void check_choices() {
    const auto check = [&](const Located<std::string>& name, const std::string& missing) {
      const PartGroup* group = model_.mesh.find_group(name.value);
      if (group && !group->elements.empty()) return;
      const Vector3 lower = model_.mesh.nodes.rowwise().minCoeff();
      const Vector3 upper = model_.mesh.nodes.rowwise().maxCoeff();
      diagnostics_.error(
          name.mark, missing,
          {fmt::format(
              "the part reaches from ({:.6g}, {:.6g}, {:.6g}) m to ({:.6g}, {:.6g}, {:.6g}) m",
              lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z())});
    };
    for (const given::PartFaces& faces : file_.mesh.faces)
      check(faces.name,
            fmt::format("no outer face of the part lies in the box of faces {}", faces.name.value));
    for (const given::PartPoint& point : file_.mesh.points)
      check(point.name, fmt::format("no node lies near point {}", point.name.value));
  }

  // Ships and blocks are some tens of metres, details some centimetres: what is 1,000 times off was
  // written in millimetres (or in metres and read as millimetres).
  void doubt_size() {
    if (file_.mesh.length_unit || file_.mesh.padeye) return;
    const std::string path = file_.mesh_path().string();
    if (structure::is_cad_file(path) && structure::declared_length(path) > 0) return;
    const Vector3 size =
        model_.mesh.nodes.rowwise().maxCoeff() - model_.mesh.nodes.rowwise().minCoeff();
    const double largest = size.maxCoeff();
    if (largest <= 500 && largest >= 2e-3) return;
    diagnostics_.error(
        file_.mesh.mark(),
        fmt::format("the part is {:.4g} m long if the mesh's coordinates are metres: is its unit "
                    "another one?",
                    largest),
        {"say which it is: length_unit: mm (or m, if it is as large as that)"});
  }

  const PartGroup* find(const Located<std::string>& name) {
    const PartGroup* group = model_.mesh.find_group(name.value);
    if (!group) {
      diagnostics_.error(name.mark, fmt::format("there is no group \"{}\" in the mesh", name.value),
                         {names_hint("its groups are", model_.mesh.group_names(), name.value)});
    } else if (group->elements.empty()) {
      diagnostics_.error(name.mark, fmt::format("group \"{}\" names no element", name.value));
    } else {
      return group;
    }
    return nullptr;
  }

  void take_materials() {
    std::map<int, int> solid_of_element;
    for (std::size_t s = 0; s < model_.mesh.solids.size(); ++s)
      solid_of_element[model_.mesh.solids[s]] = static_cast<int>(s);
    model_.material_of_solid.assign(model_.mesh.solids.size(), -1);
    int rest = -1;
    for (std::size_t m = 0; m < file_.materials.size(); ++m) {
      const PartMaterial& material = file_.materials[m];
      model_.materials.push_back({material.name.value, material.youngs_modulus,
                                  material.poisson_ratio, material.density, material.yield_stress});
      if (material.groups.empty()) {
        if (rest >= 0)
          diagnostics_.error(material.name.mark,
                             fmt::format("materials {} and {} both take all that no other names",
                                         file_.materials[rest].name.value, material.name.value),
                             {"give one of them groups"});
        rest = static_cast<int>(m);
      }
      for (const Located<std::string>& name : material.groups)
        paint(name, static_cast<int>(m), solid_of_element);
    }
    int bare = 0;
    for (int& material : model_.material_of_solid) {
      if (material < 0) material = rest;
      if (material < 0) ++bare;
    }
    if (bare > 0)
      diagnostics_.error(
          file_.mesh.mark(),
          fmt::format("{} of {} solid elements have no material", bare, model_.mesh.solids.size()),
          {"name their groups in a material, or leave one material's groups out"});
  }

  void paint(const Located<std::string>& name, int material,
             const std::map<int, int>& solid_of_element) {
    const PartGroup* group = find(name);
    if (!group) return;
    if (group->dimension != 3) {
      diagnostics_.error(
          name.mark,
          fmt::format("group \"{}\" holds no solids; a material is of solids", name.value));
      return;
    }
    for (const int element : group->elements) {
      int& of_solid = model_.material_of_solid[solid_of_element.at(element)];
      if (of_solid >= 0 && of_solid != material) {
        diagnostics_.error(
            name.mark,
            fmt::format("group \"{}\" is of material {} and holds elements of material {}",
                        name.value, model_.materials[material].name,
                        model_.materials[of_solid].name));
        return;
      }
      of_solid = material;
    }
  }

  void take_supports() {
    for (const given::PartSupport& support : file_.supports)
      for (const Located<std::string>& name : support.groups) {
        if (!find(name)) continue;
        structure::PartSupport taken{
            support.name.value, name.value, {false, false, false}, support.displacement};
        for (const std::size_t axis : support.fixed) taken.fixed[axis] = true;
        model_.supports.push_back(std::move(taken));
      }
  }

  void join_bodies() {
    std::vector<structure::FixedUnknown> held;
    std::vector<int> support_of;
    try {
      held = structure::part_supports(model_, support_of);
    } catch (const structure::ModelError& error) {
      diagnostics_.error(file_.mesh.mark(), error.what());
      return;
    }
    std::optional<double> within;
    if (file_.join) within = file_.join->within.value;
    model_.joints = structure::find_part_joints(model_.mesh, held, within);
    if (!file_.join || !model_.joints.ties.empty()) return;
    std::vector<std::string> hints;
    for (const structure::PartMeeting& meeting : model_.joints.meetings)
      hints.push_back(describe(meeting));
    if (hints.empty())
      hints.emplace_back(
          "only nodes of outer faces that face another body are joined; leave join out if the mesh "
          "is one body");
    diagnostics_.error(file_.join->within.mark,
                       fmt::format("no outer face of a body has a node that faces another body "
                                   "within {:.6g} mm, so that nothing is joined",
                                   1e3 * *within),
                       hints);
  }

  void take_loads() {
    bool needs_density = false;
    for (const given::PartLoad& load : file_.loads) {
      structure::BodyLoad body{load.name.value, Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
      if (load.gravity) body.gravity = *load.gravity;
      if (load.acceleration) body.gravity = -*load.acceleration;
      if (load.rotation) {
        body.angular_velocity = load.rotation->speed * load.rotation->axis;
        body.point = load.rotation->point;
      }
      if (load.gravity || load.acceleration || load.rotation) {
        needs_density = true;
        model_.body_loads.push_back(body);
        continue;
      }
      for (const Located<std::string>& name : load.groups) take_surface_load(load, name);
    }
    if (!needs_density) return;
    for (const PartMaterial& material : file_.materials)
      if (!(material.density > 0))
        diagnostics_.error(material.name.mark,
                           fmt::format("material {} has no density, but a load acts on its mass",
                                       material.name.value),
                           {"for steel: density: 7850 kg/m^3"});
  }

  void take_surface_load(const given::PartLoad& load, const Located<std::string>& name) {
    const PartGroup* group = find(name);
    if (!group) return;
    structure::SurfaceLoad taken;
    taken.name = load.name.value;
    taken.group = name.value;
    if (load.pressure) {
      taken.kind = structure::SurfaceLoad::Kind::pressure;
      taken.pressure = *load.pressure;
    } else if (load.traction) {
      taken.kind = structure::SurfaceLoad::Kind::traction;
      taken.vector = *load.traction;
    } else if (load.bearing) {
      taken.kind = structure::SurfaceLoad::Kind::bearing;
      taken.vector = load.bearing->force;
      taken.axis = load.bearing->axis;
      taken.point = load.bearing->point;
    } else {
      taken.vector = *load.force;
    }
    const bool is_force = taken.kind == structure::SurfaceLoad::Kind::force;
    if (group->dimension == 3 || (!is_force && group->dimension != 2)) {
      static const std::array<const char*, 4> contents = {"points", "edges", "faces", "solids"};
      diagnostics_.error(name.mark,
                         fmt::format("load {} needs {}; group \"{}\" holds {}", load.name.value,
                                     is_force ? "faces, edges or points" : "faces", name.value,
                                     contents[group->dimension]));
      return;
    }
    model_.surface_loads.push_back(std::move(taken));
  }

  const PartFile& file_;
  const std::optional<structure::SizeField>& sizes_;
  Diagnostics& diagnostics_;
  PartModel model_;
};

}  // namespace

std::string describe(const structure::PartMeeting& meeting) {
  std::string text =
      fmt::format("bodies {} and {} face each other across {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m",
                  meeting.bodies[0], meeting.bodies[1], 1e3 * meeting.gap, meeting.place.x(),
                  meeting.place.y(), meeting.place.z());
  if (meeting.tied_nodes > 0)
    text += fmt::format(" and are joined by {} nodes, the largest gap {:.3g} mm",
                        meeting.tied_nodes, 1e3 * meeting.largest_gap);
  return text;
}

namespace {

/// Solids whose stress grows without end in a corner, the middle of an edge being at its quarter.
std::vector<std::string> doubts_of_middles(const structure::PartMesh& mesh) {
  constexpr std::size_t most_told = 5;
  const std::vector<structure::QuarterMiddleOfElement> all = structure::find_quarter_middles(mesh);
  std::vector<std::string> doubts;
  for (std::size_t i = 0; i < std::min(all.size(), most_told); ++i) {
    const structure::QuarterMiddle& middle = all[i].middle;
    doubts.push_back(fmt::format(
        "{} has the middle of an edge at ({:.4g}, {:.4g}, {:.4g}) m, {:.3g} of the edge from a "
        "corner: at a quarter or less the element is singular in that corner, where stress grows "
        "without end; put it in the middle unless a crack ends there",
        mesh.describe(all[i].element), middle.place.x(), middle.place.y(), middle.place.z(),
        middle.share));
  }
  if (all.size() > most_told)
    doubts.push_back(fmt::format("{} more elements have the middle of an edge at its quarter",
                                 all.size() - most_told));
  return doubts;
}

}  // namespace

std::vector<std::string> list_doubts(const structure::PartModel& model) {
  constexpr std::size_t most_told = 12;
  std::vector<std::string> doubts;
  std::size_t more = 0;
  for (const structure::PartMeeting& meeting : model.joints.meetings) {
    if (meeting.tied_nodes > 0) continue;
    if (doubts.size() == most_told) {
      ++more;
      continue;
    }
    doubts.push_back(describe(meeting) +
                     " and are not joined: neither holds the other. If they are fastened there, "
                     "unite them in the mesh or say join: {within: ...}, a little more than the "
                     "gap");
  }
  if (more > 0) doubts.push_back(fmt::format("{} more pairs of bodies are not joined", more));
  for (std::string& doubt : doubts_of_middles(model.mesh)) doubts.push_back(std::move(doubt));
  return doubts;
}

PartModel make_part_model(const PartFile& file, Diagnostics& diagnostics,
                          const std::optional<structure::SizeField>& sizes) {
  return ModelMaker(file, sizes, diagnostics).make();
}

}  // namespace blocklift::pipeline
