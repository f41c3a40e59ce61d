#include "pipeline/formats/clock_time.h"

#include <algorithm>
#include <cctype>
#include <chrono>

namespace blocklift::pipeline {
namespace {

/// Takes a text from its front, a piece after another; nothing is taken where a piece is not there.
class Pieces {
 public:
  explicit Pieces(std::string_view text) : text_(text) {}

  bool is_done() const { return text_.empty(); }
  bool take(std::string_view one_of) {
    if (text_.empty() || one_of.find(text_.front()) == std::string_view::npos) return false;
    last_ = text_.front();
    text_.remove_prefix(1);
    return true;
  }
  char last() const { return last_; }
  /// A number of exactly so many digits.
  std::optional<int> digits(std::size_t count) {
    if (text_.size() < count ||
        !std::all_of(text_.begin(), text_.begin() + static_cast<long>(count), is_digit))
      return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) value = 10 * value + (text_[i] - '0');
    text_.remove_prefix(count);
    return value;
  }
  /// Digits behind a decimal sign.
  double fraction() {
    double value = 0;
    for (double unit = 0.1; !text_.empty() && is_digit(text_.front()); unit /= 10) {
      value += unit * (text_.front() - '0');
      text_.remove_prefix(1);
    }
    return value;
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  std::string_view text_;
  char last_ = 0;
};

/// Days since 1970 of "2026-05-04" or "04.05.2026"; the pieces are behind it then.
std::optional<double> take_date(Pieces& pieces) {
  Pieces ahead = pieces;
  std::optional<int> year = ahead.digits(4), month, day;
  const bool year_first = year.has_value();
  if (year_first) {
    if (!ahead.take("-")) return std::nullopt;
    month = ahead.digits(2);
    if (!ahead.take("-")) return std::nullopt;
    day = ahead.digits(2);
  } else {
    day = ahead.digits(2);
    if (!ahead.take(".")) return std::nullopt;
    month = ahead.digits(2);
    if (!ahead.take(".")) return std::nullopt;
    year = ahead.digits(4);
  }
  if (!year || !month || !day || !ahead.take("T ")) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  pieces = ahead;
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

}  // namespace

std::optional<ClockTime> read_clock_time(std::string_view text) {
  Pieces pieces(text);
  ClockTime result;
  constexpr double day = 86400, hour = 3600, minute = 60;
  if (const std::optional<double> date = take_date(pieces)) {
    result.has_date = true;
    result.seconds = day * *date;
  }
  const std::optional<int> hours = pieces.digits(2);
  if (!hours || *hours > 23 || !pieces.take(":")) return std::nullopt;
  const std::optional<int> minutes = pieces.digits(2);
  if (!minutes || *minutes > 59) return std::nullopt;
  double seconds = 0;
  if (pieces.take(":")) {
    const std::optional<int> whole = pieces.digits(2);
    if (!whole || *whole > 59) return std::nullopt;
    seconds = *whole;
    if (pieces.take(".,")) seconds += pieces.fraction();
  }
  result.seconds += hour * *hours + minute * *minutes + seconds;
  if (pieces.take("Z")) {
    result.has_zone = true;
  } else if (pieces.take("+-")) {
    const double sign = pieces.last() == '-' ? -1 : 1;
    const std::optional<int> ahead = pieces.digits(2);
    pieces.take(":");
    const std::optional<int> more = pieces.is_done() ? 0 : pieces.digits(2);
    if (!ahead || *ahead > 14 || !more || *more > 59) return std::nullopt;
    result.has_zone = true;
    result.seconds -= sign * (hour * *ahead + minute * *more);
  }
  if (!pieces.is_done()) return std::nullopt;
  return result;
}

}  // namespace blocklift::pipeline
