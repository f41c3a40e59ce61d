#pragma once

#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

struct LugModel;

/// A lug: a plate on a pad of the block's plates, or a place on a mesh, told apart by its keys.
Format<LugModel> lug_format();

}  // namespace blocklift::pipeline
