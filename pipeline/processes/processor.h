#pragma once

#include <string>

namespace blocklift::pipeline {

/// Starts the program anew (same process, same arguments) with an environment that suits the
/// machine, unless the user has set these variables:
/// - OPENBLAS_CORETYPE: OpenBLAS chooses its kernels by the processor's family when it is loaded,
///   and takes those without AVX-512 for families that are younger than itself, at half the speed.
/// - OPENBLAS_THREAD_TIMEOUT: OpenBLAS' threads ask for work without a pause for 2^26 cycles after
///   each product and take a core from ours meanwhile; 2^18 cycles, a tenth of a millisecond, are
///   enough.
/// - GLIBC_TUNABLES, glibc.malloc.hugetlb: the matrices' gigabytes come in pages of 2 MB in place
///   of 4 kB, of which the kernel would hand over each one singly.
/// - OMP_NUM_THREADS, OPENBLAS_NUM_THREADS: what the option --threads says.
/// The first three only for commands that solve structures; the others would wait for the second
/// start in vain.
/// Returns where there is nothing to gain or the system cannot do it.
void use_all_of_the_processor(int count, char** arguments);

/// What decides in which order sums are formed: OpenBLAS' kernels, its threads and ours, such as
/// "Haswell, 2 and 2 threads". Runs with the same are equal to the last bit.
std::string describe_arithmetic();

}  // namespace blocklift::pipeline
