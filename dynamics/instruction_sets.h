#pragma once

/// BLOCKLIFT_CLONES before a function of an unnamed namespace: one version of it for any x86-64,
/// one for machines with AVX2 and FMA and one with AVX-512; the loader chooses when the program
/// starts. GCC and Clang name the instruction sets differently. A cloned function is called from
/// its own source only, since Clang 14 gives the clones' common entry a name that other sources do
/// not know. The address sanitizer is not ready yet when the loader chooses.
#if defined(__clang__)
#if __has_feature(address_sanitizer)
#define BLOCKLIFT_SANITIZES_ADDRESSES
#endif
#define BLOCKLIFT_AVX2 "arch=haswell"
#define BLOCKLIFT_AVX512 "arch=skylake-avx512"
#else
#if defined(__SANITIZE_ADDRESS__)
#define BLOCKLIFT_SANITIZES_ADDRESSES
#endif
#define BLOCKLIFT_AVX2 "arch=x86-64-v3"
#define BLOCKLIFT_AVX512 "arch=x86-64-v4"
#endif

#if defined(__x86_64__) && !defined(__AVX2__) && !defined(BLOCKLIFT_SANITIZES_ADDRESSES)
#define BLOCKLIFT_CLONES __attribute__((target_clones("default", BLOCKLIFT_AVX2, BLOCKLIFT_AVX512)))
#else
#define BLOCKLIFT_CLONES
#endif
