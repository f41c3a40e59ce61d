#include "pipeline/report/page_template.h"

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

std::string script_safe(const nlohmann::ordered_json& data) {
  const std::string text =
      data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<')
      safe += "\\u003c";
    else
      safe += letter;
  }
  return safe;
}

std::string fill_page(std::string_view page,
                      const std::vector<std::pair<std::string_view, std::string>>& contents) {
  std::string filled;
  filled.reserve(page.size() + contents.back().second.size());
  for (const auto& [mark, text] : contents) {
    const std::size_t at = page.find(mark);
    filled += page.substr(0, at);
    filled += text;
    page.remove_prefix(at + mark.size());
  }
  filled += page;
  return filled;
}

}  // namespace blocklift::pipeline
