#include "structure/mesh/files/deck/log.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "structure/nearest_name.h"

namespace blocklift::structure {

namespace {

/// " (did you mean X?)"; nothing where no name is near.
std::string question(const std::string& meant) {
  return meant.empty() ? std::string() : fmt::format(" (did you mean {}?)", meant);
}

}  // namespace

int DeckLog::add_file(const std::string& path) {
  files_.push_back(path);
  return static_cast<int>(files_.size()) - 1;
}

std::string DeckLog::place(SourceLine line) const {
  return fmt::format("{}:{}", files_[line.file], line.line);
}

void DeckLog::complain(SourceLine line, const std::string& text) {
  const auto [found, is_new] = complaint_of_.try_emplace(text, complaints_.size());
  if (is_new) {
    complaints_.push_back({line, text});
    return;
  }
  // What several elements need is read, and found wrong, several times.
  Complaint& known = complaints_[found->second];
  if (line.file != known.line.file || line.line != known.line.line) ++known.count;
}

void DeckLog::remark(SourceLine line, const std::string& text) {
  const auto [found, is_new] = remark_of_.try_emplace(text, remarks_.size());
  if (is_new)
    remarks_.push_back({line, text});
  else
    ++remarks_[found->second].count;
}

LedgerEntry& DeckLog::entry(std::string_view name) {
  const auto found = ledger_.find(name);
  if (found != ledger_.end()) return found->second;
  LedgerEntry& entry = ledger_[std::string(name)];
  entry.name = name;
  return entry;
}

void DeckLog::read(std::string_view name, SourceLine line) {
  LedgerEntry& card = entry(name);
  if (card.read++ == 0) card.place = place(line);
}

void DeckLog::leave_out(std::string_view name, const std::string& reason) {
  LedgerEntry& card = entry(name);
  if (card.left_out.empty()) card.left_out = reason;
}

void DeckLog::leave_out_wish(std::string_view name, const std::string& reason) {
  leave_out(name, reason);
  entry(name).is_wish = true;
}

bool DeckLog::leaves_out(const std::string& name, const DeckOptions& options) {
  const bool is_asked =
      std::any_of(options.leave_out.begin(), options.leave_out.end(),
                  [&](const std::string& asked) { return asked == name || "*" + asked == name; });
  if (is_asked) missed_.insert(name);
  return is_asked;
}

void DeckLog::miss(SourceLine line, const std::string& name, const DeckOptions& options,
                   const std::vector<std::string>& known, std::string_view instead) {
  if (leaves_out(name, options)) {
    leave_out(name, "as was asked for");
    return;
  }
  if (name.find(' ') != std::string::npos && !name.starts_with('*')) {
    complain(line, fmt::format("the line has a comma, so that its fields end at commas, and \"{}\" "
                               "is the name of no card",
                               name));
    return;
  }
  const auto [found, is_new] = unknown_.try_emplace(name);
  if (!instead.empty()) {
    complain(line, fmt::format("{}: {}; leave_out names what may be missing", name, instead));
    return;
  }
  if (is_new) found->second = question(nearest_name(name, known));
  complain(line,
           fmt::format("{} {} is not known here{}: what it says would be missing from the "
                       "model; leave_out names what may be missing",
                       name.starts_with('*') ? "the keyword" : "the card", name, found->second));
}

void DeckLog::check_left_out(const DeckOptions& options) {
  std::vector<std::string> unknown;
  for (const auto& [name, meant] : unknown_)
    unknown.push_back(name.starts_with('*') ? name.substr(1) : name);
  for (const std::string& asked : options.leave_out) {
    if (missed_.contains(asked) || missed_.contains("*" + asked)) continue;
    const bool is_known = ledger_.contains(asked) || ledger_.contains("*" + asked);
    complain({}, fmt::format(
                     "leave_out names {}, which {}", asked,
                     is_known ? "is known here: only what is not can be left out"
                              : "the deck does not have" + question(nearest_name(asked, unknown))));
  }
}

void DeckLog::check() const {
  if (complaints_.empty()) return;
  std::vector<Complaint> sorted = complaints_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Complaint& a, const Complaint& b) {
    return std::pair(a.line.file, a.line.line) < std::pair(b.line.file, b.line.line);
  });
  std::vector<std::string> texts;
  for (const Complaint& complaint : sorted) {
    texts.push_back(fmt::format("{}: error: {}", place(complaint.line), complaint.text));
    if (complaint.count > 1) texts.back() += fmt::format(" ({} times)", complaint.count);
  }
  throw DeckError(std::move(texts));
}

void DeckLog::hand_over(Deck& deck) {
  for (auto& [name, card] : ledger_) {
    // What a part has is in the model once for each of its instances.
    card.used = std::min(card.used, card.read);
    deck.ledger.push_back(std::move(card));
  }
  for (const Complaint& remark : remarks_)
    deck.remarks.push_back({place(remark.line), remark.text, remark.count});
}

}  // namespace blocklift::structure
