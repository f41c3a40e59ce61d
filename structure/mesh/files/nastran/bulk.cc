#include "structure/mesh/files/nastran/bulk.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// One line of bulk data.
struct Line {
  SourceLine place;
  std::string_view name;  ///< the first field, as it stands
  std::array<std::string_view, 8> data;
  std::size_t count = 8;   ///< 4 for large fields
  std::string_view label;  ///< the last field: what the next line may name
  bool is_large() const { return count == 4; }
  bool is_continuation() const {
    return name.empty() || name.front() == '+' || name.front() == '*';
  }
};

/// Both sides of a continuation leave out signs and asterisks.
std::string_view bare(std::string_view label) {
  while (!label.empty() && (label.front() == '+' || label.front() == '*')) label.remove_prefix(1);
  return trimmed(label);
}

/// The first character of a card's last field stands for its sign, whatever it is: "ABC1" is
/// continued by "+BC1". Source: MSC Nastran Quick Reference Guide, format of bulk data entries.
std::string_view behind_first(std::string_view label) {
  return label.empty() ? label : trimmed(label.substr(1));
}

bool is_continued_by(std::string_view label, std::string_view wanted) {
  return is_same(bare(label), wanted) || is_same(behind_first(label), wanted);
}

std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') quoted = !quoted;
    if (line[i] == '$' && !quoted) return line.substr(0, i);
  }
  return line;
}

bool begins_with(std::string_view line, std::string_view word) {
  return line.size() >= word.size() && is_same(line.substr(0, word.size()), word);
}

bool is_begin(std::string_view line) {
  return begins_with(line, "BEGIN") && line.size() > 5 && (line[5] == ' ' || line[5] == '\t');
}

/// Titles of case control end with their line, also those that end in a comma.
bool is_title(std::string_view line) {
  return begins_with(line, "TITLE") || begins_with(line, "SUBTITLE") || begins_with(line, "LABEL");
}

class Splitter {
 public:
  Splitter(DeckFiles& files, DeckLog& log) : files_(files), log_(log) {}

  NastranBulk split(const std::filesystem::path& path) {
    const DeckFiles::File& file = files_.open(path);
    const bool has_begin =
        std::any_of(file.lines.begin(), file.lines.end(),
                    [](std::string_view line) { return is_begin(trimmed(line)); });
    // OptiStruct's decks have no executive section.
    const bool has_executive =
        std::any_of(file.lines.begin(), file.lines.end(),
                    [](std::string_view line) { return begins_with(trimmed(line), "CEND"); });
    section_ = !has_begin      ? Section::bulk
               : has_executive ? Section::executive
                               : Section::case_control;
    bulk_.has_case_control = has_begin;
    bulk_.data.reserve(file.lines.size() * 8);
    bulk_.cards.reserve(file.lines.size());
    read(file);
    if (section_ != Section::end) note_missing_end(file);
    place_orphans();
    return std::move(bulk_);
  }

 private:
  enum class Section { executive, case_control, bulk, end };

  void read(const DeckFiles::File& file) {
    for (std::size_t i = 0; i < file.lines.size() && section_ != Section::end; ++i) {
      const SourceLine place{file.number, static_cast<int>(i) + 1};
      std::string_view line = file.lines[i];
      if (!line.empty() && line.front() == '$') {
        note_name(line);
        continue;
      }
      line = without_comment(line);
      const std::string_view text = trimmed(line);
      if (text.empty()) continue;
      if (begins_with(text, "INCLUDE") && (text.size() == 7 || text[7] == ' ' || text[7] == '\'' ||
                                           text[7] == '"' || text[7] == '\t')) {
        include(file, i);
        continue;
      }
      try {
        read_line(place, line, text);
      } catch (const CardError& error) {
        log_.complain(place, error.text);
      }
    }
    files_.close();
  }

  // Some programs write no ENDDATA; but where the last line of a whole deck, too, is without its
  // end, the file is not all there.
  void note_missing_end(const DeckFiles::File& file) {
    const SourceLine last{file.number, static_cast<int>(file.lines.size())};
    if (file.is_ended || !bulk_.has_case_control)
      log_.remark(last, "the deck has no ENDDATA: is it all there?");
    else
      log_.complain(last, "the deck is cut off: it has no ENDDATA, and its last line no end");
  }

  void read_line(SourceLine place, std::string_view line, std::string_view text) {
    if (section_ == Section::executive) {
      if (begins_with(text, "CEND")) section_ = Section::case_control;
      if (is_begin(text)) begin_bulk(text);
    } else if (section_ == Section::case_control) {
      if (is_begin(text))
        begin_bulk(text);
      else if (!is_continued_)
        bulk_.case_control.push_back({place, text});
      is_continued_ = text.ends_with(',') && !is_title(text);
    } else if (begins_with(text, "ENDDATA")) {
      section_ = Section::end;
    } else if (is_begin(text)) {
      throw CardError{"a second BEGIN: superelements cannot be lifted"};
    } else {
      add(parts_of(place, line));
    }
  }

  void begin_bulk(std::string_view text) {
    section_ = Section::bulk;
    if (upper(text).find("BULK") == std::string::npos)
      throw CardError{fmt::format("\"{}\": superelements and parts are not known", text)};
  }

  // $HMNAME PROP   4"name" 4   and   $ Femap Property 5 : name
  void note_name(std::string_view line) {
    if (begins_with(line, "$HMNAME PROP")) {
      const auto quote = line.find('"');
      const auto end = quote == std::string_view::npos ? quote : line.find('"', quote + 1);
      if (end == std::string_view::npos) return;
      if (const auto number = to_integer(trimmed(line.substr(12, quote - 12))))
        bulk_.names[{"PROP", *number}] = std::string(line.substr(quote + 1, end - quote - 1));
    } else if (begins_with(line, "$ Femap Property ")) {
      const auto colon = line.find(':');
      if (colon == std::string_view::npos) return;
      if (const auto number = to_integer(trimmed(line.substr(17, colon - 17))))
        bulk_.names[{"PROP", *number}] = std::string(trimmed(line.substr(colon + 1)));
    }
  }

  void include(const DeckFiles::File& file, std::size_t& i) {
    const SourceLine place{file.number, static_cast<int>(i) + 1};
    log_.read("INCLUDE", place);
    std::string name(trimmed(trimmed(file.lines[i]).substr(7)));
    const char quote =
        !name.empty() && (name.front() == '\'' || name.front() == '"') ? name.front() : '\0';
    if (quote != '\0') {
      while (name.find(quote, 1) == std::string::npos && i + 1 < file.lines.size())
        name += trimmed(file.lines[++i]);
      const auto end = name.find(quote, 1);
      if (end == std::string::npos) {
        log_.complain(place, "INCLUDE: the name of the file has no closing quote");
        return;
      }
      name = name.substr(1, end - 1);
    } else {
      name = std::string(trimmed(without_comment(name)));
    }
    std::replace(name.begin(), name.end(), '\\', '/');
    try {
      read(files_.open_included(std::string(trimmed(name)), file));
      log_.use("INCLUDE");
    } catch (const CardError& error) {
      // Before the bulk data it brings commands to the solver.
      if (section_ == Section::executive || section_ == Section::case_control)
        log_.leave_out("INCLUDE", "commands to the solver in a file that is not there");
      else
        log_.complain(place, "INCLUDE: " + error.text);
    }
  }

  std::string_view laid_out(std::string_view line) {
    if (line.find('\t') == std::string_view::npos) return line;
    std::string& kept = bulk_.kept.emplace_back();
    for (const char c : line) {
      if (c == '\t')
        kept.append(8 - kept.size() % 8, ' ');
      else
        kept += c;
    }
    return kept;
  }

  Line parts_of(SourceLine place, std::string_view line) {
    Line parts;
    parts.place = place;
    if (line.find(',') != std::string_view::npos) {
      split_free(line, parts);
      return parts;
    }
    line = laid_out(line);
    const auto column = [&](std::size_t from, std::size_t width) {
      return from < line.size() ? trimmed(line.substr(from, width)) : std::string_view();
    };
    parts.name = column(0, 8);
    parts.count = parts.name.find('*') != std::string_view::npos ? 4 : 8;
    const std::size_t width = 64 / parts.count;
    for (std::size_t i = 0; i < parts.count; ++i) parts.data[i] = column(8 + i * width, width);
    parts.label = column(72, 8);
    return parts;
  }

  static void split_free(std::string_view line, Line& parts) {
    std::size_t begin = 0;
    for (std::size_t field = 0;; ++field) {
      const std::size_t comma = line.find(',', begin);
      const std::string_view text =
          trimmed(line.substr(begin, comma == std::string_view::npos ? comma : comma - begin));
      if (field == 0) {
        parts.name = text;
        parts.count = text.find('*') != std::string_view::npos ? 4 : 8;
      } else if (field <= parts.count) {
        parts.data[field - 1] = text;
      } else if (field == parts.count + 1 && !is_number(text)) {
        parts.label = text;
      } else if (!text.empty()) {
        throw CardError{
            fmt::format("a line of free fields has more than {} fields of data", parts.count)};
      }
      if (comma == std::string_view::npos) {
        take_early_label(field, parts);
        return;
      }
      begin = comma + 1;
    }
  }

  static bool is_number(std::string_view text) {
    return !text.empty() && text.front() != '+' && to_real(text);
  }

  /// A line may end in its label before all fields are there: "+" and a word are no datum.
  static void take_early_label(std::size_t field, Line& parts) {
    if (field < 1 || field > parts.count) return;
    std::string_view& last = parts.data[field - 1];
    if (last.empty() || (last.front() != '+' && last.front() != '*') || to_real(last)) return;
    parts.label = last;
    last = {};
  }

  void add(const Line& line) {
    if (!line.is_continuation()) {
      start(line);
      return;
    }
    const std::string_view wanted = bare(line.name);
    const bool follows =
        !bulk_.cards.empty() && (wanted.empty() || is_continued_by(label_, wanted));
    if (follows) {
      extend(line);
    } else if (wanted.empty()) {
      throw CardError{"a line continues no card"};
    } else if (!orphans_.try_emplace(upper(wanted), line).second) {
      throw CardError{fmt::format("a second line continues \"{}\"", wanted)};
    }
  }

  void start(const Line& line) {
    finish();
    std::string name = upper(trimmed(line.name.substr(0, line.name.find('*'))));
    if (name.empty() || !(name.front() >= 'A' && name.front() <= 'Z')) {
      // What follows is no continuation of the card before.
      bulk_.cards.push_back({"", line.place, bulk_.data.size(), 0});
      throw CardError{fmt::format("\"{}\" is no name of a card", line.name)};
    }
    bulk_.cards.push_back({std::move(name), line.place, bulk_.data.size(), 0});
    label_ = {};
    half_ = false;
    extend(line);
  }

  void append(const Line& line) {
    NastranCard& card = bulk_.cards.back();
    // A large line is half of eight fields; where the other half is left out, it is blank.
    if (half_ && !line.is_large()) {
      for (int i = 0; i < 4; ++i) bulk_.data.emplace_back();
      half_ = false;
    } else if (line.is_large()) {
      half_ = !half_;
    }
    for (std::size_t i = 0; i < line.count; ++i) bulk_.data.push_back(line.data[i]);
    card.count = bulk_.data.size() - card.first;
  }

  void extend(const Line& line) {
    append(line);
    label_ = line.label;
  }

  /// The card so far ends in a label that no line followed: it may stand elsewhere.
  void finish() {
    if (!bulk_.cards.empty() && !bare(label_).empty())
      awaiting_.emplace_back(bulk_.cards.size() - 1, label_, half_);
  }

  auto orphan_of(std::string_view label) {
    const auto found = orphans_.find(upper(bare(label)));
    return found != orphans_.end() ? found : orphans_.find(upper(behind_first(label)));
  }

  void place_orphans() {
    finish();
    for (const auto& [index, label, half] : awaiting_) {
      auto found = orphan_of(label);
      if (found == orphans_.end()) continue;
      // The card moves to the end of all data, where it can grow.
      NastranCard card = bulk_.cards[index];
      const auto first = bulk_.data.size();
      for (std::size_t i = 0; i < card.count; ++i) {
        const std::string_view field = bulk_.data[card.first + i];
        bulk_.data.push_back(field);
      }
      card.first = first;
      bulk_.cards.push_back(card);
      half_ = half;
      while (found != orphans_.end()) {
        const Line line = found->second;
        orphans_.erase(found);
        append(line);
        found = orphan_of(line.label);
      }
      bulk_.cards[index] = bulk_.cards.back();
      bulk_.cards.pop_back();
    }
    for (const auto& [label, line] : orphans_)
      log_.complain(line.place,
                    fmt::format("a line continues \"{}\", which no card ends in", label));
  }

  DeckFiles& files_;
  DeckLog& log_;
  NastranBulk bulk_;
  bool is_continued_ = false;  ///< the line of case control before
  Section section_ = Section::bulk;
  std::string_view label_;  ///< last field of the line before
  bool half_ = false;       ///< the card before has half of eight fields
  std::vector<std::tuple<std::size_t, std::string_view, bool>> awaiting_;
  std::unordered_map<std::string, Line> orphans_;
};

}  // namespace

NastranBulk read_nastran_cards(DeckFiles& files, const std::filesystem::path& path, DeckLog& log) {
  return Splitter(files, log).split(path);
}

}  // namespace blocklift::structure
