#include "pipeline/results/documents/text_document.h"

namespace blocklift::pipeline {
namespace {

using Kind = DocumentPart::Kind;

/// A bar would end a cell of Markdown.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string markdown_row(const DocumentPart::Row& row) {
  std::string text = "|";
  for (const std::string& one : row) text += " " + cell(one) + " |";
  return text + "\n";
}

std::string markdown_table(const DocumentPart& table) {
  std::string text = markdown_row(table.head);
  text += markdown_row(DocumentPart::Row(table.head.size(), "---"));
  for (const DocumentPart::Row& row : table.rows) text += markdown_row(row);
  return text + "\n";
}

std::string markdown_part(const DocumentPart& part) {
  switch (part.kind) {
    case Kind::title:
      return "# " + part.text + "\n\n";
    case Kind::heading:
      return "## " + part.text + "\n\n";
    case Kind::subheading:
      return "### " + part.text + "\n\n";
    case Kind::paragraph:
      return part.text + "\n\n";
    case Kind::bullet:
      return "- " + part.text + "\n";
    case Kind::numbered:
      return "1. " + part.text + "\n";
    case Kind::table:
      return markdown_table(part);
  }
  return {};
}

bool is_item(Kind kind) { return kind == Kind::bullet || kind == Kind::numbered; }

}  // namespace

TextDocument& TextDocument::table(DocumentPart::Row head, std::vector<DocumentPart::Row> rows) {
  parts_.push_back({DocumentPart::Kind::table, {}, std::move(head), std::move(rows)});
  return *this;
}

std::string markdown_of(const TextDocument& document) {
  std::string text;
  const std::vector<DocumentPart>& parts = document.parts();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += markdown_part(parts[i]);
    const bool list_ends =
        is_item(parts[i].kind) && (i + 1 == parts.size() || parts[i + 1].kind != parts[i].kind);
    if (list_ends) text += "\n";
  }
  return text;
}

}  // namespace blocklift::pipeline
