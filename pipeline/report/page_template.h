#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace blocklift::pipeline {

/// JSON that may stand inside a script element: no "<" can end the element early.
std::string script_safe(const nlohmann::ordered_json& data);

/// The page with its placeholders filled, in their order; each stands in it once.
std::string fill_page(std::string_view page,
                      const std::vector<std::pair<std::string_view, std::string>>& contents);

}  // namespace blocklift::pipeline
