#pragma once

#include <string>
#include <vector>

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics {

/// Which equations of the loops repeat others, which only do so in the present position, and which
/// drives they forbid.
struct LoopDiagnosis {
  /// A row that says nothing new: it is this combination of rows before it (none: the tree's joints
  /// hold it already).
  struct Redundancy {
    struct Part {
      int row = -1;
      double factor = not_a_number;
    };
    int row = -1;
    std::vector<Part> repeats = {};
  };
  /// Driven velocities that the loops allow together in a fixed proportion only, or not at all.
  struct Conflict {
    std::vector<int> velocities = {};
    std::vector<int> rows = {};  ///< rows that no free velocity can satisfy
    bool none_can_move = false;
  };

  int row_count = 0;
  int rank = 0;                ///< independent rows, in general (next to this position)
  int degrees_of_freedom = 0;  ///< free velocities less rank
  std::vector<Redundancy> redundant = {};
  std::vector<int> toggled =
      {};  ///< rows that repeat others in this position only: a toggle position
  std::vector<Conflict> conflicts = {};

  /// One sentence for each finding, in words; empty where all is well.
  std::vector<std::string> sentences(const Mechanism& mechanism) const;
  std::vector<std::string> toggle_sentences(const Mechanism& mechanism) const;
  std::vector<std::string> conflict_sentences(const Mechanism& mechanism) const;
};

/// Examines the loops at a configuration q (nq) that closes them (see assemble). Rows are judged in
/// the order of the loops, so that of two that say the same the later one is named.
LoopDiagnosis diagnose_loops(const Mechanism& mechanism, ConstVectorRef q);

}  // namespace blocklift::dynamics
