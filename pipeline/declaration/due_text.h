#pragma once

#include <string>

#include "pipeline/declaration/description.h"

namespace blocklift::pipeline {

/// "a mass is due", "the keys of a load are due".
inline std::string due_text(const ValueDescription& value) {
  using Kind = ValueDescription::Kind;
  const bool are_many = value.kind == Kind::table || value.kind == Kind::names_to;
  return value.phrase() + (are_many ? " are due" : " is due");
}

}  // namespace blocklift::pipeline
