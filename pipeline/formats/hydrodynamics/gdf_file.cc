// WAMIT's geometric data file (WAMIT user manual, chapter 6): panels of the low-order method.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/hydrodynamics/hull_file.h"

namespace blocklift::pipeline {
namespace {

// Numbers separated by blanks or commas, with the line of each. A line of the header may end in
// words, as many programs write them.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& path) : path_(path), stream_(path) {
    if (!stream_) throw HullFileError(path.string() + ": the file cannot be opened");
    std::string title;
    std::getline(stream_, title);
    line_ = 1;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw HullFileError(path_.string() + ":" + std::to_string(line_) + ": " + what);
  }

  // The next number of the file, whatever the lines.
  double next(const std::string& due) {
    std::string token;
    while (!(words_ >> token)) {
      if (!next_line()) fail("the file ends where " + due + " is due");
    }
    return parse(token, due);
  }

  // Two numbers at the beginning of a new line; the rest of it does not count.
  std::array<double, 2> pair(const std::string& due) {
    if (!next_line()) fail("the file ends where " + due + " are due");
    const double first = next(due);
    const double second = next(due);
    words_.setstate(std::ios::eofbit | std::ios::failbit);
    return {first, second};
  }
  double single(const std::string& due) {
    if (!next_line()) fail("the file ends where " + due + " is due");
    const double value = next(due);
    words_.setstate(std::ios::eofbit | std::ios::failbit);
    return value;
  }

 private:
  bool next_line() {
    std::string line;
    if (!std::getline(stream_, line)) return false;
    ++line_;
    for (char& c : line) {
      if (c == ',' || c == '\t' || c == '\r') c = ' ';
      if (c == 'd' || c == 'D') c = 'e';  // Fortran's double precision
    }
    words_ = std::istringstream(line);
    return true;
  }
  double parse(const std::string& token, const std::string& due) const {
    const char* begin = token.data() + (token.front() == '+' ? 1 : 0);
    const char* end = token.data() + token.size();
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
      fail("\"" + token + "\" is no finite number; " + due + " is due");
    }
    return value;
  }

  std::filesystem::path path_;
  std::ifstream stream_;
  std::istringstream words_;
  int line_ = 0;
};

double metres_by_gravity(double gravity, const Numbers& numbers) {
  if (gravity > 9.5 && gravity < 10.1) return 1.0;
  if (gravity > 31.5 && gravity < 32.8) return 0.3048;
  numbers.fail("GRAV is " + std::to_string(gravity) +
               "; 9.8 (the hull is in metres) or 32.2 (in feet) is due");
}

bool is_symmetric(double flag, const char* name, const Numbers& numbers) {
  if (flag == 0.0) return false;
  if (flag == 1.0) return true;
  numbers.fail(std::string(name) + " is " + std::to_string(flag) +
               "; 0 (no symmetry) or 1 (a plane of symmetry) is due");
}

/// A hull that is to be mirrored lies on one side of the plane.
void require_one_side(const std::array<dynamics::Vector3, 2>& box, int axis, double tolerance,
                      const Numbers& numbers) {
  const double low = box[0][axis], high = box[1][axis];
  if (low >= -tolerance || high <= tolerance) return;
  const char* const name = axis == 0 ? "x" : "y";
  std::ostringstream text;
  text << (axis == 0 ? "ISX" : "ISY") << " is 1 in line 3, so that the panels are one side of "
       << name << " = 0, but they reach from " << name << " = " << low << " m to " << high
       << " m; give 0 if the mesh is whole, or leave out one of its halves";
  numbers.fail(text.str());
}

}  // namespace

dynamics::Hull read_gdf(const std::filesystem::path& path, double merge_tolerance) {
  Numbers numbers(path);
  const double metres = metres_by_gravity(numbers.pair("ULEN and GRAV")[1], numbers);
  const auto [isx, isy] = numbers.pair("ISX and ISY");
  const bool mirror_x = is_symmetric(isx, "ISX", numbers);
  const bool mirror_y = is_symmetric(isy, "ISY", numbers);
  const double count = numbers.single("the number of panels, NPAN,");
  if (!(count >= 1.0) || count != std::floor(count) || count > 1e7) {
    numbers.fail("NPAN is " + std::to_string(count) + "; the number of panels is due");
  }
  dynamics::Hull hull(path.stem().string());
  for (int panel = 0; panel < static_cast<int>(count); ++panel) {
    std::array<int, 4> corners{};
    for (int& corner : corners) {
      dynamics::Vector3 p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = metres * numbers.next("a coordinate of panel " + std::to_string(panel + 1) +
                                        " of " + std::to_string(static_cast<int>(count)));
      }
      corner = hull.add_vertex(p);
    }
    hull.add_panel(corners);
  }
  const auto box = hull.bounds();
  const double tolerance = merge_tolerance * (box[1] - box[0]).norm();
  const double off_plane = 1e-4 * (box[1] - box[0]).norm();
  if (mirror_x) require_one_side(box, 0, off_plane, numbers);
  if (mirror_y) require_one_side(box, 1, off_plane, numbers);
  hull = merge_vertices(hull, tolerance);
  if (hull.panel_count() == 0) numbers.fail("no panel has three vertices in different places");
  if (mirror_x) hull = with_mirror_image(hull, 0, tolerance);
  if (mirror_y) hull = with_mirror_image(hull, 1, tolerance);
  return hull;
}

void write_gdf(const dynamics::Hull& hull, const std::filesystem::path& path, double gravity) {
  std::ostringstream text;
  text.precision(17);
  text << hull.name() << "\n1 " << gravity << "\n0 0\n" << hull.panel_count() << '\n';
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const std::span<const int> corners = hull.panel(panel);
    if (corners.size() > 4) {
      throw HullFileError(path.string() + ": panel " + std::to_string(panel) + " of hull \"" +
                          hull.name() + "\" has " + std::to_string(corners.size()) +
                          " vertices; a .gdf holds panels of three or four");
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const dynamics::Vector3& p = hull.vertex(corners[std::min(i, corners.size() - 1)]);
      text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
  }
  write_file(path, text.str());
}

}  // namespace blocklift::pipeline
