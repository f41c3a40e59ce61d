#pragma once

// One version of a function for any x86-64, one for machines with AVX2 and FMA and one with
// AVX-512, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__AVX2__)
#define BLOCKLIFT_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define BLOCKLIFT_CLONES
#endif
