#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

/// A file of a template, as it lies in pipeline/templates/<kind>; NAME_OF_FOLDER in it stands for
/// the name of what is begun.
struct TemplateFile {
  std::string kind;
  std::string name;
  std::string text;
};

/// All files of all templates, those of a kind together, the one to be run first. The definition is
/// generated at build time.
const std::vector<TemplateFile>& template_files();

}  // namespace blocklift::pipeline
