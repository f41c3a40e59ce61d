#include "pipeline/rigging/stock.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "pipeline/declaration/document.h"
#include "pipeline/files/file_kind.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

Mark mark_of_folder(const fs::path& folder) {
  return {std::make_shared<const std::string>(shown_path(folder)), 0, 0};
}

/// Files of kind rigging by their names, those of the first folder before others.
std::map<std::string, fs::path> stock_files(const std::vector<fs::path>& folders,
                                            Diagnostics& diagnostics) {
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
      const fs::path extension = entry->path().extension();
      if ((extension == ".yaml" || extension == ".csv") &&
          kind_of_file(entry->path()) == FileKind::rigging)
        files.emplace(entry->path().filename().string(), entry->path());
    }
    if (error)
      diagnostics.error(mark_of_folder(folder),
                        "no stock can be read from this folder: " + error.message());
  }
  return files;
}

/// Takes the items of one file.
class StockGatherer {
 public:
  StockGatherer(const std::vector<SlingConstruction>& constructions, Diagnostics& diagnostics)
      : constructions_(constructions), diagnostics_(diagnostics) {}

  void add(const RiggingStock& file) {
    for (const StockSling& sling : file.slings) {
      is_new(sling.name);
      if (file.construction && is_wanted(*file.construction))
        stock_.slings.push_back({sling, *file.construction, file.rule.name});
    }
    for (const StockShackle& shackle : file.shackles) {
      is_new(shackle.name);
      stock_.shackles.push_back({shackle, file.rule.name});
    }
    for (const StockMasterLink& link : file.master_links) {
      is_new(link.name);
      stock_.master_links.push_back({link, file.rule.name});
    }
    for (const StockSheave& sheave : file.sheaves) {
      is_new(sheave.name);
      stock_.sheaves.push_back({sheave, file.rule.name});
    }
    for (const StockSpreader& spreader : file.spreaders) {
      is_new(spreader.name);
      stock_.spreaders.push_back({spreader, file.rule.name});
    }
  }

  Stock finish() {
    std::stable_sort(stock_.slings.begin(), stock_.slings.end(),
                     [](const SlingInStock& a, const SlingInStock& b) {
                       return a.sling.rope.breaking_load < b.sling.rope.breaking_load;
                     });
    std::stable_sort(stock_.shackles.begin(), stock_.shackles.end(),
                     [](const ShackleInStock& a, const ShackleInStock& b) {
                       return a.shackle.working_load < b.shackle.working_load;
                     });
    std::stable_sort(stock_.master_links.begin(), stock_.master_links.end(),
                     [](const MasterLinkInStock& a, const MasterLinkInStock& b) {
                       return a.link.working_load < b.link.working_load;
                     });
    std::stable_sort(stock_.sheaves.begin(), stock_.sheaves.end(),
                     [](const SheaveInStock& a, const SheaveInStock& b) {
                       return a.sheave.working_load < b.sheave.working_load;
                     });
    std::stable_sort(stock_.spreaders.begin(), stock_.spreaders.end(),
                     [](const SpreaderInStock& a, const SpreaderInStock& b) {
                       return a.spreader.bar.mass() < b.spreader.bar.mass();
                     });
    return std::move(stock_);
  }

 private:
  void is_new(const Located<std::string>& name) {
    if (names_.insert(name.value).second) return;
    diagnostics_.error(name.mark, fmt::format("the stock has \"{}\" twice", name.value),
                       {"names are unique over all files of a stock"});
  }
  bool is_wanted(SlingConstruction construction) const {
    return constructions_.empty() || std::find(constructions_.begin(), constructions_.end(),
                                               construction) != constructions_.end();
  }

  const std::vector<SlingConstruction>& constructions_;
  Diagnostics& diagnostics_;
  std::set<std::string> names_;
  Stock stock_;
};

}  // namespace

Stock read_stock(const std::vector<fs::path>& folders,
                 const std::vector<SlingConstruction>& constructions, ModelLibrary& library,
                 Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  StockGatherer gatherer(constructions, diagnostics);
  for (const auto& [name, file] : stock_files(folders, diagnostics))
    if (const auto stock = library.read_rigging(file, diagnostics)) gatherer.add(*stock);
  Stock stock = gatherer.finish();
  if (stock.slings.empty() && diagnostics.error_count() == errors_before)
    diagnostics.error(mark_of_folder(folders.empty() ? fs::path("rigging") : folders.front()),
                      "the stock has no slings of the kind that is asked for",
                      {"a stock is a folder of files of kind rigging, as models/rigging is"});
  return stock;
}

std::vector<fs::path> shipped_stock(const ModelLibrary& library) {
  std::vector<fs::path> folders;
  for (const fs::path& models : library.folders()) {
    std::error_code ignored;
    if (fs::is_directory(models / "rigging", ignored)) folders.push_back(models / "rigging");
  }
  return folders;
}

}  // namespace blocklift::pipeline
