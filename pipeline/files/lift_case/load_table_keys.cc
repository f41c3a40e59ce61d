#include "pipeline/files/lift_case/load_table_keys.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/reading.h"

namespace blocklift::pipeline {
namespace {

/// Keys of one table of the case that a load table leaves without use, and why.
struct IdleKeys {
  const char* table;  ///< key of the case; empty: the case itself
  std::vector<const char*> keys;
  const char* why;
};

const std::vector<IdleKeys>& idle_keys() {
  static const std::vector<IdleKeys> all = {
      {"",
       {"cranes", "spreaders", "ropes", "rope_weight", "sling_tolerance", "ground",
        "ground_contact", "supports", "wind", "sea", "vessels", "moorings", "tuggers", "operation",
        "settle", "faults", "dynamics"},
       "a load table stands in place of cranes, ropes, supports, wind, sea and operation, and "
       "nothing moves"},
      {"load",
       {"vessel", "damping", "quadratic_damping", "draughts", "afloat", "position", "orientation"},
       "a load table acts on the block in its own frame, wherever it is, and there is no water"},
      {"structure",
       {"stress_points", "hot_spots", "fatigue"},
       "they are of stress in time, and a load table has two sets of loads"},
      {"checks",
       {"rope_safety_factor", "crane_capacity", "smallest_tension", "spreader_factor"},
       "a load table has no ropes, cranes and spreaders: their checks are those of a lift that "
       "is simulated"},
      {"checks",
       {"swing", "falls_twist", "tilt", "turn", "sling_angle", "offlead", "sidelead", "clearance",
        "righting_height", "heel", "freeboard"},
       "a load table says nothing of where load, ropes and cranes are: the limit would hold "
       "nothing"},
      {"standard",
       {"hoisting_class"},
       "its factor grows with the hoisting speed, which a load table does not have: give the "
       "loads in motion under dynamic, or rules with a setting"},
      {"standard",
       {"tilt", "centre_box", "length_tolerance"},
       "it is worked by the places of hooks and slings, which a load table does not have: the "
       "rules' own factors on centre and skew hold"},
      {"standard",
       {"wear", "bend_diameter", "master_links", "sheaves"},
       "it is of slings and hooks, which a load table does not have"},
      {"compare",
       {"ropes", "series"},
       "a load table has no ropes whose computed loads could stand beside them"}};
  return all;
}

}  // namespace

void check_keys_beside_load_table(const Document& document, Diagnostics& diagnostics) {
  Diagnostics said_before;  // what is wrong with the tables as such
  Reading reading(document, said_before);
  const auto entries_of = [&](const YAML::Node& node) {
    return node.IsMap() ? reading.entries_of(node) : std::vector<Entry>();
  };
  const std::vector<Entry> of_case = entries_of(document.root);
  const auto find = [](const std::vector<Entry>& entries, const std::string& key) {
    return std::find_if(entries.begin(), entries.end(),
                        [&](const Entry& entry) { return entry.key == key; });
  };
  if (find(of_case, "load_table") == of_case.end()) return;
  for (const IdleKeys& idle : idle_keys()) {
    const std::string table = idle.table;
    const auto outer = find(of_case, table);
    if (!table.empty() && outer == of_case.end()) continue;
    for (const Entry& entry : table.empty() ? of_case : entries_of(outer->value)) {
      const auto is_it = [&](const char* key) { return entry.key == key; };
      if (std::none_of(idle.keys.begin(), idle.keys.end(), is_it)) continue;
      diagnostics.error(
          entry.mark,
          table.empty() ? fmt::format("the case has a load table, and {}", entry.key)
                        : fmt::format("{} has {}, and the case has a load table", table, entry.key),
          {idle.why});
    }
  }
}

}  // namespace blocklift::pipeline
