#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/files/library/model_library.h"
#include "pipeline/files/rigging/rigging_stock.h"

namespace blocklift::pipeline {

/// A sling that may be chosen, with the rule of its stock.
struct SlingInStock {
  StockSling sling;
  SlingConstruction construction = SlingConstruction::wire_rope;
  std::string rule;  ///< "EN 13414-1"

  const std::string& name() const { return sling.name.value; }
};

/// A shackle that may be chosen, with the rule of its stock.
struct ShackleInStock {
  StockShackle shackle;
  std::string rule;

  const std::string& name() const { return shackle.name.value; }
};

/// A master link that may be chosen, with the rule of its stock.
struct MasterLinkInStock {
  StockMasterLink link;
  std::string rule;

  const std::string& name() const { return link.name.value; }
};

/// A sheave that may be chosen, with the rule of its stock.
struct SheaveInStock {
  StockSheave sheave;
  std::string rule;

  const std::string& name() const { return sheave.name.value; }
};

/// A spreader bar that may be chosen, with the rule of its stock.
struct SpreaderInStock {
  StockSpreader spreader;
  std::string rule;

  const std::string& name() const { return spreader.name.value; }
};

/// All that may be chosen, the weakest first.
struct Stock {
  std::vector<SlingInStock> slings;             ///< by breaking load
  std::vector<ShackleInStock> shackles;         ///< by working load
  std::vector<MasterLinkInStock> master_links;  ///< by working load
  std::vector<SheaveInStock> sheaves;           ///< by working load
  std::vector<SpreaderInStock> spreaders;       ///< by mass
};

/// Reads the files of kind rigging in folders, those of their subfolders left out. A file whose
/// name an earlier folder has is passed over.
/// @param constructions of slings that are taken; none: all of them.
/// Complains about a folder that cannot be read, files with mistakes, a name given twice, and a
/// stock without slings.
Stock read_stock(const std::vector<std::filesystem::path>& folders,
                 const std::vector<SlingConstruction>& constructions, ModelLibrary& library,
                 Diagnostics& diagnostics);

/// The stock that is shipped: the folder `rigging` of each folder of models.
std::vector<std::filesystem::path> shipped_stock(const ModelLibrary& library);

}  // namespace blocklift::pipeline
