#pragma once

#include <optional>

#include "structure/packet.h"

namespace blocklift::structure {

/// The processes that a run was started on (`mpirun -n N`); PETSc is ready in each. Process 0
/// leads. Without a launcher the group is this process alone.
class ProcessGroup {
 public:
  /// Number of processes that a launcher has started together, 1 without one. No group is needed.
  static int launched();
  /// Place of this process among them, from 0.
  static int place_among_launched();

  /// The group of this run, joined when first asked for, left at the end of the program: MPI can be
  /// started only once. @throws ModelError if the processes cannot be joined.
  static const ProcessGroup& of_this_run();

  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool leads() const { return rank_ == 0; }
  /// Processes of the group on this machine: they share its memory.
  int on_this_machine() const { return on_this_machine_; }

  void send(int rank, const Packet& packet) const;
  Packet receive(int rank) const;
  /// Hands the leader's packet to all others; returns it everywhere.
  Packet broadcast(const Packet& packet) const;

  /// A packet that a process posted, and which.
  struct Posted {
    int rank = 0;
    Packet packet;
  };
  /// Posts a packet of less than a gigabyte to a process that looks for it when it likes, with
  /// `take_posted`. False where the process is known to be lost.
  bool post(int rank, const Packet& packet) const;
  /// The next packet that was posted here, of those of one process in their order; none has come:
  /// nothing. Returns at once.
  std::optional<Posted> take_posted() const;

  /// From now on this process ends without a word to the others: one of them is lost, and MPI would
  /// wait for it.
  static void leave_without_farewell();
  static bool leaves_without_farewell();

  /// Ends all processes at once, after an error that only this one has met.
  [[noreturn]] static void abort();

 private:
  ProcessGroup();

  int rank_ = 0;
  int size_ = 1;
  int on_this_machine_ = 1;
};

}  // namespace blocklift::structure
