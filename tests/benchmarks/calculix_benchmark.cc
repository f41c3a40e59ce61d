// A block of crossing plates solved by Blocklift and, where `ccx` is installed, by CalculiX from the file that
// Blocklift exports, one after the other in one run: times, and how far the displacements are apart.
//
//   calculix_benchmark [BAYS [ELEMENTS A BAY]]        3 bays a side and 2 elements unless said otherwise
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "structure/mesh/files/gmsh_file.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/mesh/plates/block_generator.h"
#include "structure/output/part_files.h"
#include "structure/response/part_solution.h"
#include "structure/stopwatch.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {
namespace {

namespace fs = std::filesystem;

constexpr double bay = 2, thickness = 0.02;  // m
constexpr int responses = 40;
const Material steel{"steel", 206e9, 0.3, 7850, 355e6};

// An egg-crate: a bottom, and plates of one bay's height that cross each other over it.
BlockDescription egg_crate(int bays, int elements) {
  BlockDescription block;
  block.name = "egg-crate";
  block.materials = {steel};
  std::vector<double> lines;
  for (int i = 0; i <= bays; ++i) lines.push_back(bay * i);
  const Interval side{0, bay * bays}, height{0, bay};
  block.plates = {{"bottom", Axis::z, {0}, {{side, side, {}}}, thickness, steel.name},
                  {"frames", Axis::x, lines, {{{}, side, height}}, thickness, steel.name},
                  {"girders", Axis::y, lines, {{side, {}, height}}, thickness, steel.name}};
  block.largest_element = 1.02 * bay / elements;
  return block;
}

// Quadratic hexahedra of 20 nodes, held at one side and bent by their weight.
PartModel make_model(const BlockDescription& block, const fs::path& folder) {
  const std::string file = (folder / "block.msh").string();
  write_gmsh(generate_block_mesh(block), file);
  PartReading reading;
  const double side = block.plates[0].extent[0].upper + thickness;
  reading.faces = {{"held", Vector3(-thickness, -1, -1), Vector3(-thickness / 2, side, side)}};
  PartModel model;
  model.mesh = read_part_mesh(file, reading);
  model.materials = {steel};
  model.material_of_solid.assign(model.mesh.solids.size(), 0);
  model.supports = {{"held", "held", {true, true, true}, Vector3::Zero()}};
  model.body_loads = {{"weight", Vector3(0, 0, -9.81), Vector3::Zero(), Vector3::Zero()}};
  return model;
}

struct Times {
  double assembly_s = 0, factorisation_s = 0, one_s = 0, all_s = 0;
  double factor_bytes = 0;
  Eigen::VectorXd displacement;
};

Times solve_here(const PartModel& model) {
  Times times;
  Stopwatch watch;
  std::vector<int> support_of;
  std::vector<FixedUnknown> fixed = with_idle_nodes(model, part_supports(model, support_of));
  const Eigen::VectorXd load = part_load(model);
  ConstrainedSystem system(assemble_part_stiffness(model), std::move(fixed),
                           EliminationOrder::found);
  times.assembly_s = watch.lap();
  times.factor_bytes = system.factor_bytes();
  system.factorise();
  times.factorisation_s = watch.lap();
  times.displacement = system.solve(load);
  times.one_s = watch.lap();
  Eigen::MatrixXd loads(load.size(), responses);
  for (int r = 0; r < responses; ++r) loads.col(r) = (r + 1.0) / responses * load;
  const Eigen::MatrixXd all = system.solve(std::move(loads));
  times.all_s = watch.lap();
  if (!all.allFinite()) throw std::runtime_error("the responses are not finite");
  return times;
}

// The displacements that *NODE PRINT writes: number, x, y, z. Only the last table counts.
Eigen::VectorXd read_displacements(const fs::path& path, Eigen::Index nodes) {
  std::ifstream file(path);
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(3 * nodes);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    Eigen::Index node = 0;
    Vector3 u;
    if (numbers >> node >> u[0] >> u[1] >> u[2] && node >= 1 && node <= nodes)
      displacement.segment<3>(3 * (node - 1)) = u;
  }
  return displacement;
}

int run(int bays, int elements) {
  const fs::path folder =
      fs::temp_directory_path() / ("blocklift-calculix-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const PartModel model = make_model(egg_crate(bays, elements), folder);
  fmt::print(
      "egg-crate of {} x {} bays of {:g} m, {} elements a bay: {} hexahedra of 20 nodes, {} "
      "unknowns\n",
      bays, bays, bay, elements, model.mesh.solids.size(), 3 * model.mesh.nodes.cols());
  const Times ours = solve_here(model);
  fmt::print(
      "Blocklift: assembly {:.1f} s, factorisation {:.1f} s, one load case {:.2f} s, {} more "
      "{:.1f} s; factor {:.2f} GB\n",
      ours.assembly_s, ours.factorisation_s, ours.one_s, responses, ours.all_s,
      ours.factor_bytes / 1e9);
  std::fflush(stdout);
  write_calculix((folder / "block.inp").string(), model);
  int status = 0;
  if (std::system("command -v ccx > /dev/null") != 0) {
    fmt::print("ccx is not installed (Debian: calculix-ccx); nothing to compare with\n");
  } else {
    Stopwatch watch;
    const std::string command =
        fmt::format("cd {} && OMP_NUM_THREADS=2 ccx -i block > ccx.log 2>&1", folder.string());
    status = std::system(command.c_str());
    const double ccx_s = watch.lap();
    const Eigen::VectorXd theirs =
        read_displacements(folder / "block.dat", model.mesh.nodes.cols());
    const double largest = ours.displacement.lpNorm<Eigen::Infinity>();
    const double whole = ours.assembly_s + ours.factorisation_s + ours.one_s;
    fmt::print("CalculiX: one load case {:.1f} s, reading and writing included\n", ccx_s);
    fmt::print("ratio, one load case {:.3f}, {} of them against one {:.3f}\n", whole / ccx_s,
               responses + 1, (whole + ours.all_s) / ccx_s);
    fmt::print("displacement: largest {:.6g} mm, farthest apart {:.2g} of it\n", 1e3 * largest,
               (theirs - ours.displacement).lpNorm<Eigen::Infinity>() / largest);
  }
  fs::remove_all(folder);
  return status == 0 ? 0 : 1;
}

}  // namespace
}  // namespace blocklift::structure

int main(int argc, char** argv) {
  const int bays = argc > 1 ? std::atoi(argv[1]) : 3;
  const int elements = argc > 2 ? std::atoi(argv[2]) : 2;
  if (bays < 1 || elements < 1) {
    fmt::print(stderr, "calculix_benchmark [BAYS [ELEMENTS A BAY]], both 1 at least\n");
    return 2;
  }
  return blocklift::structure::run(bays, elements);
}
