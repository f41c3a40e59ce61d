#include "pipeline/files/rigging/rigging_table.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/text_file.h"

namespace blocklift::pipeline {
namespace {

using Cells = std::vector<std::string>;

std::string without_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The cells of a line; none where a quotation does not end.
std::optional<Cells> cells_of(const std::string& line, char separator) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      const bool is_doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (is_doubled) cells.back() += line[++i];
      if (!is_doubled) quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  for (std::string& cell : cells) cell = without_blanks(cell);
  // Spreadsheets fill every row up to the width of the widest.
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

/// A text as YAML has it in double quotes.
std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string entry(const std::string& key, const std::string& value) {
  return in_quotes(key) + ": " + in_quotes(value) + ", ";
}

bool is_any_of(const std::string& text, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// The table of a file of kind rigging whose items a row of headings begins; none: no such row.
const char* table_of(const std::string& heading) {
  static const std::map<std::string, const char*> tables{{"sling", "slings"},
                                                         {"shackle", "shackles"},
                                                         {"master_link", "master_links"},
                                                         {"sheave", "sheaves"}};
  const auto found = tables.find(heading);
  return found == tables.end() ? nullptr : found->second;
}

/// Writes each line of a table as one line of YAML, so that the lines keep their numbers.
class TableWriter {
 public:
  TableWriter(const TextFile& table, Diagnostics& diagnostics)
      : table_(table), diagnostics_(diagnostics) {}

  void add(const std::string& line) {
    ++line_;
    text_ += line_ == 1 ? "{kind: rigging, " : "\n";
    // A byte order mark begins what some spreadsheets write.
    const std::string bare = line_ == 1 && line.starts_with("\xEF\xBB\xBF") ? line.substr(3) : line;
    if (separator_ == 0 && !without_blanks(bare).empty())
      separator_ = bare.find(';') < bare.find(',') ? ';' : ',';
    const std::optional<Cells> cells = cells_of(bare, separator_);
    if (!cells)
      complain("a quotation does not end on its line");
    else if (!cells->front().empty() || cells->size() > 1)
      add_row(*cells);
  }

  std::string finish() {
    close_rule();
    if (!headings_.empty()) text_ += "}";
    return text_ + "}\n";
  }

 private:
  void add_row(const Cells& cells) {
    if (!headings_.empty())
      add_item(cells);
    else if (table_of(cells.front()))
      add_headings(cells);
    else
      add_key(cells);
  }

  void add_key(const Cells& cells) {
    if (cells.size() != 2) {
      complain(fmt::format("the row of \"{}\" has {} values; one is due", cells.front(),
                           cells.size() - 1));
      return;
    }
    if (is_any_of(cells[0], {"rule", "safety_factor", "efficiency", "formula"})) {
      if (!in_rule_) text_ += "rule: {";
      in_rule_ = true;
      text_ += entry(cells[0] == "rule" ? "name" : cells[0], cells[1]);
    } else {
      close_rule();
      text_ += entry(cells[0], cells[1]);
    }
  }

  void add_headings(const Cells& cells) {
    close_rule();
    headings_ = cells;
    text_ += std::string(table_of(cells.front())) + ": {";
  }

  void add_item(const Cells& cells) {
    if (cells.size() > headings_.size()) {
      complain(fmt::format("the row of \"{}\" has {} cells, and there are {} headings",
                           cells.front(), cells.size(), headings_.size()));
      return;
    }
    std::string rope, item;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (cells[i].empty()) continue;
      const bool is_own = headings_.front() != "sling" ||
                          is_any_of(headings_[i], {"rope", "working_load", "safety_factor"});
      (is_own ? item : rope) += entry(headings_[i], cells[i]);
    }
    text_ += in_quotes(cells.front()) + ": {" + item;
    if (!rope.empty()) text_ += "rope: {" + rope + "}";
    text_ += "}, ";
  }

  void close_rule() {
    if (in_rule_) text_ += "}, ";
    in_rule_ = false;
  }
  void complain(std::string message) {
    diagnostics_.error({table_.file, line_, 1}, std::move(message));
  }

  const TextFile& table_;
  Diagnostics& diagnostics_;
  std::string text_;
  Cells headings_;
  char separator_ = 0;
  bool in_rule_ = false;
  int line_ = 0;
};

}  // namespace

std::optional<Document> load_rigging_table(const std::filesystem::path& path,
                                           Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  const std::optional<TextFile> table = load_text(path, diagnostics);
  if (!table) return std::nullopt;
  TableWriter writer(*table, diagnostics);
  std::istringstream lines(table->text);
  for (std::string line; std::getline(lines, line);) writer.add(line);
  if (table->text.empty())
    diagnostics.error({table->file, 0, 0}, "the file is empty; rows are due");
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  Document document;
  document.file = table->file;
  document.text = writer.finish();
  document.root = YAML::Load(document.text);
  return document;
}

}  // namespace blocklift::pipeline
