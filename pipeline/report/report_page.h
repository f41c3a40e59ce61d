#pragma once

#include <string_view>

namespace blocklift::pipeline {

/// The report's page without its data: HTML with style sheet and scripts inlined, and the
/// placeholders %TITLE% (HTML text), %MARGINS% (CSS), %FRONT%, %CHECKS%, %ANNEX% (HTML) and %DATA%
/// (JSON), in this order. Its definition is generated at build time from pipeline/report/web/.
std::string_view report_page();

/// A page of tables and curves without its data, in the same way: the placeholders are %TITLE% and
/// %HEADING% (HTML text), %CONTENT% (HTML) and %DATA% (JSON).
std::string_view curves_page_template();

/// The same for pages that draw blocks in three dimensions as well, larger by the library for that.
std::string_view comparison_page_template();

}  // namespace blocklift::pipeline
