#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace blocklift::pipeline::test {

/// A file of wire rope slings s100, s200 ... of these breaking loads in kN, with a fifth of it as
/// working load and a hundred times of it as axial stiffness; steel with resin sockets.
inline std::string sling_file(const std::vector<double>& breaking_loads) {
  std::string text =
      "kind: rigging\ntitle: sample\nsource: a test\n"
      "rule: {name: a fifth, safety_factor: 5, formula: none}\nconstruction: wire_rope\nslings:\n";
  for (const double load : breaking_loads)
    text += fmt::format(
        "  s{0:g}: {{rope: {{axial_stiffness: {1:g} kN, breaking_load: {0:g} kN, mass: {2:g} kg/m, "
        "material: steel, termination: resin_socket}}, working_load: {3:g} kN}}\n",
        load, 100 * load, load / 150, load / 5);
  return text;
}

/// Bow shackles b2, b5 ... of these working loads in t, which break at five times of it.
inline std::string shackle_file(const std::vector<double>& working_loads) {
  std::string text =
      "kind: rigging\ntitle: sample\nsource: a test\n"
      "rule: {name: a fifth, safety_factor: 5, formula: none}\nshackles:\n";
  for (const double load : working_loads)
    text += fmt::format(
        "  b{0:g}: {{working_load: {0:g} t, breaking_load: {1:g} t, body: 20 mm, pin: {2:g} mm, "
        "inside_width: 30 mm, mass: 1 kg}}\n",
        load, 5 * load, 9 * std::sqrt(load));
  return text;
}

}  // namespace blocklift::pipeline::test
