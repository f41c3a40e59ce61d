// WAMIT's panels: read, or refused with a HullFileError that says where.
#include "pipeline/formats/hydrodynamics/hull_file.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blocklift;
  static const fuzz::InputFolder folder;
  const auto file = folder.write("hull.gdf", fuzz::text_of(data, size));
  try {
    const dynamics::Hull hull = pipeline::read_gdf(file);
    fuzz::require(hull.panel_count() > 0);
  } catch (const pipeline::HullFileError&) {
    // What is wrong was said.
  }
  return 0;
}
