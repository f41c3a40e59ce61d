// Cases and models in YAML: read, or refused with messages; never an exception, nor a case that is
// accepted with messages.
#include "pipeline/files/file_kind.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/mechanism/mechanism_file.h"
#include "pipeline/files/structure/part_file.h"
#include "pipeline/files/study/study_file.h"
#include "pipeline/files/vessel/vessel_model.h"
#include "tests/fuzz/input_file.h"
#include "tests/pipeline/sample_lift.h"

namespace {

using namespace blocklift;
using namespace blocklift::pipeline;

/// Reads a file of whatever kind. @returns whether it was accepted.
bool read(const std::filesystem::path& file, Diagnostics& diagnostics) {
  ModelLibrary library({});
  switch (kind_of_file(file)) {
    case FileKind::crane:
      return library.read_crane(file, diagnostics) != nullptr;
    case FileKind::block:
      return library.read_block(file, diagnostics) != nullptr;
    case FileKind::rope:
      return library.read_rope(file, diagnostics) != nullptr;
    case FileKind::standard:
      return library.read_standard(file, diagnostics) != nullptr;
    case FileKind::part:
      return read_part_file(file, diagnostics).has_value();
    case FileKind::study:
      return read_study_file(file, diagnostics).has_value();
    case FileKind::vessel:
      return read_vessel(file, diagnostics).has_value();
    case FileKind::mechanism:
      return read_mechanism_file(file, library, diagnostics).has_value();
    default: {
      const auto lift_case = read_lift_case(file, library, diagnostics);
      fuzz::require(lift_case.has_value() == !diagnostics.has_errors());
      return lift_case.has_value();
    }
  }
}

/// The models that the cases of the corpus name.
void write_models(const fuzz::InputFolder& folder) {
  folder.write("gantry.yaml", test::sample_crane);
  folder.write("plate.yaml", test::sample_block);
  folder.write("ropes/tackle.yaml", test::sample_rope);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static const bool models_are_there = (write_models(folder), true);
  fuzz::require(models_are_there);
  Diagnostics diagnostics;
  const bool is_accepted = read(folder.write("input.yaml", fuzz::text_of(data, size)), diagnostics);
  fuzz::require(is_accepted || diagnostics.has_errors());
  fuzz::require(diagnostics.to_text().size() < 1'000'000);
  return 0;
}
