#include "pipeline/results/summaries/assumptions.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "pipeline/build/stiffener_plates.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/results/summaries/radiation_summary.h"
#include "pipeline/results/summaries/table_summary.h"

namespace blocklift::pipeline {

namespace {

/// Ropes and tackles that hang by their weight.
std::string names_of_hanging(const LiftCase& lift_case) {
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const given::Rope& rope : lift_case.ropes)
    if (lift_case.hangs(rope)) add(rope.name.value);
  for (const given::Crane& crane : lift_case.cranes)
    for (const HoistModel& hoist : crane.model->hoists)
      if (lift_case.hangs(crane, hoist)) add(crane.name.value + "." + hoist.name.value);
  return names;
}

/// Ropes with friction at their sheaves.
std::string names_of_rubbing(const LiftCase& lift_case) {
  std::string names;
  for (const given::Rope& rope : lift_case.ropes)
    if (rope.friction() > 0) names += (names.empty() ? "" : ", ") + rope.name.value;
  return names;
}

/// Edges with friction, or those without, that ropes may touch.
std::string names_of_edges(const LiftCase& lift_case, bool rubbing) {
  std::string names;
  for (const given::Rope& rope : lift_case.ropes) {
    for (const LoadEdge& edge : rope.edges) {
      if ((edge.friction > 0) != rubbing) continue;
      names +=
          fmt::format("{}{} over {}", names.empty() ? "" : ", ", rope.name.value, edge.name.value);
    }
  }
  return names;
}

/// Ropes that may touch edges of the load.
std::string names_of_bent(const LiftCase& lift_case) {
  std::string names;
  for (const given::Rope& rope : lift_case.ropes)
    if (!rope.edges.empty()) names += (names.empty() ? "" : ", ") + rope.name.value;
  return names;
}

/// Ropes and tackles with a curve of tension over strain.
std::string names_of_curved(const LiftCase& lift_case) {
  std::string names;
  const auto add = [&](const std::string& name, const RopeModel& rope) {
    if (rope.tension_curve) names += (names.empty() ? "" : ", ") + name;
  };
  for (const given::Rope& rope : lift_case.ropes) add(rope.name.value, rope.rope);
  for (const given::Crane& crane : lift_case.cranes)
    for (const HoistModel& hoist : crane.model->hoists)
      add(crane.name.value + "." + hoist.name.value, hoist.rope);
  return names;
}

/// Hoists whose blocks turn, and on bearings.
std::string names_of_turning(const LiftCase& lift_case) {
  std::string names;
  for (const given::Crane& crane : lift_case.cranes)
    for (const HoistModel& hoist : crane.model->hoists) {
      const auto& turning = hoist.hook_block.turning;
      if (!turning) continue;
      names += (names.empty() ? "" : ", ") + crane.name.value + "." + hoist.name.value;
      if (turning->bearing)
        names += fmt::format(", its hook on a bearing with {:g} N m of friction",
                             turning->bearing->friction_moment);
    }
  return names;
}

std::string wind_sentence(const given::Wind& wind) {
  const bool gusts = wind.gusts != dynamics::GustSpectrum::none;
  std::string text = fmt::format(
      "{} wind of {:g} m/s towards {:.0f} degrees from +x to +y, {}",
      wind.is_gusty() ? "Mean" : "Constant", wind.speed, wind.towards * 180 / std::numbers::pi,
      gusts ? "with gusts that act everywhere at once" : "without gusts");
  if (wind.gust) {
    const dynamics::WindGust gust = wind.gust->make_gust();
    text += fmt::format(
        "{} a single gust from {:g} to {:g} s, of {:.3g} to {:.3g} m/s with the mean, everywhere "
        "at once",
        gusts ? ", and" : " but", gust.start(), gust.breakpoints().back(),
        wind.speed + gust.lowest(), wind.speed + gust.highest());
  }
  return text + ".";
}

void add_lift_assumptions(const LiftCase& lift_case, std::vector<std::string>& list) {
  const std::string turning = names_of_turning(lift_case);
  list.push_back(
      "Cranes, hook blocks and the block are rigid bodies; a crane's elasticity acts in series "
      "with each of its tackles. " +
      (turning.empty()
           ? "Hook blocks do not turn."
           : fmt::format(
                 "Hook blocks turn about the vertical alone ({}), and others not: two falls "
                 "of a tackle, with half of its tension each, turn them back with T b^2 "
                 "sin(twist) / L, 2 b being the distance of the falls and L their length.",
                 turning)));
  const std::string hanging = names_of_hanging(lift_case);
  list.push_back(
      hanging.empty()
          ? "Ropes are weightless springs with damping along their paths; they pull and never "
            "push. "
            "All falls of a tackle are taken together."
          : fmt::format("Ropes are springs with damping that pull and never push; all falls of a "
                        "tackle are taken together. {} hang as elastic catenaries at each instant, "
                        "without inertia; their tension is that of the upper end. Other ropes are "
                        "straight and weightless.",
                        hanging));
  const std::string rubbing = names_of_rubbing(lift_case);
  if (!rubbing.empty()) {
    list.push_back(
        fmt::format("In the motion {} stick to their sheaves by friction until the tensions on the "
                    "two sides differ by exp(mu x angle of wrap), and slip at that ratio (Euler, "
                    "Eytelwein). They begin with one tension all along, which they have at rest.",
                    rubbing));
  }
  const std::string bent = names_of_bent(lift_case);
  if (!bent.empty()) {
    list.push_back(
        fmt::format("{} run over edges of the load on the shortest way round them, and slide along "
                    "them sideways without friction.",
                    bent));
    const std::string smooth = names_of_edges(lift_case, false);
    if (!smooth.empty())
      list.push_back(fmt::format(
          "Without friction at edges: {}. The tension is one on both sides there; with friction "
          "it would be larger on one side, by up to exp(mu x angle of wrap).",
          smooth));
    const std::string rough = names_of_edges(lift_case, true);
    if (!rough.empty())
      list.push_back(fmt::format(
          "In the motion ropes stick to edges with friction until the tensions on the two sides "
          "differ by exp(mu x angle of wrap), and slip lengthwise at that ratio: {}. They begin "
          "with one tension all along, which they have at rest.",
          rough));
  }
  const std::string curved = names_of_curved(lift_case);
  if (!curved.empty()) {
    list.push_back(
        fmt::format("{} stretch by a curve of tension over strain, the same way back: elastic, "
                    "without hysteresis, and straight on beyond its last point. Standards' steps "
                    "for wrong lengths take the stiffness of the curve at the tension at rest.",
                    curved));
  }
  if (!lift_case.spreaders.empty()) {
    list.emplace_back(
        "Spreaders are rigid in the motion, their mass spread evenly over their bars, or so that "
        "it falls or rises evenly to the centre that is given. As columns "
        "bars and the sides of frames are pinned at their ends, in both planes; what is within a "
        "frame's sides follows from their stiffness, rigidly joined at the corners. "
        "Frames give way in the standards' step for wrong lengths.");
  }
  list.emplace_back(
      "Drives and winches follow their motion profiles exactly, whatever force that takes.");
  list.push_back(fmt::format(
      "Static: equilibrium at the same winch lengths and crane positions, every {:g} s, with the "
      "mean wind. Dynamic: time integration with relative tolerance {:g}. Largest loads of single "
      "ropes and hoists are those of all its steps; other figures are sought among samples every "
      "{:g} s and at those loads.",
      lift_case.dynamics.static_interval, lift_case.dynamics.relative_tolerance,
      lift_case.dynamics.sample_interval));
  if (lift_case.has_structure()) {
    list.emplace_back(
        lift_case.supports.empty()
            ? "Forces on the block other than of ropes (wind) are spread over its mass."
            : "Forces on the block other than of ropes (wind, pads under it) are spread over "
              "its mass: while it stands on pads, the stress is that of the ropes' pull alone.");
  }
  if (lift_case.wind) {
    list.push_back(wind_sentence(*lift_case.wind));
  } else {
    list.push_back("No wind.");
  }
}

std::string draughts_sentence(const LiftCase& lift_case) {
  const given::Load& load = lift_case.load;
  const std::string floats = "The load floats by its hull where it reaches the water; ";
  if (!load.draughts) {
    return floats + "it makes no waves, and no added mass of it is counted.";
  }
  std::string draughts;
  for (const double draught : load.draughts->value) {
    draughts += fmt::format("{}{:.4g}", draughts.empty() ? "" : ", ", draught);
  }
  const dynamics::Pose X_WB = load.pose_afloat();
  return floats +
         fmt::format(
             "what it radiates and scatters is computed for draughts of {} m, upright at ({:.4g}, "
             "{:.4g}) m against the vessels where they start, and interpolated at its draught in "
             "calm "
             "water. Water that it takes up on entering has to be set in motion (von Karman's "
             "momentum theory), spread over the draughts between; water that it leaves keeps its "
             "motion. Slamming by the rise of the waves themselves is not counted.",
             draughts, X_WB.p.x(), X_WB.p.y());
}

template <class Predicate>
std::string names_of_vessels(const LiftCase& lift_case, const Predicate& holds) {
  std::string names;
  for (const given::Vessel& vessel : lift_case.vessels) {
    if (holds(vessel)) names += (names.empty() ? "" : ", ") + vessel.name.value;
  }
  return names;
}

void add_sea_assumptions(const LiftCase& lift_case, const LiftRun& lift,
                         std::vector<std::string>& list) {
  const std::string drifting = names_of_vessels(lift_case, [](const given::Vessel& vessel) {
    return vessel.drift.value != DriftMethod::none;
  });
  const std::string linear = names_of_vessels(
      lift_case, [](const given::Vessel& vessel) { return vessel.linear_buoyancy.has_value(); });
  list.push_back(fmt::format(
      "Buoyancy and the pressure of the undisturbed waves act on each hull as it lies at each "
      "instant, exactly for its panels in still water. Waves are linear; there is no slamming or "
      "water on deck, and there are no second-order drift forces{}. Static: the sea without its "
      "waves.",
      drifting.empty() ? "" : " but those of " + drifting));
  if (std::string sea = describe_sea(lift_case, lift_case.gravity); !sea.empty())
    list.push_back(std::move(sea));
  const std::string dry = names_of_vessels(lift_case, [](const given::Vessel& vessel) {
    return vessel.radiation.value == RadiationMethod::none;
  });
  if (!dry.empty())
    list.push_back(fmt::format(
        "No water moves along with {} (radiation: none): there is no added mass, so that natural "
        "periods of heave, roll and pitch are too short, the damping is what the case gives, and "
        "waves are not diffracted.",
        dry));
  if (!drifting.empty()) {
    list.push_back(fmt::format(
        "Slow drift of {} in surge, sway and yaw by Newman's approximation, from the mean forces "
        "on "
        "the vessel as it floats freely in regular waves (Maruo's formula, or those of the "
        "database "
        "that the case names). In surge, sway and yaw the waves' first-order force is that on the "
        "hull at rest. What it has in the mean as the vessel moves is taken off Maruo's surge and "
        "sway; in yaw, and beside a database that the case names, it comes on top.",
        drifting));
  }
  if (!linear.empty()) {
    list.push_back(fmt::format(
        "Not so {}: buoyancy is linear in heave, roll and pitch about where it floats at the "
        "start, and the waves' forces are those on its hull there.",
        linear));
  }
  if (lift_case.load.vessel) {
    list.push_back(draughts_sentence(lift_case));
  }
  const dynamics::LiftSystem& system = lift.model.system;
  const MarchedWater& marched = lift.model.marched;
  if (!system.water()) return;
  list.push_back(fmt::format(
      "Radiation and diffraction of the vessels, with their interaction: linear, by the Rankine "
      "panel method about their upright rest in still water, carried along as they move, along "
      "axes that turn with their headings alone; their distance counts as unchanged. Natural "
      "periods hold the added mass of infinite frequency alone. {}",
      marched.radiation
          ? fmt::format(
                "The water's surface, {} panels in all, is marched beside them by {:.3g} s.",
                marched.unknowns, marched.step)
          : fmt::format("The memory of the water is fitted by {} states to within {:.1f} % of its "
                        "peak.",
                        system.memory_count(), 100 * system.water()->memory_error())));
  std::string misplacement =
      misplacement_sentence(record_radiation(lift.model, lift.dynamic_history()));
  if (!misplacement.empty()) list.push_back(std::move(misplacement));
}

std::string flexibility_sentence(const DynamicsSettings& settings) {
  switch (settings.flexibility) {
    case Flexibility::rigid:
      return "The elastic motion of the block does not act back on the ropes.";
    case Flexibility::static_:
      return "The block gives way at its lugs, at once, by the compliance of its structure, which "
             "the ropes feel; its elastic vibration is left out.";
    case Flexibility::modal:
      return fmt::format(
          "The ropes feel the block give way at its lugs: by {} natural modes with a damping of "
          "{:g} of the critical one, and at once by what these leave of the compliance. Stress is "
          "that of the lugs' forces and the rigid inertia; the inertia of the vibration itself is "
          "not in it.",
          settings.mode_count(), settings.mode_damping());
  }
  return {};
}

std::string displacement_sentence(const LiftRun& lift) {
  if (!lift.elastic_displacement) return {};
  return fmt::format(
      " Lug {} moves furthest within the block, against its mean motion: {:.1f} mm at {:.1f} s.",
      lift.elastic_displacement->lug, 1e3 * lift.elastic_displacement->size,
      lift.elastic_displacement->time);
}

std::string names_of_solid_lugs(const BlockModel& block) {
  std::string names;
  for (const LugModel& lug : block.lugs)
    if (lug.is_solid.value) names += (names.empty() ? "" : ", ") + lug.name.value;
  return names;
}

std::string deck_sentence(const MeshModel& mesh) {
  std::string left_out;
  for (const structure::LedgerEntry& entry : unused_cards(mesh))
    left_out += fmt::format("{}{} ({} of {})", left_out.empty() ? "" : ", ", entry.name,
                            entry.read - entry.used, entry.read);
  return fmt::format(
      "The block is read from {} (units {}). A lug there is a place: its force is spread over the "
      "plates that meet in it or are named, or acts on the link or beam that it stands at. "
      "Stresses "
      "of layered plates are their mean.{} Cards that are not used: {}.",
      mesh.file.value, mesh.units.value,
      mesh.deck && !mesh.deck->mesh.elasticities.empty()
          ? " Solids whose material depends on the direction are checked by their von Mises "
            "stress, which says little of their strength."
          : "",
      left_out.empty() ? "none" : left_out);
}

void add_block_assumptions(const Assessment& assessment, std::vector<std::string>& list) {
  const structure::MassProperties& mass = assessment.block.model->mass_properties();
  list.emplace_back(
      "The block is linear elastic; its loads are the forces of ropes, gravity and the inertia "
      "of its motion, which are in balance.");
  if (assessment.lift)
    list.push_back(flexibility_sentence(assessment.lift_case.dynamics) +
                   displacement_sentence(*assessment.lift));
  if (const auto& pressure = assessment.block.pressure)
    list.push_back(
        fmt::format("Water presses on the shell: the pressure on each piece of the hull acts, with "
                    "its resultant "
                    "and its centre, on the nearest of {} regions of the block's outer plates; {} "
                    "fields make up "
                    "the pressure of every instant to within {:.2g} % of the largest. Pads that "
                    "bear the block, and what the water does besides (radiation, diffraction, "
                    "drag), are spread over its mass.",
                    pressure->regions, pressure->count(), 100 * pressure->error));
  if (const auto& edges = assessment.block.edges)
    list.push_back(fmt::format(
        "Ropes press on the block's edges: at a sharp edge by one force, round a cylinder towards "
        "its "
        "axis over the wrap. Along the edge a hat of its contact length spreads the force over the "
        "plates nearest to it; {} unit forces make up every instant, with force and moment.",
        edges->count()));
  list.push_back(fmt::format(
      "Inertia relief: the first elastic period of the free block is about {:.2f} s; loads that "
      "rise within a few of these periods shake the block itself, which is not part of the "
      "figures.",
      assessment.block.first_elastic_period));
  list.push_back(fmt::format(
      "Of {:.1f} t, {:.1f} t are steel of the model; the remaining {:.1f} t of outfitting are "
      "spread over the plates with a density linear in place (factor {:.2f} to {:.2f} of the "
      "steel's), so that mass and centre of mass are met.",
      mass.mass / 1e3, mass.steel_mass / 1e3, mass.outfitting_mass / 1e3,
      mass.smallest_density_factor, mass.largest_density_factor));
  list.emplace_back(
      "Checked stress: von Mises of the membrane stress (averaged through the plate) over patches "
      "of 50 x 50 mm. The raw peak beside it depends on the mesh and grows with refinement at "
      "re-entrant corners.");
  list.emplace_back(
      "In the block each rope's force is spread over its lug plate; contact of the pin and welds "
      "are not part of it.");
  if (const std::string lugs = names_of_solid_lugs(*assessment.lift_case.load.model); !lugs.empty())
    list.push_back(fmt::format(
        "Solids in the block are the padeyes of {}: they stand on the plating along their base, "
        "which follows its displacement and rotation with straight cross-sections, and the force "
        "is spread over the whole bore. Their elements are not divided where plates' are; their "
        "strength is that of the padeyes' own fine meshes and formulae.",
        lugs));
  if (const auto& mesh = assessment.lift_case.load.model->mesh)
    list.push_back(deck_sentence(*mesh));
  const BlockRun& block = assessment.block;
  if (!block.padeyes.padeyes.empty())
    list.push_back(fmt::format(
        "Padeyes are cut from the block along the pad's edge and driven there by the block's "
        "displacement; the pin presses with the cosine of the angle from the rope's direction, "
        "elastic, without contact. Forces and stresses are multiplied by {:g}; hand formulae take "
        "{:g} % of the force along the pin at least. Stress within the main plate's thickness of "
        "the cut is left to the block's own.",
        assessment.lift_case.checks.lug_consequence_factor,
        100 * assessment.lift_case.checks.lug_side_load));
  list.push_back(fmt::format(
      "Buckling: {} panels between crossing plates (and the stiffeners that the block's file "
      "names), simply supported, or free where no plate crosses, under their mean membrane "
      "stresses with linear falls; openings within a panel do not weaken it beyond their stress, "
      "and neither initial deflection nor the strength after buckling counts.",
      block.buckling.panels.size()));
  if (!block.buckling.bars.empty())
    list.push_back(fmt::format(
        "Bars and stiffeners as columns: {} spans from joint to joint, pinned there; bars "
        "that cross in a joint hold each other. Buckling curve c of EN 1993-1-1 about the weaker "
        "principal axis; open sections may also twist, which is not checked. Stiffeners are "
        "checked together with their plates (EN 1993-1-5, 4.5.3) and against tripping about their "
        "toes (DNV-RP-C201, 7.5.2, beta = 1), {}.{}",
        block.buckling.bars.size(),
        std::ranges::any_of(block.buckling.bars,
                            [](const BuckledBar& bar) { return bar.span.has_tripping_brackets(); })
            ? "between the tripping brackets that the block's file names"
            : "without tripping brackets",
        block.buckling.unknown_rods > 0
            ? fmt::format(" {} rods without second moments are not looked at.",
                          block.buckling.unknown_rods)
            : ""));
  for (std::string& sentence : describe_stiffener_plates(*assessment.lift_case.load.model))
    list.push_back(std::move(sentence));
}

}  // namespace

std::vector<std::string> list_assumptions(const Assessment& assessment) {
  std::vector<std::string> list;
  if (assessment.lift) {
    add_lift_assumptions(assessment.lift_case, list);
    if (assessment.lift && assessment.lift->model.held_heading)
      list.push_back(
          "Nothing but wind turns the load about its one hook: at rest it is held at the heading "
          "of "
          "the case, as tag lines do; in motion nothing holds it.");
    if (assessment.lift_case.sea) {
      add_sea_assumptions(assessment.lift_case, *assessment.lift, list);
    }
  } else {
    list.push_back(
        "The forces at the lugs are those of the case's load table, all at once, balanced by the "
        "rigid-body acceleration that they give the block.");
    if (const auto balances = find_table_balances(assessment))
      list.push_back(describe_balances(*balances));
  }
  if (assessment.block.model) {
    add_block_assumptions(assessment, list);
  } else {
    list.emplace_back(
        "The load is a vessel: its stress was not asked, its ropes, hoists and cranes alone are "
        "checked.");
  }
  return list;
}

}  // namespace blocklift::pipeline
