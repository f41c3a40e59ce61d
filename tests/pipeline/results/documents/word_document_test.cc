// One document as Markdown and as .docx.

#include "pipeline/results/documents/word_document.h"

#include <gtest/gtest.h>

#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

TextDocument sample_document() {
  TextDocument document;
  document.title("Of <ropes> & |bars|")
      .heading("First")
      .paragraph("One\x01.")
      .bullet("a")
      .bullet("b")
      .heading("Second")
      .numbered("x")
      .numbered("y")
      .subheading("Third")
      .table({"one", "two"}, {{"1 | 2", "\xe2\x80\x93"}, {"", "<4>"}})
      .numbered("z");
  return document;
}

TEST(TextDocumentTest, IsMarkdown) {
  EXPECT_EQ(
      markdown_of(sample_document()),
      "# Of <ropes> & |bars|\n\n## First\n\nOne\x01.\n\n- a\n- b\n\n## Second\n\n1. x\n1. y\n\n"
      "### Third\n\n| one | two |\n| --- | --- |\n| 1 \\| 2 | \xe2\x80\x93 |\n|  | <4> |\n\n"
      "1. z\n\n");
}

// Every part is XML that another program parses; styles, lists and relations that are named are
// there; the text is that of the document, without what XML forbids.
TEST(WordDocumentTest, IsReadByAnotherProgram) {
  const test::TemporaryFolder folder;
  const std::string bytes = word_document_of(sample_document(), "case & hash");
  EXPECT_EQ(bytes, word_document_of(sample_document(), "case & hash"));
  folder.write("x.docx", bytes);
  folder.write("read.py", R"(import zipfile, xml.etree.ElementTree as tree
W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
with zipfile.ZipFile("x.docx") as x:
    assert x.testzip() is None
    parts = {name: tree.fromstring(x.read(name)) for name in x.namelist()}
body = parts["word/document.xml"].find(W + "body")
kinds = [(child.tag.replace(W, ""), "".join(t.text or "" for t in child.iter(W + "t"))) for child in body]
assert kinds == [("p", "Of <ropes> & |bars|"), ("p", "First"), ("p", "One."), ("p", "a"), ("p", "b"),
                 ("p", "Second"), ("p", "x"), ("p", "y"), ("p", "Third"),
                 ("tbl", "onetwo1 | 2\u2013<4>"), ("p", ""), ("p", "z"), ("sectPr", "")], kinds
rows = [[c.find(".//" + W + "t").text or "" for c in r.findall(W + "tc")] for r in body.iter(W + "tr")]
assert rows == [["one", "two"], ["1 | 2", "\u2013"], ["", "<4>"]], rows
styles = {s.get(W + "styleId") for s in parts["word/styles.xml"].iter(W + "style")}
used = {s.get(W + "val") for s in body.iter(W + "pStyle")} | {s.get(W + "val") for s in body.iter(W + "tblStyle")}
assert used <= styles, used - styles
lists = [n.get(W + "val") for n in body.iter(W + "numId")]
assert lists == ["1", "1", "2", "2", "3"], lists
assert set(lists) == {n.get(W + "numId") for n in parts["word/numbering.xml"].iter(W + "num")}
targets = {r.get("Target") for r in parts["word/_rels/document.xml.rels"]}
assert all("word/" + target in parts for target in targets)
assert "case & hash" in "".join(parts["word/footer1.xml"].itertext())
)");
  const test::Outcome outcome = test::run_command("/usr/bin/python3 read.py");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace blocklift::pipeline
