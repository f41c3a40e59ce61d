#include "structure/mesh/files/nastran_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/letter_case.h"

namespace blocklift::structure {

namespace {

using Tags = std::vector<std::size_t>;

/// A card with its continuations, each line's fields filled up to eight.
struct Card {
  std::string name;
  std::vector<std::string> fields;
  int line = 0;  ///< of its first
};

std::string without_spaces(std::string_view text) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  while (!text.empty() && is_space(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && is_space(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return std::string(text);
}

/// The first field of a line and the fields of data: free (commas), small (8 columns) or large
/// (16).
std::pair<std::string, std::vector<std::string>> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  if (line.find(',') != std::string::npos) {
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
      fields.push_back(without_spaces(field));
    const std::string first = fields.front();
    fields.erase(fields.begin());
    const std::size_t width = first.find('*') == std::string::npos ? 8 : 4;
    fields.resize(width);
    return {first, fields};
  }
  const std::string first = without_spaces(std::string_view(line).substr(0, 8));
  const bool is_large = first.find('*') != std::string::npos;
  const std::size_t width = is_large ? 16 : 8, count = is_large ? 4 : 8;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = 8 + i * width;
    fields.push_back(from < line.size() ? without_spaces(std::string_view(line).substr(from, width))
                                        : std::string());
  }
  return {first, fields};
}

/// "1.5-3" and "1.D5" are numbers here, too.
std::string with_exponent(const std::string& text) {
  std::string number;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_sign = c == '+' || c == '-';
    const char before = i > 0 ? text[i - 1] : 'E';
    if (is_sign && std::toupper(static_cast<unsigned char>(before)) != 'E' &&
        std::toupper(static_cast<unsigned char>(before)) != 'D')
      number += 'E';
    if (i == 0 && c == '+') continue;
    number += c == 'D' || c == 'd' ? 'E' : c;
  }
  return number;
}

class NastranReader {
 public:
  explicit NastranReader(std::string path) : path_(std::move(path)) {}

  AbaqusMesh read() {
    const std::vector<Card> cards = read_cards();
    for (const Card& card : cards)
      if (card.name == "GRID") add_grid(card);
    for (const Card& card : cards) add_solid(card);
    if (mesh_.elements.empty()) return {};
    find_faces();
    for (const Card& card : cards) {
      if (card.name == "CTRIA3" || card.name == "CTRIA6" || card.name == "CQUAD4" ||
          card.name == "CQUAD8")
        add_coat(card);
      if (card.name == "SPC1") add_constraint(card);
      if (card.name == "SPC") add_single_constraints(card);
      if (card.name == "PLOAD4") add_load(card);
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw ModelError(fmt::format("{}:{}: {}", path_, line, message));
  }

  std::vector<Card> read_cards() {
    std::ifstream file(path_);
    if (!file) throw ModelError("cannot read \"" + path_ + "\"");
    std::vector<std::pair<int, std::string>> lines;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      line = line.substr(0, line.find('$'));
      const std::string text = upper(without_spaces(line));
      if (text.rfind("BEGIN", 0) == 0) lines.clear();  // what was before it is no data
      if (text.rfind("ENDDATA", 0) == 0) break;
      if (!text.empty() && text.rfind("BEGIN", 0) != 0) lines.emplace_back(number, line);
    }
    std::vector<Card> cards;
    for (const auto& [number, text] : lines) {
      auto [first, fields] = fields_of(text);
      if (first.empty() || first.front() == '+' || first.front() == '*') {
        if (cards.empty()) fail(number, "a line continues no card");
        cards.back().fields.insert(cards.back().fields.end(), fields.begin(), fields.end());
        continue;
      }
      const std::string name = upper(first.substr(0, first.find('*')));
      if (name.rfind("INCLUDE", 0) == 0)
        fail(number, "INCLUDE is not known here; write the bulk data into one file");
      cards.push_back({name, std::move(fields), number});
    }
    return cards;
  }

  std::size_t number(const Card& card, std::size_t field, const char* what) const {
    const std::string text = field < card.fields.size() ? card.fields[field] : std::string();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
      fail(card.line, fmt::format("{}: \"{}\" is no {}", card.name, text, what));
    return value;
  }

  double coordinate(const Card& card, std::size_t field) const {
    if (card.fields[field].empty()) return 0;
    const std::string text = with_exponent(card.fields[field]);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(card.line, fmt::format("GRID: \"{}\" is no coordinate", card.fields[field]));
    return value;
  }

  void add_grid(const Card& card) {
    if (!card.fields[1].empty() && card.fields[1] != "0")
      fail(card.line,
           fmt::format("GRID {} is given in coordinate system {}; only the basic one is known",
                       card.fields[0], card.fields[1]));
    const std::size_t tag = number(card, 0, "grid number");
    // In large fields a grid takes two lines: the fields follow one another just so.
    if (!mesh_.nodes
             .try_emplace(tag, std::array<double, 3>{coordinate(card, 2), coordinate(card, 3),
                                                     coordinate(card, 4)})
             .second)
      fail(card.line, fmt::format("GRID {} is there twice", tag));
  }

  std::size_t grid(const Card& card, std::size_t field) const {
    const std::size_t tag = number(card, field, "grid number");
    if (mesh_.nodes.count(tag) == 0)
      fail(card.line, fmt::format("{} {} names grid {}, which does not exist", card.name,
                                  card.fields[0], tag));
    return tag;
  }

  // Abaqus' order has the middles of the upper edges before those of the upright ones.
  void add_solid(const Card& card) {
    std::size_t corners = 0;
    std::vector<std::size_t> middles;  // places among Nastran's grids
    if (card.name == "CTETRA") {
      corners = 4;
      middles = {4, 5, 6, 7, 8, 9};
    } else if (card.name == "CPENTA") {
      corners = 6;
      middles = {6, 7, 8, 12, 13, 14, 9, 10, 11};
    } else if (card.name == "CHEXA") {
      corners = 8;
      middles = {8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
    } else {
      if (card.name == "CPYRAM") fail(card.line, "CPYRAM: pyramids are not known");
      return;
    }
    constexpr std::size_t first = 2;
    std::size_t given = 0;
    for (const std::size_t place : middles)
      if (first + place < card.fields.size() && !card.fields[first + place].empty()) ++given;
    if (given != 0 && given != middles.size())
      fail(card.line, fmt::format("{} {} has {} of its {} grids between corners", card.name,
                                  card.fields[0], given, middles.size()));
    AbaqusElement element{number(card, 0, "element number"), {}};
    if (!places_.try_emplace(element.tag, mesh_.elements.size()).second)
      fail(card.line, fmt::format("element {} is there twice", element.tag));
    for (std::size_t i = 0; i < corners; ++i) element.nodes.push_back(grid(card, first + i));
    if (given > 0)
      for (const std::size_t place : middles) element.nodes.push_back(grid(card, first + place));
    mesh_.element_sets[property_of(card)].push_back(element.tag);
    mesh_.elements.push_back(std::move(element));
  }

  std::string property_of(const Card& card) const {
    // The property is the element's own number where it is left out.
    return fmt::format("property {}",
                       number(card, card.fields[1].empty() ? 0 : 1, "property number"));
  }

  Tags corners_of(const AbaqusElement& element, int face) const {
    Tags corners;
    for (const int corner : abaqus_faces(element.nodes.size())[face - 1])
      corners.push_back(element.nodes[corner]);
    return corners;
  }

  static int face_count(const AbaqusElement& element) {
    return static_cast<int>(abaqus_faces(element.nodes.size()).size());
  }

  void find_faces() {
    for (const AbaqusElement& element : mesh_.elements)
      for (int face = 1; face <= face_count(element); ++face) {
        Tags corners = corners_of(element, face);
        std::sort(corners.begin(), corners.end());
        faces_.try_emplace(std::move(corners), AbaqusFace{element.tag, face});
      }
  }

  void add_coat(const Card& card) {
    Tags corners;
    const std::size_t count = card.name.rfind("CTRIA", 0) == 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i) corners.push_back(grid(card, 2 + i));
    std::sort(corners.begin(), corners.end());
    const auto face = faces_.find(corners);
    if (face == faces_.end())
      fail(card.line,
           fmt::format("{} {} lies on no solid; a file of solids and shells is not known",
                       card.name, card.fields[0]));
    mesh_.surfaces[property_of(card)].push_back(face->second);
  }

  void add_to_constraint(const Card& card, std::size_t tag) {
    mesh_.node_sets[fmt::format("constraint {}", number(card, 0, "set number"))].push_back(tag);
  }

  void add_constraint(const Card& card) {
    if (card.fields.size() > 3 && upper(card.fields[3]) == "THRU") {
      const std::size_t last = number(card, 4, "grid number");
      for (auto node = mesh_.nodes.lower_bound(number(card, 2, "grid number"));
           node != mesh_.nodes.end() && node->first <= last; ++node)
        add_to_constraint(card, node->first);
      return;
    }
    for (std::size_t field = 2; field < card.fields.size(); ++field)
      if (!card.fields[field].empty()) add_to_constraint(card, grid(card, field));
  }

  void add_single_constraints(const Card& card) {
    for (const std::size_t field : {std::size_t{1}, std::size_t{4}})
      if (!card.fields[field].empty()) add_to_constraint(card, grid(card, field));
  }

  // One corner of the face, and the opposite one of a quadrangle, or a tetrahedron's fourth.
  void add_load(const Card& card) {
    if (card.fields[6].empty()) return;  // on shells
    const auto place = places_.find(number(card, 1, "element number"));
    if (place == places_.end())
      fail(card.line, fmt::format("PLOAD4 {} acts on element {}, which is no solid", card.fields[0],
                                  card.fields[1]));
    const AbaqusElement& element = mesh_.elements[place->second];
    const std::size_t first = grid(card, 6);
    const bool has_second = !card.fields[7].empty();
    const std::size_t second = has_second ? grid(card, 7) : 0;
    for (int face = 1; face <= face_count(element); ++face) {
      const Tags corners = corners_of(element, face);
      const auto has = [&](std::size_t tag) {
        return std::find(corners.begin(), corners.end(), tag) != corners.end();
      };
      const bool is_triangle = corners.size() == 3;
      const bool is_tetrahedron = face_count(element) == 4;
      const bool matches = is_tetrahedron ? has_second && has(first) && !has(second)
                           : has_second   ? !is_triangle && are_opposite(corners, first, second)
                                          : is_triangle && has(first);
      if (!matches) continue;
      mesh_.surfaces[fmt::format("load {}", number(card, 0, "set number"))].push_back(
          {element.tag, face});
      return;
    }
    fail(card.line, fmt::format("PLOAD4 {}: its grids name no face of element {}", card.fields[0],
                                element.tag));
  }

  static bool are_opposite(const Tags& corners, std::size_t a, std::size_t b) {
    return (corners[0] == a && corners[2] == b) || (corners[2] == a && corners[0] == b) ||
           (corners[1] == a && corners[3] == b) || (corners[3] == a && corners[1] == b);
  }

  std::string path_;
  AbaqusMesh mesh_;
  std::map<std::size_t, std::size_t> places_;  ///< of elements by tag
  std::map<Tags, AbaqusFace> faces_;           ///< by their corners
};

}  // namespace

AbaqusMesh read_nastran(const std::string& path) { return NastranReader(path).read(); }

}  // namespace blocklift::structure
