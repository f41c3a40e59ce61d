#pragma once

#include <gmsh.h>

namespace blocklift::structure {

/// Gmsh keeps one global session; this opens it for a scope, quietly and without what an earlier
/// one left: its count of errors outlives a session, and as long as it is not zero no elements are
/// raised.
class GmshSession {
 public:
  GmshSession() {
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
};

}  // namespace blocklift::structure
