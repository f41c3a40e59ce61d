#include "pipeline/results/documents/word_document.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "pipeline/formats/zip_archive.h"

namespace blocklift::pipeline {
namespace {

using Kind = DocumentPart::Kind;

constexpr const char* xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
constexpr const char* main_namespace =
    "xmlns:w=\"http://schemas.openxmlformats.org/wordprocessingml/2006/main\"";
constexpr const char* office_types =
    "application/vnd.openxmlformats-officedocument.wordprocessingml";
constexpr const char* office_relations =
    "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
constexpr const char* package_namespace = "http://schemas.openxmlformats.org/package/2006";

// A4 across with margins of 20 mm, in twentieths of a point.
constexpr int page_width = 16838, page_height = 11906, margin = 1134;

/// Text between tags: what XML reserves is written out, what it forbids is left out.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
      result += c;
  }
  return result;
}

std::string run(const std::string& text) {
  return "<w:r><w:t xml:space=\"preserve\">" + escaped(text) + "</w:t></w:r>";
}

std::string paragraph(const std::string& properties, const std::string& text) {
  return "<w:p><w:pPr>" + properties + "</w:pPr>" + run(text) + "</w:p>\n";
}

std::string styled(const char* style, const std::string& text) {
  return paragraph(fmt::format("<w:pStyle w:val=\"{}\"/>", style), text);
}

/// An item of a list. @param numbering 1 for bullets, from 2 on one for each numbered list.
std::string item(int numbering, const std::string& text) {
  return paragraph(fmt::format("<w:pStyle w:val=\"ListParagraph\"/><w:numPr><w:ilvl w:val=\"0\"/>"
                               "<w:numId w:val=\"{}\"/></w:numPr>",
                               numbering),
                   text);
}

std::string table_row(const DocumentPart::Row& row, bool is_head, int column_width) {
  // Empty cells are filled in by hand.
  std::string text = "<w:tr><w:trPr><w:cantSplit/>";
  text += "<w:trHeight w:val=\"340\" w:hRule=\"atLeast\"/>";
  if (is_head) text += "<w:tblHeader/>";
  text += "</w:trPr>";
  for (const std::string& cell : row) {
    text += fmt::format("<w:tc><w:tcPr><w:tcW w:w=\"{}\" w:type=\"dxa\"/>", column_width);
    if (is_head) text += "<w:shd w:val=\"clear\" w:color=\"auto\" w:fill=\"E7ECF1\"/>";
    text += "</w:tcPr>" + styled(is_head ? "TableHead" : "TableText", cell) + "</w:tc>";
  }
  return text + "</w:tr>\n";
}

std::string table_text(const DocumentPart& table) {
  const int columns = static_cast<int>(table.head.size());
  const int width = (page_width - 2 * margin) / std::max(1, columns);
  std::string text =
      "<w:tbl><w:tblPr><w:tblStyle w:val=\"TableGrid\"/><w:tblW w:w=\"5000\" w:type=\"pct\"/>"
      "<w:tblLayout w:type=\"autofit\"/></w:tblPr><w:tblGrid>";
  for (int i = 0; i < columns; ++i) text += fmt::format("<w:gridCol w:w=\"{}\"/>", width);
  text += "</w:tblGrid>\n" + table_row(table.head, true, width);
  for (const DocumentPart::Row& row : table.rows) text += table_row(row, false, width);
  // Tables that follow each other would grow together without a paragraph between.
  return text + "</w:tbl>\n" + styled("TableText", "");
}

/// The body's parts; counts the numbered lists, of which each begins at 1.
class Body {
 public:
  explicit Body(const TextDocument& document) {
    Kind before = Kind::paragraph;
    for (const DocumentPart& part : document.parts()) {
      if (part.kind == Kind::numbered && before != Kind::numbered) ++numbered_lists_;
      text_ += part_text(part);
      before = part.kind;
    }
  }
  const std::string& text() const { return text_; }
  int numbered_lists() const { return numbered_lists_; }

 private:
  std::string part_text(const DocumentPart& part) const {
    switch (part.kind) {
      case Kind::title:
        return styled("Title", part.text);
      case Kind::heading:
        return styled("Heading1", part.text);
      case Kind::subheading:
        return styled("Heading2", part.text);
      case Kind::paragraph:
        return styled("Normal", part.text);
      case Kind::bullet:
        return item(1, part.text);
      case Kind::numbered:
        return item(1 + numbered_lists_, part.text);
      case Kind::table:
        return table_text(part);
    }
    return {};
  }

  std::string text_;
  int numbered_lists_ = 0;
};

std::string content_types() {
  const auto part = [](const char* name, const char* type) {
    return fmt::format("<Override PartName=\"/word/{}.xml\" ContentType=\"{}.{}+xml\"/>", name,
                       office_types, type);
  };
  return fmt::format(
             "{}<Types xmlns=\"{}/content-types\"><Default Extension=\"rels\" "
             "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
             "<Default Extension=\"xml\" ContentType=\"application/xml\"/>",
             xml_head, package_namespace) +
         part("document", "document.main") + part("styles", "styles") +
         part("numbering", "numbering") + part("footer1", "footer") + "</Types>\n";
}

std::string relation(const char* id, const char* type, const char* target) {
  return fmt::format("<Relationship Id=\"{}\" Type=\"{}/{}\" Target=\"{}\"/>", id, office_relations,
                     type, target);
}

std::string relations(const std::string& entries) {
  return fmt::format("{}<Relationships xmlns=\"{}/relationships\">{}</Relationships>\n", xml_head,
                     package_namespace, entries);
}

std::string document_text(const Body& body) {
  return fmt::format(
      "{}<w:document {} xmlns:r=\"{}\"><w:body>\n{}<w:sectPr><w:footerReference "
      "w:type=\"default\" r:id=\"rId3\"/><w:pgSz w:w=\"{}\" w:h=\"{}\" w:orient=\"landscape\"/>"
      "<w:pgMar w:top=\"{}\" w:right=\"{}\" w:bottom=\"{}\" w:left=\"{}\" w:header=\"600\" "
      "w:footer=\"600\" w:gutter=\"0\"/></w:sectPr></w:body></w:document>\n",
      xml_head, main_namespace, office_relations, body.text(), page_width, page_height, margin,
      margin, margin, margin);
}

/// A style of paragraphs. @param size in half points.
std::string style(const char* id, const char* name, int size, bool bold, int before, int after,
                  const char* more = "") {
  return fmt::format(
      "<w:style w:type=\"paragraph\" w:styleId=\"{}\"{}><w:name w:val=\"{}\"/>{}<w:qFormat/>"
      "<w:pPr>{}<w:spacing w:before=\"{}\" w:after=\"{}\"/>{}</w:pPr><w:rPr>{}<w:sz "
      "w:val=\"{}\"/></w:rPr></w:style>\n",
      id, std::string_view(id) == "Normal" ? " w:default=\"1\"" : "", name,
      std::string_view(id) == "Normal" ? "" : "<w:basedOn w:val=\"Normal\"/>",
      bold ? "<w:keepNext/>" : "", before, after, more, bold ? "<w:b/>" : "", size);
}

std::string border(const char* side) {
  return fmt::format("<w:{} w:val=\"single\" w:sz=\"4\" w:space=\"0\" w:color=\"8A97A3\"/>", side);
}

std::string styles() {
  std::string text = fmt::format(
      "{}<w:styles {}><w:docDefaults><w:rPrDefault><w:rPr><w:rFonts w:ascii=\"Arial\" "
      "w:hAnsi=\"Arial\" w:cs=\"Arial\"/><w:lang w:val=\"en-GB\"/></w:rPr></w:rPrDefault>"
      "</w:docDefaults>\n",
      xml_head, main_namespace);
  text += style("Normal", "Normal", 20, false, 0, 120);
  text += style("Title", "Title", 36, true, 0, 240);
  text += style("Heading1", "heading 1", 28, true, 360, 120, "<w:outlineLvl w:val=\"0\"/>");
  text += style("Heading2", "heading 2", 22, true, 240, 80, "<w:outlineLvl w:val=\"1\"/>");
  text += style("ListParagraph", "List Paragraph", 20, false, 0, 60);
  text += style("TableHead", "Table Head", 16, true, 20, 20);
  text += style("TableText", "Table Text", 16, false, 20, 20);
  text += style("Footer", "footer", 16, false, 0, 0, "<w:jc w:val=\"right\"/>");
  text +=
      "<w:style w:type=\"table\" w:styleId=\"TableGrid\"><w:name w:val=\"Table Grid\"/><w:tblPr>"
      "<w:tblBorders>";
  for (const char* side : {"top", "left", "bottom", "right", "insideH", "insideV"})
    text += border(side);
  return text +
         "</w:tblBorders><w:tblCellMar><w:left w:w=\"80\" w:type=\"dxa\"/><w:right w:w=\"80\" "
         "w:type=\"dxa\"/></w:tblCellMar></w:tblPr></w:style></w:styles>\n";
}

std::string numbering(int numbered_lists) {
  const auto kind = [](int id, const char* format, const char* sign) {
    return fmt::format(
        "<w:abstractNum w:abstractNumId=\"{}\"><w:lvl w:ilvl=\"0\"><w:start w:val=\"1\"/>"
        "<w:numFmt w:val=\"{}\"/><w:lvlText w:val=\"{}\"/><w:lvlJc w:val=\"left\"/><w:pPr><w:ind "
        "w:left=\"454\" w:hanging=\"340\"/></w:pPr></w:lvl></w:abstractNum>\n",
        id, format, sign);
  };
  std::string text = fmt::format("{}<w:numbering {}>\n", xml_head, main_namespace);
  text += kind(0, "bullet", "•") + kind(1, "decimal", "%1.");
  text += "<w:num w:numId=\"1\"><w:abstractNumId w:val=\"0\"/></w:num>\n";
  for (int i = 0; i < numbered_lists; ++i)
    text += fmt::format(
        "<w:num w:numId=\"{}\"><w:abstractNumId w:val=\"1\"/><w:lvlOverride w:ilvl=\"0\">"
        "<w:startOverride w:val=\"1\"/></w:lvlOverride></w:num>\n",
        2 + i);
  return text + "</w:numbering>\n";
}

std::string footer(const std::string& foot) {
  return fmt::format(
      "{}<w:ftr {}><w:p><w:pPr><w:pStyle w:val=\"Footer\"/></w:pPr>{}<w:fldSimple "
      "w:instr=\" PAGE \"><w:r><w:t>1</w:t></w:r></w:fldSimple></w:p></w:ftr>\n",
      xml_head, main_namespace, run(foot + "   "));
}

}  // namespace

std::string word_document_of(const TextDocument& document, const std::string& foot) {
  const Body body(document);
  ZipArchive archive;
  archive.add("[Content_Types].xml", content_types());
  archive.add("_rels/.rels", relations(relation("rId1", "officeDocument", "word/document.xml")));
  archive.add("word/document.xml", document_text(body));
  archive.add("word/_rels/document.xml.rels",
              relations(relation("rId1", "styles", "styles.xml") +
                        relation("rId2", "numbering", "numbering.xml") +
                        relation("rId3", "footer", "footer1.xml")));
  archive.add("word/styles.xml", styles());
  archive.add("word/numbering.xml", numbering(body.numbered_lists()));
  archive.add("word/footer1.xml", footer(foot));
  return archive.finish();
}

}  // namespace blocklift::pipeline
