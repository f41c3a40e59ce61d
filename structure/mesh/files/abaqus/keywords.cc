#include "structure/mesh/files/abaqus/keywords.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// In capitals, with one blank between words.
std::string canonical(std::string_view text) {
  std::string name;
  for (const char c : upper(trimmed(text))) {
    if ((c == ' ' || c == '\t') && (name.empty() || name.back() == ' ')) continue;
    name += c == '\t' ? ' ' : c;
  }
  return name;
}

class KeywordSplitter {
 public:
  KeywordSplitter(DeckFiles& files, DeckLog& log, const KeywordFilter& is_read)
      : files_(files), log_(log), is_read_(is_read) {}

  std::vector<AbaqusBlock> split(const std::filesystem::path& path) {
    const DeckFiles::File& file = files_.open(path);
    read(file);
    note_missing_end(file);
    return std::move(blocks_);
  }

 private:
  void read(const DeckFiles::File& file) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const SourceLine place{file.number, static_cast<int>(i) + 1};
      const std::string_view text = trimmed(file.lines[i]);
      if (text.empty() || text.substr(0, 2) == "**") continue;
      if (text.front() != '*') {
        if (blocks_.empty())
          log_.complain(place, "data before the first keyword");
        else
          blocks_.back().data.push_back({place, text});
        continue;
      }
      std::string keyword(text);
      while (keyword.back() == ',' && i + 1 < file.lines.size()) {
        const std::string_view next = trimmed(file.lines[i + 1]);
        const bool is_comment = next.substr(0, 2) == "**";
        if (next.starts_with('*') && !is_comment) break;  // the comma was one too many
        ++i;
        if (!is_comment) keyword += next;
        if (next.empty()) break;
      }
      start(place, keyword, file);
    }
    files_.close();
  }

  /// What begins and does not end: the file may be cut off, and is where its last line has no end
  /// either.
  void note_missing_end(const DeckFiles::File& file) {
    for (const char* name : {"STEP", "PART", "INSTANCE", "ASSEMBLY"}) {
      const AbaqusBlock* open = nullptr;
      for (const AbaqusBlock& block : blocks_) {
        const std::string own = without_blanks(block.name);
        if (own == name) open = &block;
        if (own == std::string("END") + name) open = nullptr;
      }
      if (open == nullptr) continue;
      if (file.is_ended)
        log_.remark(open->line, fmt::format("*{0} has no *END {0}: is the deck all there?", name));
      else
        log_.complain({file.number, static_cast<int>(file.lines.size())},
                      fmt::format("the deck is cut off: *{0} ({1}) has no *END {0}, and the last "
                                  "line no end",
                                  name, log_.place(open->line)));
    }
  }

  void start(SourceLine place, const std::string& keyword, const DeckFiles::File& file) {
    AbaqusBlock block;
    block.line = place;
    std::size_t begin = 1;
    for (bool is_name = true;; is_name = false) {
      // A comma within quotes divides nothing.
      bool quoted = false;
      std::size_t end = begin;
      while (end < keyword.size() && (quoted || keyword[end] != ','))
        quoted ^= keyword[end++] == '"';
      const std::string_view part = trimmed(std::string_view(keyword).substr(begin, end - begin));
      if (is_name)
        block.name = canonical(part);
      else if (!part.empty())
        block.parameters.push_back(parameter(part));
      if (end >= keyword.size()) break;
      begin = end + 1;
    }
    if (block.name == "INCLUDE") {
      include(block, file);
      return;
    }
    blocks_.push_back(std::move(block));
    if (blocks_.back().has("INPUT") && is_read_(blocks_.back().name)) read_data_elsewhere(file);
  }

  static AbaqusBlock::Parameter parameter(std::string_view part) {
    const auto equals = part.find('=');
    AbaqusBlock::Parameter parameter;
    parameter.name = canonical(part.substr(0, equals));
    if (equals == std::string_view::npos) return parameter;
    std::string_view value = trimmed(part.substr(equals + 1));
    const bool quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
    if (quoted) value = value.substr(1, value.size() - 2);
    parameter.as_given = std::string(value);
    parameter.value = upper(value);
    return parameter;
  }

  void include(const AbaqusBlock& block, const DeckFiles::File& file) {
    log_.read("*INCLUDE", block.line);
    try {
      read(open_input(block, file));
      log_.use("*INCLUDE");
    } catch (const CardError& error) {
      log_.complain(block.line, "*INCLUDE: " + error.text);
    }
  }

  const DeckFiles::File& open_input(const AbaqusBlock& block, const DeckFiles::File& file) {
    const AbaqusBlock::Parameter* input = block.find("INPUT");
    if (input == nullptr || input->as_given.empty()) throw CardError{"INPUT = file is missing"};
    std::string name = input->as_given;
    std::replace(name.begin(), name.end(), '\\', '/');
    return files_.open_included(name, file);
  }

  /// Gives the last block the lines of the file that its INPUT names: they stand before those below
  /// the keyword itself.
  void read_data_elsewhere(const DeckFiles::File& from) {
    AbaqusBlock& block = blocks_.back();
    try {
      const DeckFiles::File& file = open_input(block, from);
      for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const SourceLine place{file.number, static_cast<int>(i) + 1};
        const std::string_view text = trimmed(file.lines[i]);
        if (text.empty() || text.substr(0, 2) == "**") continue;
        if (text.front() == '*')
          log_.complain(place,
                        fmt::format("\"{}\" in the file of INPUT = of *{}: that has lines of "
                                    "data alone; *INCLUDE takes a file with keywords",
                                    text, block.name));
        else
          block.data.push_back({place, text});
      }
      files_.close();
    } catch (const CardError& error) {
      log_.complain(block.line, fmt::format("*{}: {}", block.name, error.text));
    }
  }

  DeckFiles& files_;
  DeckLog& log_;
  const KeywordFilter& is_read_;
  std::vector<AbaqusBlock> blocks_;
};

}  // namespace

std::vector<std::string_view> AbaqusLine::fields() const {
  std::vector<std::string_view> fields;
  fields.reserve(8);
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    fields.push_back(trimmed(text.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return fields;
}

std::string without_blanks(std::string_view name) {
  std::string letters(name);
  std::erase(letters, ' ');
  return letters;
}

const AbaqusBlock::Parameter* AbaqusBlock::find(std::string_view parameter) const {
  for (const Parameter& known : parameters)
    if (known.name == parameter || without_blanks(known.name) == without_blanks(parameter))
      return &known;
  return nullptr;
}

std::string AbaqusBlock::value(std::string_view parameter) const {
  const Parameter* known = find(parameter);
  return known == nullptr ? std::string() : known->value;
}

std::string AbaqusBlock::required(std::string_view parameter) const {
  const Parameter* known = find(parameter);
  if (known == nullptr || known->value.empty())
    throw CardError{fmt::format("{} = ... is missing", parameter)};
  return known->value;
}

std::string AbaqusBlock::required_as_given(std::string_view parameter) const {
  (void)required(parameter);
  return find(parameter)->as_given;
}

std::vector<AbaqusBlock> read_abaqus_keywords(DeckFiles& files, const std::filesystem::path& path,
                                              DeckLog& log, const KeywordFilter& is_read) {
  return KeywordSplitter(files, log, is_read).split(path);
}

long abaqus_label(std::string_view text, const char* what) {
  const auto value = to_integer(text);
  if (!value || *value < 1 || *value > 999999999)
    throw CardError{fmt::format("\"{}\" as {} is no number from 1 to 999999999", text, what)};
  return *value;
}

long abaqus_integer(std::string_view text, const char* what) {
  const auto value = to_integer(text);
  if (!value) throw CardError{fmt::format("\"{}\" as {} is no whole number", text, what)};
  return *value;
}

double abaqus_real(const std::vector<std::string_view>& fields, std::size_t i, const char* what) {
  if (i >= fields.size() || fields[i].empty())
    throw CardError{fmt::format("the {} is missing", what)};
  const auto value = to_real(fields[i]);
  if (!value) throw CardError{fmt::format("\"{}\" as {} is no finite number", fields[i], what)};
  return *value;
}

double abaqus_real(const std::vector<std::string_view>& fields, std::size_t i, const char* what,
                   double otherwise) {
  return i < fields.size() && !fields[i].empty() ? abaqus_real(fields, i, what) : otherwise;
}

}  // namespace blocklift::structure
