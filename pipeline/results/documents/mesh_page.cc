#include "pipeline/results/documents/mesh_page.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "structure/output/finding_picture.h"

namespace blocklift::pipeline {

namespace {

std::string in_html(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      default:
        result += c;
    }
  return result;
}

const char* name_of(structure::Severity severity) {
  switch (severity) {
    case structure::Severity::error:
      return "error";
    case structure::Severity::warning:
      return "warning";
    case structure::Severity::note:
      break;
  }
  return "note";
}

std::string section(const structure::Mesh& mesh, const structure::Finding& finding) {
  std::string numbers;
  for (const long label : finding.labels) numbers += fmt::format(" {}", label);
  if (static_cast<std::size_t>(finding.count) > finding.labels.size()) numbers += " ...";
  return fmt::format("<h2>{}</h2>\n<p class=\"{}\">{}: {}.{}</p>\n{}", in_html(finding.kind),
                     name_of(finding.severity), name_of(finding.severity), in_html(finding.text),
                     finding.labels.empty() ? "" : " Numbers:" + numbers,
                     finding.places.empty() ? "" : structure::finding_picture(mesh, finding));
}

}  // namespace

std::string mesh_page(const MeshModel& mesh, const std::string& title) {
  if (!mesh.deck || !mesh.diagnosis) return {};
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body {{ font-family: sans-serif; max-width: 800px; margin: 2em auto; }} "
      ".error {{ color: #b00020; }} .warning {{ color: #9a5b00; }} "
      "svg {{ max-width: 100%; border: 1px solid #ddd; }}</style></head>\n"
      "<body><h1>{0}: what was found in its mesh</h1>\n<pre>{1}</pre>\n",
      in_html(title), in_html(describe_block_mesh(mesh)));
  // What is worst comes first.
  std::vector<structure::Finding> findings = mesh.diagnosis->findings;
  std::stable_sort(findings.begin(), findings.end(), [](const auto& a, const auto& b) {
    return static_cast<int>(a.severity) > static_cast<int>(b.severity);
  });
  for (const structure::Finding& finding : findings) page += section(mesh.deck->mesh, finding);
  return page + "</body></html>\n";
}

}  // namespace blocklift::pipeline
