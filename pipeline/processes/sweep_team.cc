#include "pipeline/processes/sweep_team.h"

#include <poll.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/processes/lost_processes.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {
namespace {

using Clock = std::chrono::steady_clock;
using structure::Packet;
using structure::ProcessGroup;

// A member that three workers were lost with is not tried again.
constexpr int most_losses = 3;

/// Words that processes post to one another.
enum class Word : int { begin, order, answer, alive, end, leave };

bool is_past(Clock::time_point moment, double seconds) {
  return Clock::now() - moment > std::chrono::duration<double>(seconds);
}

/// Tells whether this process itself stood still, as all others do that are stopped with it.
class Pause {
 public:
  bool is_over() {
    const bool stood_still = is_past(last_, silence_of_lost() / 2);
    last_ = Clock::now();
    return stood_still;
  }

 private:
  Clock::time_point last_ = Clock::now();
};

Packet packet_of(Word word) {
  Packet packet;
  packet.put(word);
  return packet;
}

}  // namespace

/// A worker of any process.
struct SweepTeam::Slot {
  int rank = 0;
  int place = 0;   ///< among the workers of its process
  int order = -1;  ///< that it is at
};

/// The orders of one call.
struct SweepTeam::Run {
  const std::vector<WorkOrder>& orders;
  const std::function<void(int, const std::string&)>& take;
  std::deque<int> waiting;
  std::vector<int> losses;
  std::vector<bool> is_done;
  std::size_t ended = 0;  ///< done or given up
  int losses_in_a_row = 0;
  bool all_is_well = true;
};

SweepTeam::SweepTeam(const ProcessGroup* group, std::vector<std::string> arguments, int workers)
    : group_(group), arguments_(std::move(arguments)), last_word_(Clock::now()) {
  const int processes = group_ ? group_->size() : 1;
  heard_.assign(processes, Clock::now());
  is_lost_.assign(processes, false);
  for (int place = 0; place < workers; ++place) own_.emplace_back(arguments_);
  // One worker of each process, then a second of each: few members go to many machines.
  for (int place = 0; place < workers; ++place)
    for (int rank = 0; rank < processes; ++rank) slots_.push_back({rank, place, -1});
  Packet begin = packet_of(Word::begin);
  begin.put(workers);
  begin.put(arguments_.size());
  for (const std::string& argument : arguments_) begin.put(argument);
  for (int rank = 1; rank < processes; ++rank) group_->post(rank, begin);
}

SweepTeam::~SweepTeam() {
  for (std::size_t rank = 1; rank < is_lost_.size(); ++rank)
    if (!is_lost_[rank]) group_->post(static_cast<int>(rank), packet_of(Word::end));
}

int SweepTeam::size() const { return static_cast<int>(slots_.size()); }

bool SweepTeam::run(const std::vector<WorkOrder>& orders,
                    const std::function<void(int, const std::string&)>& take,
                    const std::function<void()>& meanwhile) {
  Run run{orders, take, {}, std::vector<int>(orders.size()), std::vector<bool>(orders.size())};
  for (std::size_t order = 0; order < orders.size(); ++order)
    run.waiting.push_back(static_cast<int>(order));
  ++runs_;
  std::fill(heard_.begin(), heard_.end(), Clock::now());
  Pause pause;
  while (run.ended < orders.size()) {
    if (pause.is_over()) std::fill(heard_.begin(), heard_.end(), Clock::now());
    hand_out(run);
    wait();
    take_own_answers(run);
    if (group_) {
      take_posted(run);
      watch_others(run);
    }
    meanwhile();
    if (run.losses_in_a_row > most_losses * size()) return false;
  }
  return run.all_is_well;
}

void SweepTeam::hand_out(Run& run) {
  for (Slot& slot : slots_) {
    if (slot.order >= 0 || is_lost_[slot.rank]) continue;
    // A late answer may have come to what was to be done again.
    while (!run.waiting.empty() && run.is_done[run.waiting.front()]) run.waiting.pop_front();
    if (run.waiting.empty()) return;
    const int order = run.waiting.front();
    run.waiting.pop_front();
    give(slot, order, run.orders[order]);
  }
}

void SweepTeam::give(Slot& slot, int order, const WorkOrder& what) {
  slot.order = order;
  if (slot.rank == 0) {
    own_[slot.place].give(what);
    return;
  }
  Packet packet = packet_of(Word::order);
  packet.put(runs_);
  packet.put(slot.place);
  packet.put(order);
  packet.put(what);
  group_->post(slot.rank, packet);
}

void SweepTeam::take_own_answers(Run& run) {
  for (Slot& slot : slots_)
    if (slot.rank == 0)
      if (const auto answer = own_[slot.place].take_answer())
        take_answer(run, slot, slot.order, *answer);
}

void SweepTeam::take_posted(Run& run) {
  while (std::optional<ProcessGroup::Posted> posted = group_->take_posted()) {
    heard_[posted->rank] = Clock::now();
    Word word = Word::alive;
    posted->packet.take(word);
    if (word != Word::answer) continue;
    int of_run = 0, place = 0, order = 0;
    WorkAnswer answer;
    posted->packet.take(of_run);
    posted->packet.take(place);
    posted->packet.take(order);
    posted->packet.take(answer.kind);
    posted->packet.take(answer.text);
    const auto slot = std::find_if(slots_.begin(), slots_.end(), [&](const Slot& one) {
      return one.rank == posted->rank && one.place == place;
    });
    if (of_run == runs_ && slot != slots_.end()) take_answer(run, *slot, order, answer);
  }
}

void SweepTeam::take_answer(Run& run, Slot& slot, int order, const WorkAnswer& answer) {
  slot.order = -1;
  const auto at = static_cast<std::size_t>(order);
  if (run.is_done[at]) return;
  const std::string where = slot.rank > 0 ? fmt::format("process {}: ", slot.rank) : "";
  if (answer.kind == WorkAnswer::Kind::failed) throw std::runtime_error(where + answer.text);
  if (answer.kind == WorkAnswer::Kind::refused) {
    Diagnostics diagnostics;
    diagnostics.error({std::make_shared<const std::string>("blocklift"), 0, 0},
                      where + answer.text);
    throw InputError(diagnostics);
  }
  if (answer.kind == WorkAnswer::Kind::done) {
    run.is_done[at] = true;
    ++run.ended;
    run.losses_in_a_row = 0;
    run.take(order, answer.text);
    return;
  }
  ++run.losses_in_a_row;
  log_entry(fmt::format("{}a worker was lost with order {}", where, order));
  if (++run.losses[at] < most_losses) {
    run.waiting.push_back(order);
    return;
  }
  run.is_done[at] = true;
  run.all_is_well = false;
  ++run.ended;
}

void SweepTeam::watch_others(Run& run) {
  const double silence = silence_of_lost();
  const bool is_due = is_past(last_word_, silence / 6);
  if (is_due) last_word_ = Clock::now();
  for (std::size_t rank = 1; rank < heard_.size(); ++rank) {
    if (is_lost_[rank]) continue;
    if (is_due) group_->post(static_cast<int>(rank), packet_of(Word::alive));
    if (!is_past(heard_[rank], silence)) continue;
    is_lost_[rank] = true;
    ProcessGroup::leave_without_farewell();
    say_warning(
        fmt::format("process {} is lost: nothing was heard of it for {:g} s", rank, silence));
    for (Slot& slot : slots_) {
      if (slot.rank != static_cast<int>(rank) || slot.order < 0) continue;
      run.waiting.push_front(slot.order);
      slot.order = -1;
    }
  }
}

void SweepTeam::wait() const {
  std::vector<pollfd> descriptors;
  for (const WorkerProcess& worker : own_)
    if (worker.descriptor() >= 0) descriptors.push_back({worker.descriptor(), POLLIN, 0});
  // Packets are looked for: MPI would wait for them at a processor's full cost.
  const int milliseconds = group_ ? 5 : 100;
  ::poll(descriptors.data(), descriptors.size(), milliseconds);
}

namespace {

/// A process that follows: its workers, and what they are at.
class Follower {
 public:
  explicit Follower(const ProcessGroup& group) : group_(group) {}

  /// @returns false if it is to leave.
  bool obey(Packet packet) {
    heard_ = Clock::now();
    Word word = Word::alive;
    packet.take(word);
    if (word == Word::begin) begin(packet);
    if (word == Word::order) take_order(packet);
    if (word == Word::end) {
      workers_.clear();
      heard_.reset();
    }
    if (word == Word::leave) leave(packet);
    return word != Word::leave;
  }
  void answer() {
    for (std::size_t place = 0; place < workers_.size(); ++place)
      if (const auto what = workers_[place].take_answer()) post(place, *what);
  }
  /// @returns false if the first process is silent.
  bool keep_in_touch() {
    if (!heard_) return true;  // it reads the study, or writes its results
    if (pause_.is_over()) heard_ = Clock::now();
    if (is_past(*heard_, silence_)) return false;
    if (!is_past(said_, silence_ / 6)) return true;
    group_.post(0, packet_of(Word::alive));
    said_ = Clock::now();
    return true;
  }

 private:
  struct Task {
    int run = 0, order = -1;
  };

  void begin(Packet& packet) {
    int count = 0;
    std::size_t size = 0;
    packet.take(count);
    packet.take(size);
    std::vector<std::string> arguments(size);
    for (std::string& argument : arguments) packet.take(argument);
    for (int place = 0; place < count; ++place) workers_.emplace_back(arguments);
    tasks_.assign(count, {});
    pause_ = {};
  }
  static void leave(Packet& packet) {
    bool is_one_lost = false;
    packet.take(is_one_lost);
    if (is_one_lost) ProcessGroup::leave_without_farewell();
  }
  void take_order(Packet& packet) {
    Task task;
    int place = 0;
    WorkOrder what;
    packet.take(task.run);
    packet.take(place);
    packet.take(task.order);
    packet.take(what);
    const auto at = static_cast<std::size_t>(place);
    tasks_[at] = task;
    try {
      workers_[at].give(what);
    } catch (const std::exception& error) {
      post(at, {WorkAnswer::Kind::failed, error.what()});
    }
  }
  void post(std::size_t place, const WorkAnswer& what) {
    Packet packet = packet_of(Word::answer);
    packet.put(tasks_[place].run);
    packet.put(static_cast<int>(place));
    packet.put(tasks_[place].order);
    packet.put(what.kind);
    packet.put(what.text);
    group_.post(0, packet);
    said_ = Clock::now();
  }

  const ProcessGroup& group_;
  const double silence_ = silence_of_lost();
  std::vector<WorkerProcess> workers_;
  std::vector<Task> tasks_;
  std::optional<Clock::time_point> heard_;  ///< while there is a team
  Clock::time_point said_ = Clock::now();
  Pause pause_;
};

}  // namespace

bool follow_sweep_teams(const ProcessGroup& group) {
  Follower follower(group);
  for (;;) {
    while (std::optional<ProcessGroup::Posted> posted = group.take_posted())
      if (!follower.obey(std::move(posted->packet))) return true;
    follower.answer();
    if (!follower.keep_in_touch()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void let_followers_leave(const ProcessGroup& group) {
  const bool is_one_lost = ProcessGroup::leaves_without_farewell();
  Packet leave = packet_of(Word::leave);
  leave.put(is_one_lost);
  for (int rank = 1; rank < group.size(); ++rank) group.post(rank, leave);
  if (!is_one_lost) return;
  // Time for the words to arrive: nobody waits for anybody then.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
}

}  // namespace blocklift::pipeline
