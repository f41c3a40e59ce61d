#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What a worker of a study is told to compute.
struct WorkOrder {
  enum class Kind { member, blocks };
  Kind kind = Kind::member;
  int number = 0;  ///< of the member; of blocks the first
  int of = 1;      ///< blocks: every so-many-th from the first on
};

/// What came of an order.
struct WorkAnswer {
  enum class Kind : char {
    done = 'd',     ///< the text is the member's
    failed = 'f',   ///< the text says why; another worker would fail as well
    refused = 'r',  ///< the text says why: the input is not the study's
    lost = 'l'      ///< the worker ended before it had an answer
  };
  Kind kind = Kind::lost;
  std::string text;
};

/// A process of this program that computes one order after another. It is started with its first
/// order, again after it was lost, and ends with this object or this process, whatever it is at.
/// After blocks it ends, too: they take much memory, which an end gives back.
class WorkerProcess {
 public:
  /// @param arguments of this program, from its name on.
  explicit WorkerProcess(std::vector<std::string> arguments);
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) = delete;

  /// @throws std::runtime_error if no process can be started.
  void give(const WorkOrder& order);
  /// The answer to the order, once it is there; does not wait.
  std::optional<WorkAnswer> take_answer();
  /// What tells poll(2) that there may be an answer; -1: nothing is asked.
  int descriptor() const { return order_ ? socket_ : -1; }

 private:
  void start();
  void end();

  std::vector<std::string> arguments_;
  pid_t process_ = -1;
  int socket_ = -1;
  std::optional<WorkOrder> order_;
  std::string received_;
};

/// The other end, in the worker: answers orders until there are no more.
/// @param compute gives the text of an answer; what it throws, but for a lack of memory, is the
/// answer too: std::invalid_argument refuses the order.
void answer_orders(const std::function<std::string(const WorkOrder&)>& compute);

/// Runs this program with other arguments; true if it ends as it should. Not as a process of a
/// group that this one is of.
bool run_this_program(std::vector<std::string> arguments, const std::function<void()>& meanwhile);

}  // namespace blocklift::pipeline
