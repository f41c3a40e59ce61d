#include "pipeline/report/html.h"

#include <fmt/format.h>

namespace blocklift::pipeline {

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

std::string css_string(std::string_view text) {
  std::string string = "\"";
  for (const char letter : text) {
    // Escaped by number, so that no quote, line end or "</style" is left in the sheet.
    if (letter == '"' || letter == '\\' || letter == '<' || static_cast<unsigned char>(letter) < 32)
      string += fmt::format("\\{:x} ", static_cast<unsigned char>(letter));
    else
      string += letter;
  }
  return string + '"';
}

std::string html_table(const std::string& caption, const std::vector<HtmlColumn>& columns,
                       const std::vector<HtmlRows>& groups, const std::string& style_class) {
  const auto side = [&](std::size_t column) { return columns[column].is_text ? "left" : "right"; };
  std::string html =
      fmt::format("<div class=\"table\"><table class=\"{}\"><caption><span>{}</span></caption>\n",
                  escape_html(style_class), escape_html(caption));
  html += "<thead><tr>";
  for (std::size_t i = 0; i < columns.size(); ++i)
    html += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", side(i),
                        escape_html(columns[i].head));
  html += "</tr></thead>\n";
  for (const HtmlRows& group : groups) {
    html += "<tbody>";
    if (!group.name.empty())
      html +=
          fmt::format("<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"{}\">{}</th></tr>\n",
                      columns.size(), escape_html(group.name));
    for (const auto& row : group.rows) {
      html += "<tr>";
      for (std::size_t i = 0; i < row.size(); ++i)
        html += i == 0 ? fmt::format("<th scope=\"row\" class=\"{}\">{}</th>", side(i), row[i])
                       : fmt::format("<td class=\"{}\">{}</td>", side(i), row[i]);
      html += "</tr>\n";
    }
    html += "</tbody>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace blocklift::pipeline
