#include "structure/mesh/files/cad_unit.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>

#include "structure/letter_case.h"

namespace blocklift::structure {

namespace {

bool is_step(const std::string& ending) { return ending == ".step" || ending == ".stp"; }
bool is_iges(const std::string& ending) { return ending == ".iges" || ending == ".igs"; }

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// What a STEP file says of an instance such as "#28"; empty if nothing.
std::string definition_of(const std::string& text, const std::string& instance) {
  for (std::size_t at = text.find(instance); at != std::string::npos;
       at = text.find(instance, at + 1)) {
    std::size_t i = at + instance.size();
    while (i < text.size() && is_blank(text[i])) ++i;
    if (i < text.size() && text[i] == '=') return text.substr(i + 1, text.find(';', i) - i - 1);
  }
  return "";
}

/// Of an SI unit with metres, m, as SI_UNIT(.MILLI.,.METRE.); 0 if there is none.
double length_of_si_unit(const std::string& text) {
  static const std::map<std::string, double> prefixes{{"$", 1},          {".MILLI.", 1e-3},
                                                      {".CENTI.", 1e-2}, {".DECI.", 0.1},
                                                      {".KILO.", 1e3},   {".MICRO.", 1e-6}};
  static const std::regex metre(R"(SI_UNIT\s*\(\s*(\$|\.[A-Z]+\.)\s*,\s*\.METRE\.)");
  std::smatch found;
  if (!std::regex_search(text, found, metre)) return 0;
  const auto prefix = prefixes.find(found[1].str());
  return prefix == prefixes.end() ? 0 : prefix->second;
}

/// Of a conversion-based unit with a known name, m; 0 if there is none.
double length_of_named_unit(const std::string& text) {
  static const std::regex known(R"(CONVERSION_BASED_UNIT\s*\(\s*'\s*(INCH|FOOT|FEET))",
                                std::regex::icase);
  std::smatch found;
  if (!std::regex_search(text, found, known)) return 0;
  return upper(found[1].str()) == "INCH" ? 0.0254 : 0.3048;
}

/// Of what defines a unit, m; units converted from others by their names, else by their measures.
/// @param text all of the file.
double length_of_unit(const std::string& text, const std::string& unit, int conversions = 3) {
  static const std::regex converted(R"(CONVERSION_BASED_UNIT\s*\(\s*'[^']*'\s*,\s*(#[0-9]+))");
  static const std::regex measure(R"(LENGTH_MEASURE\s*\(\s*([-+.0-9Ee]+)\s*\)\s*,\s*(#[0-9]+))");
  if (const double length = length_of_named_unit(unit); length > 0) return length;
  std::smatch found;
  if (conversions == 0 || !std::regex_search(unit, found, converted))
    return length_of_si_unit(unit);
  const std::string factor = definition_of(text, found[1].str());
  if (!std::regex_search(factor, found, measure)) return 0;
  return std::strtod(found[1].str().c_str(), nullptr) *
         length_of_unit(text, definition_of(text, found[2].str()), conversions - 1);
}

/// Units of measured properties, such as of a volume in cubic metres, are not the geometry's.
double length_of_step(const std::string& text) {
  const std::size_t begin = text.find("GLOBAL_UNIT_ASSIGNED_CONTEXT");
  const std::string list =
      begin == std::string::npos ? "" : text.substr(begin, text.find(')', begin) - begin);
  static const std::regex instance("#[0-9]+");
  for (std::sregex_iterator i(list.begin(), list.end(), instance), end; i != end; ++i) {
    const std::string unit = definition_of(text, i->str());
    if (unit.find("LENGTH_UNIT") != std::string::npos) return length_of_unit(text, unit);
  }
  const double named = length_of_named_unit(text);
  return named > 0 ? named : length_of_si_unit(text);
}

/// Parameters of the global section: columns 1 to 72 of the lines marked G.
std::string global_section(const std::string& text) {
  std::string section;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin >= 73 && text[begin + 72] == 'G') section += text.substr(begin, 72);
    begin = end + 1;
  }
  return section;
}

// IGES 5.3, section 2.2.4.3: the 14th parameter of the global section is the unit's flag.
double length_of_iges(const std::string& text) {
  static const std::map<std::string, double> flags{{"1", 0.0254},   {"2", 1e-3}, {"4", 0.3048},
                                                   {"5", 1609.344}, {"6", 1},    {"7", 1e3},
                                                   {"8", 2.54e-5},  {"9", 1e-6}, {"10", 1e-2}};
  constexpr int flag_place = 14;
  const std::string section = global_section(text);
  std::string value;
  int place = 1;
  for (std::size_t i = 0; i < section.size() && place <= flag_place; ++i) {
    const char c = section[i];
    if (c == 'H' && !value.empty() && std::all_of(value.begin(), value.end(), [](char digit) {
          return std::isdigit(static_cast<unsigned char>(digit)) != 0;
        })) {
      i += static_cast<std::size_t>(std::strtoul(value.c_str(), nullptr, 10));  // a string's text
      value = "text";
    } else if (c == ',' || c == ';') {
      if (place++ == flag_place) break;
      value.clear();
    } else if (c != ' ') {
      value += c;
    }
  }
  const auto flag = flags.find(value);
  return place > flag_place && flag != flags.end() ? flag->second : 0;
}

}  // namespace

bool is_cad_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return is_step(ending) || is_iges(ending) || ending == ".brep";
}

double declared_length(const std::string& path) {
  const std::string ending = ending_of(path);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (is_step(ending)) return length_of_step(text);
  return is_iges(ending) ? length_of_iges(text) : 0;
}

}  // namespace blocklift::structure
