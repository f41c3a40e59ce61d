#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/limits/alpha_factor.h"
#include "pipeline/study/members/members.h"

namespace blocklift::pipeline {

/// How a limiting wave height is known.
enum class LimitKind {
  found,           ///< between two heights that were run
  below_grid,      ///< the lowest height is too much already: it is taken as zero
  above_grid,      ///< the highest height is allowed: the limit is at least that
  before_failure,  ///< the height above could not be computed: the limit is at least this one
  unknown  ///< the lowest height could not be computed: nothing is known, and nothing allowed
};

/// "found", "below the grid", "above the grid", "before a failure", "unknown".
const char* name_of(LimitKind kind);

/// The significant height at which a quantity reaches its limit.
struct LimitingHeight {
  double height = 0;  ///< m
  LimitKind kind = LimitKind::found;
};

/// Goes up through heights to where a quantity passes its limit, linear between.
/// @param heights ascending, m. @param values of the quantity there; not a number: it is not known.
/// @param worse_when_smaller the limit is the least that is allowed.
LimitingHeight find_limiting_height(const std::vector<double>& heights,
                                    const std::vector<double>& values, double limit,
                                    bool worse_when_smaller);

/// Limiting heights over peak period and heading.
struct LimitingSeas {
  std::vector<double> periods;          ///< s, ascending
  std::vector<double> headings;         ///< rad, ascending; one, zero, if the study varies none
  std::vector<LimitingHeight> heights;  ///< the least of all quantities; headings of a period
  /// Path of the quantity that it is of; empty where none reaches its limit, or a failure ends what
  /// is known.
  std::vector<std::string> governing;
  std::vector<std::string> quantities;
  std::vector<int> failed = {};  ///< number of the member that ends what is known; -1: none does

  const LimitingHeight& at(std::size_t period, std::size_t heading) const {
    return heights[period * headings.size() + heading];
  }
  /// Do the headings go all the way round?
  bool go_round() const;
  /// Between the grid's periods and headings, linear; zero beyond the periods and beside a limit
  /// that is unknown, where nothing is known. Headings go round where the grid does, and are zero
  /// beyond them elsewhere.
  double height_at(double period, double heading) const;
  /// Does the grid hold a period, or a heading?
  bool has_period(double period) const;
  bool has_heading(double heading) const;
};

/// Of each sea state the worst of its seeds counts.
/// @throws std::runtime_error if a quantity is not in any member.
LimitingSeas find_limiting_seas(const StudyFile& study, const Eigen::MatrixXd& design,
                                const std::vector<Member>& members);

/// A sea state of a scatter table or a forecast.
struct SeaState {
  double height = 0, period = 0, heading = 0;  ///< m, s, rad
  double share = 0;                            ///< of a scatter table: how often it is, any scale
  double time = 0;                             ///< of a forecast, h
};

/// Reads a CSV table whose first line names its columns: significant_height_m, peak_period_s,
/// heading_deg, and share or time_h.
/// @param needs_heading the limits are of several headings: heading_deg may not lack.
/// @throws InputError with file and line.
std::vector<SeaState> read_sea_states(const std::filesystem::path& path, bool is_forecast,
                                      bool needs_heading);

/// Does a study with limits run several headings?
bool varies_heading(const StudyFile& study);

/// A lift's share of the time, or of the forecast its windows, with heights up to alpha times the
/// limit, alpha by that limit. Where the limit is zero or not known no sea is allowed, be it calm.
struct Operability {
  double share = 0;            ///< of the table's shares, or of the forecast's instants
  double beyond_periods = 0;   ///< of them with a period that the study did not run: not allowed
  double beyond_headings = 0;  ///< the same of headings
  double sum = 0;              ///< of the table's shares, or number of instants
  double last = 0;             ///< instant of a forecast, h
  struct Window {
    double begin = 0, end = 0;  ///< h
    /// Does it last as long as a period, h?
    bool holds(double period) const { return end - begin >= period * (1 - 1e-9); }
  };
  std::vector<Window> windows;  ///< of a forecast, from allowed instant to allowed instant
  /// Steps of a forecast above twice their median (the lower of two): what the sea does within is
  /// not known, so that they end windows.
  std::vector<Window> holes;
};
Operability find_operability(const LimitingSeas& seas, const std::vector<SeaState>& states,
                             const AlphaFactor& alpha, bool is_forecast);

/// Limiting heights by period and heading, for a terminal.
std::string limiting_text(const LimitingSeas& seas);
/// Of each sea state whose limit a failed member hides, a sentence.
std::vector<std::string> sentences_of_failures(const LimitingSeas& seas);
/// What a scatter table and a forecast allow, in sentences.
std::vector<std::string> sentences_of_scatter(const Operability& operability,
                                              const AlphaFactor& alpha);
std::vector<std::string> sentences_of_forecast(const Operability& operability,
                                               const AlphaFactor& alpha);

/// Contours of the limit over period and heading; of one heading the limit over the period. SVG;
/// empty of one period.
std::string limiting_contours(const LimitingSeas& seas);
/// The limit round the compass, a curve a period: SVG; empty of one heading.
std::string limiting_polar(const LimitingSeas& seas);

}  // namespace blocklift::pipeline
