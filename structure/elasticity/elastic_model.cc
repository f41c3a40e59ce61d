#include "structure/elasticity/elastic_model.h"

#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/plates/block_generator.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

namespace {

// The stiffness alone, from below: a cell brings 3 p^2 (p + 1) unknowns (one layer a plate shares
// its other nodes), each coupled with half a cell's on one side of the diagonal, 12 bytes an entry.
// Asked before any of it is made; the factor, known only later, is larger.
int checked_degree(const BlockMesh& mesh, int degree) {
  const double p = degree;
  const double unknowns = 3 * p * p * (p + 1) * static_cast<double>(mesh.cells.size());
  const double bytes = 12 * unknowns * 3 * (p + 1) * (p + 1) * (p + 1) / 2;
  if (const double available = available_memory(); bytes > available)
    throw ModelError(
        fmt::format("{} elements of degree {} make about {:.2g} unknowns, whose stiffness needs "
                    "more than {:.0f} "
                    "GB; {:.0f} GB are free; use larger elements or a lower element degree",
                    mesh.cells.size(), degree, unknowns, bytes / 1e9, available / 1e9));
  return degree;
}

}  // namespace

ElasticModel::ElasticModel(BlockMesh mesh, int degree, std::optional<double> total_mass,
                           std::optional<Vector3> centre_of_mass_B)
    : mesh_(std::move(mesh)),
      space_(mesh_, checked_degree(mesh_, degree)),
      mass_(find_mass_properties(mesh_, space_, total_mass ? &*total_mass : nullptr,
                                 centre_of_mass_B ? &*centre_of_mass_B : nullptr)),
      mass_moments_(nodal_moments(mesh_, space_,
                                  [this](int cell, const Vector3& x) {
                                    return mesh_.material_of_cell(cell).density *
                                           mass_.density_factor(x);
                                  })),
      lug_loads_(space_.unknowns(), 3 * lug_count()),
      inertia_loads_(structure::inertia_loads(mass_moments_)) {
  for (int lug = 0; lug < lug_count(); ++lug) {
    const LugRegion& region = mesh_.lugs[static_cast<std::size_t>(lug)];
    const auto volume = nodal_moments(mesh_, space_, [&](int cell, const Vector3&) {
      return mesh_.cell_group[static_cast<std::size_t>(cell)] == region.group ? 1.0 : 0.0;
    });
    lug_loads_.middleCols(3 * lug, 3) = pin_loads(volume, space_.nodes, region.p_BPin);
  }
}

ElasticModel make_elastic_model(const BlockDescription& description, int degree) {
  return ElasticModel(generate_block_mesh(description), degree, description.total_mass,
                      description.centre_of_mass_B);
}

}  // namespace blocklift::structure
