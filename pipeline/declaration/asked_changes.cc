#include "pipeline/declaration/asked_changes.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

Mark place_of_change(const std::string& text) {
  return {std::make_shared<const std::string>("--set " + text), 0, 0};
}

}  // namespace

std::vector<KeyChange> read_asked_changes(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  std::vector<KeyChange> changes;
  for (const std::string& text : texts)
    if (auto change = parse_key_change(text, place_of_change(text), diagnostics))
      changes.push_back(std::move(*change));
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return changes;
}

void refuse_asked_changes(const std::string& path, const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  Diagnostics diagnostics;
  diagnostics.error(place_of_change(texts.front()),
                    fmt::format("no key of {} is set: keys of lift cases, of mechanisms and of "
                                "the models that they name are",
                                path));
  throw InputError(diagnostics);
}

}  // namespace blocklift::pipeline
