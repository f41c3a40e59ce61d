#include "pipeline/declaration/document.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/text_file.h"
#include "structure/letter_case.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// The number of bytes of the UTF-8 sequence that begins the text, 0 if there is none that is
/// valid. RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if (!continues(1) || !continues(2)) return 0;
    if (first == 0xE0 && byte(1) < 0xA0) return 0;
    if (first == 0xED && byte(1) > 0x9F) return 0;
    return 3;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if (!continues(1) || !continues(2) || !continues(3)) return 0;
    if (first == 0xF0 && byte(1) < 0x90) return 0;
    if (first == 0xF4 && byte(1) > 0x8F) return 0;
    return 4;
  }
  return 0;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7F;
}

/// Complains if the text is not readable UTF-8. Binary data is told from a wrong encoding by its
/// control characters.
bool is_text(const std::string& text, const std::shared_ptr<const std::string>& file,
             Diagnostics& diagnostics) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    diagnostics.error({file, 0, 0}, "the file is UTF-16 text; save it as UTF-8");
    return false;
  }
  if (std::any_of(text.begin(), text.end(), is_control)) {
    diagnostics.error({file, 0, 0}, "the file is binary, not text; a YAML file is due");
    return false;
  }
  int line = 1;
  std::size_t line_begin = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(std::string_view(text).substr(i));
    if (length == 0) {
      diagnostics.error({file, line, static_cast<int>(i - line_begin) + 1},
                        fmt::format("the byte 0x{:02X} is not UTF-8; save the file as UTF-8",
                                    static_cast<unsigned char>(text[i])));
      return false;
    }
    if (text[i] == '\n') {
      ++line;
      line_begin = i + 1;
    }
    i += length;
  }
  return true;
}

/// The text of the file, or nothing and a complaint.
std::optional<std::string> read_text(const fs::path& path,
                                     const std::shared_ptr<const std::string>& file,
                                     Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message) {
    diagnostics.error({file, 0, 0}, std::move(message));
    return std::nullopt;
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return refuse("there is no such file");
  if (error) return refuse("the file cannot be read: " + error.message());
  if (fs::is_directory(status)) return refuse("this is a folder; a YAML file is due");
  if (!fs::is_regular_file(status)) return refuse("this is no ordinary file; a YAML file is due");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return refuse("the file cannot be read: " + error.message());
  if (size > largest_input_file) {
    return refuse(fmt::format("the file has {:.1f} MB; an input file has at most {:.0f} MB",
                              static_cast<double>(size) / 1e6,
                              static_cast<double>(largest_input_file) / 1e6));
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return refuse(fmt::format("the file cannot be read: {}", std::strerror(errno)));
  }
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) return refuse("the file cannot be read to its end");
  return text;
}

/// The line of a place, without its end; empty beyond the text.
std::string line_of(const std::string& text, const YAML::Mark& mark) {
  std::size_t begin = 0;
  for (int line = 0; line < mark.line && begin != std::string::npos; ++line) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// What the parser says, put so that one knows what to do about it.
std::vector<std::string> hints_for(const YAML::Exception& exception, const std::string& text) {
  if (exception.msg.starts_with("end of ") && exception.msg.ends_with("flow not found"))
    return {"a bracket in this line or above it is opened and not closed"};
  std::vector<std::string> hints;
  const std::string line = line_of(text, exception.mark);
  const std::size_t first = line.find_first_not_of(' ');
  if (first != std::string::npos && line[first] == '\t') {
    hints.emplace_back("YAML indents with blanks, never with tabs");
  } else if (exception.msg == "illegal map value") {
    hints.emplace_back(
        "a key is followed by one value, or by nothing and its own keys on deeper lines; text that "
        "holds \": \" needs quotes");
  }
  return hints;
}

/// Notes where the second of several YAML documents begins, and the anchors on the way.
class SecondDocument : public YAML::EventHandler {
 public:
  const YAML::Mark& mark() const { return mark_; }  ///< null if there is none
  const std::vector<std::string>& anchors() const { return anchors_; }

  void OnAnchor(const YAML::Mark&, const std::string& name) override {
    if (std::find(anchors_.begin(), anchors_.end(), name) == anchors_.end())
      anchors_.push_back(name);
  }

  void OnDocumentStart(const YAML::Mark&) override { ++count_; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnMapEnd() override {}

 private:
  void note(const YAML::Mark& mark) {
    if (count_ == 2 && mark_.is_null()) mark_ = mark;
  }
  int count_ = 0;
  YAML::Mark mark_ = YAML::Mark::null_mark();
  std::vector<std::string> anchors_;
};

/// Where a second document begins; null if there is none. YAML::LoadAll is not asked: a lone comma
/// or bracket between documents, which the parser does not pass, gives it empty documents without
/// end.
YAML::Mark find_second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  SecondDocument second;
  for (int i = 0; i < 2 && parser.HandleNextDocument(second); ++i) {
  }
  return second.mark();
}

/// The anchors of a text up to its first fault.
std::vector<std::string> find_anchors(const std::string& text) {
  SecondDocument handler;
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(handler);
  } catch (const YAML::Exception&) {  // it has been complained about
  }
  return handler.anchors();
}

/// Complains about a text that the parser refused. Of an anchor that is missing it knows the place
/// and not the name.
void complain_about_yaml(const YAML::Exception& exception, const std::string& text,
                         const std::shared_ptr<const std::string>& file, Diagnostics& diagnostics) {
  const Mark mark{file, exception.mark.line + 1, exception.mark.column + 1};
  if (exception.msg == YAML::ErrorMsg::UNKNOWN_ANCHOR) {
    const std::string line = line_of(text, exception.mark);
    const auto column = static_cast<std::size_t>(std::max(exception.mark.column, 0));
    if (column < line.size() && line[column] == '*') {
      const std::string name =
          line.substr(column + 1, line.find_first_of("[]{}, \t\r", column + 1) - column - 1);
      const std::vector<std::string> anchors = find_anchors(text);
      diagnostics.error(mark, fmt::format("no anchor \"&{0}\" comes before \"*{0}\"", name),
                        {anchors.empty() ? fmt::format("\"&{}\" before a value names it", name)
                                         : names_hint("the anchors before it are", anchors, name)});
      return;
    }
  }
  diagnostics.error(mark, "this is not YAML: " + exception.msg, hints_for(exception, text));
}

}  // namespace

std::string shown_path(const fs::path& path) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error) return path.string();
  const fs::path relative = path.lexically_normal().lexically_proximate(here);
  if (relative.empty() || *relative.begin() == "..") return path.lexically_normal().string();
  return relative.string();
}

Mark Document::mark_of(const YAML::Node& node) const {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};
}

std::optional<TextFile> load_text(const fs::path& path, Diagnostics& diagnostics) {
  const auto file = std::make_shared<const std::string>(shown_path(path));
  std::optional<std::string> text = read_text(path, file, diagnostics);
  if (!text || !is_text(*text, file, diagnostics)) return std::nullopt;
  return TextFile{file, std::move(*text)};
}

namespace {

/// Decks, meshes and CAD files, which are not YAML whatever stands in them.
bool is_mesh_file(const fs::path& path) {
  static constexpr std::array endings = {".bdf",  ".nas", ".dat", ".inp",  ".msh", ".unv",
                                         ".step", ".stp", ".igs", ".iges", ".brep"};
  return std::find(endings.begin(), endings.end(), structure::ending_of(path)) != endings.end();
}

}  // namespace

std::optional<Document> load_document(const fs::path& path, Diagnostics& diagnostics) {
  std::error_code ignored;
  if (is_mesh_file(path) && fs::is_regular_file(path, ignored)) {
    diagnostics.error({std::make_shared<const std::string>(path.string()), 0, 0},
                      "this is the mesh of a block, by its ending",
                      {fmt::format("a block's file names it: \"kind: block\", then "
                                   "\"mesh: {{file: {}, units: mm-t-N}}\" with the deck's units",
                                   path.filename().string())});
    return std::nullopt;
  }
  std::optional<TextFile> loaded = load_text(path, diagnostics);
  if (!loaded) return std::nullopt;
  Document document;
  document.file = loaded->file;
  document.text = std::move(loaded->text);

  YAML::Mark second = YAML::Mark::null_mark();
  try {
    document.root = YAML::Load(document.text);
    second = find_second_document(document.text);
  } catch (const YAML::DeepRecursion& exception) {
    diagnostics.error({document.file, exception.mark.line + 1, exception.mark.column + 1},
                      "lists and keys are nested too deeply");
    return std::nullopt;
  } catch (const YAML::Exception& exception) {
    complain_about_yaml(exception, document.text, document.file, diagnostics);
    return std::nullopt;
  }
  if (!second.is_null()) {
    diagnostics.error({document.file, second.line + 1, second.column + 1},
                      "a second YAML document begins here; one file holds one",
                      {"is the line before indented like its neighbours, or a \"---\" too many?"});
    return std::nullopt;
  }
  if (document.root.IsNull()) {
    diagnostics.error({document.file, 0, 0}, "the file is empty; keys and values are due");
    return std::nullopt;
  }
  return document;
}

}  // namespace blocklift::pipeline
