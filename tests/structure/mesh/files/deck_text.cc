#include "tests/structure/mesh/files/deck_text.h"

#include <unistd.h>

#include <atomic>
#include <fstream>

#include <gtest/gtest.h>

#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure::test {

namespace {

template <typename Read>
std::string complaints(const Read& read) {
  try {
    read();
    return {};
  } catch (const DeckError& error) {
    return error.what();
  }
}

void expect_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance,
                  const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  if (a.size() == 0) return;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * (1e-12 + a.cwiseAbs().maxCoeff()))
      << what << "\n"
      << a << "\nand\n"
      << b;
}

void expect_equal(double a, double b, double tolerance, const std::string& what) {
  if (a == b) return;  // infinite ones, too
  EXPECT_NEAR(a, b, tolerance * (std::abs(a) + 1e-12)) << what;
}

void expect_same_sections(const Mesh& a, const Mesh& b, double tolerance) {
  ASSERT_EQ(a.shells.size(), b.shells.size());
  for (std::size_t i = 0; i < a.shells.size(); ++i) {
    const std::string what = "shell " + std::to_string(a.shells[i].label);
    const Shell &x = a.shells[i], &y = b.shells[i];
    EXPECT_EQ(x.vertices, y.vertices) << what;
    EXPECT_EQ(x.label, y.label);
    const ShellSection &p = a.section_of(x), &q = b.section_of(y);
    expect_equal(p.thickness, q.thickness, tolerance, what + " thickness");
    expect_equal(p.offset, q.offset, tolerance, what + " offset");
    expect_equal(p.mass_per_area, q.mass_per_area, tolerance, what + " mass");
    const Material &m = a.material_of(x), &n = b.material_of(y);
    expect_equal(m.youngs_modulus, n.youngs_modulus, tolerance, what + " modulus");
    expect_equal(m.poisson_ratio, n.poisson_ratio, tolerance, what + " ratio");
    expect_equal(m.density, n.density, tolerance, what + " density");
    ASSERT_EQ(p.laminate < 0, q.laminate < 0) << what;
    if (p.laminate >= 0) {
      const Laminate &l = a.laminates[p.laminate], &k = b.laminates[q.laminate];
      expect_equal(l.membrane, k.membrane, tolerance, what + " A");
      expect_equal(l.coupling, k.coupling, tolerance, what + " B");
      expect_equal(l.bending, k.bending, tolerance, what + " D");
      expect_equal(l.shear, k.shear, tolerance, what + " S");
    }
    ASSERT_EQ(x.curvature < 0, y.curvature < 0) << what;
    if (x.curvature >= 0)
      expect_equal(a.curved_shells[x.curvature], b.curved_shells[y.curvature], tolerance,
                   what + " curvature");
  }
}

void expect_same_beams(const Mesh& a, const Mesh& b, double tolerance) {
  ASSERT_EQ(a.beams.size(), b.beams.size());
  for (std::size_t i = 0; i < a.beams.size(); ++i) {
    const Beam &x = a.beams[i], &y = b.beams[i];
    const std::string what = "beam " + std::to_string(x.label);
    EXPECT_EQ(x.vertices, y.vertices) << what;
    EXPECT_EQ(x.label, y.label);
    EXPECT_EQ(x.release, y.release) << what;
    EXPECT_EQ(x.is_rod, y.is_rod) << what;
    for (std::size_t end = 0; end < 2; ++end)
      EXPECT_LE((x.offset[end] - y.offset[end]).norm(), tolerance) << what << " offset";
    const BeamSection &p = a.section_of(x), &q = b.section_of(y);
    expect_equal(p.area, q.area, tolerance, what + " A");
    expect_equal(p.mass_per_length, q.mass_per_length, tolerance, what + " mass");
    if (x.is_rod) continue;
    const Vector3 line = a.vertices[x.vertices[1]] - a.vertices[x.vertices[0]];
    expect_equal(line.cross(x.axis_2).normalized(), line.cross(y.axis_2).normalized(), tolerance,
                 what + " axis 3");
    const double size = p.second_moment_2 + p.second_moment_3;
    EXPECT_NEAR(p.second_moment_2, q.second_moment_2, tolerance * size) << what;
    EXPECT_NEAR(p.second_moment_3, q.second_moment_3, tolerance * size) << what;
    EXPECT_NEAR(p.product_23, q.product_23, tolerance * size) << what;
    EXPECT_NEAR(p.torsion, q.torsion, tolerance * size) << what;
    expect_equal(p.shear_area_2, q.shear_area_2, tolerance, what + " A_s2");
    expect_equal(p.shear_area_3, q.shear_area_3, tolerance, what + " A_s3");
    EXPECT_LE((p.shear_centre - q.shear_centre).norm(), tolerance) << what;
  }
}

void expect_same_rest(const Mesh& a, const Mesh& b, double tolerance) {
  ASSERT_EQ(a.masses.size(), b.masses.size());
  for (std::size_t i = 0; i < a.masses.size(); ++i) {
    EXPECT_EQ(a.masses[i].vertex, b.masses[i].vertex);
    expect_equal(a.masses[i].mass, b.masses[i].mass, tolerance, "mass");
    expect_equal(a.masses[i].offset, b.masses[i].offset, tolerance, "offset");
    expect_equal(a.masses[i].inertia, b.masses[i].inertia, tolerance, "inertia");
  }
  ASSERT_EQ(a.rigid_links.size(), b.rigid_links.size());
  for (std::size_t i = 0; i < a.rigid_links.size(); ++i) {
    EXPECT_EQ(a.rigid_links[i].master, b.rigid_links[i].master);
    EXPECT_EQ(a.rigid_links[i].slaves, b.rigid_links[i].slaves);
    EXPECT_EQ(a.rigid_links[i].bound, b.rigid_links[i].bound);
    expect_equal(a.rigid_links[i].axes, b.rigid_links[i].axes, tolerance, "axes of a link");
  }
  ASSERT_EQ(a.distributing_links.size(), b.distributing_links.size());
  for (std::size_t i = 0; i < a.distributing_links.size(); ++i) {
    EXPECT_EQ(a.distributing_links[i].reference, b.distributing_links[i].reference);
    EXPECT_EQ(a.distributing_links[i].vertices, b.distributing_links[i].vertices);
    EXPECT_EQ(a.distributing_links[i].weights, b.distributing_links[i].weights);
    EXPECT_EQ(a.distributing_links[i].bound, b.distributing_links[i].bound);
  }
  ASSERT_EQ(a.springs.size(), b.springs.size());
  for (std::size_t i = 0; i < a.springs.size(); ++i) {
    EXPECT_EQ(a.springs[i].vertices, b.springs[i].vertices);
    EXPECT_EQ(a.springs[i].components, b.springs[i].components);
    expect_equal(a.springs[i].stiffness, b.springs[i].stiffness, tolerance, "spring");
    for (std::size_t end = 0; end < 2; ++end) {
      if (a.springs[i].vertices[end] < 0) continue;
      expect_equal(a.springs[i].axes[end], b.springs[i].axes[end], tolerance, "axes of a spring");
      expect_equal(a.springs[i].arms[end], b.springs[i].arms[end], tolerance, "arms of a spring");
    }
  }
}

/// What a load case pulls with, in sum.
void expect_same_cases(const Deck& a, const Deck& b, double tolerance) {
  ASSERT_EQ(a.load_cases.size(), b.load_cases.size());
  const auto forces = [](const Deck& deck, const DeckLoadCase& one) {
    Eigen::MatrixXd sums =
        Eigen::MatrixXd::Zero(3, 2 * static_cast<long>(deck.mesh.vertices.size()) + 1);
    for (const auto& [set, factor] : one.loads) {
      const LoadSet& loads = deck.load_sets[set];
      sums.rightCols<1>() += factor * loads.gravity;
      for (const PointLoad& load : loads.point_loads) {
        sums.col(2 * load.vertex) += factor * load.force;
        sums.col(2 * load.vertex + 1) += factor * load.moment;
      }
    }
    return sums;
  };
  const auto pressures = [](const Deck& deck, const DeckLoadCase& one) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(
        7, static_cast<long>(deck.mesh.shells.size() + deck.mesh.beams.size()));
    for (const auto& [set, factor] : one.loads) {
      for (const PlateLoad& load : deck.load_sets[set].plate_loads) {
        for (int i = 0; i < 4; ++i) sums(i, load.shell) += factor * load.pressure[i];
        sums.col(load.shell).tail<3>() = load.direction;
      }
      for (const BeamLoad& load : deck.load_sets[set].beam_loads) {
        auto of_beam = sums.col(static_cast<long>(deck.mesh.shells.size()) + load.beam);
        of_beam.head<3>() += factor * (load.force[0] + load.force[1]);
        of_beam.segment<3>(3) += factor * (load.moment[0] + load.moment[1]);
      }
    }
    return sums;
  };
  const auto on_faces = [](const Deck& deck, const DeckLoadCase& one) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(4, static_cast<long>(deck.mesh.vertices.size()));
    for (const auto& [set, factor] : one.loads)
      for (const SolidLoad& load : deck.load_sets[set].solid_loads) {
        const Solid& solid = deck.mesh.solids[load.solid];
        const auto& face = topology_of(solid.shape).faces[load.face];
        for (std::size_t i = 0; i < face.size(); ++i) {
          auto of_corner = sums.col(solid.vertices[face[i]]);
          of_corner[0] += factor * load.pressure[i];
          of_corner.tail<3>() += load.direction;
        }
      }
    return sums;
  };
  const auto held = [](const Deck& deck, const DeckLoadCase& one) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(12, static_cast<long>(deck.mesh.vertices.size()));
    for (const int set : one.supports)
      for (const Support& support : deck.support_sets[set].supports)
        for (int i = 0; i < 6; ++i) {
          if (!support.held[i]) continue;
          sums(i, support.vertex) = 1 + support.axes(0, i % 3) + 2 * support.axes(1, i % 3);
          sums(6 + i, support.vertex) = support.value[i];
        }
    return sums;
  };
  for (std::size_t i = 0; i < a.load_cases.size(); ++i) {
    expect_equal(forces(a, a.load_cases[i]), forces(b, b.load_cases[i]), tolerance, "forces");
    expect_equal(pressures(a, a.load_cases[i]), pressures(b, b.load_cases[i]), tolerance,
                 "pressures");
    expect_equal(on_faces(a, a.load_cases[i]), on_faces(b, b.load_cases[i]), tolerance, "faces");
    expect_equal(held(a, a.load_cases[i]), held(b, b.load_cases[i]), tolerance, "supports");
  }
}

}  // namespace

DeckFolder::DeckFolder() {
  static std::atomic<int> number = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("blocklift-deck-" + std::to_string(::getpid()) + "-" + std::to_string(number++));
  std::filesystem::create_directories(path_);
}

DeckFolder::~DeckFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::filesystem::path DeckFolder::write(const std::string& name, const std::string& text) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name) << text;
  return path_ / name;
}

Deck nastran(const std::string& text, const std::string& units, const DeckOptions& options) {
  const DeckFolder folder;
  return read_nastran(folder.write("deck.bdf", text), unit_system(units), options);
}

Deck abaqus(const std::string& text, const std::string& units, const DeckOptions& options) {
  const DeckFolder folder;
  return read_abaqus(folder.write("deck.inp", text), unit_system(units), options);
}

std::string complaints_of_nastran(const std::string& text, const std::string& units) {
  return complaints([&] { nastran(text, units); });
}

std::string complaints_of_abaqus(const std::string& text, const std::string& units) {
  return complaints([&] { abaqus(text, units); });
}

const LedgerEntry& entry(const Deck& deck, const std::string& name) {
  for (const LedgerEntry& one : deck.ledger)
    if (one.name == name) return one;
  throw ModelError("the ledger has no " + name);
}

void expect_near(const Eigen::MatrixXd& value, const Eigen::MatrixXd& expected, double tolerance) {
  EXPECT_LE((value - expected).norm(), tolerance) << value << "\nis due to be\n" << expected;
}

void expect_mass(const Deck& deck, double mass, const Vector3& moment) {
  const MeshMass found = mass_properties(deck.mesh);
  EXPECT_NEAR(found.mass, mass, 1e-9 * mass);
  EXPECT_LE((found.mass * found.centre - moment).norm(), 1e-6 * mass) << found.centre.transpose();
}

void expect_same(const Deck& a, const Deck& b, double tolerance) {
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  double size = 0;
  for (const Vector3& vertex : a.mesh.vertices) size = std::max(size, vertex.norm());
  for (std::size_t v = 0; v < a.mesh.vertices.size(); ++v)
    EXPECT_LE((a.mesh.vertices[v] - b.mesh.vertices[v]).norm(), tolerance * size);
  EXPECT_EQ(a.mesh.vertex_labels, b.mesh.vertex_labels);
  expect_same_sections(a.mesh, b.mesh, tolerance);
  expect_same_beams(a.mesh, b.mesh, tolerance);
  expect_same_rest(a.mesh, b.mesh, tolerance);
  expect_same_cases(a, b, tolerance);
}

}  // namespace blocklift::structure::test
