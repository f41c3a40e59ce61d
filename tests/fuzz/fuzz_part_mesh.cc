// What is read of a part's mesh before Gmsh sees it, or in its place: Abaqus' and Nastran's solids,
// nodes of .msh, statements of .geo.
#include "structure/error.h"
#include "structure/mesh/files/abaqus_file.h"
#include "structure/mesh/files/geometry_script.h"
#include "structure/mesh/files/msh_check.h"
#include "structure/mesh/files/nastran_file.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blocklift;
  static const fuzz::InputFolder folder;
  const std::string mesh = folder.write("mesh", fuzz::text_of(data, size));
  const auto read = [&](const auto& reader) {
    try {
      reader();
    } catch (const structure::ModelError&) {
      // What is wrong was said.
    }
  };
  read([&] { structure::read_abaqus(mesh); });
  read([&] { structure::read_nastran(mesh); });
  read([&] { structure::require_known_nodes(mesh); });
  read([&] { structure::require_closed_script(mesh); });
  return 0;
}
