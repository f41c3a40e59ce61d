#include "pipeline/formats/results/preparation.h"

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <utility>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* preparation_folder = ".in-preparation";
constexpr const char* earlier_folder = "earlier";
constexpr const char* list_file = "moves.txt";

/// What is done with one name of the folder of the results.
struct Move {
  bool is_new = false;  ///< a file takes the name; otherwise an older file of the name goes
  std::string name;

  /// The later a file comes, the sooner an older one leaves: figures, pages, the verdict.
  int place() const {
    if (name == layout::summary_file) return 2;
    return fs::path(name).extension() == ".html" ? 1 : 0;
  }
};

/// In the order in which files come.
std::vector<Move> plan_moves(const fs::path& aside, const std::vector<std::string>& absent) {
  std::vector<Move> moves;
  for (const fs::directory_entry& entry : fs::directory_iterator(aside))
    moves.push_back({true, entry.path().filename().string()});
  for (const std::string& name : absent)
    if (!fs::exists(aside / name)) moves.push_back({false, name});
  std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
    return std::pair(a.place(), a.name) < std::pair(b.place(), b.name);
  });
  return moves;
}

std::string text_of(const std::vector<Move>& moves) {
  std::string text;
  for (const Move& move : moves) {
    text += move.is_new ? "+ " : "- ";
    text += move.name + "\n";
  }
  return text;
}

std::vector<Move> moves_of(const std::string& text) {
  std::vector<Move> moves;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.size() > 2) moves.push_back({line[0] == '+', line.substr(2)});
  return moves;
}

/// Renamings that can be taken back.
class Renamings {
 public:
  void rename(const fs::path& from, const fs::path& to) {
    fs::rename(from, to);
    done_.emplace_back(from, to);
  }
  /// @returns false if something stays where it was moved to.
  bool take_back() noexcept {
    bool all = true;
    for (auto one = done_.rbegin(); one != done_.rend(); ++one) {
      std::error_code error;
      fs::rename(one->second, one->first, error);
      all = all && !error;
    }
    return all;
  }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

void move_all(const std::vector<Move>& moves, const fs::path& aside, const fs::path& folder,
              Renamings& renamings) {
  for (auto move = moves.rbegin(); move != moves.rend(); ++move) {
    const fs::path place = folder / move->name;
    if (fs::is_directory(place))
      throw fs::filesystem_error("cannot replace a folder by a file", place,
                                 std::make_error_code(std::errc::is_a_directory));
    if (fs::exists(fs::symlink_status(place)))
      renamings.rename(place, aside / earlier_folder / move->name);
  }
  for (const Move& move : moves)
    if (move.is_new) renamings.rename(aside / move.name, folder / move.name);
}

}  // namespace

void complete_stopped_move(const fs::path& folder) {
  const fs::path aside = folder / preparation_folder;
  std::error_code ignored;
  if (!fs::is_regular_file(aside / list_file, ignored)) return;
  const std::vector<Move> moves = moves_of(read_file(aside / list_file));
  // What has left its place in there has come already; nothing else of the name is older.
  for (auto move = moves.rbegin(); move != moves.rend(); ++move)
    if (!move->is_new || fs::exists(aside / move->name)) fs::remove(folder / move->name);
  for (const Move& move : moves)
    if (move.is_new && fs::exists(aside / move.name))
      fs::rename(aside / move.name, folder / move.name);
  fs::remove_all(aside);
}

Preparation::Preparation(const fs::path& folder)
    : folder_(folder), aside_(folder / preparation_folder) {
  complete_stopped_move(folder_);
  for (fs::path above = fs::absolute(folder_).lexically_normal(); !fs::exists(above);
       above = above.parent_path()) {
    // "a/b/" has an empty name after its last slash
    if (above.has_filename()) made_.push_back(above);
  }
  fs::create_directories(folder_);
  fs::remove_all(aside_);
  fs::create_directory(aside_);
}

Preparation::~Preparation() {
  if (is_kept_) return;
  std::error_code ignored;
  fs::remove_all(aside_, ignored);
  // Only folders that are empty can be removed so.
  for (const fs::path& made : made_) fs::remove(made, ignored);
}

void Preparation::move_into_place(const std::vector<std::string>& absent) {
  const std::vector<Move> moves = plan_moves(aside_, absent);
  fs::create_directory(aside_ / earlier_folder);
  write_file(aside_ / list_file, text_of(moves));
  Renamings renamings;
  try {
    move_all(moves, aside_, folder_, renamings);
  } catch (...) {
    is_kept_ = !renamings.take_back();
    std::error_code ignored;
    fs::remove(aside_ / list_file, ignored);
    throw;
  }
}

}  // namespace blocklift::pipeline
