#pragma once

#include <string>

#include "pipeline/results/documents/text_document.h"

namespace blocklift::pipeline {

/// A document as the bytes of a .docx file (Office Open XML, ECMA-376: WordprocessingML in a ZIP
/// archive): A4 across, headings for a table of contents, heads of tables repeated on each page,
/// the number of the page at its foot. The same document gives the same bytes.
/// @param foot stands before the number of the page.
std::string word_document_of(const TextDocument& document, const std::string& foot);

}  // namespace blocklift::pipeline
