#include "structure/process_group.h"

#include <mpi.h>
#include <petscsys.h>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

// Open MPI's launcher, then those that follow MPICH.
int from_environment(const std::vector<const char*>& names, int otherwise) {
  for (const char* name : names)
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return otherwise;
}

// Set where a process of this run may be lost without an end of all: MPI then says so.
MPI_Comm posting = MPI_COMM_NULL;
constexpr int tag_of_posted = 1;
bool is_without_farewell = false;

/// What MPI keeps until the end is none of ours: unseen by the sanitizers within a scope.
struct UnseenByLeakSanitizer {
#ifdef __SANITIZE_ADDRESS__
  __lsan::ScopedDisabler disabler;
#endif
};

// MPI counts in int: long messages go in pieces.
constexpr std::size_t longest_piece = std::numeric_limits<int>::max() / 2;

template <typename Transfer>
void in_pieces(std::size_t size, const Transfer& transfer) {
  for (std::size_t done = 0; done < size; done += longest_piece)
    transfer(done, static_cast<int>(std::min(longest_piece, size - done)));
}

}  // namespace

int ProcessGroup::launched() {
  // Slurm's srun tells PMIx' processes their place, and their number only in its own words.
  if (std::getenv("PMIX_RANK"))
    return std::max(1, from_environment({"OMPI_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS"}, 1));
  return std::max(1, from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1));
}

int ProcessGroup::place_among_launched() {
  return from_environment({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}, 0);
}

const ProcessGroup& ProcessGroup::of_this_run() {
  static const ProcessGroup group;
  return group;
}

ProcessGroup::ProcessGroup() {
  [[maybe_unused]] const UnseenByLeakSanitizer unseen;
  // Without a launcher Open MPI would start a helper process.
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);  // NOLINT(concurrency-mt-unsafe)
  // Options come from the part's file alone, and errors as return values.
  PetscOptionsSetValue(nullptr, "-skip_petscrc", "true");
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  if (PetscInitializeNoArguments() != 0) throw ModelError("MPI or PETSc could not be started");
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
  MPI_Comm_size(PETSC_COMM_WORLD, &size_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &on_this_machine_);
  MPI_Comm_free(&machine);
  MPI_Comm_dup(PETSC_COMM_WORLD, &posting);
  MPI_Comm_set_errhandler(posting, MPI_ERRORS_RETURN);
}

ProcessGroup::~ProcessGroup() {
  if (is_without_farewell) return;
  [[maybe_unused]] const UnseenByLeakSanitizer unseen;
  MPI_Comm_free(&posting);
  PetscFinalize();
}

void ProcessGroup::send(int rank, const Packet& packet) const {
  const unsigned long size = packet.bytes().size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG, rank, 0, PETSC_COMM_WORLD);
  in_pieces(size, [&](std::size_t first, int count) {
    MPI_Send(packet.bytes().data() + first, count, MPI_BYTE, rank, 0, PETSC_COMM_WORLD);
  });
}

Packet ProcessGroup::receive(int rank) const {
  unsigned long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG, rank, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<std::byte> bytes(size);
  in_pieces(size, [&](std::size_t first, int count) {
    MPI_Recv(bytes.data() + first, count, MPI_BYTE, rank, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  });
  return Packet(std::move(bytes));
}

Packet ProcessGroup::broadcast(const Packet& packet) const {
  unsigned long size = packet.bytes().size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, PETSC_COMM_WORLD);
  std::vector<std::byte> bytes = packet.bytes();
  bytes.resize(size);
  in_pieces(size, [&](std::size_t first, int count) {
    MPI_Bcast(bytes.data() + first, count, MPI_BYTE, 0, PETSC_COMM_WORLD);
  });
  return Packet(std::move(bytes));
}

bool ProcessGroup::post(int rank, const Packet& packet) const {
  const std::size_t size = packet.bytes().size();
  if (size > longest_piece) throw ModelError("a packet is too long to be posted");
  return MPI_Send(packet.bytes().data(), static_cast<int>(size), MPI_BYTE, rank, tag_of_posted,
                  posting) == MPI_SUCCESS;
}

std::optional<ProcessGroup::Posted> ProcessGroup::take_posted() const {
  int is_there = 0, size = 0;
  MPI_Status status;
  if (MPI_Iprobe(MPI_ANY_SOURCE, tag_of_posted, posting, &is_there, &status) != MPI_SUCCESS ||
      !is_there)
    return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  if (MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, tag_of_posted, posting,
               MPI_STATUS_IGNORE) != MPI_SUCCESS)
    return std::nullopt;
  return Posted{status.MPI_SOURCE, Packet(std::move(bytes))};
}

void ProcessGroup::leave_without_farewell() { is_without_farewell = true; }

bool ProcessGroup::leaves_without_farewell() { return is_without_farewell; }

void ProcessGroup::abort() {
  MPI_Abort(PETSC_COMM_WORLD, 1);
  std::abort();
}

}  // namespace blocklift::structure
