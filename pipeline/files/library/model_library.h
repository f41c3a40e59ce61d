#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/key_change.h"
#include "pipeline/files/crane/crane_model.h"
#include "pipeline/files/rigging/rigging_stock.h"
#include "pipeline/files/rigging/rope_model.h"
#include "pipeline/files/standard/standard_rules.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/vessel/vessel_model.h"

namespace blocklift::pipeline {

/// A model file that was found by its name.
struct FoundModel {
  std::string name;  ///< as the file that names it writes it
  std::filesystem::path file;
  std::string text;  ///< as it was read, with its changes; of vessels none
};

/// Finds and reads model files by name.
///
/// A model `cranes/goliath-600t` of the kind crane is one of the files, in this order of places and
/// names: in the folder of the file that names it, for a crane's rope in the folder of the case
/// that names the crane, then in each folder of models,
///   cranes/goliath-600t, cranes/goliath-600t.yaml, cranes/goliath-600t/crane.yaml.
/// A standard's name may do without its folder: nd-0027 is standards/nd-0027.
/// A name that leads out of all these folders is refused, unless files outside are allowed.
/// Each file is read once, however often it is named; a crane once for each set of parameters. Of a
/// case that is read again with other changes, what these do not touch is not read again.
class ModelLibrary {
 public:
  explicit ModelLibrary(std::vector<std::filesystem::path> model_folders)
      : model_folders_(std::move(model_folders)) {}

  /// Of the folders of model_path().
  static ModelLibrary of_installation();

  const std::vector<std::filesystem::path>& folders() const { return model_folders_; }

  /// Files of one name in the folders right below `group`, in the order of those folders' names:
  /// benchmarks/bricard/reference.yaml of the group benchmarks. Of folders of the same name in
  /// several folders of models the first counts.
  std::vector<std::filesystem::path> files_of(const std::string& group,
                                              const std::string& file_name) const;

  /// Reads a model; complains at the place of the name if there is none, and returns null then and
  /// when the file cannot be read. A model with mistakes inside is returned, too: they have been
  /// complained about, and the checks pass over what is missing.
  /// @param parameters values that take the place of the crane's own.
  std::shared_ptr<const CraneModel> load_crane(const Located<std::string>& name,
                                               const std::filesystem::path& beside,
                                               Diagnostics& diagnostics,
                                               const ParameterValues& parameters = {});
  std::shared_ptr<const BlockModel> load_block(const Located<std::string>& name,
                                               const std::filesystem::path& beside,
                                               Diagnostics& diagnostics);
  /// @returns null also if the vessel has mistakes inside: its hull cannot be made then.
  std::shared_ptr<const Vessel> load_vessel(const Located<std::string>& name,
                                            const std::filesystem::path& beside,
                                            Diagnostics& diagnostics);
  std::shared_ptr<const StandardRules> load_standard(const Located<std::string>& name,
                                                     const std::filesystem::path& beside,
                                                     Diagnostics& diagnostics);
  /// The rope that is chosen by name or by its keys. @returns an empty rope if there is none.
  RopeModel resolve(const RopeChoice& choice, const std::filesystem::path& beside,
                    Diagnostics& diagnostics) {
    return resolve_among(choice, {beside}, diagnostics);
  }

  /// The file of a vessel: vessel.yaml in its folder. Empty after a complaint.
  std::filesystem::path find_vessel(const Located<std::string>& name,
                                    const std::filesystem::path& beside,
                                    Diagnostics& diagnostics) const {
    return find(name, "vessel", {beside}, diagnostics);
  }

  /// A case is read from now on, or read again: what was found for the one before is forgotten, and
  /// models with mistakes inside will be read, and complained about, again.
  void begin_case();
  /// The models that were found since a case was begun, each file once, in the order of their first
  /// naming.
  const std::vector<FoundModel>& found() const { return found_; }

  /// Keys of cranes, blocks, ropes and standards, and of the case file, that are to have other
  /// values in the case that is begun next.
  void set_changes(std::vector<KeyChange> changes) { changes_ = std::move(changes); }
  /// Reads a case file with its changes. Its nodes are those of the same file read before.
  std::optional<Document> read_case(const std::filesystem::path& file, Diagnostics& diagnostics) {
    return load_changed(file, "", diagnostics);
  }
  /// Complains about changes of models that were not read.
  void complain_about_unused_changes(Diagnostics& diagnostics) const;

  /// Reads a crane's file itself, with the ropes that it names.
  /// @param of_case the folder of the case that names the crane, if there is one.
  std::shared_ptr<const CraneModel> read_crane(
      const std::filesystem::path& file, Diagnostics& diagnostics,
      const ParameterValues& parameters = {},
      const std::optional<std::filesystem::path>& of_case = std::nullopt);
  /// @param of_case the folder of the case that names the block, if there is one.
  std::shared_ptr<const BlockModel> read_block(
      const std::filesystem::path& file, Diagnostics& diagnostics,
      const std::optional<std::filesystem::path>& of_case = std::nullopt);
  /// Reads a block's file for the load cases of its own deck. It is not kept.
  std::shared_ptr<const BlockModel> read_block_of_own_cases(const std::filesystem::path& file,
                                                            Diagnostics& diagnostics);
  std::shared_ptr<const RopeModel> read_rope(const std::filesystem::path& file,
                                             Diagnostics& diagnostics);
  std::shared_ptr<const StandardRules> read_standard(const std::filesystem::path& file,
                                                     Diagnostics& diagnostics);
  /// Reads a stock with the ropes that it names, which are looked for beside it, too, and checks
  /// that its figures hold together.
  std::shared_ptr<const RiggingStock> read_rigging(const std::filesystem::path& file,
                                                   Diagnostics& diagnostics);

 private:
  using Folders = std::vector<std::filesystem::path>;

  using Ropes = std::vector<std::shared_ptr<const RopeModel>>;

  /// A model that was read.
  template <class Model>
  struct Kept {
    std::shared_ptr<const Model> model;
    Ropes ropes;            ///< that it names
    std::string text;       ///< of its file, with its changes
    std::string changes;    ///< that were made in its file
    int last_case = 0;      ///< that it served
    bool is_sound = false;  ///< nothing was complained about
  };
  /// The model that is kept by a key; null if none is, or not one that serves the case at hand.
  template <class Model>
  Kept<Model>* find_kept(std::map<std::string, Kept<Model>>& kept, const std::string& key,
                         const std::filesystem::path& file);
  /// The model that is kept of a file, or else is read now.
  template <class Model, class Read>
  std::shared_ptr<const Model> keep(std::map<std::string, Kept<Model>>& kept,
                                    const std::filesystem::path& file, Diagnostics& diagnostics,
                                    const Read& read);
  /// What a model was read as, to be kept.
  template <class Model>
  Kept<Model> kept_of(std::shared_ptr<const Model> model, const std::filesystem::path& file,
                      bool is_sound) const;

  /// The rope that is chosen by name; null if none is, or it cannot be read.
  std::shared_ptr<const RopeModel> find_rope(const RopeChoice& choice, const Folders& beside,
                                             Diagnostics& diagnostics);
  RopeModel resolve_among(const RopeChoice& choice, const Folders& beside,
                          Diagnostics& diagnostics);
  /// The file of a model; empty after a complaint.
  /// @param beside folders that come before those of models.
  std::filesystem::path find(const Located<std::string>& name, const std::string& kind,
                             const Folders& beside, Diagnostics& diagnostics) const;
  /// The same; keeps the file in mind as one that was found.
  std::filesystem::path find_and_note(const Located<std::string>& name, const std::string& kind,
                                      const Folders& beside, Diagnostics& diagnostics);
  std::vector<std::string> names_of_kind(const std::string& kind, const Folders& beside) const;
  /// What may have been meant by a name that no model of the kind has; empty if nothing is near.
  std::string hint_of_name(const std::string& name, const std::string& kind,
                           const Folders& beside) const;
  /// Who named a file as a model of that kind first; empty if nobody did.
  std::vector<std::string> naming_hints(const std::string& kind,
                                        const std::filesystem::path& file) const;
  FoundModel* find_found(const std::filesystem::path& file);
  /// The changes of a file that was found by its name, as text.
  std::string changes_of(const std::filesystem::path& file) const;
  /// The document of a model's file with its changes.
  std::optional<Document> load(const std::filesystem::path& file, Diagnostics& diagnostics);
  std::optional<Document> load_changed(const std::filesystem::path& file, const std::string& name,
                                       Diagnostics& diagnostics);

  std::vector<std::filesystem::path> model_folders_;
  std::map<std::string, std::filesystem::path> places_;  ///< of names, by kind and folders
  std::map<std::filesystem::path, ChangingDocument> changing_;
  std::vector<FoundModel> found_;
  std::map<std::string, Mark> named_at_;  ///< where a file was named first, by kind and file
  std::vector<KeyChange> changes_;
  int case_ = 0;
  std::map<std::string, Kept<CraneModel>> cranes_;  ///< by file and parameters
  std::map<std::string, Kept<BlockModel>> blocks_;
  std::map<std::string, Kept<RopeModel>> ropes_;
  std::map<std::string, Kept<Vessel>> vessels_;
  std::map<std::string, Kept<StandardRules>> standards_;
};

}  // namespace blocklift::pipeline
