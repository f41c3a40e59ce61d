#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// What the page of the report draws, as one JSON object (its twin is
/// pipeline/report/web/src/data.ts):
///
///   summary     summary.json as it stands
///   case        {name, title, created, program_version, yaml}
///   stages      [{name, start, end}]
///   histories   {static, dynamic}: {start, end, ropes, hoists, drives, energy}, lists of
///               {name, quantity, units, description, time, values}, thinned by indices_to_draw
///   motion      {static, dynamic}: {time, bodies: {name: poses}}, some hundred instants
///   outputs     list of series like those of the histories, what a mechanism file asks for
///   modes       [{time, bodies: {name: amplitudes}}], in the order of the summary's
///     natural_periods
///   scene       {load, bodies: [{name, kind, boxes}], ropes: [{name, kind, bodies, points}], lugs}
///   surface     {points, quads, quad_group, groups, fields: {way: {state: {...}}}, note}
///
/// Arrays are packed (packed_array.h); `surface` is made of the parts of block_surface.h.
///
/// Parts that the results do not have are null.
/// @throws ResultsError if the file lacks what it must have or its parts do not fit together.
nlohmann::ordered_json make_page_data(const ResultsReader& results,
                                      const nlohmann::ordered_json& summary);

/// Tensions of ropes and hoists in one history, as series of the page: a list of {name, quantity,
/// units, description, time, values}. Empty if there is no such history.
/// @param group layout::static_history or layout::dynamic_history
nlohmann::ordered_json tension_series(const ResultsReader& results, std::string_view group);

/// One series of the page, thinned: {name, quantity, units, description, time, values}.
/// @param quantity in one word: "tension"
/// @param time, values of one length; what is not finite is left out.
nlohmann::ordered_json page_series(const std::string& name, const std::string& quantity,
                                   const Meaning& meaning, const std::vector<double>& time,
                                   const std::vector<double>& values);

}  // namespace blocklift::pipeline
