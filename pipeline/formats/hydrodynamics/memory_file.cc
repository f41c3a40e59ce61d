#include "pipeline/formats/hydrodynamics/memory_file.h"

#include <span>

#include "dynamics/errors.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

using dynamics::MemoryStateSpace;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* memory_format = "blocklift memory of the water";
constexpr double memory_format_version = 1;

std::string memory_group(std::size_t index) { return "/memories/" + std::to_string(index); }

void write_memory(ResultsWriter& file, const std::string& group, const MemoryStateSpace& memory) {
  file.make_group(group);
  file.write_attribute(group, "states", memory.state_count());
  file.write_attribute(group, "error", memory.error());
  if (memory.state_count() == 0) {
    file.write_attribute(group, "modes", memory.mode_count());
    return;
  }
  const VectorXd decay = memory.decay(), turn = memory.turn();
  file.write(group + "/decay", span_of(decay), {"s-1", "diagonal of A"});
  file.write(group + "/turn", span_of(turn), {"s-1", "of A, right of its diagonal"});
  file.write_matrix(group + "/input", memory.B(), {"", "B of x' = A x + B v, by state and mode"});
  file.write_matrix(group + "/output", memory.C(), {"", "C of F = -C x, by mode and state"});
}

MatrixXd matrix_of(const Array<double>& array) {
  return Eigen::Map<const RowMajorMatrix>(array.values.data(),
                                          static_cast<Eigen::Index>(array.rows()),
                                          static_cast<Eigen::Index>(array.columns()));
}

VectorXd vector_of(const Array<double>& array) {
  return Eigen::Map<const VectorXd>(array.values.data(),
                                    static_cast<Eigen::Index>(array.values.size()));
}

MemoryStateSpace read_memory(const ResultsReader& file, const std::string& group) {
  const double error = file.read_number_attribute(group, "error");
  if (file.read_number_attribute(group, "states") == 0.0) {
    const auto modes = static_cast<Eigen::Index>(file.read_number_attribute(group, "modes"));
    return {VectorXd(), VectorXd(), MatrixXd(0, modes), MatrixXd(modes, 0), error};
  }
  return {vector_of(file.read(group + "/decay")), vector_of(file.read(group + "/turn")),
          matrix_of(file.read(group + "/input")), matrix_of(file.read(group + "/output")), error};
}

}  // namespace

void write_memories(const std::filesystem::path& path,
                    const std::vector<MemoryStateSpace>& memories, const std::string& identity) {
  ResultsWriter file(path);
  file.write_attribute("/", "format", memory_format);
  file.write_attribute("/", "format_version", memory_format_version);
  file.write_attribute("/", "identity", identity);
  for (std::size_t k = 0; k < memories.size(); ++k)
    write_memory(file, memory_group(k), memories[k]);
  file.finish();
}

std::optional<std::vector<MemoryStateSpace>> read_memories(const std::filesystem::path& path,
                                                           const std::string& identity) {
  try {
    const ResultsReader file(path);
    const bool known = file.read_text_attribute("/", "format") == memory_format &&
                       file.read_number_attribute("/", "format_version") == memory_format_version &&
                       file.read_text_attribute("/", "identity") == identity;
    if (!known) return std::nullopt;
    std::vector<MemoryStateSpace> memories;
    for (std::size_t k = 0; file.has(memory_group(k)); ++k) {
      memories.push_back(read_memory(file, memory_group(k)));
    }
    return memories;
  } catch (const ResultsError&) {
    return std::nullopt;
  } catch (const dynamics::ModelError&) {
    return std::nullopt;
  }
}

}  // namespace blocklift::pipeline
