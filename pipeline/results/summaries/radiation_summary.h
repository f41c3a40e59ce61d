#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dynamics/simulation/misplacement.h"
#include "pipeline/build/build_marine.h"

namespace blocklift::pipeline {

/// What a lift or mechanism kept of the arrangement that its vessels' water was computed for.
struct RadiationRecord {
  dynamics::Arrangement arrangement;
  dynamics::Misplacement misplacement;
  bool direct = false;      ///< the surface was marched
  long memory_states = 0;   ///< that stand for the memory, else
  double memory_error = 0;  ///< of their fit, over the memory's peak
};

/// Of a built lift or mechanism and its motion.
template <class Built>
RadiationRecord record_radiation(const Built& built, const dynamics::History& history) {
  RadiationRecord record;
  if (!built.system.water()) return record;
  record.arrangement = built.arrangement;
  record.misplacement = find_misplacement(built.arrangement, history);
  record.direct = built.marched.radiation != nullptr;
  record.memory_states = built.system.memory_count();
  record.memory_error = built.system.water()->memory_error();
  return record;
}

/// The part "radiation" of a summary (results_layout.h); null without radiation.
nlohmann::ordered_json radiation_json(const RadiationRecord& record);

/// Puts "radiation" and what misplacement_warnings says into a summary; nothing without radiation.
void add_radiation(const RadiationRecord& record, nlohmann::ordered_json& summary);

/// How far the vessels came from the places for which their water was computed, for people; empty
/// where one vessel alone makes waves, or none.
std::string misplacement_sentence(const RadiationRecord& record);

/// A sentence for each pair of vessels that came further than what holds good.
std::vector<std::string> misplacement_warnings(const RadiationRecord& record);
/// The same for the terminal, a line each.
std::string misplacement_notice(const RadiationRecord& record);

}  // namespace blocklift::pipeline
