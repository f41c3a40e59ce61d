#include "pipeline/assessment/part_assessment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "pipeline/assessment/stopwatch.h"
#include "structure/error.h"
#include "structure/mesh/part_reader.h"
#include "structure/response/cell_stress.h"

namespace blocklift::pipeline {

namespace {

using structure::PartGroup;
using structure::PartModel;

/// Puts the parts of a file and its mesh together; complains at the places of names.
class ModelMaker {
 public:
  ModelMaker(const PartFile& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  PartModel make() {
    structure::PartReading reading;
    reading.length_unit = file_.mesh.length_unit.value_or(1);
    reading.element_order = file_.mesh.element_order;
    reading.element_size = file_.mesh.element_size.value_or(0);
    reading.refinements = file_.mesh.refinements;
    reading.memory = structure::available_memory();
    for (const PartPlate& plate : file_.mesh.plates)
      reading.plates[plate.name.value] = plate.thickness;
    try {
      model_.mesh = structure::read_part_mesh(file_.mesh_path().string(), reading);
    } catch (const structure::ModelError& error) {
      diagnostics_.error(file_.mesh.file.mark, error.what());
      return {};
    }
    doubt_size();
    take_materials();
    take_supports();
    take_loads();
    return std::move(model_);
  }

 private:
  // Ships and blocks are some tens of metres, details some centimetres: what is 1,000 times off was
  // written in millimetres (or in metres and read as millimetres).
  void doubt_size() {
    if (file_.mesh.length_unit) return;
    const Vector3 size =
        model_.mesh.nodes.rowwise().maxCoeff() - model_.mesh.nodes.rowwise().minCoeff();
    const double largest = size.maxCoeff();
    if (largest <= 500 && largest >= 2e-3) return;
    diagnostics_.error(
        file_.mesh.file.mark,
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
                                         file_.materials[static_cast<std::size_t>(rest)].name.value,
                                         material.name.value),
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
          file_.mesh.file.mark,
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
      int& of_solid =
          model_.material_of_solid[static_cast<std::size_t>(solid_of_element.at(element))];
      if (of_solid >= 0 && of_solid != material) {
        diagnostics_.error(
            name.mark,
            fmt::format("group \"{}\" is of material {} and holds elements of material {}",
                        name.value, model_.materials[static_cast<std::size_t>(material)].name,
                        model_.materials[static_cast<std::size_t>(of_solid)].name));
        return;
      }
      of_solid = material;
    }
  }

  void take_supports() {
    for (const PartSupportInFile& support : file_.supports)
      for (const Located<std::string>& name : support.groups) {
        if (!find(name)) continue;
        structure::PartSupport taken{
            support.name.value, name.value, {false, false, false}, support.displacement};
        for (const std::size_t axis : support.fixed) taken.fixed[axis] = true;
        model_.supports.push_back(std::move(taken));
      }
  }

  void take_loads() {
    bool needs_density = false;
    for (const PartLoadInFile& load : file_.loads) {
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

  void take_surface_load(const PartLoadInFile& load, const Located<std::string>& name) {
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
                                     contents[static_cast<std::size_t>(group->dimension)]));
      return;
    }
    model_.surface_loads.push_back(std::move(taken));
  }

  const PartFile& file_;
  Diagnostics& diagnostics_;
  PartModel model_;
};

std::vector<ProbeResult> find_probes(const PartFile& file, const PartModel& model,
                                     const structure::PartSolution& solution,
                                     Diagnostics& diagnostics) {
  std::vector<ProbeResult> results;
  for (const PartProbeInFile& probe : file.probes) {
    ProbeResult result{probe.name.value, !probe.at, {}};
    const int count = probe.at ? 1 : probe.points;
    for (int i = 0; i < count; ++i) {
      const Vector3 place = probe.at ? *probe.at
                                     : Vector3(*probe.from + static_cast<double>(i) / (count - 1) *
                                                                 (*probe.to - *probe.from));
      result.points.push_back(structure::probe_part(model, solution, place));
    }
    const auto outside = std::count_if(result.points.begin(), result.points.end(),
                                       [](const auto& point) { return !point.inside; });
    if (outside == count)
      diagnostics.error(probe.name.mark,
                        fmt::format("probe {} lies outside the part", probe.name.value));
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<HotSpotResult> find_hot_spots(const PartFile& file, const PartModel& model,
                                          const structure::PartSolution& solution,
                                          Diagnostics& diagnostics) {
  std::vector<HotSpotResult> results;
  for (const HotSpotInFile& asked : file.hot_spots) {
    HotSpotResult result{asked.name.value, {asked.toe, asked.direction, asked.thickness}, {}, {}};
    std::array<structure::Stress, 2> stress;
    bool inside = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3 place = result.spot.places()[i];
      const structure::PartProbe probe = structure::probe_part(model, solution, place);
      stress[i] = probe.stress;
      if (inside && !probe.inside)
        diagnostics.error(asked.name.mark,
                          fmt::format("hot spot {} is read at ({:.6g}, {:.6g}, {:.6g}) m, which is "
                                      "outside the part",
                                      asked.name.value, place.x(), place.y(), place.z()),
                          {"the toe lies on the surface and the direction along it"});
      inside = inside && probe.inside;
    }
    result.structural = structure::hot_spot_stress(stress[0], stress[1]);
    result.stress = structure::evaluate_hot_spot(result.structural, asked.direction);
    results.push_back(std::move(result));
  }
  return results;
}

// Alone, this process iterates as a team of one.
structure::PartDisplacement solve_alone(const PartModel& model,
                                        const std::vector<structure::FixedUnknown>& fixed,
                                        const Eigen::VectorXd& load,
                                        const structure::SolverChoice& choice) {
  using structure::SolverMethod;
  try {
    if (choice.method != SolverMethod::iterative) return solve_by_cholesky(model, fixed, load);
  } catch (const structure::NotEnoughMemory&) {
    if (choice.method == SolverMethod::direct) throw;
  }
  structure::PartTeam team(structure::ProcessGroup::of_this_run());
  return team.solve(model, fixed, load, {SolverMethod::iterative, choice.tolerance});
}

}  // namespace

double figure_of(const PartAssessment& assessment, const PartReference& reference) {
  if (reference.mode) return assessment.modes->frequencies[*reference.mode - 1];
  const auto probe = std::find_if(
      assessment.probes.begin(), assessment.probes.end(),
      [&](const ProbeResult& result) { return result.name == reference.probe->value; });
  const structure::PartProbe& point = probe->points.at(0);
  const PartQuantity quantity = *reference.quantity;
  if (quantity == PartQuantity::von_mises) return structure::von_mises(point.stress);
  const int place = static_cast<int>(quantity);
  return quantity >= PartQuantity::u_x
             ? point.displacement[place - static_cast<int>(PartQuantity::u_x)]
             : point.stress[place];
}

std::string name_of(const PartReference& reference) {
  return reference.mode
             ? fmt::format("frequency of mode {}", *reference.mode)
             : fmt::format("{} at {}", name_of(*reference.quantity), reference.probe->value);
}

PartModel make_part_model(const PartFile& file, Diagnostics& diagnostics) {
  return ModelMaker(file, diagnostics).make();
}

namespace {

RefinementStep step_of(const PartAssessment& assessment) {
  const structure::PartSolution& solution = assessment.solution;
  return {assessment.file.mesh.element_order,
          assessment.model.mesh.solids.size(),
          static_cast<int>(3 * assessment.model.mesh.nodes.cols()),
          solution.estimated_error,
          solution.all.von_mises,
          solution.all.von_mises_error};
}

// The next better mesh: quadratic elements first, then halved ones.
void refine(PartMeshInFile& mesh) {
  if (mesh.element_order < 2)
    mesh.element_order = 2;
  else
    ++mesh.refinements;
}

// Meshes and solves, with better meshes until the accuracy is met.
void solve(PartAssessment& assessment, structure::PartTeam* team, Diagnostics& diagnostics) {
  constexpr std::size_t most_steps = 6;
  Stopwatch watch;
  const std::optional<double> accuracy = assessment.file.accuracy;
  for (;;) {
    try {
      watch.lap();
      assessment.model = make_part_model(assessment.file, diagnostics);
      if (diagnostics.has_errors()) throw InputError(diagnostics);
      assessment.mesh_s = watch.lap();
      if (assessment.file.loads.empty()) return;
      assessment.solution = structure::solve_part(
          assessment.model, [&](const PartModel& model, const auto& fixed, const auto& load) {
            const structure::SolverChoice& choice = assessment.file.solver;
            return team ? team->solve(model, fixed, load, choice)
                        : solve_alone(model, fixed, load, choice);
          });
    } catch (const structure::ModelError& error) {
      std::string message = error.what();
      if (!assessment.refinement.empty())
        message += fmt::format(
            "; the accuracy of {:.3g} % is not reached: {} elements have an error of {:.3g} %",
            100 * *accuracy, assessment.refinement.back().elements,
            100 * assessment.refinement.back().estimated_error);
      diagnostics.error(assessment.file.mesh.file.mark, message);
      throw InputError(diagnostics);
    }
    assessment.refinement.push_back(step_of(assessment));
    const RefinementStep& last = assessment.refinement.back();
    if (!accuracy || last.estimated_error <= *accuracy) return;
    if (assessment.refinement.size() == most_steps) {
      const Vector3& worst = assessment.solution.worst_point;
      diagnostics.error(
          assessment.file.mesh.file.mark,
          fmt::format("the accuracy of {:.3g} % is not reached: {} elements have an error of "
                      "{:.3g} %, most of it at ({:.4g}, {:.4g}, {:.4g}) m",
                      100 * *accuracy, last.elements, 100 * last.estimated_error, worst.x(),
                      worst.y(), worst.z()),
          {"make the mesh finer there, round off a sharp corner, or ask for less"});
      throw InputError(diagnostics);
    }
    refine(assessment.file.mesh);
  }
}

}  // namespace

PartAssessment assess_part(PartFile file, structure::PartTeam* team) {
  Diagnostics diagnostics;
  PartAssessment assessment;
  assessment.file = std::move(file);
  solve(assessment, team, diagnostics);
  Stopwatch watch;
  try {
    if (assessment.file.modes)
      assessment.modes = structure::find_part_modes(assessment.model, *assessment.file.modes);
  } catch (const structure::ModelError& error) {
    diagnostics.error(assessment.file.mesh.file.mark, error.what());
    throw InputError(diagnostics);
  }
  assessment.modes_s = watch.lap();
  assessment.mass = structure::find_part_mass(assessment.model);
  if (assessment.file.loads.empty()) return assessment;
  assessment.probes =
      find_probes(assessment.file, assessment.model, assessment.solution, diagnostics);
  assessment.hot_spots =
      find_hot_spots(assessment.file, assessment.model, assessment.solution, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return assessment;
}

}  // namespace blocklift::pipeline
