#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {

/// Reads a stock of rigging that a spreadsheet has written (CSV by commas or semicolons, cells in
/// double quotes where they need it), as the document that a YAML file of the same contents would
/// be: rows of a key and its value first (title, source, construction; rule, safety_factor,
/// efficiency, formula one below the other), then a row of headings that begins with `sling`,
/// `shackle`, `master_link` or `sheave`, then a row an item. Headings are keys of the item and, of
/// slings, of the rope; values have their units. Empty cells are left out.
///
/// Lines keep their numbers, columns do not: they are those of the document that was made. Nothing
/// is returned after a complaint about the form of the file.
std::optional<Document> load_rigging_table(const std::filesystem::path& path,
                                           Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
