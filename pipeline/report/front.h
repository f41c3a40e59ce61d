#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace blocklift::pipeline {

/// What the page says without its script, as HTML: made of the data that the page draws
/// (page_data.h), so that verdict, key figures and checks are read where scripts are off.

/// Title, the document's table, verdict, key figures and warnings.
std::string front_html(const nlohmann::ordered_json& data);

/// The governing check of each group, as a section; nothing if there are no checks. What is not met
/// is shown whole.
std::string checks_html(const nlohmann::ordered_json& data);

/// The annex: every check by its group and utilisation, and the input value by value.
std::string annex_html(const nlohmann::ordered_json& data);

/// Style of the printed page's margins: project, revision and names, hash of the input, number of
/// the page.
std::string margins_css(const nlohmann::ordered_json& data);

}  // namespace blocklift::pipeline
