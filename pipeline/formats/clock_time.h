#pragma once

#include <optional>
#include <string_view>

namespace blocklift::pipeline {

/// An instant as loggers write it.
struct ClockTime {
  double seconds = 0;     ///< since the midnight of its day or, with a date, since 1970 began, s
  bool has_date = false;  ///< of the Gregorian calendar
  bool has_zone = false;  ///< the instant is one of UTC
};

/// Reads "2026-05-04T10:00:00.5Z", "2026-05-04 12:00:00,5+02:00", "04.05.2026 10:00:00" or
/// "10:00:00.5" (ISO 8601, the date with a blank in place of the T and with points in place of
/// dashes as well; seconds, their fraction and the zone may be left out). With a zone the instant
/// is taken to UTC; leap seconds are not counted.
/// @returns nothing if the text is anything else, or a day or an hour that there is not.
std::optional<ClockTime> read_clock_time(std::string_view text);

}  // namespace blocklift::pipeline
