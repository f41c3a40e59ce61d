#include "pipeline/results/files/load_case_decks.h"

#include <functional>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/output/load_case_deck.h"

namespace blocklift::pipeline {

namespace {

/// Titled by what the solver's plates should find.
std::vector<structure::LoadCase> governing_loads(const BlockRun& block) {
  const auto titled = [](structure::LoadCase load, const std::string& state, double stress) {
    load.name = fmt::format("{}, membrane stress {:.1f} MPa", state, stress / 1e6);
    return load;
  };
  if (block.history) {
    const auto of_history = [&](const char* name, const HistoryState& state) {
      return titled(state.governing,
                    fmt::format("{} at {:.2f} s", name, state.checked_von_mises.time),
                    state.checked_von_mises.at.value);
    };
    return {of_history("at rest", block.history->static_state),
            of_history("in motion", block.history->dynamic_state)};
  }
  const auto of_table = [&](const char* name, const BlockState& state) {
    return titled(state.load, name, state.result.checked_von_mises.value);
  };
  return {of_table("static loads", block.assessment.simultaneous.static_state),
          of_table("dynamic loads", block.assessment.simultaneous.dynamic_state)};
}

/// Displacements against the deck's supports, in its numbers and units.
std::string displacements(const BlockRun& block, const structure::Deck& deck,
                          const std::vector<structure::LoadCase>& loads) {
  const structure::Mesh& mesh = block.model->mesh();
  std::string text = fmt::format("case,node,x,y,z,u_x,u_y,u_z in {}\n", deck.units.name);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Eigen::Matrix3Xd moved =
        structure::displacement_against(deck.support_sets.front().supports, *block.model,
                                        block.responses->displacement(loads[i])) /
        deck.units.length;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto u = moved.col(v);
      if (u.hasNaN()) continue;
      const structure::Vector3 x = mesh.vertices[v] / deck.units.length;
      text +=
          fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.6e},{:.6e},{:.6e}\n", i + 1,
                      mesh.vertex_labels.empty() ? static_cast<long>(v) + 1 : mesh.vertex_labels[v],
                      x.x(), x.y(), x.z(), u.x(), u.y(), u.z());
    }
  }
  return text;
}

LoadCaseFile written(const char* name, const std::function<std::string()>& write) {
  LoadCaseFile file{name, {}, {}};
  try {
    file.text = write();
  } catch (const structure::ModelError& error) {
    file.refusal = error.what();
  }
  return file;
}

}  // namespace

std::vector<LoadCaseFile> load_case_files(const Assessment& assessment) {
  const BlockRun& block = assessment.block;
  if (!block.model) return {};
  const auto& mesh = assessment.lift_case.load.model->mesh;
  const std::vector<structure::LoadCase> loads = governing_loads(block);
  std::vector<structure::TitledLoads> vectors;
  for (const structure::LoadCase& load : loads)
    vectors.push_back({load.name, block.responses->load_vector(load)});
  structure::Deck deck = structure::load_case_deck(
      *block.model, vectors,
      mesh && mesh->deck ? mesh->deck->units : structure::unit_system("mm-t-N"),
      mesh || block.model->space().degree() < 2 ? structure::DeckElements::as_they_are
                                                : structure::DeckElements::quadratic);
  deck.title = assessment.lift_case.title;
  return {written(abaqus_load_cases, [&] { return structure::to_abaqus(deck); }),
          written(nastran_load_cases, [&] { return structure::to_nastran(deck); }),
          {load_case_displacements, displacements(block, deck, loads), {}}};
}

}  // namespace blocklift::pipeline
