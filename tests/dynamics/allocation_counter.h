#pragma once

namespace blocklift::test {

/// Can calls of the C allocator be counted in this build? (Sanitizers bring their own allocator.)
bool counts_allocations();

/// Calls of malloc in this executable so far, operator new and Eigen's included.
long allocations();

}  // namespace blocklift::test
