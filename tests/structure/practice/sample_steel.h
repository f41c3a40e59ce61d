#pragma once

#include "structure/material.h"

namespace blocklift::structure::test {

inline const Material steel_s355{"S355", 210e9, 0.3, 7850, 355e6};

}  // namespace blocklift::structure::test
