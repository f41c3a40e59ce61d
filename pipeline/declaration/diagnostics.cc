#include "pipeline/declaration/diagnostics.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "structure/nearest_name.h"

namespace blocklift::pipeline {
namespace {

std::string place_text(const Mark& mark) {
  const std::string& file = mark.file ? *mark.file : std::string("input");
  if (mark.line == 0) return file;
  if (mark.column == 0) return fmt::format("{}:{}", file, mark.line);
  return fmt::format("{}:{}:{}", file, mark.line, mark.column);
}

/// The beginning of a text, not cut within a character, and "..." if it has more bytes.
std::string beginning_of(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return std::string(text.substr(0, end)) + "...";
}

/// What stands between two quotation marks by its beginning, and so any word without a blank: a
/// line of a file may have megabytes, and a file that is named by mistake may hold secrets.
std::string shortened(const std::string& message) {
  constexpr std::size_t most_quoted = 80, longest_word = 300, longest_message = 20000;
  std::string text;
  for (std::size_t begin = 0; begin < message.size();) {
    const bool is_quote = message[begin] == '"';
    const std::size_t end =
        std::min(is_quote ? message.find('"', begin + 1) : message.find_first_of(" \n\"", begin),
                 message.size());
    const std::string_view passage = std::string_view(message).substr(
        begin + (is_quote ? 1 : 0), end - begin - (is_quote ? 1 : 0));
    if (is_quote) text += '"';
    text += beginning_of(passage, is_quote ? most_quoted : longest_word);
    begin = end;
    if (begin == message.size() || (!is_quote && message[begin] == '"')) continue;
    text += message[begin++];
  }
  return beginning_of(text, longest_message);
}

/// Keeps the first of complaints that say the same of one place: what an anchor holds is read at
/// each of its names, and its faults are found again. Those of one place stand beside each other.
void drop_repeated(std::vector<const Diagnostic*>& sorted) {
  const auto is_same_place = [](const Mark& a, const Mark& b) {
    return a.file == b.file && a.line == b.line && a.column == b.column;
  };
  std::vector<const Diagnostic*> kept;
  for (const Diagnostic* error : sorted) {
    bool is_told = false;
    for (auto told = kept.rbegin(); told != kept.rend() && !is_told; ++told) {
      if (!is_same_place((*told)->mark, error->mark)) break;
      is_told = (*told)->message == error->message && (*told)->hints == error->hints;
    }
    if (!is_told) kept.push_back(error);
  }
  sorted = std::move(kept);
}

}  // namespace

void Diagnostics::error(Mark mark, std::string message, std::vector<std::string> hints) {
  message = shortened(message);
  for (std::string& hint : hints) hint = shortened(hint);
  errors_.push_back({std::move(mark), std::move(message), std::move(hints)});
}

std::string Diagnostics::to_text() const {
  if (errors_.empty()) return {};
  // Files in the order in which they were first complained about, complaints by line within each.
  std::map<std::string, std::size_t> order_of_file;
  const auto file_of = [](const Diagnostic& error) {
    return error.mark.file ? *error.mark.file : std::string();
  };
  for (const Diagnostic& error : errors_) {
    order_of_file.emplace(file_of(error), order_of_file.size());
  }
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& error : errors_) sorted.push_back(&error);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Diagnostic* a, const Diagnostic* b) {
    return std::tuple(order_of_file.at(file_of(*a)), a->mark.line, a->mark.column) <
           std::tuple(order_of_file.at(file_of(*b)), b->mark.line, b->mark.column);
  });

  drop_repeated(sorted);

  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), most_printed); ++i) {
    text += fmt::format("{}: error: {}\n", place_text(sorted[i]->mark), sorted[i]->message);
    for (const std::string& hint : sorted[i]->hints) text += fmt::format("    {}\n", hint);
  }
  if (sorted.size() > most_printed) {
    text += fmt::format("and {} more that are not shown\n", sorted.size() - most_printed);
  }
  text += fmt::format("{} error{}\n", sorted.size(), sorted.size() == 1 ? "" : "s");
  return text;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  return structure::nearest_name(name, candidates);
}

std::string list_of_names(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > most) list += fmt::format(", ... ({} in all)", names.size());
  return list;
}

namespace {

/// "its lugs are" becomes "it has no lugs", "the outputs are" "there are no outputs".
std::string hint_of_no_names(std::string_view introduction) {
  constexpr std::string_view verb = " are";
  if (introduction.ends_with(verb)) {
    const std::string_view named = introduction.substr(0, introduction.size() - verb.size());
    if (named.starts_with("its ")) return fmt::format("it has no {}", named.substr(4));
    if (named.starts_with("the ")) return fmt::format("there are no {}", named.substr(4));
  }
  return fmt::format("{} none", introduction);
}

}  // namespace

std::string names_hint(std::string_view introduction, const std::vector<std::string>& candidates,
                       std::string_view wrong_name) {
  if (candidates.empty()) return hint_of_no_names(introduction);
  std::string hint = fmt::format("{} {}", introduction, list_of_names(candidates));
  const std::string nearest = nearest_name(wrong_name, candidates);
  if (!nearest.empty()) hint += fmt::format("; did you mean \"{}\"?", nearest);
  return hint;
}

}  // namespace blocklift::pipeline
