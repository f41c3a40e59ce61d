#include "structure/mesh/files/nastran/temperatures.h"

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/deck/label_range.h"

namespace blocklift::structure {

namespace {

/// Calls visit(label) for the elements that fields from one on name: numbers, and numbers THRU
/// numbers, of which those that are known count.
void for_each_element(const CardView& card, std::size_t first,
                      const std::unordered_map<long, int>& known,
                      const std::function<void(long)>& visit) {
  for (std::size_t i = first; i < card.size(); ++i) {
    if (!card.has(i)) continue;
    if (!card.is(i, "THRU")) {
      visit(card.label(i, "element"));
      continue;
    }
    std::size_t before = i, after = i + 1;
    while (before > first && !card.has(--before)) continue;
    while (after < card.size() && !card.has(after)) ++after;
    const long from = card.label(before, "element"), to = card.label(after, "last element");
    for (const long label : known_labels(known, from + 1, to)) visit(label);
    i = after;
  }
}

}  // namespace

NastranTemperatures::NastranTemperatures(NastranModel& model) : model_(model) {
  model.for_each({{"TEMP", [&](const CardView& card) { add_grids(card); }},
                  {"TEMPD", [&](const CardView& card) { add_everywhere(card); }},
                  {"TEMPP1", [&](const CardView& card) { add_plates(card); }},
                  {"TEMPRB", [&](const CardView& card) { add_bars(card); }}});
  read_unknown();
}

/// Sets with cards of other kinds are there, and are refused where they are computed with.
void NastranTemperatures::read_unknown() {
  static const std::set<std::string_view> others{"TEMPP2", "TEMPP3", "TEMPF",  "TEMPN1",
                                                 "TEMPG",  "TEMPB3", "TEMPBC", "TEMPEX"};
  for (const NastranCard& card : model_.bulk.cards) {
    if (!others.contains(card.name)) continue;
    if (const auto number = to_integer(CardView(model_.bulk, card).text(0)))
      sets_[*number].obstacle =
          fmt::format("{} at {} is not known; TEMP, TEMPD, TEMPP1, TEMPRB are", card.name,
                      model_.log.place(card.line));
  }
}

// TEMP SID G1 T1 G2 T2 G3 T3
void NastranTemperatures::add_grids(const CardView& card) {
  Set& into = set(card);
  for (const std::size_t i : {1U, 3U, 5U}) {
    if (!card.has(i) || model_.is_scalar_point(card.label(i, "grid"))) continue;
    into.at_vertices[model_.vertex(card, i, "grid")] = card.real(i + 1, "temperature");
  }
}

// TEMPD SID1 T1 SID2 T2 SID3 T3 SID4 T4
void NastranTemperatures::add_everywhere(const CardView& card) {
  for (const std::size_t i : {0U, 2U, 4U, 6U})
    if (card.has(i) || i == 0)
      sets_[card.label(i, "temperature set")].everywhere = card.real(i + 1, "temperature");
}

// TEMPP1 SID EID1 TBAR TPRIME TS1 TS2 / EID2 EID3 ... or EID2 THRU EIDi EIDj THRU EIDk
void NastranTemperatures::add_plates(const CardView& card) {
  const TemperatureField::OfShell of{card.real(2, "TBAR"),
                                     card.real(3, "TPRIME", 0.0) / model_.units.length};
  if (card.has(4) || card.has(5))
    model_.log.leave_out("TEMPP1", "TS1, TS2: temperatures are linear through the plate");
  const auto add = [&](long label) {
    const auto found = model_.shell_of.find(label);
    if (found != model_.shell_of.end())
      set(card).shells[found->second] = of;
    else if (model_.any_elements.count(label) == 0)
      throw CardError{fmt::format("temperatures of set {} are of element {}, which does not exist",
                                  card.text(0), label)};
    else
      model_.log.leave_out("TEMPP1", "temperatures of what is no plate");
  };
  add(card.label(1, "element"));
  for_each_element(card, 8, model_.shell_of, add);
}

// TEMPRB SID EID1 TA TB TP1A TP1B TP2A TP2B / TCA ... TFB / EID2 ...
void NastranTemperatures::add_bars(const CardView& card) {
  const double mean[] = {card.real(2, "TA"), card.real(3, "TB")};
  const double length = model_.units.length;
  // Direction 1 is that of the bar's plane 1, which has axis 2 in it; slopes are along 3 and 2.
  const Eigen::Vector2d slopes[] = {
      Eigen::Vector2d(card.real(6, "TP2A", 0.0), card.real(4, "TP1A", 0.0)) / length,
      Eigen::Vector2d(card.real(7, "TP2B", 0.0), card.real(5, "TP1B", 0.0)) / length};
  for (std::size_t i = 8; i < 16; ++i)
    if (card.has(i))
      model_.log.leave_out("TEMPRB", "TCA to TFB: temperatures are linear over the section");
  const auto add = [&](long label) {
    const auto found = model_.beam_of.find(label);
    if (found == model_.beam_of.end()) {
      if (model_.any_elements.count(label) == 0)
        throw CardError{fmt::format(
            "temperatures of set {} are of element {}, which does not exist", card.text(0), label)};
      model_.log.leave_out("TEMPRB", "temperatures of what is no bar");
      return;
    }
    const std::vector<int> pieces = model_.pieces_of_beam(found->second);
    const std::vector<Beam>& beams = model_.deck.mesh.beams;
    const Vector3& begin = model_.place(beams[at(pieces.front())].vertices[0]);
    const double whole = (model_.place(beams[at(pieces.back())].vertices[1]) - begin).norm();
    for (const int piece : pieces) {
      TemperatureField::OfBeam& of = set(card).beams[piece];
      for (std::size_t end = 0; end < 2; ++end) {
        const double share = (model_.place(beams[at(piece)].vertices[end]) - begin).norm() / whole;
        of.mean[end] = (1 - share) * mean[0] + share * mean[1];
        of.slopes[end] = (1 - share) * slopes[0] + share * slopes[1];
      }
    }
  };
  add(card.label(1, "element"));
  for_each_element(card, 16, model_.beam_of, add);
}

const NastranTemperatures::Set& NastranTemperatures::get(long number) const {
  const auto found = sets_.find(number);
  if (found == sets_.end())
    throw CardError{fmt::format("temperature set {} does not exist", number)};
  return found->second;
}

double NastranTemperatures::at_vertex(const Set& set, std::size_t vertex) const {
  const int own = model_.deck.own_vertices;
  if (own > 0 && vertex >= at(own)) return std::numeric_limits<double>::quiet_NaN();
  if (const auto found = set.at_vertices.find(static_cast<int>(vertex));
      found != set.at_vertices.end())
    return found->second;
  return set.everywhere.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Where a CBEAM's section changes between its grids there is none: what is linear between them.
std::vector<double> NastranTemperatures::at_all_vertices(const Set& set) const {
  const Mesh& mesh = model_.deck.mesh;
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) values.push_back(at_vertex(set, v));
  for (const auto& [label, first] : model_.beam_of) {
    const std::vector<int> pieces = model_.pieces_of_beam(first);
    const int from = mesh.beams[at(pieces.front())].vertices[0],
              to = mesh.beams[at(pieces.back())].vertices[1];
    const double whole = (model_.place(to) - model_.place(from)).norm();
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const int between = mesh.beams[at(pieces[i])].vertices[1];
      const double share = (model_.place(between) - model_.place(from)).norm() / whole;
      values[at(between)] = (1 - share) * values[at(from)] + share * values[at(to)];
    }
  }
  return values;
}

TemperatureField NastranTemperatures::make(long load, long initial) const {
  const Set& hot = get(load);
  TemperatureField field;
  field.name = fmt::format("temperature set {}", load);
  field.counts_from_reference = initial == 0;
  field.obstacle = hot.obstacle;
  field.shells = hot.shells;
  field.beams = hot.beams;
  field.at_vertices = at_all_vertices(hot);
  if (initial == 0) return field;
  const Set& cold = get(initial);
  if (field.obstacle.empty()) field.obstacle = cold.obstacle;
  if (field.obstacle.empty() && (!cold.shells.empty() || !cold.beams.empty()))
    field.obstacle = "the initial ones are given by element (TEMPP1, TEMPRB)";
  const std::vector<double> before = at_all_vertices(cold);
  for (std::size_t v = 0; v < before.size(); ++v) field.at_vertices[v] -= before[v];
  for (auto& [shell, of] : field.shells) {
    const Shell& one = model_.deck.mesh.shells[at(shell)];
    const std::size_t corners = one.is_triangle() ? 3 : 4;
    for (std::size_t i = 0; i < corners; ++i)
      of.mean -= before[at(one.vertices[i])] / static_cast<double>(corners);
  }
  for (auto& [beam, of] : field.beams)
    for (std::size_t end = 0; end < 2; ++end)
      of.mean[end] -= before[at(model_.deck.mesh.beams[at(beam)].vertices[end])];
  for (const auto& [shell, of] : field.shells)
    if (field.obstacle.empty() && std::isnan(of.mean))
      field.obstacle = "nodes of plates have no initial temperature";
  for (const auto& [beam, of] : field.beams)
    if (field.obstacle.empty() && std::isnan(of.mean[0] + of.mean[1]))
      field.obstacle = "nodes of bars have no initial temperature";
  return field;
}

int NastranTemperatures::field(long load, long initial) {
  if (const auto known = made_.find({load, initial}); known != made_.end()) return known->second;
  std::vector<TemperatureField>& fields = model_.deck.temperatures;
  fields.push_back(make(load, initial));
  return made_[{load, initial}] = static_cast<int>(fields.size()) - 1;
}

}  // namespace blocklift::structure
