#pragma once

#include <string>
#include <vector>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// The share of a limiting significant height up to which a lift may be done by a forecast, since
/// forecasts are not exact (the alpha factor of DNV-ST-N001): one number, or by the height from a
/// row of a table. Between the heights of a row it is linear, below the lowest and above the
/// highest one it is theirs.
class AlphaFactor {
 public:
  AlphaFactor(double same = 1) : heights_{0}, factors_{same} {}
  /// @param heights of the row, m, ascending, one at least. @param factors one each.
  /// @param row_period the longest planned period that the row holds for, h. @param planned_period
  /// that of the operation, h, by which the row is chosen. @param contingency time for what goes
  /// wrong, h, which the row does not count.
  AlphaFactor(std::vector<double> heights, std::vector<double> factors, double row_period,
              double planned_period, double contingency = 0);

  /// @param limiting_height of the operation in a sea, m.
  double at(double limiting_height) const;
  bool is_of_table() const { return row_period_ > 0; }
  /// Of a table, h: the longest planned period that the row holds for.
  double row_period() const { return row_period_; }
  double planned_period() const { return planned_period_; }
  double contingency() const { return contingency_; }
  /// How long a window has to last, h: planned period and contingency (DNV-ST-N001).
  double reference_period() const { return planned_period_ + contingency_; }
  /// "alpha 0.71", or "alpha from 0.65 to 0.79, by the height, of operations up to 24 h".
  std::string text() const;

 private:
  std::vector<double> heights_, factors_;
  double row_period_ = 0, planned_period_ = 0, contingency_ = 0;
};

/// The factor that the limits of a study ask for. A table is a CSV file beside it with the columns
/// operation_period_h, significant_height_m and alpha, each period with each height; its row is
/// that of the shortest period which is not shorter than the planned one.
/// @throws InputError with file and line if the table cannot be used, or ends before the planned
///   period.
AlphaFactor read_alpha_factor(const StudyFile& study);

}  // namespace blocklift::pipeline
