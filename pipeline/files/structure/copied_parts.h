#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/structure/block_model.h"

namespace blocklift::pipeline {

/// Which parts of a block are copied, and what their copies are called.
struct CopiedParts {
  /// Names of plates, openings, pads and lugs, each for itself and the copies made of it before;
  /// absent: all. Openings go with their plate.
  std::optional<std::vector<Located<std::string>>> parts;
  std::string label;  ///< of the copies: "web" is copied as "web.<label>"
  Mark place;
};

/// Copies of parts, the k-th moved by k times the step. They are named "web.1", "web.2", ..., with
/// the label, if there is one, before the number.
struct RepeatModel : CopiedParts {
  int count = 0;  ///< of the copies
  Located<Vector3> step{Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), {}};  ///< m
};

/// Copies of parts on the other side of a plane normal to an axis: "web.mirrored". What lies in the
/// plane itself is not copied.
struct MirrorModel : CopiedParts {
  std::size_t normal = 0;                                            ///< 0, 1, 2 for x, y, z
  Located<double> at{std::numeric_limits<double>::quiet_NaN(), {}};  ///< m
};

/// A block as its file writes it: copies are made of it by `with_copies`.
struct BlockFile : BlockModel {
  std::vector<RepeatModel> repeats;
  std::vector<MirrorModel> mirrors;
};

Format<RepeatModel> repeat_format();
Format<MirrorModel> mirror_format();

/// The block with its copies: repeated first, in the order of the file, then mirrored. What a copy
/// refers to is the copy made with it, if there is one. Copies that cannot be made are left out.
/// @param reading takes complaints: unknown names, names that come up twice, mirror planes through
///   parts; null: nobody hears them.
BlockModel with_copies(const BlockFile& file, Reading* reading);

}  // namespace blocklift::pipeline
