// WAMIT's results: the files .1, .3 and .hst behind each other, parted by lines of "====". Read, or
// refused with a HydrodynamicFileError that says where.
#include <algorithm>
#include <string>
#include <string_view>

#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blocklift;
  static const fuzz::InputFolder folder;
  std::string_view text = fuzz::text_of(data, size);
  constexpr std::string_view parting = "====\n";
  for (const std::string ending : {".1", ".3", ".hst"}) {
    const std::size_t end = std::min(text.find(parting), text.size());
    folder.write("results" + ending, text.substr(0, end));
    text.remove_prefix(std::min(end + parting.size(), text.size()));
  }
  try {
    pipeline::import_hydrodynamics(folder.write("unused", "").replace_filename("results.1"), {});
  } catch (const pipeline::HydrodynamicFileError&) {
    // What is wrong was said.
  }
  return 0;
}
