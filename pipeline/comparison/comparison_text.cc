#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pipeline/comparison/comparison.h"

namespace blocklift::pipeline {
namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t value_width = 11;
constexpr std::size_t change_width = 10;
/// Results beside the first that a line has room for.
constexpr std::size_t others_in_a_line = 2;

/// A text of a terminal counts its letters, not its bytes.
std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

/// The text, cut in its middle where it is longer: both ends of a name tell most.
std::string cut(std::string_view text, std::size_t width) {
  if (letters(text) <= width) return std::string(text);
  const std::size_t end = (width - 2) / 2;
  return fmt::format("{}..{}", text.substr(0, width - 2 - end), text.substr(text.size() - end));
}

std::string to_the_left(std::string_view text, std::size_t width) {
  std::string line = cut(text, width);
  line.append(width - std::min(letters(line), width), ' ');
  return line;
}

std::string to_the_right(std::string_view text, std::size_t width) {
  const std::string line = cut(text, width);
  return std::string(width - std::min(letters(line), width), ' ') + line;
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

/// Stands for a blank at which no line is broken.
constexpr char unbroken_blank = '\x01';

/// A label broken at blanks, its later lines indented: what tells figures apart may stand at its
/// end. A word that is too long alone is cut.
std::vector<std::string> label_lines(const std::string& label, std::size_t indent,
                                     std::size_t width) {
  std::vector<std::string> lines;
  std::string line(indent, ' ');
  std::istringstream words(label);
  for (std::string word; words >> word;) {
    const bool is_first = line.find_first_not_of(' ') == std::string::npos;
    if (!is_first && letters(line) + 1 + letters(word) > width) {
      lines.push_back(std::move(line));
      line = std::string(indent + 2, ' ') + word;
    } else {
      line += (is_first ? "" : " ") + word;
    }
  }
  lines.push_back(std::move(line));
  for (std::string& one : lines) {
    std::replace(one.begin(), one.end(), unbroken_blank, ' ');
    one = cut(one, width);
  }
  return lines;
}

std::string name_of_file(const std::string& file) { return file.empty() ? "the case file" : file; }

/// Differing keys, each with its values below one another: they may be long.
std::string input_text(const ResultComparison& comparison) {
  const bool all_have_models =
      std::all_of(comparison.results.begin(), comparison.results.end(),
                  // Results of a part alone hold no input at all.
                  [](const ComparedResult& result) { return result.has_models; });
  std::string text = comparison.input.empty() ? "input: no key differs\n" : "input that differs\n";
  std::size_t name_width = 0;
  for (const ComparedResult& result : comparison.results)
    name_width = std::max(name_width, letters(result.name));
  name_width = std::min<std::size_t>(name_width, 20);
  const std::string* file = nullptr;
  for (const InputDifference& difference : comparison.input) {
    if (!file || *file != difference.file)
      text += fmt::format(" {}\n", cut(name_of_file(difference.file), line_width - 1));
    file = &difference.file;
    if (!difference.key.empty()) text += fmt::format("  {}\n", cut(difference.key, line_width - 2));
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
      text += without_trailing_blanks(
          fmt::format("    {}  {}", to_the_left(comparison.results[i].name, name_width),
                      cut(difference.values[i].value_or("-"), line_width - 6 - name_width)));
  }
  if (!all_have_models) text += " (models are not compared: not all results hold them)\n";
  return text;
}

/// Which versions of the program the results are of, where they are not of one: a figure may differ
/// by that alone.
std::string versions_text(const ResultComparison& comparison) {
  const auto version_of = [](const ComparedResult& result) {
    return result.summary.value("program_version", std::string("unknown"));
  };
  const std::vector<ComparedResult>& results = comparison.results;
  if (std::ranges::all_of(results, [&](const ComparedResult& one) {
        return version_of(one) == version_of(results.front());
      }))
    return {};
  std::string text = "versions of the program differ\n";
  for (const ComparedResult& result : results)
    text += without_trailing_blanks(
        fmt::format("    {}  {}", to_the_left(result.name, 20), version_of(result)));
  return text;
}

/// The results from `begin` on beside the first, as many as a line has room for.
std::string figures_text(const ResultComparison& comparison, std::size_t begin) {
  const std::size_t end = std::min(begin + others_in_a_line, comparison.results.size());
  const std::size_t label_width =
      line_width - value_width - (end - begin) * (value_width + change_width);
  const auto line = [&](std::string_view label, const auto& value_of, const auto& change_of) {
    std::string text = to_the_left(label, label_width) + to_the_right(value_of(0), value_width);
    for (std::size_t i = begin; i < end; ++i)
      text += to_the_right(value_of(i), value_width) + to_the_right(change_of(i), change_width);
    return without_trailing_blanks(std::move(text));
  };
  std::string text =
      "\n" + line(
                 "",
                 [&](std::size_t i) { return cut(comparison.results[i].name, value_width - 1); },
                 [](std::size_t) { return std::string("change"); });
  const std::string* group = nullptr;
  for (const ComparedFigure& figure : comparison.figures) {
    const SummaryFigure& one = figure.figure;
    if ((!group || *group != one.group) && one.group != "verdict") text += one.group + '\n';
    group = &one.group;
    std::string unit = one.unit.empty() ? "" : ", " + one.unit;
    std::replace(unit.begin(), unit.end(), ' ', unbroken_blank);
    const std::size_t indent = one.group == "verdict" ? 0 : 1;
    // A blank stays between label and value.
    std::vector<std::string> label = label_lines(one.label + unit, indent, label_width - 1);
    for (std::size_t i = 0; i + 1 < label.size(); ++i) text += label[i] + '\n';
    text += line(
        label.back(), [&](std::size_t i) { return shown_value(figure, figure.values[i]); },
        [&](std::size_t i) { return shown_change(figure, i); });
  }
  return text;
}

}  // namespace

std::string comparison_text(const ResultComparison& comparison) {
  std::string text = input_text(comparison) + versions_text(comparison);
  for (std::size_t begin = 1; begin < comparison.results.size(); begin += others_in_a_line)
    text += figures_text(comparison, begin);
  if (comparison.tolerances.empty()) return text;
  text += comparison.moved.empty()
              ? fmt::format("\nno figure moved beyond its tolerance; figures that have one: {}\n",
                            comparison.held)
              : "\nbeyond tolerance\n";
  for (const MovedFigure& moved : comparison.moved)
    text += fmt::format(" {}\n", shown_move(comparison, moved));
  return text;
}

}  // namespace blocklift::pipeline
