#include "tests/benchmarks/peers/modules.h"

#include <dlfcn.h>

#include <iostream>
#include <sstream>

#include "tests/benchmarks/peers/blocklift_peer.h"

namespace blocklift::peers {

std::vector<const PeerModule*> load_modules() {
  std::vector<const PeerModule*> modules{&blocklift_module()};
  std::istringstream paths(PEER_MODULES);  // separated by colons, may be empty
  for (std::string path; std::getline(paths, path, ':');) {
    if (path.empty()) continue;
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = handle ? dlsym(handle, "peer_module") : nullptr;
    if (!symbol) {
      std::cerr << "left out: " << path << ": " << dlerror() << "\n";
      continue;
    }
    modules.push_back(reinterpret_cast<decltype(&peer_module)>(symbol)());
  }
  return modules;
}

std::string describe(const std::vector<const PeerModule*>& modules) {
  std::ostringstream text;
#ifdef __AVX__
  text << "Blocklift: built for this machine's own instructions\n";
#else
  text << "Blocklift: generic build, as users get it\n";
#endif
  for (std::size_t i = 1; i < modules.size(); ++i) {
    text << modules[i]->name << " " << modules[i]->version
         << ": the distribution's package, a generic x86-64 build\n";
  }
  if (modules.size() == 1) text << "no other library is installed; nothing to compare with\n";
  return text.str();
}

}  // namespace blocklift::peers
