#pragma once

namespace blocklift::pipeline {

/// Lets memory that has been freed go back to the system.
///
/// SuperLU_DIST, which PETSc and Trilinos bring along, forbids that to the whole process when it is
/// loaded (mallopt with M_MMAP_MAX 0 and M_TRIM_THRESHOLD -1): a stiffness matrix that is no longer
/// needed would stay beneath the factor that was made of it. Blocks from 32 MB on are mapped singly
/// from now on, smaller ones stay in the heap, where they are had again without asking the kernel.
/// To be called first of all, while nothing large has been allocated. Without effect where the C
/// library is not glibc.
void return_freed_memory();

}  // namespace blocklift::pipeline
