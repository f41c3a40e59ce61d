#pragma once

#include <string>
#include <string_view>

/// Where everything lies in results.h5 and summary.json: the one place that names it.
///
/// The report is made from these two files alone. Parts marked (o) are optional: a case with a load
/// table has no /static, /dynamic, /operation, /modes and /scene; a run without structure has no
/// /structure; a mechanism has no /static, and /outputs besides. Sizes: n samples of the stage, b
/// boxes, k rope points, N surface points, M surface quadrangles. Frames: W world, B a body, all
/// SI. Poses are x y z, then the unit quaternion w x y z.
///
/// results.h5
///   /                                  attributes format = "blocklift results", format_version = 2
///   /case                              attributes name, title, created (ISO 8601),
///                                      program_version, run (o): the same in summary.json of the
///                                      same run
///   /case/yaml                         text of the case file
///   /case/models                   (o) names   texts [m], as the case names them
///                                      contents   texts [m], the model files as they stood
///   /operation/stage_names         (o) texts [s]
///   /operation/stage_start             s [s]      /operation/stage_end   s [s]
///   /static, /dynamic              (o) the two histories, alike inside:
///     time                             s [n]
///     ropes/<rope>/tension             N [n]      elongation (o)         m [n]
///     hoists/<hoist>/tension       (o) N [n]      length (o)             m [n]
///                                      swing (o) rad [n]
///     bodies/<body>/pose           (o) m, 1 [n x 7], X_WB
///     bodies/<body>/velocity       (o) rad/s, m/s [n x 6], angular then linear (acceleration
///                                      alike)
///     elastic_modes/<mode>/coordinate (o) m [n], of a natural mode in which a body gives way: root
///                                      of the mean square displacement over its mass; rate m/s
///                                      [n], acceleration m/s2 [n]; attributes of the group: body,
///                                      frequency_Hz of the free body, damping_ratio,
///                                      modal_mass_kg
///     drives/<drive>/position      (o) m or rad [n]                      force (o) N or N m [n]
///     loops/<loop>/force           (o) N m, N [n x 6], on its second body at its frame, in W
///                                      multipliers (o) N or N m [n x its equations]
///                                      residual (o) m or rad [n]
///                                      attribute of the group: kind
///     measures/<measure>           (o) in its unit [n]: a figure that follows from the motion; not
///                                      a number where it has none
///     energy/<term>                (o) J [n]; the term `balance` is what the others leave
///                                      unexplained
///   /time, /outputs/<output>       (o) s [n], and what a mechanism file asks for [n x columns];
///                                      attribute columns (o): their names
///   /statistics                    (o) what the time integration cost: attributes
///   /measured/<rope>               (o) time s [p], tension N [p]: a measured series
///   /modes/<i>                     (o) natural modes at rest at one instant, i = 1, 2, ...;
///                                      m modes; attributes instant (in words), time
///     names, kinds                     texts [m]  kind: oscillating, overdamped, neutral, unstable
///     period                           s [m]      damping_ratio, elastic_share   1 [m]
///     eigenvalue                       s-1 [m x 2], real and imaginary part
///     bodies/<body>/motion             rad, m [m x 12], complex amplitudes in W: rotation vector,
///                                      displacement of the origin (real parts), then both
///                                      imaginary; largest motion 1 m
///     elastic_modes/<mode>/amplitude (o) m [m x 2], complex amplitude of its coordinate
///   /scene                         (o) what the drawing shows; bodies are those of .../bodies, or
///                                      "world"
///     bodies/<body>/boxes              m, m, 1 [b x 10], size x y z, centre x y z, quaternion, in
///                                      B (may have no rows); attribute kind (o) of the body:
///                                      crane, hook block, load, ...
///     ropes/<rope>/bodies              texts [k], the body each point of the path belongs to
///     ropes/<rope>/points              m [k x 3], each in its body's frame; attribute kind: sling
///                                      or hoist
///     lugs/names                       texts [l]
///                                      lugs/points           m [l x 3], in the load's frame
///                                      attribute body of /scene/lugs: the load's body; the surface
///                                      of /structure is drawn at this body's pose
///   /structure/surface             (o)
///     points                           m [N x 3], block frame             quads   indices [M x 4]
///     quad_group                       index [M] into group_names         group_names   texts
///   /structure/<way>/<state>       (o) way: simultaneous, per_rope_maxima; state: static, dynamic
///     displacement                     m [N x 3], relative to the rigid motion
///     von_mises                        Pa [N]
///     peak_stress_point (o), checked_stress_point (o), max_displacement_point (o)
///                                      m [3], block frame
///                                      attributes of the group (o): rope (the governing one), time
///   /structure/history/<state>     (o) the same for the largest von Mises stress over all
///                                      instants; its displacement is that of the instant of the
///                                      largest checked stress
///     patches/von_mises                Pa [P]   patches/time   s [P]
///                                      patches/rope   index [P] into ../ropes
///   /structure/history/ropes           texts;   patches/points   m [P x 3]
///                                      patches/plate   index [P] into patches/plates, texts
///   /structure/panels              (o) plates   texts [p]
///                                      table   [p x 15], a panel a row, the nearest to
///                                      buckling first; what the columns are stands in its
///                                      description
///   /structure/columns             (o) bars   texts [b]
///                                      table   [b x 19], a free span of a bar a row, sorted so too
///   /structure/padeyes/<lug>       (o) the governing state of a padeye; attributes state, rope,
///                                      time (o)
///     corners                          m [c x 8], x y of four corners of a column of elements,
///                                      padeye's frame
///     plate                            [c]  0 main plate, 1, 2 cheek plates in front and behind
///     von_mises                        Pa [c], of the mean stress   force   N [3], of the pin
///   /structure/history/points/<name>   point m [3]; <state>/von_mises, <state>/normal_stress
///                                      Pa [n];   unit_stress/, <state>/factors: unit_stress_file.h
///
/// summary.json, one object; everything but case may be missing, null stands for "not known"; what
/// is simulated and not assessed has no verdict
///   case, title, program_version, created, run (o): as in results.h5
///   input_hash (o)     fingerprint of case file, models and mesh
///   verdict            "pass" | "fail";   verdict_reasons   list of text
///   checks             [{name, demand, limit, unit, utilisation, pass, time_s (o), note (o)}] unit
///                      as given is turned into the report's: N -> kN, Pa -> MPa, m -> mm, rad ->
///                      deg
///   ropes              [{name, lug (o), hoist (o), breaking_load_N (o), bend_efficiency (o): what
///                      a bend leaves of it, largest_strain (o): of a rope with a tension_curve at
///                      its largest dynamic tension, max_static_tension_N, time_of_max_static_s,
///                      max_dynamic_tension_N, time_of_max_dynamic_s, dynamic_over_static,
///                      linked_static_N (o), linked_dynamic_N (o), after_blow (o): {slack_rope,
///                      slack_from_s, taut_again_s, within_s}: the snatch that the largest dynamic
///                      tension follows}]; linked: {rope: tension} at that instant
///   stages         (o) [{name, start_s, end_s, ropes and hoists: [{name, max_static_tension_N, ...
///                      as of ropes}], load: the same of all slings' vertical force}]
///   parted         (o) [{name, time_s, tension_N, energy_J}]: ropes that parted, their tension and
///                      stored energy then
///   worst_instant  (o) {time_s, rope, share, peak_time_s, undisturbed: {rope, share, peak_time_s},
///                      tried: [{time_s, rope, share, peak_time_s}]}: when a fault is worst; share:
///                      of the breaking load
///   measures       (o) [{name, subject, kind, unit, extreme, meaning, static, time_of_static_s,
///                      dynamic, time_of_dynamic_s}]: of each figure the value that is furthest out
///   hoists         (o) like ropes, and crane, capacity_N (o), max_swing_rad (o)
///   cranes         (o) like ropes, max_static_load_N and max_dynamic_load_N instead of tensions,
///                      capacity_N
///   loops          (o) [{name, kind, max_static_load_N (_Nm of a gear that turns),
///                      time_of_max_static_s, max_dynamic_load_N, time_of_max_dynamic_s,
///                      dynamic_over_static, max_static_moment_Nm (o), max_dynamic_moment_Nm (o),
///                      min_static_tension_N (o), min_dynamic_tension_N (o), largest_residual}]:
///                      what closes the cranes' linkages, and equalisers
///   comparison     (o) {source, ropes: [{name, published_static_N, published_dynamic_N,
///                      static_difference_percent, dynamic_difference_percent}], series (o):
///                      [{name, points, mean_difference_percent, largest_difference_percent,
///                      time_of_largest_s}], the computed tension in motion less the measured one,
///                      of the largest measured, mean of its size, stress_increase_percent (o),
///                      deformation_increase_percent (o)}: published figures
///   structure      (o) {unknowns, elements, element_degree, mesh_size_m, material (o), yield_Pa
///                      (o), per_rope_maxima: WAY, simultaneous: WAY, simultaneous_by_rope (o):
///                      [{rope} + WAY], lugs (o): [{name, rope (o), simultaneous:
///                      {static_checked_von_mises_Pa, dynamic_checked_von_mises_Pa,
///                      stress_increase_percent}, per_rope_maxima: the same}], mass: {total_kg,
///                      steel_kg, outfitting_kg, centre_of_mass_m, steel_centre_of_mass_m (o)}}
///     WAY = {static: STATE, dynamic: STATE, stress_increase_percent, deformation_increase_percent}
///     STATE = {checked_von_mises_Pa, peak_von_mises_Pa, max_displacement_m, force_residual,
///              moment_residual, reaction_over_weight, rope (o), time_s (o), checked_group (o),
///              peak_group (o), checked_point_m (o), peak_point_m (o),
///              max_displacement_point_m (o)}
///     history      (o) WAY, its STATEs with rope_share, largest_principal_Pa,
///                      smallest_principal_Pa, instants, max_displacement_time_s, lugs: [{name,
///                      value, time_s, rope, rope_share}], and beside them places, practice:
///                      {per_rope_maxima, rope_instants: {safe, largest_difference_percent,
///                      worst_difference_percent, worst_part, worst_envelope_Pa,
///                      share_of_patches_short}}, fatigue: {curve, source, stress_concentration,
///                      lifts}, points: [{name, part, point_m, max_static_von_mises_Pa,
///                      max_dynamic_von_mises_Pa, cycles_per_lift, largest_range_Pa,
///                      damage_per_lift, damage}], hot_spot_curve, hot_spots: the same with
///                      largest_normal_Pa, smallest_normal_Pa (structural stress across the weld)
///     stages       (o) [{name, start_s, end_s, static_checked_von_mises: {value, time_s, point_m,
///                      part}, dynamic_checked_von_mises: the same, stress_increase_percent}]
///     estimated_error (o) {relative, worst_part, worst_point_m, groups: {name: relative}}: of the
///                      stress field in the energy norm, at the instant of the largest checked
///                      stress
///     buckling     (o) {panels_looked_at, panels: the worst of [{plate, centre_m, sides_m,
///                      field_m, thickness_m, free_edges, free_edges_along_sides [2], s11_Pa,
///                      s22_Pa, s12_Pa: means, tension positive, s11_gradient_Pa,
///                      s22_gradient_Pa: at the edges s11 and s22 are that much above and below
///                      their means, utilisation, elastic_utilisation, state, time_s (o)}],
///                      bars_looked_at (o),
///                      rods_without_second_moments, bar_factor, bars: the worst of [{bar, from_m,
///                      to_m, buckling_length_m, compression_N, moments_Nm, buckling_resistance_N,
///                      utilisation (under forces times bar_factor; null: beyond Euler's load),
///                      state, time_s (o), tripping_length_m (o), tripping_stress_Pa (o),
///                      tripping_strength_Pa (o), tripping_compression_Pa (o, times bar_factor),
///                      tripping_utilisation (o)}]}
///     padeyes      (o) [{lug, rope, padeye, consequence_factor, unknowns, governing_state, file,
///                      formulas: [{name, demand, limit, unit, utilisation, pass, source, time_s
///                      (o)}], with the factor, states: [{name, time_s (o), force_N,
///                      main_plate_checked_von_mises_Pa, cheeks_checked_von_mises_Pa,
///                      peak_von_mises_Pa, peak_point_m, force_residual, moment_residual}], without
///                      it, in the padeye's frame}]
///   natural_periods (o) [{instant, time_s, modes: [{name, kind, period_s, frequency_Hz,
///                      damping_ratio, elastic_share, energy_share_by_body: {body: share},
///                      energy_share_by_elastic_mode (o): {mode: share}, which the share of its
///                      body includes, turned_by_wind (o): true of one that grows because wind
///                      turns a load that nothing holds}]}], modes slowest first; period_s null
///                      where nothing brings the motion back
///   radiation      (o) {method, vessels, memory_states (o), memory_error (o), turn_of_all:
///                      LARGEST, misplacement: [{vessels, both_in_water, distance (o): LARGEST,
///                      turn (o): LARGEST, at_hull_ends (o): LARGEST, limit_m (o),
///                      share_of_time_beyond (o)}]} of pairs of vessels: from the places against
///                      each other that their water was computed for (misplacement.h); LARGEST =
///                      {size_m or angle_rad, time_s}
///   energy         (o) {largest_energy_J, largest_imbalance_J, relative_imbalance}
///   solver         (o) {any name: number or text}, shown as it stands, underscores as spaces
///   timing         (o) {static_s, dynamic_s, simulated_s, assembly_s, factorisation_s, solve_s,
///                      report_s, ...}
///   document       (o) {project, client, revision, prepared, checked, approved}: text, each (o)
///   indicative     (o) why the verdict is indicative only: a sentence without a full stop
///   assumptions    (o) list of text;   warnings (o) list of text
///   files          (o) [{name, content}]
namespace blocklift::pipeline::layout {

inline constexpr std::string_view results_file = "results.h5";
inline constexpr std::string_view summary_file = "summary.json";
inline constexpr std::string_view report_file = "report.html";
inline constexpr std::string_view table_file = "results.csv";

inline constexpr std::string_view format_name = "blocklift results";
inline constexpr double format_version = 2;

inline constexpr std::string_view case_group = "/case";
inline constexpr std::string_view run = "run";
inline constexpr std::string_view case_yaml = "/case/yaml";
inline constexpr std::string_view model_names = "/case/models/names";
inline constexpr std::string_view model_contents = "/case/models/contents";

inline constexpr std::string_view stage_names = "/operation/stage_names";
inline constexpr std::string_view stage_start = "/operation/stage_start";
inline constexpr std::string_view stage_end = "/operation/stage_end";

inline constexpr std::string_view static_history = "/static";
inline constexpr std::string_view dynamic_history = "/dynamic";

inline constexpr std::string_view outputs_time = "/time";
inline constexpr std::string_view outputs_group = "/outputs";
inline constexpr std::string_view statistics_group = "/statistics";

inline constexpr std::string_view measured_group = "/measured";

inline constexpr std::string_view modes_group = "/modes";

inline constexpr std::string_view scene_group = "/scene";
inline constexpr std::string_view scene_bodies = "/scene/bodies";
inline constexpr std::string_view scene_ropes = "/scene/ropes";
inline constexpr std::string_view scene_lugs = "/scene/lugs";
inline constexpr std::string_view scene_lug_names = "/scene/lugs/names";
inline constexpr std::string_view scene_lug_points = "/scene/lugs/points";
inline constexpr std::string_view world = "world";

inline constexpr std::string_view structure_group = "/structure";
inline constexpr std::string_view surface_points = "/structure/surface/points";
inline constexpr std::string_view surface_quads = "/structure/surface/quads";
inline constexpr std::string_view surface_quad_group = "/structure/surface/quad_group";
inline constexpr std::string_view surface_group_names = "/structure/surface/group_names";

inline constexpr std::string_view panels_group = "/structure/panels";
inline constexpr std::string_view columns_group = "/structure/columns";
inline constexpr std::string_view padeyes_group = "/structure/padeyes";

inline constexpr std::string_view simultaneous = "simultaneous";
inline constexpr std::string_view per_rope_maxima = "per_rope_maxima";
inline constexpr std::string_view history = "history";
inline constexpr std::string_view static_state = "static";
inline constexpr std::string_view dynamic_state = "dynamic";

/// `group`/`member`, for example join("/dynamic", "ropes", "R1", "tension").
template <typename... Names>
std::string join(std::string_view group, const Names&... names) {
  std::string path(group);
  ((path += '/', path += std::string_view(names)), ...);
  return path;
}

}  // namespace blocklift::pipeline::layout
