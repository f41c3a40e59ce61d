#include "structure/space/shell_batch.h"

#include <algorithm>
#include <utility>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

std::vector<std::unique_ptr<ShellBatch>> make_shell_batches(const Mesh& mesh) {
  std::vector<std::unique_ptr<ShellBatch>> batches;
  const int count = static_cast<int>(mesh.shells.size());
  for (int first = 0; first < count; first += ShellBatch::most_shells) {
    const int end = std::min(count, first + ShellBatch::most_shells);
    std::vector<dealii::Point<3>> vertices;
    std::vector<dealii::CellData<2>> cells(at(end - first));
    for (int s = first; s < end; ++s) {
      dealii::CellData<2>& cell = cells[s - first];
      for (unsigned v = 0; v < 4; ++v) {
        cell.vertices[v] = static_cast<unsigned>(vertices.size());
        const Vector3& place = mesh.vertices[mesh.shells[s].vertices[v]];
        vertices.emplace_back(place.x(), place.y(), place.z());
      }
      cell.material_id = static_cast<dealii::types::material_id>(batches.size());
    }
    auto batch = std::make_unique<ShellBatch>();
    batch->first_shell = first;
    try {
      batch->cells.create_triangulation(vertices, cells, dealii::SubCellData());
    } catch (const dealii::ExceptionBase& error) {
      // deal.II's own messages name its sources; the user is told what is wrong with the mesh.
      throw ModelError(std::string("the mesh cannot be used: ") + error.what());
    }
    batches.push_back(std::move(batch));
  }
  return batches;
}

ShellMapping::ShellMapping(int degree, std::vector<int> first_cells, std::vector<Points> points)
    : dealii::MappingQ<2, 3>(static_cast<unsigned>(degree)),
      table_(std::make_shared<const Table>(Table{std::move(first_cells), std::move(points)})) {}

std::unique_ptr<dealii::Mapping<2, 3>> ShellMapping::clone() const {
  return std::make_unique<ShellMapping>(*this);
}

ShellMapping::Points ShellMapping::compute_mapping_support_points(
    const dealii::Triangulation<2, 3>::cell_iterator& cell) const {
  const auto index = static_cast<std::size_t>(table_->first_cells[cell->material_id()]) +
                     cell->active_cell_index();
  return table_->points[index];
}

}  // namespace blocklift::structure
