#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/processes/worker_process.h"
#include "structure/process_group.h"

namespace blocklift::pipeline {

/// The workers of a study: those of this process and, where a launcher has started several
/// (`mpirun -n N`), those of the others, which follow. An order goes to whichever worker is free;
/// what is lost with a worker, or with a whole process where the launcher bears that, goes to
/// another.
class SweepTeam {
 public:
  /// @param group of several processes, which all but this one follow; null: this one is alone.
  /// @param arguments by which a worker is started. @param workers of each process.
  SweepTeam(const structure::ProcessGroup* group, std::vector<std::string> arguments, int workers);
  /// Ends all workers.
  ~SweepTeam();
  SweepTeam(const SweepTeam&) = delete;
  SweepTeam& operator=(const SweepTeam&) = delete;

  /// How many workers there are in all.
  int size() const;

  /// Has all orders done, in any sequence.
  /// @param take is given each order's number among them, and the text that answers it, once.
  /// @returns false if workers were lost again and again.
  /// @throws std::runtime_error of what failed, InputError of what was refused.
  bool run(const std::vector<WorkOrder>& orders,
           const std::function<void(int order, const std::string& text)>& take,
           const std::function<void()>& meanwhile);

 private:
  struct Slot;
  struct Run;

  void hand_out(Run& run);
  void give(Slot& slot, int order, const WorkOrder& what);
  void take_own_answers(Run& run);
  void take_posted(Run& run);
  void take_answer(Run& run, Slot& slot, int order, const WorkAnswer& answer);
  void watch_others(Run& run);
  void wait() const;

  const structure::ProcessGroup* group_;
  std::vector<std::string> arguments_;
  std::vector<WorkerProcess> own_;
  std::vector<Slot> slots_;                                   ///< of all processes
  std::vector<std::chrono::steady_clock::time_point> heard_;  ///< last word of each process
  std::vector<bool> is_lost_;
  std::chrono::steady_clock::time_point last_word_;  ///< of this process to the others
  int runs_ = 0;                                     ///< answers to an earlier run are late
};

/// What every process of a group but the first does: computes what it is told to, of one team after
/// another.
/// @returns false if the first falls silent.
bool follow_sweep_teams(const structure::ProcessGroup& group);
/// Ends what the others do. Where one was lost, nobody waits for the others at the program's end.
void let_followers_leave(const structure::ProcessGroup& group);

}  // namespace blocklift::pipeline
