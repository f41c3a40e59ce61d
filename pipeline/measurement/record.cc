#include "pipeline/measurement/record.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/series_file.h"

namespace blocklift::pipeline {
namespace {

constexpr std::size_t fewest_rows = 8;

/// "ropes.R1 [kN]" in its two parts.
struct ColumnHead {
  std::string name;
  std::optional<std::string> unit;
};

ColumnHead head_of(const std::string& text) {
  const auto bracket = text.rfind('[');
  if (bracket == std::string::npos || text.back() != ']') return {text, std::nullopt};
  const auto end = text.find_last_not_of(" \t", bracket == 0 ? 0 : bracket - 1);
  return {bracket == 0 || end == std::string::npos ? "" : text.substr(0, end + 1),
          text.substr(bracket + 1, text.size() - bracket - 2)};
}

/// The factor that turns a column's unit into that of the results; complains where there is none.
std::optional<double> factor_of(const ColumnHead& head, const std::string& unit, const Mark& mark,
                                Diagnostics& diagnostics) {
  const std::string due = fmt::format("the unit stands in brackets: \"{} [{}]\"", head.name, unit);
  if (!head.unit) {
    diagnostics.error(mark, fmt::format("the column \"{}\" has no unit", head.name), {due});
    return std::nullopt;
  }
  const std::optional<Measure> own = unit == "1" ? Measure{1, {}} : find_unit(unit);
  try {
    const Measure found = *head.unit == "1" ? Measure{1, {}} : parse_measure("1 " + *head.unit);
    if (own && found.exponents == own->exponents) return found.value / own->value;
    const Exponents mass{0, 1, 0, 0};
    if (unit == "N" && found.exponents == mass) return found.value * newton_per_tonne / 1000;
    diagnostics.error(mark,
                      fmt::format("the column \"{}\" is in {}, which is no unit of what it holds",
                                  head.name, *head.unit),
                      {due + " or another unit of that kind"});
  } catch (const QuantityError& error) {
    diagnostics.error(mark, fmt::format("the column \"{}\": {}", head.name, error.what()), {due});
  }
  return std::nullopt;
}

/// The name of a channel that results.csv calls otherwise: "R1.tension" is "ropes.R1". What is no
/// such name, or might be two channels, is returned as it stands.
std::string name_in_results(const std::string& name, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  std::vector<std::string> meant;
  for (const std::string& one : names) {
    const std::string thing = one.substr(one.find('.') + 1);
    const bool is_drive = one.rfind("drives.", 0) == 0;
    if (name == thing || name == thing + (is_drive ? ".position" : ".tension"))
      meant.push_back(one);
  }
  return meant.size() == 1 ? meant.front() : name;
}

/// Reads one file and says all that is wrong with it.
class RecordReader {
 public:
  RecordReader(const std::filesystem::path& path, const ResultsReader& results,
               Diagnostics& diagnostics)
      : results_(results),
        diagnostics_(diagnostics),
        name_(std::make_shared<const std::string>(shown_path(path))) {
    try {
      file_ = read_series_file(path, SeriesCells::of_loggers);
    } catch (const SeriesFileError& error) {
      complain_about_file(path, error.what());
      is_read_ = false;
    }
    head_ = {name_, std::max(1, file_.lines_before), 1};
  }

  MeasuredRecord read() {
    MeasuredRecord record{*name_, {}, {}};
    if (!is_read_ || !read_time()) return record;
    const std::vector<std::string> names = names_of_channels(results_);
    for (std::size_t i = 0; i < file_.names.size(); ++i)
      if (i != time_column_) read_channel(i, names, record);
    if (record.channels.empty() && !diagnostics_.has_errors())
      diagnostics_.error(head_, "the record has no column beside its time",
                         {names_hint("columns may be", names, "")});
    record.remarks = std::move(remarks_);
    return record;
  }

 private:
  /// Enters a message that begins with the path and, where there is one, the line.
  void complain_about_file(const std::filesystem::path& path, std::string message) {
    Mark mark{name_, 0, 0};
    message.erase(0, std::min(message.size(), path.string().size() + 1));
    std::size_t digits = 0;
    while (digits < message.size() && std::isdigit(static_cast<unsigned char>(message[digits])))
      ++digits;
    if (digits > 0 && digits < 9) {
      mark = {name_, std::stoi(message.substr(0, digits)), 1};
      message.erase(0, std::min(message.size(), digits + 1));
    }
    diagnostics_.error(mark,
                       message.substr(std::min(message.find_first_not_of(' '), message.size())));
  }

  bool read_time() {
    const std::string due = "its first line is to be \"time [s], ropes.R1 [kN], ...\"";
    if (file_.names.empty()) {
      diagnostics_.error({name_, 1, 1}, "the record has no header", {due});
      return false;
    }
    const auto is_time = [](const std::string& text) { return head_of(text).name == "time"; };
    const auto found = std::find_if(file_.names.begin(), file_.names.end(), is_time);
    if (found == file_.names.end()) {
      diagnostics_.error(head_, "the record has no column \"time\"", {due});
      return false;
    }
    time_column_ = static_cast<std::size_t>(found - file_.names.begin());
    time_ = file_.columns[time_column_];
    if (file_.is_clock[time_column_]) {
      if (!count_from_first(head_of(*found))) return false;
    } else {
      const std::optional<double> factor = factor_of(head_of(*found), "s", head_, diagnostics_);
      if (!factor) return false;
      for (double& instant : time_) instant *= *factor;
    }
    if (time_.size() < fewest_rows) {
      diagnostics_.error(head_, fmt::format("the record has {} rows; at least {} are needed",
                                            time_.size(), fewest_rows));
      return false;
    }
    return put_in_order();
  }

  /// Leaves rows without a time of their own out and sorts in those that come late, as long as they
  /// are few: of more it is not known what the clock did.
  bool put_in_order() {
    constexpr std::size_t few_of = 20, latest_at_once = 5;
    std::vector<std::size_t> order;
    std::size_t bad = 0, without_time = 0, late = 0, late_at_once = 0;
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < time_.size(); ++i) {
      const bool is_late = !std::isnan(time_[i]) && time_[i] <= last;
      late_at_once = is_late && time_[i] < last ? late_at_once + 1 : 0;
      if (std::isnan(time_[i]) || is_late) ++bad;
      if (few_of * bad > time_.size() || late_at_once > latest_at_once) {
        complain_about_row(i, last);
        return false;
      }
      if (std::isnan(time_[i])) {
        ++without_time;
        continue;
      }
      late += is_late && time_[i] < last ? 1 : 0;
      last = std::max(last, time_[i]);
      order.push_back(i);
    }
    // A row of the same time as an earlier one is the second of the two after this.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return time_[a] < time_[b]; });
    const std::size_t all = order.size();
    const auto is_same = [&](std::size_t a, std::size_t b) { return time_[a] == time_[b]; };
    order.erase(std::unique(order.begin(), order.end(), is_same), order.end());
    remark(without_time, "had no time and were left out");
    remark(late, "came later than others of a later time and were sorted in");
    remark(all - order.size(), "had the time of an earlier row and were left out");
    take_rows(order);
    return true;
  }

  void remark(std::size_t rows, const char* what) {
    if (rows > 0)
      remarks_.push_back(
          fmt::format("{} of the {} rows of {} {}", rows, time_.size(), *name_, what));
  }

  /// @param last the latest time before the row.
  void complain_about_row(std::size_t i, double last) {
    const Mark row{name_, file_.lines[i], 1};
    if (std::isnan(time_[i])) {
      diagnostics_.error(row, "the row has no time");
      return;
    }
    const std::string hint = "sort the rows by their time, and leave one row for each instant";
    if (time_[i] == last)
      diagnostics_.error(row,
                         fmt::format("the time {:.15g} s is that of an earlier row, as it is too "
                                     "often: time has to rise",
                                     last),
                         {hint, "times with few digits may be rounded to less than a step"});
    else
      diagnostics_.error(row,
                         fmt::format("the time {:.15g} s does not follow {:.15g} s; time has to "
                                     "rise",
                                     time_[i], last),
                         {hint});
  }

  void take_rows(const std::vector<std::size_t>& order) {
    std::vector<double> time;
    for (const std::size_t i : order) time.push_back(time_[i]);
    time_ = std::move(time);
    for (std::vector<double>& column : file_.columns) {
      std::vector<double> values;
      for (const std::size_t i : order) values.push_back(column[i]);
      column = std::move(values);
    }
  }

  /// Instants of a clock become seconds since the record's first; without a date the clock may pass
  /// midnight.
  bool count_from_first(const ColumnHead& head) {
    if (head.unit && *head.unit != "UTC") {
      diagnostics_.error(head_,
                         fmt::format("the column \"{}\" has instants of a clock and the unit {}",
                                     head.name, *head.unit),
                         {"leave the unit out: such instants count in seconds from the first"});
      return false;
    }
    constexpr double day = 86400, nearly_a_day = 0.95 * day;
    const auto is_known = [](double instant) { return !std::isnan(instant); };
    const auto known = std::find_if(time_.begin(), time_.end(), is_known);
    if (known == time_.end()) return true;  // complained of with the rows
    const double first = *known;
    double days = 0, before = first;
    for (double& instant : time_) {
      if (!is_known(instant)) continue;
      if (!file_.has_dates && instant < before - day / 2) days += day;
      // A row of before midnight may come late.
      if (!file_.has_dates && instant > before + nearly_a_day) days -= day;
      before = instant;
      instant += days - first;
    }
    return true;
  }

  void read_channel(std::size_t column, const std::vector<std::string>& names,
                    MeasuredRecord& record) {
    ColumnHead head = head_of(file_.names[column]);
    head.name = name_in_results(head.name, names);
    MeasuredChannel channel{head.name, "", {}};
    for (std::size_t i = 0; i < time_.size(); ++i) {
      if (std::isnan(file_.columns[column][i])) continue;
      channel.series.time.push_back(time_[i]);
      channel.series.values.push_back(file_.columns[column][i]);
    }
    if (!seen_.insert(head.name).second) {
      diagnostics_.error(head_, fmt::format("the column \"{}\" is there twice", head.name));
      return;
    }
    if (head.name == wind_channel) {
      channel.unit = "m/s";
    } else if (head.name == wave_channel) {
      channel.unit = "m";
    } else if (std::find(names.begin(), names.end(), head.name) == names.end()) {
      std::vector<std::string> allowed = names;
      allowed.insert(allowed.end(), {wind_channel, wave_channel});
      diagnostics_.error(
          head_, fmt::format("the results hold no \"{}\" (column {})", head.name, column + 1),
          {names_hint("columns may be", allowed, head.name)});
      return;
    } else {
      channel.unit = read_computed_channel(results_, head.name).unit;
    }
    if (file_.is_clock[column]) {
      diagnostics_.error(head_,
                         fmt::format("the column \"{}\" has instants of a clock", head.name));
      return;
    }
    if (channel.series.size() < fewest_rows) {
      diagnostics_.error(
          head_, fmt::format("the column \"{}\" has {} values; at least {} are needed", head.name,
                             channel.series.size(), fewest_rows));
      return;
    }
    const std::optional<double> factor = factor_of(head, channel.unit, head_, diagnostics_);
    if (!factor) return;
    for (double& value : channel.series.values) value *= *factor;
    record.channels.push_back(std::move(channel));
  }

  const ResultsReader& results_;
  Diagnostics& diagnostics_;
  std::shared_ptr<const std::string> name_;
  SeriesFile file_;
  Mark head_;
  bool is_read_ = true;
  std::size_t time_column_ = 0;
  std::vector<double> time_;
  std::set<std::string> seen_;
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<MeasuredRecord> read_records(const std::vector<std::filesystem::path>& paths,
                                         const ResultsReader& results) {
  Diagnostics diagnostics;
  std::vector<MeasuredRecord> records;
  std::set<std::string> seen;
  for (const std::filesystem::path& path : paths) {
    records.push_back(RecordReader(path, results, diagnostics).read());
    for (const MeasuredChannel& channel : records.back().channels)
      if (!seen.insert(channel.name).second)
        diagnostics.error({std::make_shared<const std::string>(shown_path(path)), 0, 0},
                          fmt::format("\"{}\" is in an earlier record, too", channel.name));
  }
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return records;
}

}  // namespace blocklift::pipeline
