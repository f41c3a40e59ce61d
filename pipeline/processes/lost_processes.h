#pragma once

#include "structure/process_group.h"

namespace blocklift::pipeline {

/// Seconds after which a process of which nothing is heard is taken for lost: BLOCKLIFT_LOST_AFTER
/// of the environment, else 60.
double silence_of_lost();

/// Joins the processes that a launcher has started. MPI waits for all of them and cannot be told
/// not to; one that was lost before it had joined lets the others wait for ever where the launcher
/// keeps them running. So the first process warns once it has waited for `silence_of_lost`, and all
/// end with exit code 1 once they have waited for five times as long.
/// @throws ModelError if they cannot be joined.
const structure::ProcessGroup& join_launched_processes();

}  // namespace blocklift::pipeline
