// Materials: elasticity, density, and the yield stress of a plastic curve.

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/deck/plausibility.h"

namespace blocklift::structure {

namespace {

/// One material, whose keywords follow it.
class MaterialBlocks {
 public:
  MaterialBlocks(AbaqusModel& model, const AbaqusBlock& block) : model_(model) {
    material_.isotropic.name = block.required("NAME");
    material_.line = block.line;
  }

  /// Whether a keyword says something of a material.
  static bool knows(const std::string& name) {
    return name == "ELASTIC" || name == "DENSITY" || name == "PLASTIC" || name == "EXPANSION" ||
           is_left_out(name);
  }

  void read(const AbaqusBlock& block) {
    if (is_left_out(block.name)) {
      model_.log.leave_out("*" + block.name, "matters to no lift");
      return;
    }
    if (block.name == "EXPANSION") {
      read_expansion(block);
      return;
    }
    if (block.data.empty()) throw CardError{"a line of data is missing"};
    if (block.data.size() > lines_of(block.value("TYPE")) && block.name != "PLASTIC")
      model_.log.leave_out("*" + block.name, "values at other temperatures: the first are used");
    auto fields = block.data.front().fields();
    for (std::size_t i = 1; i < lines_of(block.value("TYPE")) && i < block.data.size(); ++i) {
      fields.resize(8 * i);  // lines before the last are full
      const auto more = block.data[i].fields();
      fields.insert(fields.end(), more.begin(), more.end());
    }
    if (block.name == "DENSITY")
      material_.isotropic.density = abaqus_real(fields, 0, "density") * model_.units.density();
    else if (block.name == "PLASTIC")
      read_yield(fields);
    else
      read_elastic(block, fields);
  }

  void finish() {
    if (!has_elasticity_) return;
    const Material& solid = material_.isotropic;
    if (material_.is_isotropic) material_.ply = isotropic_ply(solid);
    material_.ply.density = solid.density;
    material_.ply.expansion << material_.expansion[0], material_.expansion[1],
        material_.expansion[3];
    // One that is refused below is there all the same: what is made of it is not at fault.
    if (!model_.materials.try_emplace(solid.name, material_).second)
      throw CardError{fmt::format("material {} is there twice", solid.name)};
    if (!material_.is_isotropic) return;
    check_plausible(solid, "material " + solid.name, model_.units, model_.log, material_.line);
    check_poisson_ratio(solid, "material " + solid.name);
  }

  SourceLine line() const { return material_.line; }

 private:
  static bool is_left_out(const std::string& name) {
    static const std::set<std::string> names{"CONDUCTIVITY", "SPECIFIC HEAT", "DAMPING",
                                             "DEPVAR",       "CREEP",         "RATE DEPENDENT"};
    return names.count(name) > 0;
  }

  /// Lines of data at one temperature.
  static std::size_t lines_of(const std::string& type) {
    if (type.starts_with("ANISO")) return 3;
    return type.starts_with("ENGINEERING") || type.starts_with("ORTHO") ? 2 : 1;
  }

  // *EXPANSION, TYPE = ISO | ORTHO | ANISO / a, or a11, a22, a33, or those and a12, a13, a23; then
  // the temperature. With one coefficient for all temperatures that of no expansion (ZERO) has no
  // effect: strains count from the initial temperatures.
  void read_expansion(const AbaqusBlock& block) {
    const std::string type = block.value("TYPE");
    const bool is_ortho = type.starts_with("ORTHO"), is_aniso = type.starts_with("ANISO");
    const auto hinder = [&](const std::string& why) {
      material_.obstacle = fmt::format("material {} {} (*EXPANSION at {})",
                                       material_.isotropic.name, why, model_.log.place(block.line));
    };
    if (block.has("USER") || !(type.empty() || type.starts_with("ISO") || is_ortho || is_aniso)) {
      hinder("expands in a way that is not known; ISO, ORTHO and ANISO are");
      return;
    }
    if (block.data.empty()) throw CardError{"a line of data is missing"};
    const std::size_t count = is_aniso ? 6 : is_ortho ? 3 : 1;
    for (std::size_t i = 0; i < block.data.size(); ++i) {
      const auto fields = block.data[i].fields();
      ExpansionStrains strains = ExpansionStrains::Zero();
      for (std::size_t k = 0; k < count; ++k)
        strains[k] = abaqus_real(fields, k, "coefficient of expansion");
      if (count == 1) strains.head<3>().setConstant(strains[0]);
      if (!strains.tail<3>().isZero(0)) hinder("expands in shear, which is not known");
      if (i > 0 && strains != material_.expansion) hinder("expands by the temperature");
      if (i == 0) material_.expansion = strains;
    }
  }

  void read_yield(const std::vector<std::string_view>& fields) {
    material_.isotropic.yield_stress = abaqus_real(fields, 0, "stress") * model_.units.stress();
    model_.log.leave_out("*PLASTIC", "plasticity: its first stress is the yield stress");
  }

  void read_elastic(const AbaqusBlock& block, const std::vector<std::string_view>& fields) {
    has_elasticity_ = true;
    const double stress = model_.units.stress();
    const std::string type = block.value("TYPE");
    if (type.empty() || type == "ISOTROPIC" || type == "ISO") {
      material_.isotropic.youngs_modulus = abaqus_real(fields, 0, "Young's modulus") * stress;
      material_.isotropic.poisson_ratio = abaqus_real(fields, 1, "Poisson's ratio", 0.0);
      return;
    }
    if (without_blanks(type) == "ENGINEERINGCONSTANTS" || type.starts_with("ORTHO")) {
      read_orthotropic(type.starts_with("ORTHO"), fields);
      return;
    }
    if (type.starts_with("ANISO")) {
      read_matrix(fields);
      return;
    }
    if (type != "LAMINA")
      throw CardError{
          fmt::format("elasticity of type {} is not known; ISOTROPIC, LAMINA, ORTHOTROPIC, "
                      "ENGINEERING CONSTANTS and ANISOTROPIC are",
                      type)};
    // E1, E2, nu12, G12, G13, G23
    std::array<double, 6> value{};
    for (std::size_t i = 0; i < 6; ++i)
      value[i] = abaqus_real(fields, i, "elastic constant") * (i == 2 ? 1.0 : stress);
    if (!(*std::min_element(value.begin(), value.end()) >= 0 && value[0] > 0 && value[1] > 0 &&
          value[3] > 0 && value[4] > 0 && value[5] > 0))
      throw CardError{"moduli must be positive"};
    material_.is_isotropic = false;
    material_.isotropic.youngs_modulus = value[0];
    material_.isotropic.poisson_ratio = value[2];
    material_.ply = orthotropic_ply(value[0], value[1], value[2], value[3], value[4], value[5], 0);
  }

  // E1, E2, E3, nu12, nu13, nu23, G12, G13 / G23, or D1111, D1122, D2222, D1133, D2233, D3333,
  // D1212, D1313 / D2323. A plate of it is in plane stress.
  void read_orthotropic(bool is_by_stiffness, const std::vector<std::string_view>& fields) {
    const double stress = model_.units.stress();
    std::array<double, 9> v{};
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = abaqus_real(fields, i, "elastic constant") *
             (!is_by_stiffness && i >= 3 && i < 6 ? 1.0 : stress);
    // Compliance of the direct stresses: epsilon = c sigma.
    Eigen::Matrix3d c;
    if (is_by_stiffness) {
      Eigen::Matrix3d d;
      d << v[0], v[1], v[3], v[1], v[2], v[4], v[3], v[4], v[5];
      c = d.inverse();
    } else {
      c << 1 / v[0], -v[3] / v[0], -v[4] / v[0], -v[3] / v[0], 1 / v[1], -v[5] / v[1], -v[4] / v[0],
          -v[5] / v[1], 1 / v[2];
    }
    const Eigen::Vector3d shear(v[6], v[7], v[8]);  // G12, G13, G23
    if (!c.allFinite() || !(shear.minCoeff() > 0) || !(algebra::symmetric_eigenvalues(c)[0] > 0))
      throw CardError{"the elastic constants belong to no material: its energy is not positive"};
    const double modulus = 3 / c.trace();
    const double ratio = -modulus * (c(0, 1) + c(0, 2) + c(1, 2)) / 3;
    Eigen::Matrix3d even = Eigen::Matrix3d::Constant(-ratio / modulus);
    even.diagonal().setConstant(1 / modulus);
    constexpr double rounding = 1e-3;
    material_.is_isotropic =
        (c - even).cwiseAbs().maxCoeff() < rounding / modulus &&
        (shear * (2 * (1 + ratio) / modulus) - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff() <
            rounding;
    material_.isotropic.youngs_modulus = material_.is_isotropic ? modulus : 1 / c(0, 0);
    material_.isotropic.poisson_ratio = material_.is_isotropic ? ratio : -c(0, 1) / c(0, 0);
    if (material_.is_isotropic) return;
    material_.ply =
        orthotropic_ply(1 / c(0, 0), 1 / c(1, 1), -c(0, 1) / c(0, 0), v[6], v[7], v[8], 0);
    material_.of_solids =
        orthotropic_elasticity({{1 / c(0, 0), 1 / c(1, 1), 1 / c(2, 2)},
                                {-c(0, 1) / c(0, 0), -c(0, 2) / c(0, 0), -c(1, 2) / c(1, 1)},
                                shear});
  }

  // D1111, D1122, D2222, D1133, D2233, D3333, D1112, D2212 / D3312, D1212, D1113, D2213, D3313,
  // D1213, D1313, D1123 / D2223, D3323, D1223, D1323, D2323: of 11, 22, 33, 12, 13, 23 the upper
  // half, column by column.
  void read_matrix(const std::vector<std::string_view>& fields) {
    static constexpr std::array<Eigen::Index, 6> order{0, 1, 2, 3, 5, 4};
    Elasticity d;
    std::size_t field = 0;
    for (std::size_t j = 0; j < order.size(); ++j)
      for (std::size_t i = 0; i <= j; ++i)
        d(order[i], order[j]) = d(order[j], order[i]) =
            abaqus_real(fields, field++, "elastic constant") * model_.units.stress();
    if (!is_positive(d))
      throw CardError{"the elastic constants belong to no material: its energy is not positive"};
    const Material nearest = nearest_isotropic(d);
    material_.isotropic.youngs_modulus = nearest.youngs_modulus;
    material_.isotropic.poisson_ratio = nearest.poisson_ratio;
    material_.is_isotropic = is_isotropic(d);
    if (material_.is_isotropic) return;
    material_.of_solids = d;
    material_.is_for_solids_alone = true;
  }

  AbaqusModel& model_;
  AbaqusMaterial material_;
  bool has_elasticity_ = false;
};

}  // namespace

void read_abaqus_materials(AbaqusModel& model) {
  for (const AbaqusScope& scope : model.scopes) {
    for (std::size_t i = 0; i < scope.blocks.size(); ++i) {
      if (scope.blocks[i]->name != "MATERIAL") continue;
      model.guarded(*scope.blocks[i], [&] {
        MaterialBlocks material(model, *scope.blocks[i]);
        for (std::size_t j = i + 1;
             j < scope.blocks.size() && MaterialBlocks::knows(scope.blocks[j]->name); ++j)
          model.guarded(*scope.blocks[j], [&] { material.read(*scope.blocks[j]); });
        material.finish();
      });
    }
  }
}

void refuse_solids_alone(const AbaqusMaterial& material) {
  if (material.is_for_solids_alone)
    throw CardError{
        fmt::format("material {} is given as solids have it (ANISOTROPIC); a plate "
                    "takes LAMINA, ORTHOTROPIC or ENGINEERING CONSTANTS",
                    material.isotropic.name)};
}

int abaqus_solid_material(AbaqusModel& model, const std::string& name) {
  const auto found = model.materials.find(name);
  if (found == model.materials.end() || !found->second.of_solids)
    return abaqus_material(model, name);
  AbaqusMaterial& material = found->second;
  if (material.directional_place < 0) {
    Material nearest = nearest_isotropic(*material.of_solids);
    nearest.name = material.isotropic.name;
    nearest.density = material.isotropic.density;
    nearest.yield_stress = material.isotropic.yield_stress;
    check_plausible(nearest, "material " + nearest.name, model.units, model.log, material.line,
                    1e3);  // cores are soft
    material.directional_place = static_cast<int>(model.deck.mesh.materials.size());
    model.deck.mesh.materials.push_back(nearest);
    model.deck.expansions.set(material.directional_place, {0, 0, material.obstacle});
  }
  return material.directional_place;
}

int abaqus_material(AbaqusModel& model, const std::string& name) {
  const auto found = model.materials.find(name);
  if (found == model.materials.end())
    throw CardError{fmt::format("material {} does not exist, or has no elasticity", name)};
  AbaqusMaterial& material = found->second;
  if (!material.is_isotropic)
    throw CardError{
        fmt::format("material {} depends on the direction; an isotropic one is due", name)};
  if (material.place < 0) {
    material.place = static_cast<int>(model.deck.mesh.materials.size());
    model.deck.mesh.materials.push_back(material.isotropic);
    model.deck.expansions.set(material.place,
                              even_expansion(material.expansion, 0, material.obstacle,
                                             "material " + material.isotropic.name));
  }
  return material.place;
}

}  // namespace blocklift::structure
