#pragma once

#include <gmsh.h>

namespace blocklift::structure {

/// Gmsh keeps one global session; this opens it for a scope, quietly.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
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
