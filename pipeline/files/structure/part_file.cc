#include "pipeline/files/structure/part_file.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/format_once.h"
#include "pipeline/declaration/table.h"
#include "pipeline/files/named_file.h"

namespace blocklift::pipeline {

namespace {

Format<Vector3> vector_of(Dimension dimension) {
  return converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(quantity(dimension)),
      [](std::array<double, 3> v) { return Vector3(v[0], v[1], v[2]); });
}

const auto origin = "[0 m, 0 m, 0 m]";

Format<PartPlate> part_plate_format() {
  Table<PartPlate> table("plate", "A plate whose mid-surface is meshed.");
  table.required("thickness", &PartPlate::thickness, quantity(Dimension::length, Range::positive()),
                 "half of it is laid on each side of the mid-surface");
  return table.format();
}

Format<given::PartFaces> faces_format() {
  Table<given::PartFaces> table("faces", "The outer faces of the solids that lie in a box.");
  table
      .required("from", &given::PartFaces::from, position_format(), "corner of smallest x, y and z")
      .required("to", &given::PartFaces::to, position_format(), "corner of largest x, y and z")
      .rule([](const given::PartFaces& faces, Reading& reading, const Mark& mark) {
        if ((faces.to - faces.from).minCoeff() < 0)
          reading.error(mark, "the box ends before it begins: to is smaller than from");
      });
  return table.format();
}

Format<given::PartPoint> part_point_format() {
  Table<given::PartPoint> table("point", "The node at a place.");
  table.required("at", &given::PartPoint::at, position_format(),
                 "where it is, to a hundredth of the part's diagonal");
  return table.format();
}

void check_mesh(const given::PartMesh& mesh, Reading& reading, const Mark& mark) {
  if (mesh.file.has_value() == mesh.padeye.has_value()) {
    reading.error(mark,
                  mesh.file ? "the mesh is both a file and a padeye"
                            : "the mesh is neither a file nor a padeye",
                  {"a file: file: part.step", "or a padeye: padeye: {radius: 300 mm, ...}"});
    return;
  }
  if (mesh.padeye && (mesh.length_unit || mesh.element_size || mesh.element_order != 2 ||
                      !mesh.plates.empty() || !mesh.faces.empty() || !mesh.points.empty()))
    reading.error(
        mark, "of a padeye's mesh only its divisions and refinements can be chosen",
        {"length_unit, element_size, element_order, plates, faces and points are for files"});
}

Format<given::PartMesh> mesh_format() {
  const std::vector<std::pair<std::string, double>> units = {
      {"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};
  Table<given::PartMesh> table("mesh", "The part's mesh, a geometry that is meshed, or a padeye.");
  table
      .optional(
          "file", &given::PartMesh::file, located(text()),
          "what Gmsh opens (.msh, .geo, .step, .brep, .bdf, .unv), or .inp of Abaqus or CalculiX; "
          "relative to this file")
      .optional("padeye", &given::PartMesh::padeye, located(padeye_part_format()),
                "in the place of a file; a refinement doubles its divisions")
      .optional("length_unit", &given::PartMesh::length_unit, choice<double>(units),
                "of the file's coordinates; a STEP or IGES file states its own, which this must be "
                "where it is given; of other files m if left out, and then doubted where the part "
                "comes out too large or too small")
      .by_default("element_order", &given::PartMesh::element_order, integer(Range::between(1, 2)),
                  "2",
                  "that linear elements are raised to; linear ones are far too stiff in bending")
      .optional("element_size", &given::PartMesh::element_size,
                quantity(Dimension::length, Range::positive()),
                "largest edge where the file is a geometry")
      .by_default("refinements", &given::PartMesh::refinements, integer(Range::between(0, 6)), "0",
                  "how often every element is halved along each of its edges; curved sides of a "
                  "mesh that is "
                  "not made here get straight between its nodes")
      .optional(
          "plates", &given::PartMesh::plates, named_tables(part_plate_format()),
          "by group of surfaces: the file holds mid-surfaces of quadrangles, which are "
          "thickened into solids; each plate's sides are the groups \"NAME +\" and \"NAME -\"")
      .optional("faces", &given::PartMesh::faces, named_tables(faces_format()),
                "groups of faces by name, for meshes without names: a box around them chooses")
      .optional("points", &given::PartMesh::points, named_tables(part_point_format()),
                "groups of one node each by name")
      .rule(check_mesh);
  return table.format();
}

Format<PartMaterial> part_material_format() {
  Table<PartMaterial> table("material", "An isotropic elastic material and where it is.");
  table
      .required("youngs_modulus", &PartMaterial::youngs_modulus,
                quantity(Dimension::stress, Range::positive()), "E")
      .required("poisson_ratio", &PartMaterial::poisson_ratio, number(Range::inside(-1, 0.5)), "nu")
      .by_default("density", &PartMaterial::density,
                  quantity(Dimension::density, Range::not_negative()), "0 kg/m^3",
                  "needed by gravity, acceleration and rotation")
      .required("yield_stress", &PartMaterial::yield_stress,
                quantity(Dimension::stress, Range::positive()), "smallest yield stress")
      .optional("groups", &PartMaterial::groups, list_of(located(text()), 1),
                "groups of solids; if left out, all that no other material names");
  return table.format();
}

Format<given::PartJoin> join_format() {
  Table<given::PartJoin> table(
      "join", "Bodies that share no node and face each other closely are joined there.");
  table.required("within", &given::PartJoin::within,
                 located(quantity(Dimension::length, Range::positive())),
                 "largest gap between them that is joined");
  return table.format();
}

Format<given::PartSupport> part_support_format() {
  const std::vector<std::pair<std::string, std::size_t>> axes = {{"x", 0}, {"y", 1}, {"z", 2}};
  Table<given::PartSupport> table("support", "Components of the displacement that are given.");
  table
      .required("groups", &given::PartSupport::groups, list_of(located(text()), 1),
                "of faces, edges, points or solids")
      .by_default("fixed", &given::PartSupport::fixed, list_of(choice<std::size_t>(axes), 1),
                  "[x, y, z]", "components")
      .by_default("displacement", &given::PartSupport::displacement, position_format(), origin,
                  "of the fixed components");
  return table.format();
}

Format<PartRotation> rotation_format() {
  Table<PartRotation> table("rotation", "Steady rotation: the centrifugal load.");
  table.required("axis", &PartRotation::axis, direction_format(), "direction of the axis")
      .by_default("point", &PartRotation::point, position_format(), origin, "on the axis")
      .required("speed", &PartRotation::speed, quantity(Dimension::angular_speed), "of rotation");
  return table.format();
}

void check_part_load(const given::PartLoad& load, Reading& reading, const Mark& mark) {
  const int on_groups = load.pressure.has_value() + load.traction.has_value() +
                        load.force.has_value() + load.bearing.has_value();
  const int on_all =
      load.gravity.has_value() + load.acceleration.has_value() + load.rotation.has_value();
  if (on_groups + on_all != 1)
    reading.error(mark,
                  fmt::format("the load has {} kinds; exactly one is due", on_groups + on_all),
                  {"pressure, traction, force, bearing, gravity, acceleration or rotation"});
  if (on_groups == 1 && load.groups.empty())
    reading.error(mark, "the load acts on no group", {"name them: groups: [...]"});
  if (on_all == 1 && !load.groups.empty())
    reading.error(load.groups[0].mark, "gravity, acceleration and rotation act on the whole part",
                  {"leave groups out"});
}

Format<PartBearing> bearing_format() {
  Table<PartBearing> table(
      "bearing",
      "A pin that presses on its hole: pressure with the cosine of the angle from the "
      "force's direction over half of the hole; what is along the axis is spread over "
      "all of it. The sum is the force exactly, without a moment about the axis.");
  table.required("force", &PartBearing::force, vector_of(Dimension::load), "of the pin on the hole")
      .required("axis", &PartBearing::axis, direction_format(), "of the hole")
      .required("point", &PartBearing::point, position_format(), "on the axis");
  return table.format();
}

Format<given::PartLoad> part_load_format() {
  Table<given::PartLoad> table("load", "A load on groups, or on all material.");
  table
      .optional("groups", &given::PartLoad::groups, list_of(located(text()), 1),
                "of faces; a force may act on edges and points, too")
      .optional("pressure", &given::PartLoad::pressure, quantity(Dimension::stress),
                "against the faces; negative pulls")
      .optional("traction", &given::PartLoad::traction, vector_of(Dimension::stress),
                "force for each area of the faces")
      .optional("force", &given::PartLoad::force, vector_of(Dimension::load),
                "resultant, spread evenly over all of a group; each group bears it")
      .optional("bearing", &given::PartLoad::bearing, bearing_format(),
                "of a pin on a hole's faces")
      .optional("gravity", &given::PartLoad::gravity, vector_of(Dimension::acceleration),
                "acceleration of gravity")
      .optional("acceleration", &given::PartLoad::acceleration, vector_of(Dimension::acceleration),
                "of the part: its inertia pulls the other way")
      .optional("rotation", &given::PartLoad::rotation, rotation_format(), "about a fixed axis")
      .rule(check_part_load);
  return table.format();
}

void check_probe(const given::PartProbe& probe, Reading& reading, const Mark& mark) {
  const bool is_line = probe.from && probe.to && !probe.at;
  if (is_line || (probe.at && !probe.from && !probe.to)) return;
  reading.error(mark, "the probe is neither a point nor a line",
                {"a point: at: [x, y, z]", "a line: from: [x, y, z], to: [x, y, z]"});
}

Format<given::PartProbe> probe_format() {
  Table<given::PartProbe> table("probe", "Where displacement and stress are asked for.");
  table.optional("at", &given::PartProbe::at, position_format(), "a point")
      .optional("from", &given::PartProbe::from, position_format(), "start of a line")
      .optional("to", &given::PartProbe::to, position_format(), "its end")
      .by_default("points", &given::PartProbe::points, integer(Range::between(2, 100000)), "11",
                  "along a line")
      .rule(check_probe);
  return table.format();
}

const std::vector<std::pair<std::string, PartQuantity>>& quantity_words() {
  using Q = PartQuantity;
  static const std::vector<std::pair<std::string, Q>> words = {{"xx", Q::xx},
                                                               {"yy", Q::yy},
                                                               {"zz", Q::zz},
                                                               {"xy", Q::xy},
                                                               {"yz", Q::yz},
                                                               {"zx", Q::zx},
                                                               {"von_mises", Q::von_mises},
                                                               {"u_x", Q::u_x},
                                                               {"u_y", Q::u_y},
                                                               {"u_z", Q::u_z}};
  return words;
}

void check_figure(const PartReference& figure, Reading& reading, const Mark& mark) {
  const bool of_probe = figure.probe && figure.quantity && !figure.mode;
  if (!of_probe && !(figure.mode && !figure.probe && !figure.quantity)) {
    reading.error(mark, "the figure is neither of a probe nor of a mode",
                  {"of a probe: probe and quantity", "of a natural mode: mode"});
    return;
  }
  const Dimension due = figure.mode                             ? Dimension::frequency
                        : *figure.quantity >= PartQuantity::u_x ? Dimension::length
                                                                : Dimension::stress;
  if (figure.value.value.dimension == due) return;
  const DimensionText& text = text_of(due);
  reading.error(figure.value.mark,
                fmt::format("{} is due, for example \"{}\"", text.noun, text.example));
}

Format<PartReference> reference_figure_format() {
  Table<PartReference> table("figure",
                             "A published figure of a point probe, or a natural frequency.");
  table.optional("probe", &PartReference::probe, located(reference()), "one of the point probes")
      .optional("quantity", &PartReference::quantity, choice<PartQuantity>(quantity_words()),
                "of the probe: stress component, von Mises stress or displacement")
      .optional("mode", &PartReference::mode, integer(Range::between(1, 1000)),
                "number of a natural mode, rigid ones counted")
      .required("value", &PartReference::value,
                located(quantity_of({Dimension::stress, Dimension::length, Dimension::frequency})),
                "as published")
      .required("tolerance", &PartReference::tolerance,
                quantity(Dimension::ratio, Range::positive()), "of the value, as \"1 %\"")
      .rule(check_figure);
  return table.format();
}

Format<PartReferences> references_format() {
  Table<PartReferences> table("references", "Published figures, held by `blocklift verify`.");
  table.required("source", &PartReferences::source, text(), "where they stand")
      .by_default("refinements", &PartReferences::refinements, integer(Range::between(0, 4)), "0",
                  "they are also held after so many halvings of the mesh; the bound of a coarser "
                  "mesh is four times that of the next, the tolerance that of the finest")
      .required("figures", &PartReferences::figures, list_of(reference_figure_format(), 1),
                "one for each figure");
  return table.format();
}

Format<CheckedStress> checked_stress_format() {
  Table<CheckedStress> table(
      "checked stress",
      "How accurate the von Mises stress shall be where it is checked. Its error is estimated by "
      "superconvergent patch recovery; it does not fall at a sharp corner or under a point load.");
  table
      .required("accuracy", &CheckedStress::accuracy,
                quantity(Dimension::ratio, Range::between(1e-6, 1)), "its largest error, as 3 %")
      .optional("probes", &CheckedStress::probes, list_of(located(reference()), 1),
                "point probes; the largest stress of the part if left out");
  return table.format();
}

Format<structure::SolverChoice> solver_format() {
  using Choice = structure::SolverChoice;
  using Method = structure::SolverMethod;
  Table<Choice> table("solver", "How the equations are solved.");
  table
      .by_default("method", &Choice::method,
                  choice<Method>({{"automatic", Method::automatic},
                                  {"direct", Method::direct},
                                  {"iterative", Method::iterative}}),
                  "automatic",
                  "direct: Cholesky factorisation; iterative: conjugate gradients with algebraic "
                  "multigrid, in a fraction of the memory; automatic: directly if that fits")
      .by_default("tolerance", &Choice::tolerance, number(Range::between(1e-14, 1e-4)), "1e-12",
                  "of the iteration: residual over load");
  return table.format();
}

/// Complains unless the name is that of a point probe.
bool is_point_probe(const PartFile& part, const Located<std::string>& name, Reading& reading) {
  std::vector<std::string> names;
  for (const given::PartProbe& probe : part.probes)
    if (probe.at) names.push_back(probe.name.value);
  if (std::find(names.begin(), names.end(), name.value) != names.end()) return true;
  reading.error(name.mark, fmt::format("there is no point probe \"{}\"", name.value),
                {names_hint("the point probes are", names, name.value)});
  return false;
}

void check_checked_stress(const PartFile& part, Reading& reading, const Mark& mark) {
  if (!part.checked_stress) return;
  if (part.loads.empty())
    reading.error(mark, "the accuracy of a stress is asked for, but there are no loads");
  for (const Located<std::string>& name : part.checked_stress->probes)
    is_point_probe(part, name, reading);
}

void check_references(const PartFile& part, Reading& reading, const Mark&) {
  if (!part.references) return;
  for (const PartReference& figure : part.references->figures) {
    if (figure.mode && *figure.mode > part.modes.value_or(0))
      reading.error(figure.value.mark, fmt::format("mode {} is not asked for", *figure.mode),
                    {fmt::format("ask for it: modes: {}", *figure.mode)});
    if (!figure.probe) continue;
    if (is_point_probe(part, *figure.probe, reading) && part.loads.empty())
      reading.error(figure.probe->mark, "a part without loads has no stresses");
  }
}

void check_part(const PartFile& part, Reading& reading, const Mark& mark) {
  if (part.loads.empty() && !part.modes)
    reading.error(mark, "the part has neither loads nor modes: there is nothing to compute",
                  {"give it loads, or ask for natural frequencies: modes: 10"});
  if (!part.loads.empty() && part.supports.empty())
    reading.error(mark, "the part has loads but no supports",
                  {"hold it: supports: {root: {groups: [...]}}; loads in balance need six held "
                   "components"});
  if (part.accuracy && part.loads.empty())
    reading.error(mark, "an accuracy is asked for, but without loads there is no stress");
  for (const given::PartProbe& probe : part.probes)
    if (part.loads.empty())
      reading.error(probe.name.mark, "a part without loads has nothing to probe");
  for (const given::HotSpot& spot : part.hot_spots)
    if (part.loads.empty())
      reading.error(spot.name.mark, "a part without loads has no stress at a weld toe");
  if (part.modes)
    for (const PartMaterial& material : part.materials)
      if (!(material.density > 0))
        reading.error(
            material.name.mark,
            fmt::format("material {} has no density, but modes are asked for", material.name.value),
            {"for steel: density: 7850 kg/m^3"});
}

}  // namespace

const std::string& name_of(PartQuantity quantity) {
  return quantity_words()[static_cast<std::size_t>(quantity)].first;
}

std::filesystem::path PartFile::mesh_path() const {
  return file.parent_path() / std::filesystem::path(mesh.file ? mesh.file->value : std::string());
}

Format<PartFile> part_file_format() {
  Table<PartFile> table("part",
                        "Any part of solids with materials, supports and loads, for "
                        "`blocklift stress`.");
  table.required("part", &PartFile::name, name(), "its name")
      .optional("title", &PartFile::title, text(), "for people")
      .required("mesh", &PartFile::mesh, mesh_format(), "the part's mesh")
      .required("materials", &PartFile::materials, named_tables(part_material_format()), "by name")
      .optional("join", &PartFile::join, join_format(),
                "bodies of an assembly that touch, whose meshes need not match; without it they "
                "stay apart, and a warning says where")
      .optional("supports", &PartFile::supports, named_tables(part_support_format()),
                "by name; loads need them, natural modes do not")
      .optional("loads", &PartFile::loads, named_tables(part_load_format()),
                "by name; they act together")
      .optional("probes", &PartFile::probes, named_tables(probe_format()), "by name")
      .optional("hot_spots", &PartFile::hot_spots, hot_spots_format(),
                "weld toes, by name, whose structural stress is extrapolated")
      .optional("solver", &PartFile::solver, solver_format(), "how the equations are solved")
      .optional("modes", &PartFile::modes, integer(Range::between(1, 1000)),
                "natural modes to find, the lowest, those of rigid motion counted")
      .optional("accuracy", &PartFile::accuracy,
                quantity(Dimension::ratio, Range::between(1e-6, 1)),
                "largest estimated error of the stress field in the energy norm, such as 5 %; "
                "elements are raised to quadratic ones and made smaller until it is met: those of "
                "a geometry of tetrahedra where the error is, others all by half")
      .optional(
          "checked_stress", &PartFile::checked_stress, checked_stress_format(),
          "the same for the stress that is checked: elements are made smaller until its error "
          "is met")
      .optional("references", &PartFile::references, references_format(),
                "published figures to hold against ours")
      .rule(check_part)
      .rule(check_checked_stress)
      .rule(check_references);
  return table.format();
}

std::optional<PartFile> read_part_file(const std::filesystem::path& path,
                                       Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::error_code error;
  const std::filesystem::path file =
      std::filesystem::is_directory(path, error) ? path / "part.yaml" : path;
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  PartFile part;
  part.file = file;
  part.yaml = document->text;
  Reading reading(*document, diagnostics);
  format_once<part_file_format>().read(document->root, reading, part);
  if (part.mesh.file) path_of_named_file(*part.mesh.file, file.parent_path(), diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return part;
}

}  // namespace blocklift::pipeline
