#include "pipeline/files/library/model_library.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/declaration/reading.h"
#include "pipeline/files/named_file.h"
#include "pipeline/files/rigging/rigging_table.h"
#include "pipeline/terminal/run_log.h"
#include "structure/outside_files.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !error && fs::exists(status) && !fs::is_directory(status);
}

/// "a crane", "a group of vessels".
std::string kind_in_words(const std::string& kind) {
  return kind == "vessels" ? "a group of vessels" : "a " + kind;
}

/// Complains if the file is of another kind than the one that is due.
/// @param hints who named the file.
bool is_of_kind(const Document& document, const std::string& kind, Diagnostics& diagnostics,
                const std::vector<std::string>& hints) {
  if (!document.root.IsMap()) return true;  // the reader will say what is wrong
  const YAML::Node found = document.root["kind"];
  const bool is_case = !found && document.root["case"];
  if (!is_case && (!found || !found.IsScalar() || found.Scalar() == kind)) return true;
  diagnostics.error(
      document.mark_of(is_case ? document.root["case"] : found),
      fmt::format("this file describes {}; {} is due",
                  kind_in_words(is_case ? "lift case" : found.Scalar()), kind_in_words(kind)),
      hints);
  return false;
}

/// Reads a model file into a value; null if nothing could be read.
template <class T>
std::shared_ptr<T> read_model(const std::optional<Document>& document, const std::string& kind,
                              const Format<T>& format, Diagnostics& diagnostics,
                              const std::vector<std::string>& named_by = {},
                              const ParameterValues& parameters = {}) {
  if (!document || !is_of_kind(*document, kind, diagnostics, named_by)) return nullptr;
  auto model = std::make_shared<T>();
  Reading reading(*document, diagnostics);
  std::vector<OutsideParameter> outside;
  for (const Named<Located<Measure>>& parameter : parameters) {
    outside.push_back({parameter.name.value, parameter.value.value, parameter.value.mark});
  }
  reading.set_outside_parameters(std::move(outside));
  reading.with_owner("the " + kind, [&] { return format.read(document->root, reading, *model); });
  for (const Named<Located<Measure>>& parameter : parameters) {
    if (reading.parameters().find(parameter.name.value)) continue;
    const std::vector<std::string> known = reading.parameters().names();
    reading.error(parameter.name.mark,
                  fmt::format("{} has no parameter \"{}\"", *document->file, parameter.name.value),
                  {known.empty() ? "it has none at all"
                                 : names_hint("its parameters are", known, parameter.name.value)});
  }
  return model;
}

/// A place in a table that was made a document: its column says nothing about the table.
Mark without_column(Mark mark) {
  mark.column = std::min(mark.column, 1);
  return mark;
}

void forget_columns(RiggingStock& stock) {
  for (StockSling& sling : stock.slings) sling.name.mark = without_column(sling.name.mark);
  for (StockShackle& shackle : stock.shackles)
    shackle.name.mark = without_column(shackle.name.mark);
  for (StockMasterLink& link : stock.master_links) link.name.mark = without_column(link.name.mark);
  for (StockSheave& sheave : stock.sheaves) sheave.name.mark = without_column(sheave.name.mark);
}

/// A word of YAML without its quotes.
std::string without_quotes(const std::string& word) {
  const bool is_quoted = word.size() > 1 && word.front() == word.back() &&
                         (word.front() == '"' || word.front() == '\'');
  return is_quoted ? word.substr(1, word.size() - 2) : word;
}

/// Whether a file has the line `kind: crane` near its beginning. No more of it is read: the folder
/// of a case may hold many large files, and pipes.
bool says_kind(const fs::path& file, const std::string& kind) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  std::string beginning(10000, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  std::istringstream lines(beginning.substr(0, static_cast<std::size_t>(stream.gcount())));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, value;
    if (!(words >> key >> value)) continue;
    if (without_quotes(key.substr(0, key.size() - 1)) == "kind" && key.ends_with(':') &&
        !line.starts_with(' '))
      return without_quotes(value) == kind;
  }
  return false;
}

/// The models of a kind in a folder of models: folders that hold `crane.yaml`, and YAML files below
/// `cranes`.
/// @param is_home in the folder of a case models lie as they like: each YAML file counts that says
///   that it is of the kind.
void add_models(const fs::path& folder, const std::string& kind, bool is_home,
                std::vector<std::string>& names) {
  constexpr int deepest = 4;
  constexpr int most_visited = 10000;
  int visited = 0;
  std::error_code error;
  fs::recursive_directory_iterator files(folder, fs::directory_options::skip_permission_denied,
                                         error);
  for (; !error && files != fs::recursive_directory_iterator(); files.increment(error)) {
    if (++visited > most_visited) return;
    if (files.depth() >= deepest) files.disable_recursion_pending();
    const fs::path relative = files->path().lexically_relative(folder);
    if (relative.extension() != ".yaml") continue;
    if (relative.filename() == kind + ".yaml" && relative.has_parent_path()) {
      names.push_back(relative.parent_path().string());
    } else if (*relative.begin() == kind + "s" || (is_home && says_kind(files->path(), kind))) {
      names.push_back((relative.parent_path() / relative.stem()).string());
    }
  }
}

/// The rope of a choice: its keys, or the model that it names; an empty one where there is neither.
RopeModel rope_of(const RopeChoice& choice, const std::shared_ptr<const RopeModel>& named) {
  if (choice.keys) return *choice.keys;
  return named ? *named : RopeModel{};
}

/// The name without its folders.
std::string last_part(const std::string& name) { return fs::path(name).filename().string(); }

}  // namespace

ModelLibrary ModelLibrary::of_installation() { return ModelLibrary(model_path()); }

std::vector<fs::path> ModelLibrary::files_of(const std::string& group,
                                             const std::string& file_name) const {
  std::map<std::string, fs::path> by_folder;
  for (const fs::path& models : model_folders_) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(models / group, error)) {
      const fs::path file = entry.path() / file_name;
      if (is_file(file)) by_folder.emplace(entry.path().filename().string(), file);
    }
  }
  std::vector<fs::path> files;
  for (const auto& [folder, file] : by_folder) files.push_back(file.lexically_normal());
  return files;
}

std::string ModelLibrary::hint_of_name(const std::string& name, const std::string& kind,
                                       const Folders& beside) const {
  const std::vector<std::string> known = names_of_kind(kind, beside);
  const bool without_folder = name.find('/') == std::string::npos;
  std::vector<std::string> shown = known;
  if (kind == "standard" && without_folder)
    for (std::string& one : shown)
      if (one.starts_with("standards/")) one = last_part(one);
  std::string hint = names_hint(fmt::format("the {} models are", kind), shown, name);
  if (!nearest_name(name, shown).empty()) return hint;
  // The folder may be wrong, or missing, and the name right.
  std::vector<std::string> last_parts;
  for (const std::string& one : known) last_parts.push_back(last_part(one));
  const std::string near = nearest_name(last_part(name), last_parts);
  const auto found = std::find(last_parts.begin(), last_parts.end(), near);
  if (near.empty() || found == last_parts.end()) return hint;
  return fmt::format("{}; did you mean \"{}\"?", hint, known[found - last_parts.begin()]);
}

fs::path ModelLibrary::find(const Located<std::string>& name, const std::string& kind,
                            const Folders& beside, Diagnostics& diagnostics) const {
  std::vector<fs::path> places = beside;
  places.insert(places.end(), model_folders_.begin(), model_folders_.end());
  const bool is_short = kind == "standard" && name.value.find('/') == std::string::npos;
  if (is_short)
    for (const fs::path& folder : model_folders_) places.push_back(folder / "standards");
  const bool is_free = structure::are_files_outside_allowed();
  bool leads_somewhere = false, is_outside = false;
  for (const fs::path& place : places) {
    const fs::path named = name.value;
    for (const fs::path& within :
         {named, fs::path(named.string() + ".yaml"), named / (kind + ".yaml")}) {
      const fs::path file = place / within;
      if (!is_free && !is_within(within, place, beside, model_folders_)) {
        is_outside |= is_file(file);
        continue;
      }
      leads_somewhere = true;
      if (!is_file(file)) continue;
      log_entry(fmt::format("{} model \"{}\" is {}", kind, name.value, shown_path(file)));
      return file.lexically_normal();
    }
  }
  if (is_outside || !leads_somewhere) {
    complain_about_outside(name, diagnostics);
    return {};
  }
  std::vector<std::string> looked_in;
  for (const fs::path& place : places) {
    const std::string shown = shown_path(place.empty() ? fs::path(".") : place);
    if (std::find(looked_in.begin(), looked_in.end(), shown) == looked_in.end()) {
      looked_in.push_back(shown);
    }
  }
  std::vector<std::string> hints = {hint_of_name(name.value, kind, beside),
                                    "looked for in " + list_of_names(looked_in)};
  for (const std::string other : {"crane", "block", "rope", "vessel", "vessels", "standard"}) {
    if (other == kind) continue;
    const std::vector<std::string> others = names_of_kind(other, beside);
    if (std::find(others.begin(), others.end(), name.value) != others.end())
      hints.push_back(fmt::format("\"{}\" is {}", name.value, kind_in_words(other)));
  }
  diagnostics.error(name.mark, fmt::format("there is no {} model \"{}\"", kind, name.value),
                    std::move(hints));
  return {};
}

fs::path ModelLibrary::find_and_note(const Located<std::string>& name, const std::string& kind,
                                     const Folders& beside, Diagnostics& diagnostics) {
  std::string key = kind + "\n" + name.value;
  for (const fs::path& folder : beside) key += "\n" + folder.string();
  fs::path& file = places_[key];
  if (file.empty()) file = find(name, kind, beside, diagnostics);
  if (!file.empty() && !find_found(file)) found_.push_back({name.value, file, ""});
  if (!file.empty()) named_at_.emplace(kind + "\n" + file.string(), name.mark);
  return file;
}

std::vector<std::string> ModelLibrary::naming_hints(const std::string& kind,
                                                    const fs::path& file) const {
  const auto named = named_at_.find(kind + "\n" + file.string());
  if (named == named_at_.end() || !named->second.file) return {};
  const Mark& mark = named->second;
  return {fmt::format("{}:{}:{} names it as the model of a {}", *mark.file, mark.line, mark.column,
                      kind)};
}

FoundModel* ModelLibrary::find_found(const fs::path& file) {
  const auto found = std::find_if(found_.begin(), found_.end(),
                                  [&](const FoundModel& model) { return model.file == file; });
  return found != found_.end() ? &*found : nullptr;
}

void ModelLibrary::begin_case() {
  found_.clear();
  named_at_.clear();
  ++case_;
}

std::string ModelLibrary::changes_of(const fs::path& file) const {
  std::string text;
  for (const FoundModel& model : found_)
    if (model.file == file)
      for (const KeyChange& change : changes_)
        if (change.file == model.name) text += change.key + "=" + change.value + "\n";
  return text;
}

void ModelLibrary::complain_about_unused_changes(Diagnostics& diagnostics) const {
  std::vector<std::string> models;
  for (const FoundModel& model : found_)
    if (!model.text.empty()) models.push_back(model.name);
  for (const KeyChange& change : changes_) {
    if (change.file.empty() || std::find(models.begin(), models.end(), change.file) != models.end())
      continue;
    diagnostics.error(
        change.mark, fmt::format("the case has no model \"{}\" to change", change.file),
        {names_hint("its cranes, blocks, ropes and standards are", models, change.file)});
  }
}

std::optional<Document> ModelLibrary::load(const fs::path& file, Diagnostics& diagnostics) {
  FoundModel* const found = find_found(file);
  if (!found) return load_document(file, diagnostics);
  std::optional<Document> document = load_changed(file, found->name, diagnostics);
  if (document) found->text = document->text;
  return document;
}

std::optional<Document> ModelLibrary::load_changed(const fs::path& file, const std::string& name,
                                                   Diagnostics& diagnostics) {
  // Where keys change they are likely to change again: reading a document takes far longer.
  const bool changes = std::any_of(changes_.begin(), changes_.end(),
                                   [&](const KeyChange& change) { return change.file == name; });
  if (!changes) return load_document(file, diagnostics);
  auto known = changing_.find(file);
  if (known == changing_.end()) {
    std::optional<Document> document = load_document(file, diagnostics);
    if (!document) return std::nullopt;
    known = changing_.emplace(file, ChangingDocument(*document)).first;
  }
  return known->second.with(changes_, name, diagnostics);
}

template <class Model>
ModelLibrary::Kept<Model>* ModelLibrary::find_kept(std::map<std::string, Kept<Model>>& kept,
                                                   const std::string& key, const fs::path& file) {
  const auto known = kept.find(key);
  if (known == kept.end()) return nullptr;
  Kept<Model>& one = known->second;
  if (one.last_case == case_) return &one;
  if (!one.is_sound || one.changes != changes_of(file)) return nullptr;
  one.last_case = case_;
  if (FoundModel* const found = find_found(file)) found->text = one.text;
  return &one;
}

template <class Model>
ModelLibrary::Kept<Model> ModelLibrary::kept_of(std::shared_ptr<const Model> model,
                                                const fs::path& file, bool is_sound) const {
  Kept<Model> kept{std::move(model), {}, {}, changes_of(file), case_, is_sound};
  for (const FoundModel& found : found_)
    if (found.file == file) kept.text = found.text;
  return kept;
}

template <class Model, class Read>
std::shared_ptr<const Model> ModelLibrary::keep(std::map<std::string, Kept<Model>>& kept,
                                                const fs::path& file, Diagnostics& diagnostics,
                                                const Read& read) {
  if (const Kept<Model>* known = find_kept(kept, file.string(), file)) return known->model;
  const std::size_t errors_before = diagnostics.error_count();
  std::shared_ptr<const Model> model = read();
  kept[file.string()] = kept_of(model, file, diagnostics.error_count() == errors_before);
  return model;
}

std::vector<std::string> ModelLibrary::names_of_kind(const std::string& kind,
                                                     const Folders& beside) const {
  std::vector<std::string> names;
  for (const fs::path& folder : model_folders_) add_models(folder, kind, false, names);
  for (const fs::path& folder : beside)
    add_models(folder.empty() ? fs::path(".") : folder, kind, true, names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  // A crane brings ropes of its own: "gantry/ropes/tackle" tells no more than "ropes/tackle".
  const std::vector<std::string> all = names;
  std::erase_if(names, [&](const std::string& name) {
    return std::any_of(all.begin(), all.end(),
                       [&](const std::string& shorter) { return name.ends_with("/" + shorter); });
  });
  return names;
}

std::shared_ptr<const CraneModel> ModelLibrary::load_crane(const Located<std::string>& name,
                                                           const fs::path& beside,
                                                           Diagnostics& diagnostics,
                                                           const ParameterValues& parameters) {
  const fs::path file = find_and_note(name, "crane", {beside}, diagnostics);
  return file.empty() ? nullptr : read_crane(file, diagnostics, parameters, beside);
}

std::shared_ptr<const BlockModel> ModelLibrary::load_block(const Located<std::string>& name,
                                                           const fs::path& beside,
                                                           Diagnostics& diagnostics) {
  const fs::path file = find_and_note(name, "block", {beside}, diagnostics);
  return file.empty() ? nullptr : read_block(file, diagnostics, beside);
}

std::shared_ptr<const Vessel> ModelLibrary::load_vessel(const Located<std::string>& name,
                                                        const fs::path& beside,
                                                        Diagnostics& diagnostics) {
  const fs::path file = find_and_note(name, "vessel", {beside}, diagnostics);
  if (file.empty()) return nullptr;
  return keep(vessels_, file, diagnostics, [&]() -> std::shared_ptr<const Vessel> {
    Diagnostics ignored;  // the vessel's reader says the same
    const std::optional<Document> document = load_document(file, ignored);
    if (document && !is_of_kind(*document, "vessel", diagnostics, naming_hints("vessel", file)))
      return nullptr;
    std::optional<Vessel> vessel = read_vessel(file, diagnostics, {beside});
    return vessel ? std::make_shared<const Vessel>(std::move(*vessel)) : nullptr;
  });
}

std::shared_ptr<const RopeModel> ModelLibrary::find_rope(const RopeChoice& choice,
                                                         const Folders& beside,
                                                         Diagnostics& diagnostics) {
  if (choice.keys || !choice.model_name || choice.model_name->value.empty()) return nullptr;
  const fs::path file = find_and_note(*choice.model_name, "rope", beside, diagnostics);
  return file.empty() ? nullptr : read_rope(file, diagnostics);
}

RopeModel ModelLibrary::resolve_among(const RopeChoice& choice, const Folders& beside,
                                      Diagnostics& diagnostics) {
  return rope_of(choice, find_rope(choice, beside, diagnostics));
}

std::shared_ptr<const CraneModel> ModelLibrary::read_crane(const fs::path& file,
                                                           Diagnostics& diagnostics,
                                                           const ParameterValues& parameters,
                                                           const std::optional<fs::path>& of_case) {
  std::string key = file.string();
  for (const Named<Located<Measure>>& parameter : parameters) {
    key += fmt::format("\n{} = {:a}", parameter.name.value, parameter.value.value.value);
  }
  Folders beside = {file.parent_path()};
  if (of_case) beside.push_back(*of_case);
  const auto ropes_of = [&](const CraneModel& crane) {
    Ropes ropes;
    for (const HoistModel& hoist : crane.hoists)
      ropes.push_back(find_rope(hoist.rope_choice, beside, diagnostics));
    return ropes;
  };
  const auto before = cranes_.find(key);
  const bool served_this_case = before != cranes_.end() && before->second.last_case == case_;
  if (const Kept<CraneModel>* known = find_kept(cranes_, key, file))
    if (served_this_case || ropes_of(*known->model) == known->ropes) return known->model;
  const std::size_t errors_before = diagnostics.error_count();
  const std::shared_ptr<CraneModel> crane =
      read_model(load(file, diagnostics), "crane", format_once<crane_model_format>(), diagnostics,
                 naming_hints("crane", file), parameters);
  Ropes ropes;
  if (crane) {
    ropes = ropes_of(*crane);
    for (std::size_t hoist = 0; hoist < ropes.size(); ++hoist)
      crane->hoists[hoist].rope = rope_of(crane->hoists[hoist].rope_choice, ropes[hoist]);
  }
  Kept<CraneModel>& kept = cranes_[key];
  kept = kept_of<CraneModel>(crane, file, diagnostics.error_count() == errors_before);
  kept.ropes = std::move(ropes);
  return crane;
}

std::shared_ptr<const BlockModel> ModelLibrary::read_block(const fs::path& file,
                                                           Diagnostics& diagnostics,
                                                           const std::optional<fs::path>& of_case) {
  return keep(blocks_, file, diagnostics, [&] {
    std::shared_ptr<BlockModel> block =
        read_model(load(file, diagnostics), "block", format_once<block_model_format>(), diagnostics,
                   naming_hints("block", file));
    if (block) read_block_mesh(*block, file.parent_path(), diagnostics, of_case);
    return block;
  });
}

std::shared_ptr<const BlockModel> ModelLibrary::read_block_of_own_cases(const fs::path& file,
                                                                        Diagnostics& diagnostics) {
  const std::shared_ptr<BlockModel> block =
      read_model(load(file, diagnostics), "block", format_once<block_model_format>(), diagnostics);
  if (block)
    read_block_mesh(*block, file.parent_path(), diagnostics, std::nullopt, MeshUse::own_cases);
  return block;
}

std::shared_ptr<const RopeModel> ModelLibrary::read_rope(const fs::path& file,
                                                         Diagnostics& diagnostics) {
  return keep(ropes_, file, diagnostics, [&] {
    return read_model(load(file, diagnostics), "rope", format_once<rope_model_format>(),
                      diagnostics, naming_hints("rope", file));
  });
}

std::shared_ptr<const StandardRules> ModelLibrary::load_standard(const Located<std::string>& name,
                                                                 const fs::path& beside,
                                                                 Diagnostics& diagnostics) {
  const fs::path file = find_and_note(name, "standard", {beside}, diagnostics);
  return file.empty() ? nullptr : read_standard(file, diagnostics);
}

std::shared_ptr<const StandardRules> ModelLibrary::read_standard(const fs::path& file,
                                                                 Diagnostics& diagnostics) {
  return keep(standards_, file, diagnostics, [&] {
    return read_model(load(file, diagnostics), "standard", format_once<standard_rules_format>(),
                      diagnostics, naming_hints("standard", file));
  });
}

std::shared_ptr<const RiggingStock> ModelLibrary::read_rigging(const fs::path& file,
                                                               Diagnostics& diagnostics) {
  const bool is_table = file.extension() == ".csv";
  Diagnostics own;
  const std::shared_ptr<RiggingStock> stock =
      read_model(is_table ? load_rigging_table(file, own) : load(file, own), "rigging",
                 format_once<rigging_stock_format>(), own);
  if (stock && is_table) forget_columns(*stock);
  if (stock) {
    for (StockSling& sling : stock->slings)
      sling.rope = resolve(sling.rope_choice, file.parent_path(), own);
    check_rigging_stock(*stock, own);
  }
  for (const Diagnostic& error : own.errors()) {
    const bool in_table = is_table && error.mark.file && *error.mark.file == shown_path(file);
    diagnostics.error(in_table ? without_column(error.mark) : error.mark, error.message,
                      error.hints);
  }
  return stock;
}

}  // namespace blocklift::pipeline
