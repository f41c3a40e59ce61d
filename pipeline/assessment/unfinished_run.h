#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "structure/stopwatch.h"

namespace blocklift::pipeline {

/// One of the things on which a run's figures depend to their last bit.
struct RunTrait {
  std::string what;  ///< "input"
  std::string is;    ///< its fingerprint, or its name; one line
};

/// What a run has done so far, kept beside its results until they are in place, so that a run that
/// is stopped can be gone on with. It lies in a hidden folder and is never taken for results.
///
/// A part is kept only if the work since the last one is worth it: keep_after() seconds. What
/// cannot be kept (a full disk, say) is done again instead.
class UnfinishedRun {
 public:
  /// @param results the folder of the results; it need not exist.
  UnfinishedRun(const std::filesystem::path& results, std::vector<RunTrait> traits);

  /// The traits in which an earlier run that was stopped here differs: its parts are of no use to
  /// this one. Empty if there is none, or it was the same run.
  const std::vector<std::string>& differences() const { return differences_; }
  /// Names of the parts that can be used.
  std::vector<std::string> parts() const;

  /// A part of the earlier run; none if it was not kept, or not whole.
  std::optional<std::string> find(const std::string& part) const;
  /// Has this run done enough since it began, or kept something?
  bool is_due() const;
  /// Keeps a part in place of an earlier one of its name.
  void keep(const std::string& part, const std::string& bytes);
  /// Removes all parts, of whichever run: the results are in place.
  void forget();

  /// Seconds of work that are worth keeping: 10, or what BLOCKLIFT_KEEP_AFTER says.
  static double keep_after();

 private:
  std::string identity() const;

  std::filesystem::path folder_;
  std::vector<RunTrait> traits_;
  std::vector<std::string> differences_;
  bool is_of_this_run_ = false;  ///< is what lies there?
  structure::Stopwatch since_kept_;
};

}  // namespace blocklift::pipeline
