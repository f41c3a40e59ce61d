#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {

/// A key of an input file that is to have another value than the file gives it.
struct KeyChange {
  std::string file;   ///< a model, as the case calls it; empty: the case file
  std::string key;    ///< "ropes.R1.length", "operation[1].moves[2].by": lists count from 1
  std::string value;  ///< as it would be written in the file: "10.02 m"
  Mark mark;          ///< what asks for it
};

/// Reads a change: "ropes.R1.length=10.02 m", "blocks/hull-860t:mass=870 t". None after a
/// complaint.
std::optional<KeyChange> parse_key_change(std::string_view text, const Mark& mark,
                                          Diagnostics& diagnostics);

/// A document whose keys are given other values, again and again.
class ChangingDocument {
 public:
  explicit ChangingDocument(Document document) : document_(std::move(document)) {}

  /// The document with the new values of the changes that are of this file, and with no others; its
  /// text is that of the document with them. Places that share an anchor change together. Complains
  /// about a key that is not there or holds a table or a list, and leaves it. What was handed out
  /// before has the same nodes, and changes as well.
  Document with(const std::vector<KeyChange>& changes, std::string_view file,
                Diagnostics& diagnostics);

 private:
  struct Before {
    YAML::Node node;
    std::optional<std::string> value;  ///< none: the key had no value
  };
  void take_back();

  Document document_;
  std::vector<Before> before_;  ///< what the latest changes replaced, in their order
};

}  // namespace blocklift::pipeline
