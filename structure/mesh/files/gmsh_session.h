#pragma once

#include <mutex>

#include <gmsh.h>

namespace blocklift::structure {

/// Gmsh keeps one global session; this opens it for a scope, quietly and without what an earlier
/// one left: its count of errors outlives a session, and as long as it is not zero no elements are
/// raised. Another thread waits until it is closed.
class GmshSession {
 public:
  GmshSession() : lock_(open_) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::clear();  // resets that count
    gmsh::model::add("blocklift");
  }
  ~GmshSession() {
    try {
      gmsh::finalize();
    } catch (...) {  // a destructor must not throw; the session is lost anyhow
    }
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

 private:
  static inline std::mutex open_;
  std::lock_guard<std::mutex> lock_;
};

}  // namespace blocklift::structure
