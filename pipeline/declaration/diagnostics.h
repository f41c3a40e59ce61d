#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace blocklift::pipeline {

/// A place in an input file. Line and column count from 1; line 0 stands for the file as a whole,
/// column 0 for the line.
struct Mark {
  std::shared_ptr<const std::string> file;  ///< path as it is shown to the user
  int line = 0;
  int column = 0;
};

/// A value together with the place in the file that gave it, for checks that come later.
template <class T>
struct Located {
  T value{};
  Mark mark;

  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

/// One complaint about the input: what was found and, in the hints, what is allowed or what to do.
struct Diagnostic {
  Mark mark;
  std::string message;
  std::vector<std::string> hints;
};

/// Gathers everything that is wrong with a set of input files, so that it is all said at once.
class Diagnostics {
 public:
  /// Complaints that are printed at most; what lies beyond is only counted.
  static constexpr std::size_t most_printed = 50;

  /// What message and hints quote is cut at 80 characters.
  void error(Mark mark, std::string message, std::vector<std::string> hints = {});

  bool has_errors() const { return !errors_.empty(); }
  std::size_t error_count() const { return errors_.size(); }
  const std::vector<Diagnostic>& errors() const { return errors_; }

  /// All complaints in the form of compilers, `path:line:column: error: message` with indented
  /// hints below, file by file in the order of the lines, and their count as the last line.
  /// Empty if there are none.
  std::string to_text() const;

 private:
  std::vector<Diagnostic> errors_;
};

/// The input cannot be used; what() is the text of all complaints.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const Diagnostics& diagnostics) : std::runtime_error(diagnostics.to_text()) {}
};

/// The candidate that is most probably meant by a mistyped name: the nearest by the number of
/// inserted, lost, changed and swapped letters, letter case counting little. Empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// The hint for a name that does not exist: `its lugs are L1, L2, L3; did you mean "L1"?`
/// @param introduction what precedes the list: "its lugs are".
/// @param candidates names that exist; long lists are cut.
std::string names_hint(std::string_view introduction, const std::vector<std::string>& candidates,
                       std::string_view wrong_name);

/// The thing of that name; null if there is none.
template <class T>
const T* find_by_name(const std::vector<T>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const T& item) { return item.name.value == name; });
  return found == items.end() ? nullptr : &*found;
}

/// Names of things that have a located one, for hints.
template <class T>
std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.push_back(item.name.value);
  return names;
}

/// "a, b, c", cut after twelve: "a, b, ... (30 in all)".
std::string list_of_names(const std::vector<std::string>& names);

}  // namespace blocklift::pipeline
