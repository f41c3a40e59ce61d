#include "dynamics/marine/hull/point_text.h"

#include <sstream>

namespace blocklift::dynamics {

std::string text_of_point(const Vector3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ") m";
  return text.str();
}

}  // namespace blocklift::dynamics
