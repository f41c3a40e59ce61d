#include "structure/mesh/files/abaqus/generation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

/// More would be a slip of the keyboard, not a block.
constexpr long most_made = 10'000'000;

void refuse(const AbaqusBlock& block, std::initializer_list<const char*> unknown) {
  for (const char* parameter : unknown)
    if (block.has(parameter)) throw CardError{fmt::format("{} is not known", parameter)};
}

long whole(const Fields& fields, std::size_t i, const char* what, long otherwise) {
  return i < fields.size() && !fields[i].empty() ? abaqus_integer(fields[i], what) : otherwise;
}

long whole(const AbaqusBlock& block, const char* parameter) {
  return abaqus_integer(block.required(parameter), parameter);
}

Vector3 point(const Fields& fields, std::size_t first) {
  return {abaqus_real(fields, first, "coordinate", 0.0),
          abaqus_real(fields, first + 1, "coordinate", 0.0),
          abaqus_real(fields, first + 2, "coordinate", 0.0)};
}

/// Turns `from` about a centre towards `to` by a share of the angle between them, less than half a
/// turn; the radius goes linearly from one to the other.
Vector3 on_arc(const Vector3& from, const Vector3& to, const Vector3& centre, double share) {
  const Vector3 a = from - centre, b = to - centre;
  const Vector3 axis = a.cross(b);
  if (!(axis.norm() > 1e-9 * a.norm() * b.norm()))
    throw CardError{"the ends of an arc lie on one line with its centre"};
  const double angle = std::atan2(axis.norm(), a.dot(b));
  const double radius = (1 - share) * a.norm() + share * b.norm();
  return centre + radius * (Eigen::AngleAxisd(share * angle, axis.normalized()) * a.normalized());
}

class NodeMaker {
 public:
  NodeMaker(const AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block,
            const std::vector<long>& labels)
      : model_(model), scope_(scope), block_(block), labels_(labels) {}

  MadeNodes make() {
    if (block_.name == "NGEN") each_line([&](const Fields& fields) { between(fields); });
    if (block_.name == "NFILL") each_line([&](const Fields& fields) { fill(fields); });
    if (block_.name == "NCOPY") copy();
    return std::move(made_);
  }

 private:
  template <typename Step>
  void each_line(const Step& step) {
    made_.set = block_.value("NSET");
    for (const AbaqusLine& line : block_.data) step(line.fields());
  }

  void add(long label, const Vector3& place) {
    if (label < 1) throw CardError{fmt::format("node {} would be made", label)};
    if (static_cast<long>(made_.places.size()) >= most_made)
      throw CardError{fmt::format("more than {} nodes would be made", most_made)};
    made_.places.emplace_back(label, place);
  }

  // first, last, step of numbers, node at the centre, or its place
  void between(const Fields& fields) {
    refuse(block_, {"SYSTEM"});
    const std::string line = block_.value("LINE");
    if (!line.empty() && line != "C")
      throw CardError{fmt::format("LINE = {} is not known; C and straight lines are", line)};
    if (fields.size() < 2) throw CardError{"two nodes are due"};
    const int first = model_.node_of(scope_, fields[0]), last = model_.node_of(scope_, fields[1]);
    const long from = labels_[first], to = labels_[last];
    const long step = whole(fields, 2, "the step of numbers", 1);
    if (step == 0 || (to - from) / step <= 0 || (to - from) % step != 0)
      throw CardError{fmt::format("steps of {} do not lead from node {} to {}", step, from, to)};
    const long intervals = (to - from) / step;
    const Vector3 a = model_.place(first), b = model_.place(last);
    for (long i = 1; i < intervals; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(intervals);
      add(from + i * step,
          line == "C" ? on_arc(a, b, centre(fields), share) : Vector3((1 - share) * a + share * b));
    }
    made_.others.push_back(first);
    made_.others.push_back(last);
  }

  Vector3 centre(const Fields& fields) const {
    if (fields.size() > 3 && !fields[3].empty())
      return model_.place(model_.node_of(scope_, fields[3]));
    if (fields.size() < 6) throw CardError{"the centre of the arc is missing"};
    return model_.units.length * (scope_.turn * point(fields, 4) + scope_.shift);
  }

  std::vector<int> in_order(std::string_view set) const {
    std::vector<int> nodes = model_.nodes_of(scope_, set);
    std::sort(nodes.begin(), nodes.end(), [&](int a, int b) { return labels_[a] < labels_[b]; });
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  // one set, another, intervals between them, step of numbers from the first
  void fill(const Fields& fields) {
    refuse(block_, {"BIAS", "TWO STEP", "SINGULAR"});
    if (fields.size() < 3) throw CardError{"two sets and the number of intervals are due"};
    const std::vector<int> from = in_order(fields[0]), to = in_order(fields[1]);
    const long intervals = whole(fields, 2, "the number of intervals", 1),
               step = whole(fields, 3, "the step of numbers", 1);
    if (from.size() != to.size())
      throw CardError{fmt::format("the sets {} and {} have {} and {} nodes", fields[0], fields[1],
                                  from.size(), to.size())};
    for (std::size_t n = 0; n < from.size(); ++n)
      for (long i = 1; i < intervals; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(intervals);
        add(labels_[from[n]] + i * step,
            (1 - share) * model_.place(from[n]) + share * model_.place(to[n]));
      }
    made_.others = from;
    made_.others.insert(made_.others.end(), to.begin(), to.end());
  }

  // OLD SET = , CHANGE NUMBER = , SHIFT, MULTIPLE = , NEW SET = / shift / axis, angle
  void copy() {
    refuse(block_, {"REFLECT", "POLE"});
    if (!block_.has("SHIFT")) throw CardError{"SHIFT is due: no other way of copying is known"};
    made_.set = block_.value("NEW SET");
    const long step = whole(block_, "CHANGE NUMBER");
    const long times = block_.has("MULTIPLE") ? whole(block_, "MULTIPLE") : 1;
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (!block_.data.empty()) motion.pretranslate(point(block_.data[0].fields(), 0));
    if (block_.data.size() > 1) {
      const Fields fields = block_.data[1].fields();
      const Vector3 from = point(fields, 0), axis = point(fields, 3) - from;
      const double angle = abaqus_real(fields, 6, "angle", 0.0) * std::numbers::pi / 180;
      if (!(axis.norm() > 0) && angle != 0) throw CardError{"the axis of rotation has no length"};
      if (angle != 0)
        motion = Eigen::Translation3d(from) * Eigen::AngleAxisd(angle, axis.normalized()) *
                 Eigen::Translation3d(-from) * motion;
    }
    for (const int node : in_order(block_.required("OLD SET"))) {
      Vector3 given =
          scope_.turn.transpose() * (model_.place(node) / model_.units.length - scope_.shift);
      for (long i = 1; i <= times; ++i) {
        given = motion * given;
        add(labels_[node] + i * step, model_.units.length * (scope_.turn * given + scope_.shift));
      }
    }
  }

  const AbaqusModel& model_;
  const AbaqusScope& scope_;
  const AbaqusBlock& block_;
  const std::vector<long>& labels_;
  MadeNodes made_;
};

int one_element(const AbaqusModel& model, const AbaqusScope& scope, std::string_view text) {
  const std::vector<int> found = model.elements_of(scope, text);
  if (found.size() != 1)
    throw CardError{fmt::format("\"{}\" stands for {} elements; one is due", text, found.size())};
  return found.front();
}

// element, count, step of nodes, step of elements in a row; the same of rows, and of layers
void add_rows(const AbaqusModel& model, const AbaqusScope& scope, const Fields& fields,
              MadeElements& made) {
  if (fields.empty()) throw CardError{"an element is due"};
  const int master = one_element(model, scope, fields[0]);
  made.others.push_back(master);
  std::array<long, 3> count{}, nodes{}, numbers{};
  long total = 1;
  for (std::size_t way = 0; way < 3; ++way) {
    count[way] = whole(fields, 1 + 3 * way, "the number of elements", 1);
    nodes[way] = whole(fields, 2 + 3 * way, "the step of nodes", 1);
    numbers[way] = whole(fields, 3 + 3 * way, "the step of elements", 1);
    if (count[way] < 1 || count[way] > most_made || (total *= count[way]) > most_made)
      throw CardError{fmt::format("{} elements would be made", count[way])};
  }
  const long label = model.elements[master].label;
  for (long k = 0; k < count[2]; ++k)
    for (long j = 0; j < count[1]; ++j)
      for (long i = 0; i < count[0]; ++i)
        if (i + j + k > 0)
          made.elements.push_back({master, label + i * numbers[0] + j * numbers[1] + k * numbers[2],
                                   i * nodes[0] + j * nodes[1] + k * nodes[2]});
}

}  // namespace

MadeNodes make_nodes(const AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block,
                     const std::vector<long>& labels) {
  return NodeMaker(model, scope, block, labels).make();
}

MadeElements make_elements(const AbaqusModel& model, const AbaqusScope& scope,
                           const AbaqusBlock& block) {
  MadeElements made;
  if (block.name == "ELGEN") {
    refuse(block, {"ALL NODES"});
    made.set = block.value("ELSET");
    for (const AbaqusLine& line : block.data) add_rows(model, scope, line.fields(), made);
    return made;
  }
  refuse(block, {"REFLECT"});
  made.set = block.value("NEW SET");
  const long shift = whole(block, "SHIFT NODES"), step = whole(block, "ELEMENT SHIFT");
  for (const int element : model.elements_of(scope, block.required("OLD SET")))
    made.elements.push_back({element, model.elements[element].label + step, shift});
  return made;
}

}  // namespace blocklift::structure
