// Meshes of Gmsh and CAD surfaces as plates and bars.
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/surfaces/cad_file.h"
#include "structure/mesh/files/surfaces/given_properties.h"
#include "structure/mesh/files/surfaces/surface_reader.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"

namespace blocklift::structure {
namespace {

namespace fs = std::filesystem;
namespace occ = gmsh::model::occ;
using examples::plain_steel;
using ::testing::HasSubstr;

class Surfaces : public ::testing::Test {
 protected:
  Surfaces()
      : folder_(fs::temp_directory_path() / ("blocklift-surfaces-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Surfaces() override { fs::remove_all(folder_); }

  /// A file of what `draw` draws in Gmsh.
  std::string made(const std::string& name, const std::function<void()>& draw) const {
    const GmshSession session;
    draw();
    gmsh::write((folder_ / name).string());
    return (folder_ / name).string();
  }
  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

 private:
  fs::path folder_;
};

SurfaceReading reading_of(const std::string& units, double size = 0) {
  SurfaceReading reading;
  reading.units = unit_system(units);
  reading.sizes.largest = size;
  return reading;
}

/// The plates of a file, all of one thickness.
Mesh plates_of(const std::string& path, const SurfaceReading& reading, double plate_thickness) {
  Deck deck = read_surfaces(path, reading);
  deck.mesh.materials = {plain_steel()};
  for (const std::string& group : deck.groups_without_thickness)
    give_thickness(deck.mesh, group, plate_thickness, 0);
  check_mesh(deck.mesh);
  return deck.mesh;
}

std::string reading_error(const std::string& path, const SurfaceReading& reading) {
  try {
    read_surfaces(path, reading);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "";
}

void draw_plate() {
  occ::addRectangle(0, 0, 0, 1000, 1000);
  occ::synchronize();
}

constexpr double plate_pressure = 1e3, plate_thickness = 0.01;  // Pa, m

/// Deflection of the middle of a plate of 1 m by 1 m, simply supported, under pressure.
double middle_deflection(const Mesh& mesh) {
  const Space space(mesh, {3, {}});
  const auto on = [](double x) { return std::min(std::abs(x), std::abs(x - 1)) < 1e-6; };
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [&](const Vector3& p) { return on(p.x()); }, {0, 1, 2, 3, 5}, fixed);
  examples::hold(
      space, [&](const Vector3& p) { return on(p.y()) && !on(p.x()); }, {0, 1, 2, 4, 5}, fixed);
  const Eigen::VectorXd load =
      examples::area_load(space, [](const Vector3&) { return Vector3(0, 0, -plate_pressure); });
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  return -examples::displacement_at(space, motion, {0.5, 0.5, 0}).z();
}

// Timoshenko and Woinowsky-Krieger (1959), table 8: w = 0.00406 q a^4 / D. Shear adds
// 0.0737 q a^2 / (5/6 G t), a thousandth; the node nearest to the middle is within h / 2 of it,
// where the deflection is less by no more than (pi h / 2)^2 / 4 for h = 0.1 m.
TEST_F(Surfaces, APlateBendsAlikeByMeshGeometryAndPlates) {
  const Material steel = plain_steel();
  const double stiffness = steel.youngs_modulus * std::pow(plate_thickness, 3) /
                           (12 * (1 - steel.poisson_ratio * steel.poisson_ratio));
  const double expected = 0.004062 * plate_pressure / stiffness;
  const std::string msh = made("plate.msh", [] {
    draw_plate();
    gmsh::model::mesh::setTransfiniteAutomatic();
    gmsh::option::setNumber("Mesh.MeshSizeMax", 125);
    gmsh::option::setNumber("Mesh.RecombineAll", 1);
    gmsh::model::mesh::generate(2);
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), "plate");
  });
  const std::string step = made("plate.step", draw_plate);
  BlockDescription block;
  block.materials = {steel};
  block.plates = {{"plate", Axis::z, {0}, {{{0, 1}, {0, 1}, {0, 0}}}, plate_thickness, steel.name}};
  block.largest_element = 0.125;
  const double tolerance = 0.012 * expected;
  EXPECT_NEAR(middle_deflection(plates_of(msh, reading_of("mm-t-N"), plate_thickness)), expected,
              tolerance);
  EXPECT_NEAR(middle_deflection(plates_of(step, reading_of("mm-t-N", 0.1), plate_thickness)),
              expected, tolerance);
  EXPECT_NEAR(middle_deflection(generate_shell_mesh(block)), expected, tolerance);
}

// A quarter of a cylinder: the arc's quadratic chords are off by (angle / 2)^4 / 45 or so.
TEST_F(Surfaces, AQuarterOfACylinderWeighsWhatItWeighs) {
  constexpr double radius = 2, length = 3;
  const std::string file = made("bilge.brep", [] {
    const int arc = occ::addCircle(0, 0, 0, radius, -1, 0, std::numbers::pi / 2);
    gmsh::vectorpair out;
    occ::extrude({{1, arc}}, 0, 0, length, out);
    occ::synchronize();
  });
  const Mesh mesh = plates_of(file, reading_of("m-kg-N", 0.5), plate_thickness);
  EXPECT_FALSE(mesh.curved_shells.empty());
  const auto mass = mass_properties(mesh);
  const double expected =
      plain_steel().density * plate_thickness * length * radius * std::numbers::pi / 2;
  EXPECT_NEAR(mass.mass, expected, 1e-5 * expected);
  const double centre = 2 * radius / std::numbers::pi;
  EXPECT_LT((mass.centre - Vector3(centre, centre, length / 2)).norm(), 1e-4);
}

// A web that crosses a deck and one that ends on it: what meets shares nodes.
TEST_F(Surfaces, PlatesAreCutAtTheirJoints) {
  const std::string file = made("joints.step", [] {
    occ::addRectangle(0, 0, 0, 4000, 2000);
    const auto upright = [](double x, double low, double high) {
      const int plate = occ::addRectangle(low, 0, 0, high - low, 2000);
      occ::rotate({{2, plate}}, 0, 0, 0, 0, 1, 0, -std::numbers::pi / 2);
      occ::translate({{2, plate}}, x, 0, 0);
    };
    upright(1000, -500, 700);
    upright(3000, 0, 800);
    occ::synchronize();
  });
  SurfaceReading reading = reading_of("mm-t-N", 0.5);
  reading.sizes.at_places = 0.1;
  reading.sizes.places = {Vector3(3, 1, 0.8)};
  const Mesh mesh = plates_of(file, reading, plate_thickness);
  for (const int part : connected_parts(mesh)) EXPECT_LE(part, 0);
  EXPECT_NEAR(mass_properties(mesh).mass,
              plain_steel().density * plate_thickness * (8 + 2 * 1.2 + 2 * 0.8), 1e-6);
  const auto longest_near = [&](const Vector3& place) {
    double longest = 0;
    for (const Shell& shell : mesh.shells)
      if ((position(mesh, shell, {0.5, 0.5}) - place).norm() < 0.3)
        longest = std::max(longest, longest_edge(mesh, shell));
    return longest;
  };
  EXPECT_LT(longest_near({3, 1, 0.8}), 0.2);
  EXPECT_GT(longest_near({0.5, 0.5, 0}), 0.3);
}

// An open box of five plates of three thicknesses, with the units and groups of a file.
TEST_F(Surfaces, ABoxFromStepWeighsAsThatOfPlates) {
  const std::string file = made("box.step", [] {
    const auto plate = [](double x, double y, double width, double height, double turn,
                          const Vector3& axis) {
      const int tag = occ::addRectangle(0, 0, 0, width, height);
      occ::rotate({{2, tag}}, 0, 0, 0, axis.x(), axis.y(), axis.z(), turn);
      occ::translate({{2, tag}}, x, y, 0);
    };
    const double quarter = std::numbers::pi / 2;
    plate(0, 0, 4000, 3000, 0, Vector3::UnitX());
    plate(0, 0, 4000, 1500, quarter, Vector3::UnitX());
    plate(0, 3000, 4000, 1500, quarter, Vector3::UnitX());
    plate(0, 0, 1500, 3000, -quarter, Vector3::UnitY());
    plate(4000, 0, 1500, 3000, -quarter, Vector3::UnitY());
    occ::synchronize();
  });
  Deck deck = read_surfaces(file, reading_of("mm-t-N", 0.5));
  deck.mesh.materials = {plain_steel()};
  EXPECT_THAT(
      deck.groups_without_thickness,
      ::testing::ElementsAre("surface 1", "surface 2", "surface 3", "surface 4", "surface 5"));
  for (const std::string& group : deck.groups_without_thickness)
    give_thickness(deck.mesh, group,
                   group == "surface 1" ? 0.02 : (group < "surface 4" ? 0.015 : 0.012), 0);
  check_mesh(deck.mesh);
  const std::string steel = plain_steel().name;
  BlockDescription block;
  block.materials = {plain_steel()};
  block.plates = {{"bottom", Axis::z, {0}, {{{0, 4}, {0, 3}, {0, 0}}}, 0.02, steel},
                  {"sides", Axis::y, {0, 3}, {{{0, 4}, {0, 0}, {0, 1.5}}}, 0.015, steel},
                  {"ends", Axis::x, {0, 4}, {{{0, 0}, {0, 3}, {0, 1.5}}}, 0.012, steel}};
  block.largest_element = 0.5;
  const auto of_file = mass_properties(deck.mesh);
  const auto of_plates = mass_properties(generate_shell_mesh(block));
  EXPECT_NEAR(of_file.mass, of_plates.mass, 1e-9 * of_plates.mass);
  EXPECT_LT((of_file.centre - of_plates.centre).norm(), 1e-9);
  for (const int part : connected_parts(deck.mesh)) EXPECT_LE(part, 0);
}

// Frames within and without a pipe of flat shells: each piece stands on its shell's face, along its
// normal, where one direction for all would leave most of them lying aslant. Their centroids lie on
// a polygon of its own, whose sides are as long as its distance from the axis has it.
TEST(FrameAxis, RingFramesStandTowardsTheAxisOrAwayFromIt) {
  constexpr int count = 12;
  const double radius = 2, thickness = 0.01, height = 0.15;
  Mesh pipe;
  pipe.materials = {plain_steel()};
  pipe.shell_sections = {{thickness, 0, 0}};
  pipe.groups = {{"shell", 0}, {"frame", 0}};
  pipe.regions = {{"shell", 0, false}, {"frame", 1, false}};
  const Vector3 foot(0.3, -0.2, 1);  // the axis is upright through it
  for (int i = 0; i < count; ++i)
    for (const double z : {0.0, 1.0}) {
      const double angle = 2 * std::numbers::pi * i / count;
      pipe.vertices.push_back(foot +
                              Vector3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  for (int i = 0; i < count; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % count);
    Shell shell;
    shell.vertices = {a, b, a + 1, b + 1};
    pipe.shells.push_back(shell);
    Beam frame;
    frame.vertices = {a + 1, b + 1};
    frame.section = -1;
    frame.region = 1;
    pipe.beams.push_back(frame);
  }
  for (const double side : {-1.0, 1.0}) {
    Mesh mesh = pipe;
    give_profile(mesh, "frame", flat_bar(height, 0.012),
                 FrameAxis{foot + Vector3(0, 0, 7), Vector3::UnitZ(), side > 0}, 0);
    for (const Beam& beam : mesh.beams) {
      const Vector3 middle =
          (mesh.vertices[beam.vertices[0]] + mesh.vertices[beam.vertices[1]]) / 2 - foot;
      const Vector3 radial = Vector3(middle.x(), middle.y(), 0).normalized();
      EXPECT_LT((beam.axis_2 - side * radial).norm(), 1e-12);
      const double away = side * (thickness / 2 + height / 2), half = std::numbers::pi / count;
      Vector3 ends[2];
      for (std::size_t end = 0; end < 2; ++end) {
        EXPECT_NEAR(beam.offset[end].dot(radial), away, 1e-12);
        ends[end] = mesh.vertices[beam.vertices[end]] + beam.offset[end];
        const Vector3 from_axis = ends[end] - foot - Vector3(0, 0, 1);
        EXPECT_NEAR(from_axis.norm(), radius + away / std::cos(half), 1e-12);
      }
      EXPECT_NEAR((ends[1] - ends[0]).norm(),
                  2 * std::sin(half) * radius + 2 * std::tan(half) * away, 1e-12);
    }
    check_mesh(mesh);
  }
  Mesh mesh = pipe;
  const Vector3 middle = (pipe.vertices[1] + pipe.vertices[3]) / 2;
  EXPECT_THROW(give_profile(mesh, "frame", flat_bar(height, 0.012),
                            FrameAxis{middle, Vector3::UnitZ(), false}, 0),
               ModelError);
}

// A deck whose edge in its middle is a bar of its own group, 2 m long. Its lines lie along straight
// edges of shells and are one beam each, in a mesh of second order, too.
TEST_F(Surfaces, LinesOfAGroupWithASectionAreBars) {
  std::size_t of_first_order = 0;
  for (const int order : {1, 2}) {
    const std::string file = made("bars.msh", [order] {
      const int left = occ::addRectangle(0, 0, 0, 1, 2), right = occ::addRectangle(1, 0, 0, 1, 2);
      gmsh::vectorpair out;
      std::vector<gmsh::vectorpair> of_input;
      occ::fragment({{2, left}}, {{2, right}}, out, of_input);
      occ::synchronize();
      gmsh::vectorpair middle;
      gmsh::model::getEntitiesInBoundingBox(0.9, -0.1, -0.1, 1.1, 2.1, 0.1, middle, 1);
      gmsh::model::addPhysicalGroup(2, {1, 2}, 7);
      gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {middle[0].second}), "bar");
      gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
      gmsh::model::mesh::generate(2);
      gmsh::model::mesh::setOrder(order);
    });
    SurfaceReading reading = reading_of("m-kg-N");
    EXPECT_TRUE(read_surfaces(file, reading).mesh.beams.empty());
    reading.given.bars = {"bar"};
    Deck deck = read_surfaces(file, reading);
    EXPECT_THAT(deck.groups_without_thickness, ::testing::ElementsAre("surface group 7"));
    EXPECT_THAT(deck.groups_without_section, ::testing::ElementsAre("bar"));
    deck.mesh.materials = {plain_steel()};
    give_thickness(deck.mesh, "surface group 7", plate_thickness, 0);
    const Profile bar = flat_bar(0.15, 0.012);
    Mesh other = deck.mesh;
    EXPECT_THROW(give_profile(other, "bar", bar, Vector3(0, 1, 0), 0), ModelError);
    give_profile(deck.mesh, "bar", bar, Vector3(0, 0, -1), 0);
    check_mesh(deck.mesh);
    for (const Beam& beam : deck.mesh.beams)
      EXPECT_NEAR(beam.offset[0].z(), -plate_thickness / 2 - 0.075, 1e-12);
    EXPECT_NEAR(mass_properties(deck.mesh).mass,
                plain_steel().density * (4 * plate_thickness + 2 * 0.15 * 0.012), 1e-6);
    EXPECT_TRUE(deck.mesh.surface_points.empty());
    if (order == 1) of_first_order = deck.mesh.beams.size();
    EXPECT_EQ(deck.mesh.beams.size(), of_first_order);
  }
}

/// A deck of 4 m by 2 m, a stiffener of 4 m drawn on it, a pillar of 1 m that stands on it, and a
/// quarter of a circle of 2 m about the pillar's foot, above the deck.
void draw_deck_with_bars() {
  const auto line = [](const std::array<double, 3>& from, const std::array<double, 3>& to) {
    occ::addLine(occ::addPoint(from[0], from[1], from[2]), occ::addPoint(to[0], to[1], to[2]));
  };
  occ::addRectangle(0, 0, 0, 4000, 2000);
  line({0, 800, 0}, {4000, 800, 0});
  line({2000, 1200, 0}, {2000, 1200, 1000});
  occ::addCircle(2000, 1200, 1000, 2000, -1, 0, std::numbers::pi / 2);
  occ::synchronize();
}

/// Groups of a file's curves, by the list of what it leaves out.
std::vector<std::string> groups_of_curves(const std::string& path) {
  const Deck deck = read_surfaces(path, reading_of("mm-t-N", 0.25));
  for (const LedgerEntry& line : deck.ledger) {
    if (line.name != "curves") continue;
    std::vector<std::string> groups;
    std::istringstream names(line.left_out.substr(line.left_out.find(": ") + 2));
    for (std::string name; std::getline(names >> std::ws, name, ',');) groups.push_back(name);
    return groups;
  }
  return {};
}

// Bars that lie in a plate or stand on it share its nodes; arcs are chords of a mesh that is finer
// there: the length of the arc is met within (angle of a chord)^2 / 24.
TEST_F(Surfaces, CurvesOfAGeometryAreBars) {
  for (const char* name : {"bars.step", "bars.brep"}) {
    SCOPED_TRACE(name);
    const std::string file = made(name, draw_deck_with_bars);
    const std::vector<std::string> groups = groups_of_curves(file);
    ASSERT_EQ(groups.size(), 3U);
    SurfaceReading reading = reading_of("mm-t-N", 0.25);
    reading.given.bars = {groups[0], groups[1]};
    Deck deck = read_surfaces(file, reading);
    EXPECT_THAT(deck.groups_without_section, ::testing::ElementsAre(groups[0], groups[1]));
    EXPECT_THAT(deck.ledger.back().left_out, HasSubstr(groups[2]));
    for (const int part : connected_parts(deck.mesh)) EXPECT_LE(part, 0);
    deck.mesh.materials = {plain_steel()};
    give_thickness(deck.mesh, deck.groups_without_thickness.front(), plate_thickness, 0);
    give_profile(deck.mesh, groups[0], flat_bar(0.15, 0.012), Vector3(0, 0, -1), 0);
    give_profile(deck.mesh, groups[1], flat_bar(0.15, 0.012), Vector3(1, 0, 0), 0);
    check_mesh(deck.mesh);
    EXPECT_NEAR(mass_properties(deck.mesh).mass,
                plain_steel().density * (8 * plate_thickness + 5 * 0.15 * 0.012), 1e-6);
    // The stiffener stands under the plate's face, wherever its elements are.
    int on_plate = 0;
    for (const Beam& beam : deck.mesh.beams)
      if (std::abs(beam.offset[0].z() + plate_thickness / 2 + 0.075) < 1e-12) ++on_plate;
    EXPECT_GE(on_plate, 16);
    reading.given.bars = groups;
    const Mesh mesh = read_surfaces(file, reading).mesh;
    double length = 0;
    for (const Beam& beam : mesh.beams)
      length += (mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]]).norm();
    EXPECT_NEAR(length, 5 + std::numbers::pi, std::numbers::pi * std::pow(0.0625, 2) / 24);
  }
}

/// Writes a file of IGES 5.3 (ANS US PRO/IPO-100-1996), whose lines have their section's letter and
/// a number behind column 72.
class IgesText {
 public:
  /// @param status 10000: only there for what is made of it.
  /// @return the number by which other entities name this one.
  int entity(int type, const std::string& parameters, int status = 0) {
    const int number = directory_lines_ + 1;
    const std::string data =
        fmt::format("{:<64}{:>8}", fmt::format("{},{};", type, parameters), number);
    parameters_ += line(data, 'P', ++parameter_lines_);
    directory_ += line(fmt::format("{0:>8}{1:>8}{2:>8}{2:>8}{2:>8}{2:>8}{2:>8}{2:>8}{3:08}", type,
                                   parameter_lines_, 0, status),
                       'D', ++directory_lines_);
    directory_ += line(fmt::format("{0:>8}{1:>8}{1:>8}{2:>8}{1:>8}{3:>24}{1:>8}", type, 0, 1, ""),
                       'D', ++directory_lines_);
    return number;
  }
  std::string text() const {
    const std::string globals =
        "1H,,1H;,4Hdeck,8Hdeck.igs,4Htest,1H1,32,38,6,308,15,4Hdeck,1.,2,2HMM,1,";
    const std::string more =
        "0.01,15H20260101.000000,1E-6,1E5,4Htest,4Htest,11,0,15H20260101.000000;";
    return line("", 'S', 1) + line(globals, 'G', 1) + line(more, 'G', 2) + directory_ +
           parameters_ +
           line(fmt::format("S{:07}G{:07}D{:07}P{:07}", 1, 2, directory_lines_, parameter_lines_),
                'T', 1);
  }

 private:
  static std::string line(const std::string& data, char section, int number) {
    return fmt::format("{:<72}{}{:07}\n", data, section, number);
  }
  std::string directory_, parameters_;
  int directory_lines_ = 0, parameter_lines_ = 0;
};

// A deck and a web, ruled between lines (entities 118 and 110), a quarter of a cylinder of 1 m that
// stands on the deck, between arcs (100), and a line of 4 m along the deck that is a bar.
TEST_F(Surfaces, AnIgesFileOfRuledSurfacesAndLines) {
  IgesText iges;
  constexpr int dependent = 10000, line = 110, arc = 100, ruled = 118;
  const auto surface_between = [&](int type, const std::string& first, const std::string& second) {
    const int a = iges.entity(type, first, dependent), b = iges.entity(type, second, dependent);
    iges.entity(ruled, fmt::format("{},{},0,0", a, b));
  };
  surface_between(line, "0.,0.,0.,4000.,0.,0.", "0.,2000.,0.,4000.,2000.,0.");
  surface_between(line, "2000.,0.,0.,2000.,2000.,0.", "2000.,0.,800.,2000.,2000.,800.");
  surface_between(arc, "0.,3000.,1000.,4000.,1000.,3000.,2000.",
                  "1000.,3000.,1000.,4000.,1000.,3000.,2000.");
  iges.entity(line, "0.,800.,0.,4000.,800.,0.");
  const std::string file = written("deck.igs", iges.text());
  EXPECT_EQ(declared_length(file), 1e-3);
  const std::vector<std::string> groups = groups_of_curves(file);
  ASSERT_EQ(groups.size(), 1U);
  SurfaceReading reading = reading_of("mm-t-N", 0.25);
  reading.given.bars = groups;
  Deck deck = read_surfaces(file, reading);
  for (const int part : connected_parts(deck.mesh)) EXPECT_LE(part, 0);
  deck.mesh.materials = {plain_steel()};
  EXPECT_EQ(deck.groups_without_thickness.size(), 3U);
  for (const std::string& group : deck.groups_without_thickness)
    give_thickness(deck.mesh, group, plate_thickness, 0);
  const Profile bar = flat_bar(0.15, 0.012);
  give_profile(deck.mesh, groups[0], bar, Vector3(0, 0, -1), 0);
  check_mesh(deck.mesh);
  const double area = 8 + 1.6 + std::numbers::pi / 2;
  const double mass = plain_steel().density * (area * plate_thickness + 4 * bar.section.area);
  EXPECT_NEAR(mass_properties(deck.mesh).mass, mass, 1e-5 * mass);
}

TEST_F(Surfaces, AGeometryMayBeOfBarsAlone) {
  const std::string file = made("frame.step", [] {
    const int foot = occ::addPoint(0, 0, 0), knee = occ::addPoint(0, 0, 3000);
    occ::addLine(foot, knee);
    occ::addLine(knee, occ::addPoint(2000, 0, 3000));
    occ::synchronize();
  });
  const std::string without = reading_error(file, reading_of("mm-t-N", 0.25));
  EXPECT_THAT(without, HasSubstr("the file has curves alone, and no section is given to their "
                                 "groups: curve 1, curve 2"));
  SurfaceReading reading = reading_of("mm-t-N", 0.25);
  reading.given.bars = {"curve 1", "curve 2"};
  const Deck deck = read_surfaces(file, reading);
  EXPECT_GE(deck.mesh.beams.size(), 20U);
  EXPECT_EQ(deck.mesh.vertices.size(), deck.mesh.beams.size() + 1);
}

TEST_F(Surfaces, SaysWhatIsWrong) {
  const std::string plate = made("plate.step", draw_plate);
  EXPECT_THAT(reading_error(plate, reading_of("m-kg-N", 0.1)),
              HasSubstr("the file says that its lengths are in units of 0.001 m"));
  EXPECT_THAT(reading_error(plate, reading_of("mm-t-N", 1e-6)),
              HasSubstr("is the size or the file's"));
  const std::string solid = made("solid.step", [] {
    occ::addBox(0, 0, 0, 1, 1, 1);
    occ::synchronize();
  });
  EXPECT_THAT(reading_error(solid, reading_of("mm-t-N", 0.1)),
              HasSubstr("the file has 1 solid, and"));
  SurfaceReading without = reading_of("mm-t-N", 0.1);
  without.leave_solids_out = true;
  EXPECT_THAT(reading_error(solid, without), HasSubstr("neither surfaces nor curves"));
  std::ifstream file(plate);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string cut = written("cut.step", text.substr(0, text.size() / 2));
  EXPECT_NE(reading_error(cut, reading_of("mm-t-N", 0.1)), "");
  EXPECT_NE(reading_error(written("empty.brep", ""), reading_of("mm-t-N", 0.1)), "");
  for (const char* msh : {"", "\n",
                          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n"
                          "$EndNodes\n$Elements\n0\n$EndElements\n"})
    EXPECT_THAT(reading_error(written("empty.msh", msh), reading_of("mm-t-N")),
                HasSubstr("neither plates nor bars"));
  const std::string twice = made("twice.msh", [] {
    draw_plate();
    for (const char* name : {"deck", "plate"})
      gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), name);
    gmsh::model::mesh::generate(2);
  });
  EXPECT_THAT(reading_error(twice, reading_of("mm-t-N")), HasSubstr("of which none is given"));
  SurfaceReading chosen = reading_of("mm-t-N");
  chosen.given.plates = {"deck"};
  EXPECT_EQ(reading_error(twice, chosen), "");
}

TEST_F(Surfaces, UnitsThatFilesDeclare) {
  EXPECT_EQ(declared_length(written("a.stp", "#1=(SI_UNIT($,.METRE.));")), 1);
  EXPECT_EQ(declared_length(written("b.stp",
                                    "CONVERSION_BASED_UNIT('INCH',#2) "
                                    "SI_UNIT(.MILLI.,.METRE.)")),
            0.0254);
  // Inches whose file measures volumes in cubic metres; the yard by its measure alone.
  const std::string units =
      "#7 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) );\n"
      "#8=DERIVED_UNIT_ELEMENT(#7,3.);\n#31 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3)\n"
      "GLOBAL_UNIT_ASSIGNED_CONTEXT((#30,#28)) REPRESENTATION_CONTEXT('','') );\n"
      "#30=(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.));\n";
  EXPECT_EQ(declared_length(written("d.stp", units + "#28=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT("
                                                     ".MILLI.,.METRE.));")),
            1e-3);
  EXPECT_EQ(declared_length(written("e.stp", units + "#28 =(CONVERSION_BASED_UNIT('INCH',#29)"
                                                     "LENGTH_UNIT());")),
            0.0254);
  EXPECT_DOUBLE_EQ(
      declared_length(written(
          "f.stp", units + "#28=(CONVERSION_BASED_UNIT('YARD',#29)LENGTH_UNIT()NAMED_UNIT(#9));\n"
                           "#29=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.9144),#7);")),
      0.9144);
  const std::string global = ",,4HA,;B,6Hb.iges,1Hc,1Hd,32,308,15,308,15,,1.,6,1HM,1,0.01;";
  EXPECT_EQ(declared_length(
                written("c.igs", global + std::string(72 - global.size(), ' ') + "G0000001\n")),
            1);
}

}  // namespace
}  // namespace blocklift::structure
