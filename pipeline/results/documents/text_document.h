#pragma once

#include <string>
#include <utility>
#include <vector>

namespace blocklift::pipeline {

/// A piece of a document for people: text, or a table.
struct DocumentPart {
  enum class Kind { title, heading, subheading, paragraph, bullet, numbered, table };
  using Row = std::vector<std::string>;

  Kind kind = Kind::paragraph;
  std::string text = {};
  Row head = {};               ///< of a table
  std::vector<Row> rows = {};  ///< of a table, each as long as its head
};

/// A document as its parts, which each kind of file writes in its own way.
class TextDocument {
 public:
  TextDocument& title(std::string text) { return add(DocumentPart::Kind::title, std::move(text)); }
  TextDocument& heading(std::string text) {
    return add(DocumentPart::Kind::heading, std::move(text));
  }
  TextDocument& subheading(std::string text) {
    return add(DocumentPart::Kind::subheading, std::move(text));
  }
  TextDocument& paragraph(std::string text) {
    return add(DocumentPart::Kind::paragraph, std::move(text));
  }
  TextDocument& bullet(std::string text) {
    return add(DocumentPart::Kind::bullet, std::move(text));
  }
  TextDocument& numbered(std::string text) {
    return add(DocumentPart::Kind::numbered, std::move(text));
  }
  TextDocument& table(DocumentPart::Row head, std::vector<DocumentPart::Row> rows);

  const std::vector<DocumentPart>& parts() const { return parts_; }

 private:
  TextDocument& add(DocumentPart::Kind kind, std::string text) {
    parts_.push_back({kind, std::move(text)});
    return *this;
  }
  std::vector<DocumentPart> parts_;
};

/// As Markdown with tables.
std::string markdown_of(const TextDocument& document);

}  // namespace blocklift::pipeline
