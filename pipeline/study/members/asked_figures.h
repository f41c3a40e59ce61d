#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/files/study/study_file.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// The goal of a search and what is subject to bounds.
std::vector<const Located<std::string>*> figures_of_search(const StudyFile& study);

/// What the figures of a study need: of a member's run, and of its summary. Parts of the summary of
/// which it is not known that they need less take everything.
class AskedFigures {
 public:
  /// Those that the study names, its goal and bounds of a search among them; where it names none,
  /// the usual ones (list_figures): loads, natural periods and stress.
  explicit AskedFigures(const StudyFile& study);

  /// The same figures of a run and a summary that have everything.
  AskedFigures among_all() const;
  bool is_among_all() const { return is_among_all_; }

  /// As find_figure takes them; empty: none is named.
  const std::vector<std::string>& paths() const { return paths_; }
  /// Is one of the figures in this part of the summary, by its key?
  bool is_in(std::string_view part) const { return parts_.contains(part); }
  const RunExtent& extent() const { return extent_; }

 private:
  std::vector<std::string> paths_;
  bool is_among_all_ = false;
  std::set<std::string, std::less<>> parts_;
  RunExtent extent_ = RunExtent::tensions();
};

}  // namespace blocklift::pipeline
