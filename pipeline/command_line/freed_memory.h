#pragma once

namespace blocklift::pipeline {

/// Lets memory that has been freed go back to the system, but not at once.
///
/// SuperLU_DIST, which PETSc and Trilinos bring along, forbids that to the whole process when it is
/// loaded (mallopt with M_MMAP_MAX 0 and M_TRIM_THRESHOLD -1): a stiffness matrix that is no longer
/// needed would stay beneath the factor that was made of it. From now on what is free at the heap's
/// end beyond 512 MB is returned. Large blocks stay in the heap too: mapped singly, as glibc does
/// without being told, each is cleared by the kernel whenever it is asked for anew (measured on
/// 50,000 shells: 97 s of the kernel's time against 10 s, for a quarter more memory at most).
/// To be called first of all, while nothing large has been allocated. Without effect where the C
/// library is not glibc.
void return_freed_memory();

/// Keeps all that is freed from now on, for a run that asks for as much again and again: the
/// responses of a block on one mesh after another. The kernel clears what comes back to it whenever
/// it is asked for anew (measured on five meshes of up to 643,000 unknowns under 53 fields of
/// pressure: 17 s of clearing in place of 25, 5.6 GB at most in place of 5.4). Where memory is
/// short, what is kept goes back (structure::memory_for). Without effect where the C library is not
/// glibc.
void keep_freed_memory();

/// Returns now what has been freed and is still held, for a process that goes on with less: it
/// costs some milliseconds. Without effect where the C library is not glibc.
void return_what_is_free();

}  // namespace blocklift::pipeline
