#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace blocklift::pipeline {

/// Text as HTML content or attribute value.
std::string escape_html(std::string_view text);

/// Text as a string of a style sheet, with its quotes.
std::string css_string(std::string_view text);

/// A column of a table: its head as text, and whether it holds words (left) or numbers (right).
struct HtmlColumn {
  std::string head;
  bool is_text = false;
};

/// Rows of a table under a heading of their own; cells are HTML. An empty name gives no heading.
struct HtmlRows {
  std::string name;
  std::vector<std::vector<std::string>> rows;
};

/// A table of the page, marked as those that the page's script makes.
///
/// @param caption as text
/// @param style_class of the table, beside its own
std::string html_table(const std::string& caption, const std::vector<HtmlColumn>& columns,
                       const std::vector<HtmlRows>& groups, const std::string& style_class = {});

}  // namespace blocklift::pipeline
