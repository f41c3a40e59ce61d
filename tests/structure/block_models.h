#pragma once

#include "structure/mesh/plates/shell_generator.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure::test {

/// The shells of a description, in elements of a degree.
inline ElasticModel make_elastic_model(const BlockDescription& block, int degree) {
  return ElasticModel(generate_shell_mesh(block), {degree, {}}, block.total_mass,
                      block.centre_of_mass_B);
}

}  // namespace blocklift::structure::test
