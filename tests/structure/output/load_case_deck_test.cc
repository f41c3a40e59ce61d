// Load cases as decks: in balance, the same model when read again, and what another solver finds.
#include "structure/output/load_case_deck.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/lugs/lug_on_mesh.h"
#include "structure/mesh/padeye/padeye_in_block.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/response/unit_responses.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

namespace fs = std::filesystem;

/// Slings that pull at the four lugs and lean inwards and along, balanced by the motion that they
/// give the block.
LoadCase pull(const ElasticModel& model) {
  LoadCase load;
  load.name = "four slings";
  Wrench sum;
  for (int lug = 0; lug < model.lug_count(); ++lug) {
    const Vector3 force = 1e3 * Vector3(1 + lug, lug % 2 == 0 ? 4 : -5, 20 + lug);
    load.lug_forces_B.push_back(force);
    sum.force += force;
    sum.moment += model.mesh().lifting_points[lug].p_BPin.cross(force);
  }
  load.field = balancing_field(model.mass_properties(), sum);
  return load;
}

Deck deck_of(const UnitResponses& responses, const LoadCase& load) {
  return load_case_deck(
      responses.model(), {{load.name, responses.load_vector(load)}}, unit_system("mm-t-N"),
      responses.model().space().degree() > 1 ? DeckElements::quadratic : DeckElements::as_they_are);
}

/// The deck as Nastran's reader finds it.
Deck again(const Deck& deck) {
  const fs::path path =
      fs::temp_directory_path() / ("load-case-deck-" + std::to_string(::getpid()) + ".bdf");
  write_nastran(deck, path);
  Deck read = read_nastran(path, deck.units);
  fs::remove(path);
  return read;
}

double sum_of_forces(const LoadSet& loads) {
  double sum = 0;
  for (const PointLoad& load : loads.point_loads) sum += load.force.norm();
  return sum;
}

void expect_balance(const Deck& deck, double tolerance) {
  const LoadSet& loads = deck.load_sets.at(0);
  const Wrench left = resultant_of_points(deck.mesh, loads);
  const double size = sum_of_forces(loads);
  EXPECT_LT(left.force.norm(), tolerance * size);
  EXPECT_LT(left.moment.norm(), tolerance * size * 5);  // the block is some 5 m across
}

/// Bars with an offset under the bottom, so that moments and beams are in the deck, too.
Mesh block_with_bars() {
  Mesh mesh = generate_shell_mesh(test::small_block());
  BeamSection bar;
  bar.area = 1e-3;
  bar.second_moment_2 = bar.second_moment_3 = 1e-7;
  bar.torsion = 1e-7;
  bar.shear_area_2 = bar.shear_area_3 = 8e-4;
  mesh.beam_sections = {bar};
  for (const Shell& shell : mesh.shells) {
    if (mesh.group_of_region(shell.region).name != "bottom") continue;
    Beam beam;
    beam.vertices = {shell.vertices[0], shell.vertices[1]};
    beam.offset = {Vector3(0, 0, 0.06), Vector3(0, 0, 0.06)};
    beam.region = shell.region;
    mesh.beams.push_back(beam);
  }
  return mesh;
}

TEST(LoadCaseDeck, LoadsStayInBalance) {
  for (const int degree : {1, 2, 3}) {
    const ElasticModel model(block_with_bars(), {degree, {}});
    const UnitResponses responses(model, 1);
    const LoadCase load = pull(model);
    const Deck deck = deck_of(responses, load);
    expect_balance(deck, 1e-12);
    EXPECT_EQ(deck.mesh.curved_shells.empty(), degree == 1);
    EXPECT_EQ(deck.mesh.beams.size(), (degree == 1 ? 1 : 2) * model.mesh().beams.size());
    // Eleven digits of a card.
    expect_balance(again(deck), 1e-9);
  }
}

TEST(LoadCaseDeck, SixComponentsAreHeld) {
  const ElasticModel model(generate_shell_mesh(test::small_block()), {1, {}});
  const UnitResponses responses(model, 1);
  const LoadCase load = pull(model);
  const Deck deck = deck_of(responses, load);
  int held = 0;
  const auto& supports = deck.support_sets.at(0).supports;
  for (const Support& support : supports)
    for (const bool component : support.held) held += component ? 1 : 0;
  EXPECT_EQ(held, 6);
  const Eigen::Matrix3Xd moved =
      displacement_against(supports, model, responses.displacement(load));
  for (const Support& support : supports)
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(support.held[axis] ? moved(axis, support.vertex) : 0, 0, 1e-12);
    }
}

// Of elements as fine as the deck's, the deck's forces are the model's own.
TEST(LoadCaseDeck, ForcesAtNodesDoWhatTheLoadsDo) {
  Mesh mesh = block_with_bars();
  mesh.vertex_labels.clear();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertex_labels.push_back(1000 + 3 * static_cast<long>(v));
  const ElasticModel model(std::move(mesh), {1, {}});
  const UnitResponses responses(model, 1);
  const LoadCase load = pull(model);
  const Deck deck = again(deck_of(responses, load));
  EXPECT_EQ(deck.mesh.vertex_labels, model.mesh().vertex_labels);
  ASSERT_EQ(deck.load_cases.size(), 1U);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(model.freedoms());
  for (const PointLoad& point : deck.load_sets.at(0).point_loads) {
    const Eigen::Index row =
        6 * static_cast<Eigen::Index>(model.space().node_of_vertex(point.vertex));
    loads.segment<3>(row) += point.force;
    loads.segment<3>(row + 3) += point.moment;
  }
  const Eigen::VectorXd found = responses.without_rigid_motion(responses.solve(loads));
  const Eigen::VectorXd expected = responses.without_rigid_motion(responses.displacement(load));
  // Small moments stand as pairs of forces.
  EXPECT_LT((found - expected).norm(), 2e-3 * expected.norm());
}

/// The small block with its first lug as a padeye of solids.
Mesh box_with_solid_lug(double largest_element) {
  BlockDescription block = test::small_block();
  block.largest_element = largest_element;
  Mesh mesh = generate_shell_mesh(block);
  Eigen::Matrix3d R_BP;
  R_BP << -Vector3::UnitX(), Vector3::UnitZ(), Vector3::UnitY();
  stand_padeye(
      mesh,
      {"L1", {0.12, 0.03, 0.06, 0.057, 0.09, 0.01, 0.25, 0.4, 0.4}, R_BP, block.lugs[0].p_BPin});
  return mesh;
}

/// The same as a mesh with a padeye of solids askew on its bottom, across edges of its shells.
Mesh box_with_lug_on_plating(double largest_element) {
  BlockDescription block = test::small_block();
  block.largest_element = largest_element;
  block.pads.clear();
  block.lugs.clear();
  Mesh mesh = generate_shell_mesh(block);
  const Vector3 pin(1.1, 1.3, 0.25);
  add_lug(mesh, {"L1", pin});
  Eigen::Matrix3d R_BP;
  R_BP.col(0) = Vector3(0.8, 0.6, 0);
  R_BP.col(1) = Vector3::UnitZ();
  R_BP.col(2) = R_BP.col(0).cross(R_BP.col(1));
  stand_padeye(mesh, {"L1", {0.12, 0.03, 0.06, 0.057, 0.09, 0.01, 0.25, 0.4, 0.4}, R_BP, pin});
  return mesh;
}

// What lies within a shell is said by equations, which the reader takes for the same tie.
TEST(LoadCaseDeck, PlacesWithinShellsAreEquations) {
  for (const auto& [is_on_mesh, degree] : {std::pair(false, 1), {false, 2}, {true, 1}, {true, 2}}) {
    const ElasticModel model(is_on_mesh ? box_with_lug_on_plating(0.5) : box_with_solid_lug(1),
                             {degree, {}});
    const UnitResponses responses(model, 1);
    const LoadCase load = pull(model);
    const Deck deck = deck_of(responses, load);
    expect_balance(deck, 1e-12);
    EXPECT_TRUE(deck.mesh.surface_points.empty());
    EXPECT_TRUE(deck.mesh.rigid_links.empty());
    EXPECT_FALSE(deck.mesh.equations.empty());
    for (MotionEquation equation : deck.mesh.equations) {
      EXPECT_GT(equation.terms.size(), 1U);
      EXPECT_LT(balance(deck.mesh, equation), 1e-12);
    }
    Deck read = again(deck);
    for (Material& material : read.mesh.materials) material.yield_stress = 355e6;  // none in a deck
    const ElasticModel other(read.mesh, {degree, {}});
    const UnitResponses again_responses(other, 1);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(other.freedoms());
    for (const PointLoad& point : read.load_sets.at(0).point_loads) {
      const Eigen::Index row =
          6 * static_cast<Eigen::Index>(other.space().node_of_vertex(point.vertex));
      loads.segment<3>(row) += point.force;
      loads.segment<3>(row + 3) += point.moment;
    }
    const Eigen::Matrix3Xd found =
        displacement_against(read.support_sets.at(0).supports, other, again_responses.solve(loads));
    const Eigen::Matrix3Xd expected =
        displacement_against(deck.support_sets.at(0).supports, model, responses.displacement(load));
    double difference = 0, size = 0;
    for (std::size_t v = 0; v < model.mesh().vertices.size(); ++v) {
      const auto column = static_cast<Eigen::Index>(v);
      if (expected.col(column).hasNaN() || found.col(column).hasNaN()) continue;
      difference += (found.col(column) - expected.col(column)).squaredNorm();
      size += expected.col(column).squaredNorm();
    }
    // Small moments stand as pairs of forces. A deck's quadratic shells have eight nodes and the
    // model's nine: on the plating 3.1 % on elements of 1 m, 1.0 % on these.
    EXPECT_LT(std::sqrt(difference / size), degree == 1 ? 1e-4 : 0.015);
  }
}

#ifdef BLOCKLIFT_CALCULIX

struct Solution {
  std::map<long, Vector3> displacement, force;  ///< m; N, loads included
};

/// What CalculiX finds for a deck of one step.
Solution solve_by_calculix(const Deck& deck) {
  std::string text = to_abaqus(deck);
  text.insert(text.rfind("*NODE FILE"),
              "*NODE PRINT, NSET=NODES\nU\n*NODE PRINT, NSET=NODES\nRF\n");
  const fs::path folder =
      fs::temp_directory_path() / ("load-case-deck-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "deck.inp") << text;
  const std::string command = "cd " + folder.string() + " && OMP_NUM_THREADS=1 " +
                              BLOCKLIFT_CALCULIX " deck > log.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(folder / "deck.dat");
  Solution solution;
  std::map<long, Vector3>* into = nullptr;
  for (std::string line; std::getline(file, line);) {
    if (line.find("displacements") != std::string::npos) into = &solution.displacement;
    if (line.find("forces") != std::string::npos) into = &solution.force;
    std::istringstream words(line);
    long node = 0;
    Vector3 value;
    if (into && words >> node >> value.x() >> value.y() >> value.z()) (*into)[node] = value;
  }
  for (auto& [node, value] : solution.displacement) value *= deck.units.length;
  fs::remove_all(folder);
  return solution;
}

struct Difference {
  double displacement = 0;  ///< root mean square over that of the displacements
  double reaction = 0;      ///< largest over the sum of all forces
};

Difference compare(const UnitResponses& responses, const LoadCase& load) {
  const Deck deck = deck_of(responses, load);
  const Solution theirs = solve_by_calculix(deck);
  const auto& supports = deck.support_sets.at(0).supports;
  const Eigen::Matrix3Xd ours =
      displacement_against(supports, responses.model(), responses.displacement(load));
  double square = 0, difference = 0;
  for (Eigen::Index v = 0; v < ours.cols(); ++v) {
    square += ours.col(v).squaredNorm();
    difference += (theirs.displacement.at(v + 1) - ours.col(v)).squaredNorm();
  }
  Difference result;
  result.displacement = std::sqrt(difference / square);
  for (const Support& support : supports) {
    Vector3 reaction = theirs.force.at(support.vertex + 1);
    for (const PointLoad& point : deck.load_sets.at(0).point_loads)
      if (point.vertex == support.vertex) reaction -= point.force;
    for (int axis = 0; axis < 3; ++axis)
      if (support.held[axis]) result.reaction = std::max(result.reaction, std::abs(reaction[axis]));
  }
  result.reaction /= sum_of_forces(deck.load_sets.at(0));
  return result;
}

TEST(LoadCaseDeck, CalculiXAgreesOnAPlate) {
  BlockDescription plate;
  plate.materials = {test::steel()};
  plate.plates = {{"plate", Axis::z, {0}, {{{0, 4}, {0, 3}, {}}}, 0.05, test::steel().name}};
  plate.largest_element = 0.5;
  Mesh mesh = generate_shell_mesh(plate);
  for (const Vector3& pin :
       {Vector3(0.5, 0.5, 0), Vector3(3.5, 0.5, 0), Vector3(3.5, 2.5, 0), Vector3(0.5, 2.5, 0)}) {
    LiftingPoint lug;
    lug.name = "L" + std::to_string(mesh.lifting_points.size() + 1);
    lug.p_BPin = pin;
    for (std::size_t s = 0; s < mesh.shells.size(); ++s)
      if ((position(mesh, mesh.shells[s], {0.5, 0.5}) - pin).norm() < 0.5)
        lug.shells.push_back(static_cast<int>(s));
    mesh.lifting_points.push_back(lug);
  }
  const ElasticModel model(std::move(mesh), {3, {}});
  const UnitResponses responses(model, 1);
  const Difference difference = compare(responses, pull(model));
  EXPECT_LT(difference.displacement, 0.01);
  EXPECT_LT(difference.reaction, 1e-7);  // digits of their tables
}

// Where plates meet at an angle, CalculiX joins the solids that it makes of them by rigid bodies,
// which stiffens coarse meshes: the difference is 10, 4.4, 2.3 and 0.9 % with elements of 0.75,
// 0.5, 0.3 and 0.15 m, while a higher degree of ours moves it by a tenth of a per cent.
TEST(LoadCaseDeck, CalculiXAgreesOnABlock) {
  BlockDescription block = test::small_block();
  block.largest_element = 0.3;
  const ElasticModel model(generate_shell_mesh(block), {2, {}});
  const UnitResponses responses(model, 1);
  const Difference difference = compare(responses, pull(model));
  EXPECT_LT(difference.displacement, 0.03);
  EXPECT_LT(difference.reaction, 1e-7);
}

#endif

}  // namespace
}  // namespace blocklift::structure
