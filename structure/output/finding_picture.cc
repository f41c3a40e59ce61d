#include "structure/output/finding_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::structure {

namespace {

// Of two shells at an edge: beyond it, the edge is drawn (25 degrees).
constexpr double cosine_of_fold = 0.906;
constexpr std::size_t most_marks = 3000;

class FindingPicture {
 public:
  FindingPicture(const Mesh& mesh, double width) : mesh_(mesh), width_(width) {
    // The axes of the picture: towards the eye, to the right, up.
    const Vector3 eye = Vector3(-0.55, -1, 0.6).normalized();
    right_ = Vector3::UnitZ().cross(eye).normalized();
    up_ = eye.cross(right_);
    find_frame();
  }

  std::string draw(const Finding& finding) const {
    std::string text =
        fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{:.0f}" height="{:.0f}" )"
                    R"(viewBox="0 0 {:.0f} {:.0f}" font-family="sans-serif" font-size="11">)",
                    width_, height_, width_, height_);
    text += R"(<rect width="100%" height="100%" fill="#fff"/><path fill="none" stroke="#9aa5b1" )"
            R"(stroke-width="0.6" d=")" +
            outline() + R"("/>)";
    if (!mesh_.beams.empty())
      text += R"(<path fill="none" stroke="#5b7fa6" stroke-width="0.8" d=")" + beams() + R"("/>)";
    return text + marks(finding) + "</svg>\n";
  }

 private:
  Eigen::Vector2d flat(const Vector3& place) const { return {right_.dot(place), -up_.dot(place)}; }
  Eigen::Vector2d on_paper(const Vector3& place) const {
    return scale_ * (flat(place) - low_) + Eigen::Vector2d::Constant(margin);
  }

  template <typename Visit>
  void for_each_used(const Visit& visit) const {
    for (const Shell& shell : mesh_.shells)
      for (const int vertex : shell.vertices) visit(mesh_.vertices[vertex]);
    for (const Beam& beam : mesh_.beams)
      for (const int vertex : beam.vertices) visit(mesh_.vertices[vertex]);
  }

  void find_frame() {
    low_.setConstant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low_;
    for_each_used([&](const Vector3& place) {
      low_ = low_.cwiseMin(flat(place));
      high = high.cwiseMax(flat(place));
    });
    if (!(low_.x() <= high.x())) low_ = high = Eigen::Vector2d::Zero();
    const Eigen::Vector2d size = (high - low_).cwiseMax(1e-9);
    // As wide as it may be, but no higher than wide.
    scale_ = (width_ - 2 * margin) / size.maxCoeff();
    height_ = scale_ * size.y() + 2 * margin;
  }

  std::string line(const Vector3& from, const Vector3& to) const {
    const Eigen::Vector2d a = on_paper(from), b = on_paper(to);
    return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
  }

  Vector3 normal(int shell) const {
    const auto& v = mesh_.shells[shell].vertices;
    return (mesh_.vertices[v[3]] - mesh_.vertices[v[0]])
        .cross(mesh_.vertices[v[2]] - mesh_.vertices[v[1]])
        .normalized();
  }

  std::string outline() const {
    std::vector<std::tuple<int, int, int>> edges;  // two vertices, a shell
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const auto& v = mesh_.shells[s].vertices;
      for (const auto& [a, b] : {std::pair(v[0], v[1]), std::pair(v[1], v[3]),
                                 std::pair(v[3], v[2]), std::pair(v[2], v[0])})
        if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b), static_cast<int>(s));
    }
    std::sort(edges.begin(), edges.end());
    std::string text;
    for (std::size_t i = 0; i < edges.size();) {
      const int a = std::get<0>(edges[i]), b = std::get<1>(edges[i]);
      std::size_t end = i;
      while (end < edges.size() && std::get<0>(edges[end]) == a && std::get<1>(edges[end]) == b)
        ++end;
      if (end - i != 2 || is_drawn(std::get<2>(edges[i]), std::get<2>(edges[i + 1])))
        text += line(mesh_.vertices[a], mesh_.vertices[b]);
      i = end;
    }
    return text;
  }

  bool is_drawn(int one, int other) const {
    return mesh_.shells[one].section != mesh_.shells[other].section ||
           std::abs(normal(one).dot(normal(other))) < cosine_of_fold;
  }

  std::string beams() const {
    std::string text;
    for (const Beam& beam : mesh_.beams)
      text += line(mesh_.vertices[beam.vertices[0]], mesh_.vertices[beam.vertices[1]]);
    return text;
  }

  std::string marks(const Finding& finding) const {
    std::string text = R"(<g fill="#d62728" fill-opacity="0.6">)";
    const std::size_t step = 1 + finding.places.size() / most_marks;
    for (std::size_t i = 0; i < finding.places.size(); i += step) {
      const Eigen::Vector2d place = on_paper(finding.places[i]);
      text += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3"/>)", place.x(), place.y());
    }
    text += "</g><g>";
    for (std::size_t i = 0; i < std::min<std::size_t>(5, finding.labels.size()); ++i) {
      if (i >= finding.places.size()) break;
      const Eigen::Vector2d place = on_paper(finding.places[i]);
      text += fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", place.x() + 4, place.y() - 4,
                          finding.labels[i]);
    }
    return text + "</g>";
  }

  static constexpr double margin = 24;
  const Mesh& mesh_;
  double width_, height_ = 0, scale_ = 1;
  Vector3 right_, up_;
  Eigen::Vector2d low_;
};

}  // namespace

std::string finding_picture(const Mesh& mesh, const Finding& finding, double width) {
  return FindingPicture(mesh, width).draw(finding);
}

}  // namespace blocklift::structure
