// Changes YAML by what it says: keys renamed, left out, repeated and swapped; lists for scalars and
// the other way round; other units, extremes, empty names. One change in eight is the fuzzer's own,
// of bytes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

namespace {

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t count) {
  return count == 0 ? 0 : static_cast<std::size_t>(random()) % count;
}

/// A YAML document that may hold a key twice, which no YAML::Node can.
struct Tree {
  enum class Kind { scalar, list, table } kind = Kind::scalar;
  std::string text;               ///< of a scalar
  std::vector<std::string> keys;  ///< of a table
  std::vector<Tree> children;
};

constexpr int deepest = 40;

Tree tree_of(const YAML::Node& node, int depth = 0) {
  Tree tree;
  if (depth > deepest) return tree;
  if (node.IsMap()) {
    tree.kind = Tree::Kind::table;
    for (const auto& entry : node) {
      tree.keys.push_back(entry.first.IsScalar() ? entry.first.Scalar() : "key");
      tree.children.push_back(tree_of(entry.second, depth + 1));
    }
  } else if (node.IsSequence()) {
    tree.kind = Tree::Kind::list;
    for (const auto& item : node) tree.children.push_back(tree_of(item, depth + 1));
  } else if (node.IsScalar()) {
    tree.text = node.Scalar();
  }
  return tree;
}

void emit(const Tree& tree, YAML::Emitter& out) {
  switch (tree.kind) {
    case Tree::Kind::scalar:
      out << tree.text;
      return;
    case Tree::Kind::list:
      out << YAML::Flow << YAML::BeginSeq;
      for (const Tree& child : tree.children) emit(child, out);
      out << YAML::EndSeq;
      return;
    case Tree::Kind::table:
      out << YAML::BeginMap;
      for (std::size_t i = 0; i < tree.keys.size(); ++i) {
        out << YAML::Key << tree.keys[i] << YAML::Value;
        emit(tree.children[i], out);
      }
      out << YAML::EndMap;
  }
}

void gather(Tree& tree, std::vector<Tree*>& all) {
  all.push_back(&tree);
  for (Tree& child : tree.children) gather(child, all);
}

constexpr std::array<const char*, 28> values = {
    "",        "0",         "-1",         "0 m",   "-1 m",         "1e300 m", "1e-300 m",
    "nan",     ".inf",      "1e9 t",      "-5 t",  "0 t",          "1e12 s",  "0 s",
    "360 deg", "1e9 rad/s", "1 kN",       "1 MPa", "1e20 Pa",      "3 knots", "1 / 0 m",
    "~",       "true",      "../outside", "L1",    "2147483648 m", "100 %",   "1e5"};

/// Another unit behind the number of a quantity.
std::string with_other_unit(const std::string& text, Random& random) {
  constexpr std::array<const char*, 14> units = {"m", "mm",  "ft",  "t",   "kg",  "N", "MPa",
                                                 "s", "min", "deg", "rad", "m/s", "%", "furlong"};
  return text.substr(0, text.find(' ')) + " " + units[below(random, units.size())];
}

void change_scalar(Tree& tree, Random& random) {
  switch (below(random, 4)) {
    case 0:
      tree.text = with_other_unit(tree.text, random);
      return;
    case 1:
      tree = Tree{Tree::Kind::list, "", {}, {tree}};
      return;
    case 2:
      tree = Tree{Tree::Kind::table, "", {tree.text}, {Tree{}}};
      return;
    default:
      tree.text = values[below(random, values.size())];
  }
}

void change_children(Tree& tree, Random& random) {
  const bool is_table = tree.kind == Tree::Kind::table;
  const std::size_t at = below(random, tree.children.size());
  const std::size_t other = below(random, tree.children.size());
  const auto place = static_cast<std::ptrdiff_t>(at);
  switch (below(random, 7)) {
    case 0:
      tree.children.erase(tree.children.begin() + place);
      if (is_table) tree.keys.erase(tree.keys.begin() + place);
      return;
    case 1:
      tree.children.push_back(Tree(tree.children[at]));
      if (is_table) tree.keys.push_back(std::string(tree.keys[at]));
      return;
    case 2:
      std::swap(tree.children[at], tree.children[other]);
      return;
    case 3:
      if (is_table) tree.keys[at] = below(random, 2) == 0 ? "" : tree.keys[at] + "x";
      return;
    case 4:
      if (is_table) std::swap(tree.keys[at], tree.keys[other]);
      return;
    case 5:
      tree = Tree(tree.children[at]);
      return;
    default:
      tree.children.clear();
      tree.keys.clear();
  }
}

void change(Tree& root, Random& random) {
  std::vector<Tree*> all;
  gather(root, all);
  Tree& tree = *all[below(random, all.size())];
  switch (below(random, 8)) {
    case 0: {
      // A copy of another part in its place; copied first, since one may hold the other.
      const Tree other = *all[below(random, all.size())];
      if (all.size() < 2000) tree = other;
      return;
    }
    case 1:
      tree = Tree{below(random, 2) == 0 ? Tree::Kind::list : Tree::Kind::table, "", {}, {}};
      return;
    default:
      if (tree.kind == Tree::Kind::scalar || tree.children.empty())
        change_scalar(tree, random);
      else
        change_children(tree, random);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t largest, unsigned int seed) {
  Random random(seed);
  if (below(random, 8) == 0) return LLVMFuzzerMutate(data, size, largest);
  try {
    Tree root = tree_of(YAML::Load(std::string(reinterpret_cast<const char*>(data), size)));
    for (std::size_t i = 0, count = 1 + below(random, 3); i < count; ++i) change(root, random);
    YAML::Emitter out;
    emit(root, out);
    if (!out.good() || out.size() > largest) return LLVMFuzzerMutate(data, size, largest);
    std::memcpy(data, out.c_str(), out.size());
    return out.size();
  } catch (const std::exception&) {
    return LLVMFuzzerMutate(data, size, largest);  // it is no YAML any more
  }
}
