#include "pipeline/build/build_marine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/files/environment/sea_band.h"

namespace blocklift::pipeline {
namespace {

using dynamics::BodyIndex;

/// A wave of the world as a frame with the same axes has it whose origin is at p.
dynamics::RegularWave seen_from(const Vector3& p, const dynamics::WaveComponent& wave,
                                double wave_number) {
  const double way = p.x() * std::cos(wave.heading) + p.y() * std::sin(wave.heading);
  return {wave.omega, wave.heading, std::polar(wave.amplitude, -(wave.phase + wave_number * way))};
}

/// By the mean of the wave numbers, weighted with the energy; m.
double mean_wave_length(const dynamics::WaveField& waves) {
  double energy = 0, sum = 0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const double amplitude = waves.component(c).amplitude;
    energy += amplitude * amplitude;
    sum += amplitude * amplitude * waves.wave_number(c);
  }
  return sum > 0 ? 2.0 * std::numbers::pi * energy / sum : std::numeric_limits<double>::infinity();
}

/// `vessel` is null for a load, which does not drift.
dynamics::FroudeKrylovPart part_from_database(const given::Vessel* vessel) {
  using Part = dynamics::FroudeKrylovPart;
  if (vessel && vessel->linear_buoyancy) return Part::whole;
  return vessel && vessel->drift.value == DriftMethod::newman ? Part::along_water : Part::none;
}

}  // namespace

dynamics::BodyDefinition MarineBuilder::body(const given::Vessel& vessel) {
  const VesselModel& model = vessel.model->model;
  const Vector3 squares = model.radii_of_gyration.cwiseAbs2();
  dynamics::BodyDefinition body;
  body.name = vessel.name.value;
  body.joint.kind = dynamics::JointKind::free;
  body.mass = model.mass;
  body.p_BoBcm_B = model.centre_of_mass;
  body.I_BBcm_B = (model.mass * squares).asDiagonal();
  return body;
}

void MarineBuilder::place(const std::function<double(const std::string&)>& carried) {
  for (const given::Vessel& vessel : parts_.vessels) {
    const std::string& name = vessel.name.value;
    const double mass = vessel.model->model.mass + carried(name);
    displaced_mass_[name] = mass;
    const double height = vessel.draught
                              ? -vessel.draught->value
                              : dynamics::find_floating_height(*clusters(*vessel.model),
                                                               dynamics::Matrix3::Identity(),
                                                               mass / parts_.sea->density);
    start_[name] = {dynamics::rotation_about(Vector3::UnitZ(), vessel.heading),
                    {vessel.position[0], vessel.position[1], height}};
  }
}

MarineBuilder::Radiating MarineBuilder::lowered(std::string name,
                                                std::shared_ptr<const Vessel> vessel,
                                                std::vector<double> draughts,
                                                const Eigen::Vector2d& position, double heading) {
  const double height = -vessel->hull.bounds()[0].z() - draughts.back();
  return {
      std::move(name),
      std::move(vessel),
      {dynamics::rotation_about(Vector3::UnitZ(), heading), {position.x(), position.y(), height}},
      std::move(draughts)};
}

std::vector<MarineBuilder::Radiating> MarineBuilder::radiating() const {
  std::vector<Radiating> vessels;
  for (const given::Vessel& vessel : parts_.vessels) {
    if (vessel.radiation.value == RadiationMethod::none) continue;
    const std::string& name = vessel.name.value;
    if (vessel.draughts) {
      vessels.push_back(lowered(name, vessel.model, vessel.draughts->value,
                                {vessel.position[0], vessel.position[1]}, vessel.heading));
    } else {
      vessels.push_back(
          {name, vessel.model, start(name), {}, vessel.hydrodynamics, vessel.hydrodynamic_body});
    }
  }
  if (!vessels.empty() && vessels.front().given) {
    const dynamics::Pose X_WD = world_of_database(vessels);
    for (Radiating& vessel : vessels) {
      if (!vessel.given) continue;
      const auto body = static_cast<std::size_t>(vessel.given_body);
      const Vector3 p_WR = X_WD.apply(vessel.given->reference_points[body]);
      vessel.X_BR = {vessel.X_WB.R.transpose() * X_WD.R,
                     vessel.X_WB.R.transpose() * (p_WR - vessel.X_WB.p)};
    }
  }
  if (load_) {
    vessels.push_back(
        lowered(load_->name, load_->vessel, load_->draughts, load_->position, load_->heading));
  }
  return vessels;
}

MarineBuilder::Radiating MarineBuilder::radiating(const std::string& name) const {
  const std::vector<Radiating> vessels = radiating();
  return *std::find_if(vessels.begin(), vessels.end(),
                       [&](const Radiating& one) { return one.name == name; });
}

dynamics::Pose MarineBuilder::world_of_database(const std::vector<Radiating>& vessels) {
  const dynamics::Pose& alone = vessels.front().X_WB;
  if (vessels.size() == 1) return {alone.R, {alone.p.x(), alone.p.y(), 0}};
  const std::vector<Vector3>& centres = vessels.front().given->centres_of_buoyancy;
  Vector3 shift = Vector3::Zero();
  for (const Radiating& vessel : vessels) {
    if (!vessel.given || centres.empty()) continue;
    const dynamics::Hydrostatics rest =
        calc_hydrostatics(dynamics::HullClusters(vessel.vessel->hull), vessel.X_WB);
    const Vector3 difference = vessel.X_WB.p + rest.p_BoC_W() - centres[vessel.given_body];
    shift += Vector3(difference.x(), difference.y(), 0) / static_cast<double>(vessels.size());
  }
  return {dynamics::Matrix3::Identity(), shift};
}

RadiationProblem MarineBuilder::radiation_problem() const {
  RadiationProblem problem;
  const std::vector<Radiating> vessels = radiating();
  if (vessels.empty()) return problem;
  const auto counts = [&](const Radiating& vessel) {
    return vessels.size() == 1 || vessel.draughts.empty();
  };
  const auto count = static_cast<double>(std::count_if(vessels.begin(), vessels.end(), counts));
  Vector3 middle = Vector3::Zero();
  for (const Radiating& vessel : vessels) {
    const Vector3& p = vessel.X_WB.p;
    if (counts(vessel)) middle += Vector3(p.x(), p.y(), 0) / count;
  }
  for (const Radiating& vessel : vessels) {
    if (!vessel.draughts.empty() && !problem.lowered)
      problem.lowered = {problem.bodies.size(), vessel.draughts};
    problem.bodies.push_back({vessel.name,
                              {vessel.vessel, &vessel.vessel->hull},
                              {vessel.X_WB.R, vessel.X_WB.p - middle},
                              vessel.X_BR.p});
    problem.given_bodies.push_back(vessel.given_body);
  }
  if (vessels.front().given) {
    problem.given = vessels.front().given;
    const dynamics::Pose X_DW = world_of_database(vessels).inverse();
    for (std::size_t k = 0; k < vessels.size(); ++k) {
      problem.bodies[k].X_DB = X_DW * vessels[k].X_WB;
    }
    if (has_waves()) {
      const auto moving = sea(false);
      problem.field = std::shared_ptr<const dynamics::WaveField>(moving, &moving->waves);
    }
  }
  problem.origin = middle.head<2>();
  if (const auto& lids = parts_.sea->radiation.lids) {
    problem.lids = make_lids(lids->value, problem.origin);
  }
  problem.water = water_of(*parts_.sea, gravity_);
  problem.place = parts_.sea->radiation.place;
  problem.frequencies = radiation_frequencies();
  problem.method = parts_.sea->radiation.method.value;
  problem.headings = default_headings();
  // What a named database's excitation has in the mean by itself is known of waves alone.
  const bool drifts = std::any_of(
      parts_.vessels.begin(), parts_.vessels.end(),
      [](const given::Vessel& vessel) { return vessel.drift.value != DriftMethod::none; });
  // Nor is it known where vessels move on a stiffness of their own in place of their hull's.
  const bool is_on_own_stiffness =
      std::any_of(parts_.vessels.begin(), parts_.vessels.end(), [](const given::Vessel& vessel) {
        return vessel.linear_buoyancy && vessel.linear_buoyancy->stiffness;
      });
  // A body that is lowered, the load perhaps, floats nowhere: beside a named database it is refused
  // when that is taken (take_given_database).
  if (drifts && !problem.lowered && (!problem.given || (has_waves() && !is_on_own_stiffness)))
    problem.drifting = free_vessels(problem);
  problem.far_field = problem.drifting && !problem.given;
  problem.direct =
      std::any_of(parts_.vessels.begin(), parts_.vessels.end(), [](const given::Vessel& vessel) {
        return vessel.radiation.value == RadiationMethod::direct;
      });
  if (problem.direct && has_waves()) {
    const dynamics::WaveField& waves = sea(false)->waves;
    problem.ramp = waves.ramp();
    for (std::size_t k = 0; k < waves.component_count(); ++k) {
      problem.waves.push_back(seen_from(middle, waves.component(k), waves.wave_number(k)));
    }
  }
  return problem;
}

std::vector<double> MarineBuilder::radiation_frequencies() const {
  const given::Sea& sea = *parts_.sea;
  const auto [lowest, highest] = band().radiation;
  const int count = band().frequencies;
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) {
    frequencies.push_back(lowest + i * (highest - lowest) / (count - 1));
  }
  if (sea.waves && sea.waves->regular) {
    for (const given::RegularWave& wave : *sea.waves->regular) frequencies.push_back(wave.omega());
  }
  std::sort(frequencies.begin(), frequencies.end());
  const auto same = [](double a, double b) { return b - a < 1e-9 * b; };
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end(), same), frequencies.end());
  return frequencies;
}

const SeaBand& MarineBuilder::band() const {
  if (!band_) band_ = find_sea_band(parts_, gravity_);
  return *band_;
}

std::shared_ptr<const dynamics::Sea> MarineBuilder::sea(bool at_rest) const {
  auto& sea = seas_[at_rest];
  if (!sea) {
    sea = std::make_shared<const dynamics::Sea>(at_rest || !has_waves()
                                                    ? make_sea(parts_, gravity_, true)
                                                    : make_sea(parts_, gravity_, band()));
  }
  return sea;
}

std::shared_ptr<const dynamics::HullClusters> MarineBuilder::clusters(const Vessel& vessel) {
  auto& made = clusters_[&vessel];
  if (!made) made = std::make_shared<const dynamics::HullClusters>(vessel.hull);
  return made;
}

dynamics::BodyFrame MarineBuilder::radiation_frame(const Radiating& vessel, const BodyOf& point) {
  return {point({{vessel.name, {}}, Vector3::Zero(), {}}).body, vessel.X_BR};
}

dynamics::DraughtMark MarineBuilder::draught_mark(const std::vector<Radiating>& vessels,
                                                  const BodyOf& point) {
  for (const Radiating& vessel : vessels) {
    if (vessel.draughts.empty()) continue;
    const auto [low, high] = vessel.vessel->hull.bounds();
    return {radiation_frame(vessel, point).body,
            {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z()}};
  }
  return {};
}

dynamics::Arrangement MarineBuilder::arrangement(const BodyOf& point) const {
  dynamics::Arrangement arrangement;
  const std::vector<Radiating> vessels = radiating();
  for (const Radiating& vessel : vessels) {
    if (!vessel.draughts.empty()) {
      arrangement.lowered_body = static_cast<int>(arrangement.bodies.size());
      arrangement.mark = draught_mark(vessels, point);
    }
    const auto [low, high] = vessel.vessel->hull.bounds();
    const Eigen::Vector2d size = (high - low).head<2>();
    arrangement.bodies.push_back({vessel.name, radiation_frame(vessel, point),
                                  vessel.X_WB.apply(vessel.X_BR.p).head<2>(), size.maxCoeff(),
                                  size.minCoeff()});
  }
  if (!vessels.empty() && has_waves()) {
    arrangement.wave_length = mean_wave_length(sea(false)->waves);
  }
  return arrangement;
}

void MarineBuilder::add_hull(const std::string& name, BodyIndex body, const Vessel& vessel,
                             const given::Damping& linear, const given::Damping& quadratic,
                             double displaced_mass, bool at_rest,
                             dynamics::ForceElements& elements) {
  std::get<std::vector<dynamics::HullForce>>(elements).push_back(
      dynamics::HullForce({"hull of " + name, body, clusters(vessel), sea(at_rest)}));
  add_damping(name, body, vessel, linear, quadratic, displaced_mass, at_rest, elements);
}

void MarineBuilder::add_damping(const std::string& name, BodyIndex body, const Vessel& vessel,
                                const given::Damping& linear, const given::Damping& quadratic,
                                double displaced_mass, bool at_rest,
                                dynamics::ForceElements& elements) {
  dynamics::QuadraticDamping::Definition damping;
  damping.name = "damping of " + name;
  damping.point = {body, vessel.model.centre_of_mass};
  damping.linear = linear.vector();
  damping.quadratic = quadratic.vector();
  if (damping.linear.isZero() && damping.quadratic.isZero()) return;
  damping.sea = sea(at_rest);
  damping.hull = clusters(vessel);
  damping.reference_volume = displaced_mass / parts_.sea->density;
  std::get<std::vector<dynamics::QuadraticDamping>>(elements).emplace_back(damping);
}

void MarineBuilder::add_linear_buoyancy(const given::Vessel& vessel, BodyIndex body,
                                        dynamics::ForceElements& elements) {
  const std::string& name = vessel.name.value;
  const given::LinearBuoyancy& model = *vessel.linear_buoyancy;
  const Vector3& centre_of_mass = vessel.model->model.centre_of_mass;
  const dynamics::Pose& X_WB = start(name);
  const double rho_g = parts_.sea->density * gravity_;
  const dynamics::Hydrostatics rest = calc_hydrostatics(*clusters(*vessel.model), X_WB);
  dynamics::LinearBuoyancy::Definition buoyancy;
  buoyancy.name = "buoyancy of " + name;
  buoyancy.frame = {body, {X_WB.R.transpose(), Vector3::Zero()}};
  buoyancy.buoyancy = rho_g * rest.volume;
  Vector3 p_WC = X_WB.p + rest.p_BoC_W();
  if (model.stiffness) {
    buoyancy.frame.X_BH = dynamics::Pose::translation(model.about.value_or(centre_of_mass));
    buoyancy.stiffness =
        model.given() - dynamics::calc_stiffness_of_weight(vessel.model->model.mass * gravity_,
                                                           centre_of_mass - buoyancy.frame.X_BH.p);
  } else if (vessel.hydrodynamics) {
    take_buoyancy_of_database(vessel, rho_g, buoyancy, p_WC);
  } else {
    constexpr std::array<int, 3> heave_roll_pitch = {5, 0, 1};
    const Eigen::Matrix<double, 6, 6> K = rho_g * calc_stiffness_over_rho_g(rest);
    buoyancy.stiffness = K(heave_roll_pitch, heave_roll_pitch);
  }
  const dynamics::Pose X_WH = X_WB * buoyancy.frame.X_BH;
  buoyancy.rest_height = X_WH.p.z();
  buoyancy.centre = (X_WH.R.transpose() * (p_WC - X_WH.p)).head<2>();
  std::get<std::vector<dynamics::LinearBuoyancy>>(elements).emplace_back(buoyancy);
}

void MarineBuilder::take_buoyancy_of_database(const given::Vessel& vessel, double rho_g,
                                              dynamics::LinearBuoyancy::Definition& buoyancy,
                                              Vector3& p_WC) const {
  const dynamics::HydrodynamicDatabase& database = *vessel.hydrodynamics;
  const auto b = static_cast<std::size_t>(vessel.hydrodynamic_body);
  const Radiating own = radiating(vessel.name.value);
  buoyancy.frame.X_BH = own.X_BR;
  const dynamics::Pose X_WH = own.X_WB * own.X_BR;
  if (database.displaced_volumes[b] > 0.0) {
    buoyancy.buoyancy = rho_g * database.displaced_volumes[b];
  }
  const auto from_reference = [&](const std::vector<Vector3>& points) {
    return Vector3(points[b] - database.reference_points[b]);
  };
  if (!database.centres_of_buoyancy.empty()) {
    p_WC = X_WH.apply(from_reference(database.centres_of_buoyancy));
  }
  const Vector3 arm = database.centres_of_mass.empty()
                          ? own.X_BR.inverse().apply(vessel.model->model.centre_of_mass)
                          : from_reference(database.centres_of_mass);
  const Eigen::Index heave = dynamics::modes_per_body * Eigen::Index{vessel.hydrodynamic_body} + 2;
  const dynamics::Matrix3 C = database.hydrostatic_stiffness.block<3, 3>(heave, heave);
  // The database's bodies float by themselves: they weigh what their water weighs.
  buoyancy.stiffness =
      0.5 * (C + C.transpose()) - dynamics::calc_stiffness_of_weight(buoyancy.buoyancy, arm);
}

void MarineBuilder::add_restraint(const given::Vessel& vessel, BodyIndex body,
                                  dynamics::ForceElements& elements) const {
  const given::Restraint& model = *vessel.restraint;
  const dynamics::Pose& X_WB = start(vessel.name.value);
  dynamics::LinearRestraint::Definition restraint;
  restraint.name = "restraint of " + vessel.name.value;
  restraint.point = {body, model.about.value_or(vessel.model->model.centre_of_mass)};
  restraint.X_WR = {X_WB.R, X_WB.apply(restraint.point.p_BoQ_B)};
  restraint.stiffness = given::Restraint::matrix(model.stiffness);
  restraint.damping = given::Restraint::matrix(model.damping);
  std::get<std::vector<dynamics::LinearRestraint>>(elements).emplace_back(restraint);
}

RadiationProblem::FreeVessels MarineBuilder::free_vessels(const RadiationProblem& problem) const {
  const auto modes = dynamics::modes_per_body * static_cast<Eigen::Index>(problem.bodies.size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(modes, modes);
  RadiationProblem::FreeVessels all{none, none, none};
  Eigen::Index first = 0;
  for (const PanelProblem::Body& body : problem.bodies) {
    const auto vessel =
        std::find_if(parts_.vessels.begin(), parts_.vessels.end(),
                     [&](const given::Vessel& one) { return one.name.value == body.name; });
    const RadiationProblem::FreeVessels alone = free_vessel(*vessel, body);
    all.mass.block<6, 6>(first, first) = alone.mass;
    all.stiffness.block<6, 6>(first, first) = alone.stiffness;
    all.damping.block<6, 6>(first, first) = alone.damping;
    first += dynamics::modes_per_body;
  }
  return all;
}

RadiationProblem::FreeVessels MarineBuilder::free_vessel(const given::Vessel& vessel,
                                                         const PanelProblem::Body& body) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const VesselModel& model = vessel.model->model;
  const dynamics::Pose& X_WB = start(vessel.name.value);
  const Vector3 p_BoBcm_W = X_WB.R * model.centre_of_mass;
  // Motion of the centre of mass by that of the reference point: displacement + rotation x arm.
  Matrix6 at_centre = Matrix6::Identity();
  at_centre.topRightCorner<3, 3>() = -dynamics::skew(p_BoBcm_W - X_WB.R * body.p_BoR_B);
  Matrix6 turned = Matrix6::Zero();
  turned.topLeftCorner<3, 3>() = X_WB.R;
  turned.bottomRightCorner<3, 3>() = X_WB.R;
  Eigen::Matrix<double, 6, 1> linear;
  const Eigen::Matrix<double, 6, 1> given = vessel.damping.vector();
  linear << given.tail<3>(), given.head<3>();
  const dynamics::Matrix3 R_WD = X_WB.R * body.X_DB.R.transpose();
  Matrix6 of_world = Matrix6::Zero();
  of_world.topLeftCorner<3, 3>() = R_WD;
  of_world.bottomRightCorner<3, 3>() = R_WD;
  const Matrix6 from_reference = at_centre * of_world;
  const auto about_reference = [&](const Matrix6& matrix) {
    return Eigen::MatrixXd(from_reference.transpose() * matrix * from_reference);
  };
  const dynamics::Hydrostatics rest =
      calc_hydrostatics(dynamics::HullClusters(vessel.model->hull), X_WB);
  return {about_reference(dynamics::make_mass_matrix(displaced_mass_.at(vessel.name.value),
                                                     model.radii_of_gyration, X_WB.R)),
          about_reference(parts_.sea->density * gravity_ *
                          dynamics::calc_floating_stiffness_over_rho_g(rest, p_BoBcm_W)),
          about_reference(turned * linear.asDiagonal() * turned.transpose())};
}

void MarineBuilder::add_current_load(const given::Vessel& vessel, BodyIndex body, bool at_rest,
                                     dynamics::ForceElements& elements) {
  const given::CurrentLoad& model = *vessel.current_load;
  const double draught = -start(vessel.name.value).p.z();
  const double low = vessel.model->hull.bounds()[0].z();
  dynamics::CurrentLoad::Definition load;
  load.name = "current on " + vessel.name.value;
  load.reference = {body, model.about.value_or(Vector3(0, 0, 0.5 * (low + draught)))};
  load.coefficients = {model.area, model.area, 0.0, model.length, {}};
  for (const std::array<Quantity, 4>& row : model.coefficients.value) {
    load.coefficients.table.push_back(
        {row[0].value, row[1].value, row[2].value, 0.0, 0.0, row[3].value});
  }
  load.sea = sea(at_rest);
  load.hull = clusters(*vessel.model);
  load.reference_volume = displaced_mass_.at(vessel.name.value) / parts_.sea->density;
  std::get<std::vector<dynamics::CurrentLoad>>(elements).emplace_back(load);
}

void MarineBuilder::add_vessel(const given::Vessel& vessel, BodyIndex body, bool at_rest,
                               dynamics::ForceElements& elements) {
  const std::string& name = vessel.name.value;
  if (vessel.linear_buoyancy) {
    add_linear_buoyancy(vessel, body, elements);
  } else {
    dynamics::HullForce::Definition hull{"hull of " + name, body, clusters(*vessel.model),
                                         sea(at_rest)};
    if (vessel.drift.value == DriftMethod::newman) hull.p_BoR_B = radiating(name).X_BR.p;
    std::get<std::vector<dynamics::HullForce>>(elements).emplace_back(std::move(hull));
  }
  add_damping(name, body, *vessel.model, vessel.damping, vessel.quadratic_damping,
              displaced_mass_.at(name), at_rest, elements);
  if (vessel.current_load) add_current_load(vessel, body, at_rest, elements);
  if (vessel.restraint) add_restraint(vessel, body, elements);
  for (const given::Member& model : vessel.members) {
    dynamics::MorisonMember::Definition member;
    member.name = "member of " + name;
    member.body = body;
    member.p_BoP_B = model.from;
    member.p_BoQ_B = model.to;
    member.diameter = model.diameter;
    member.drag_coefficient = model.drag_coefficient;
    member.sea = sea(at_rest);
    std::get<std::vector<dynamics::MorisonMember>>(elements).emplace_back(member);
  }
}

void MarineBuilder::add_lines(const BodyOf& point, dynamics::ForceElements& elements) const {
  for (const given::Mooring& model : parts_.moorings) {
    dynamics::MooringLine::Definition line;
    line.name = model.name.value;
    line.anchor = point(model.anchor);
    line.fairlead = point(model.fairlead);
    line.line = {model.length.value, model.submerged_mass * gravity_, model.axial_stiffness,
                 model.on_seabed};
    std::get<std::vector<dynamics::MooringLine>>(elements).emplace_back(line);
  }
  for (const given::Tugger& model : parts_.tuggers) {
    dynamics::TuggerLine::Definition line;
    line.name = model.name.value;
    line.from = point(model.from);
    line.to = point(model.to);
    line.stiffness = model.stiffness.value_or(0);
    line.damping = model.damping;
    line.unstretched_length = model.length ? model.length->value : 0;
    line.tension = model.tension ? model.tension->value : 0;
    std::get<std::vector<dynamics::TuggerLine>>(elements).emplace_back(line);
  }
}

void MarineBuilder::add_elements(const BodyOf& point, const dynamics::HydrodynamicSeries* series,
                                 bool at_rest, dynamics::ForceElements& elements) {
  const auto body_of = [&](const given::Vessel& vessel) {
    return point({vessel.name, Vector3::Zero(), {}}).body;
  };
  for (const given::Vessel& vessel : parts_.vessels) {
    add_vessel(vessel, body_of(vessel), at_rest, elements);
  }
  add_lines(point, elements);
  if (!series || at_rest || !has_waves()) return;
  // The elements share one copy.
  const auto shared = std::make_shared<const dynamics::HydrodynamicSeries>(*series);
  const std::vector<Radiating> vessels = radiating();
  std::shared_ptr<const dynamics::HydrodynamicDatabase> drift;
  int index = 0;
  for (const Radiating& vessel : vessels) {
    const given::Vessel* in_case = parts_.find_vessel(vessel.name);
    if (in_case && in_case->drift.value == DriftMethod::newman) {
      if (!drift) drift = {shared, &shared->databases.front()};
      std::get<std::vector<dynamics::SlowDrift>>(elements).emplace_back(
          dynamics::SlowDrift::Definition{"drift of " + vessel.name, radiation_frame(vessel, point),
                                          drift, index, sea(at_rest)});
    }
    dynamics::DiffractionForce::Definition force;
    force.name = "diffraction about " + vessel.name;
    force.frame = radiation_frame(vessel, point);
    force.series = shared;
    force.mark = draught_mark(vessels, point);
    force.database_body = index++;
    force.sea = sea(at_rest);
    force.froude_krylov = part_from_database(in_case);
    std::get<std::vector<dynamics::DiffractionForce>>(elements).emplace_back(std::move(force));
  }
}

std::shared_ptr<const dynamics::RadiatedWater> MarineBuilder::make_water(
    const BodyOf& point, const dynamics::HydrodynamicSeries* series,
    const MarchedWater& marched) const {
  if (!series && !marched.radiation) return nullptr;
  dynamics::RadiatedWater::Definition water;
  const std::vector<Radiating> vessels = radiating();
  for (const Radiating& vessel : vessels) water.frames.push_back(radiation_frame(vessel, point));
  if (marched.radiation) {
    return std::make_shared<const dynamics::RadiatedWater>(
        water.frames, marched.radiation->infinite_added_mass());
  }
  water.series = std::make_shared<const dynamics::HydrodynamicSeries>(*series);
  water.mark = draught_mark(vessels, point);
  water.fit = memory_fit_of_vessels();
  return std::make_shared<const dynamics::RadiatedWater>(water);
}

}  // namespace blocklift::pipeline
