#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <yaml-cpp/node/node.h>

#include "pipeline/declaration/description.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/expression.h"

namespace blocklift::pipeline {

/// One key of a YAML mapping with its value.
struct Entry {
  std::string key;
  Mark mark;  ///< of the key
  YAML::Node value;
};

/// A value for a parameter that another file gives, and where.
struct OutsideParameter {
  std::string name;
  Measure value;
  Mark mark;
};

/// The reading of one document: knows where it is, so that complaints can name key and owner.
class Reading {
 public:
  /// Values that are read at most; aliases can multiply a small file into an endless one.
  static constexpr std::size_t most_values = 1'000'000;

  Reading(const Document& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics) {}

  Mark mark_of(const YAML::Node& node) const { return document_.mark_of(node); }
  Diagnostics& diagnostics() { return diagnostics_; }

  void error(const YAML::Node& node, std::string message, std::vector<std::string> hints = {});
  void error(Mark mark, std::string message, std::vector<std::string> hints = {});

  /// Counts a value that is read; false, after one complaint, when there are too many.
  bool count_value(const YAML::Node& node);

  /// The entries of a mapping in the order of the file. A YAML merge key `<<` adds entries of the
  /// mappings that it names where the mapping itself has none. Complains about keys given twice,
  /// about keys that are no plain text and about empty ones, which are left out.
  std::vector<Entry> entries_of(const YAML::Node& mapping);

  /// Complains if the entry has a key and nothing behind it; `due` is what should stand there.
  bool has_value(const Entry& entry, const ValueDescription& due);

  /// The text of a scalar for a value that is described; complains about anything else.
  bool scalar_text(const YAML::Node& node, const ValueDescription& due, std::string& text);

  /// The key whose value is being read; names the value in complaints.
  const std::string& key() const { return key_; }
  /// What the table being read describes: "rope R1".
  const std::string& owner() const { return owner_; }
  /// Has something of that table, or of what stands in it, been complained of, or left out because
  /// its parameter was? What a rule misses then may be what could not be read. Complaints about
  /// other tables do not count.
  bool is_owner_unsound() const {
    return unread_count_ + diagnostics_.error_count() > unsound_before_owner_;
  }
  /// Tells that a value was not read without a complaint of its own: its parameter has one.
  void pass_over_value() { ++unread_count_; }

  /// What expressions in this document may use.
  Parameters& parameters() { return parameters_; }
  /// Values that take the place of the document's own parameters of these names.
  const std::vector<OutsideParameter>& outside_parameters() const { return outside_parameters_; }
  void set_outside_parameters(std::vector<OutsideParameter> values) {
    outside_parameters_ = std::move(values);
  }

  /// Reads a value with key and owner set for the time being.
  bool with_key(const std::string& key, const std::function<bool()>& read);
  bool with_owner(const std::string& owner, const std::function<bool()>& read);
  /// The name that the next table read belongs to; used once.
  void set_name(std::string name) { name_ = std::move(name); }
  std::string take_name() { return std::exchange(name_, {}); }

 private:
  /// Entries, each found by its key in an instant however many there are.
  struct EntryList {
    std::vector<Entry> entries;
    std::unordered_map<std::string, std::size_t> place_of_key;
  };
  void add_entries(const YAML::Node& mapping, int merge_depth, EntryList& list);
  void merge_entries(const YAML::Node& merged, int merge_depth, EntryList& list);

  const Document& document_;
  Diagnostics& diagnostics_;
  Parameters parameters_;
  std::vector<OutsideParameter> outside_parameters_;
  std::size_t value_count_ = 0;
  std::string key_;
  std::string owner_ = "the file";
  std::string name_;
  std::size_t unread_count_ = 0;
  std::size_t unsound_before_owner_ = 0;  ///< values passed over and complaints
};

}  // namespace blocklift::pipeline
