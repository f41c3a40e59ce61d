#include "structure/system/assembly.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/error.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/shell.h"
#include "structure/formulation/solid.h"
#include "structure/index.h"
#include "structure/large_pages.h"
#include "structure/mesh/spring_motion.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

namespace {

/// Later group in the columns of a group, with the place of its first row below the group's own
/// rows.
struct Neighbour {
  int group;
  long offset;
};

struct Pattern {
  std::vector<std::vector<Neighbour>> neighbours;  // of each group, ascending
  std::vector<long> column_start;                  // of each unknown, and the end
};

/// Later groups in the columns of a group.
std::vector<Neighbour> neighbours_of(const Elimination& elimination, int g) {
  std::vector<int> others;
  for (const int element : elimination.groups[g].elements)
    for (const int other : elimination.groups_of_elements[element])
      if (other > g) others.push_back(other);
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  std::vector<Neighbour> neighbours;
  long rows = 0;
  for (const int other : others) {
    neighbours.push_back({other, rows});
    rows += elimination.groups[other].count;
  }
  return neighbours;
}

Pattern make_pattern(const Elimination& elimination, int threads) {
  Pattern pattern;
  pattern.neighbours.resize(elimination.groups.size());
  parallel::in_batches(static_cast<int>(elimination.groups.size()), 256, threads,
                       [&](int first, int count) {
                         for (int g = first; g < first + count; ++g)
                           pattern.neighbours[g] = neighbours_of(elimination, g);
                       });
  pattern.column_start.reserve(at(elimination.count) + 1);
  pattern.column_start.push_back(0);
  for (std::size_t g = 0; g < elimination.groups.size(); ++g) {
    const UnknownGroup& group = elimination.groups[g];
    long rows = 0;
    if (!pattern.neighbours[g].empty()) {
      const Neighbour& last = pattern.neighbours[g].back();
      rows = last.offset + elimination.groups[last.group].count;
    }
    for (long k = 0; k < group.count; ++k)
      pattern.column_start.push_back(pattern.column_start.back() + group.count - k + rows);
  }
  return pattern;
}

/// The row numbers of a group's columns.
void write_rows(const Elimination& elimination, const Pattern& pattern, int g, long* rows) {
  const UnknownGroup& group = elimination.groups[g];
  for (int k = 0; k < group.count; ++k) {
    long* row = rows + pattern.column_start[group.first + k];
    for (int r = k; r < group.count; ++r) *row++ = group.first + r;
    for (const Neighbour& neighbour : pattern.neighbours[g]) {
      const UnknownGroup& other = elimination.groups[neighbour.group];
      for (int r = 0; r < other.count; ++r) *row++ = other.first + r;
    }
  }
}

SparseLower make_matrix(const Elimination& elimination, const Pattern& pattern, int threads) {
  SparseLower matrix(elimination.count, elimination.count);
  const long entries = pattern.column_start.back();
  matrix.resizeNonZeros(entries);
  prefer_large_pages(matrix.valuePtr(), at(entries) * sizeof(double));
  prefer_large_pages(matrix.innerIndexPtr(), at(entries) * sizeof(long));
  std::copy(pattern.column_start.begin(), pattern.column_start.end(), matrix.outerIndexPtr());
  parallel::in_batches(
      static_cast<int>(elimination.groups.size()), 256, threads, [&](int first, int count) {
        for (int g = first; g < first + count; ++g) {
          const UnknownGroup& group = elimination.groups[g];
          write_rows(elimination, pattern, g, matrix.innerIndexPtr());
          std::fill(matrix.valuePtr() + pattern.column_start[group.first],
                    matrix.valuePtr() + pattern.column_start[group.first + group.count], 0.0);
        }
      });
  return matrix;
}

/// An element's matrix by the unknowns that its freedoms are sums of.
void take_freedoms(const Space& space, int element, const Eigen::MatrixXd& of_freedoms,
                   ElementEntries& entries) {
  const std::vector<int> freedoms = space.element_freedoms(element);
  std::vector<int> unknowns;
  bool is_plain = true;
  for (const int freedom : freedoms) {
    const Space::Term *begin = space.begin_of(freedom), *end = space.end_of(freedom);
    is_plain = is_plain && end - begin == 1 && begin->weight == 1;
    for (const Space::Term* term = begin; term != end; ++term) unknowns.push_back(term->unknown);
  }
  if (is_plain) return take_entries(unknowns, of_freedoms, entries);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  Eigen::MatrixXd terms = Eigen::MatrixXd::Zero(freedoms.size(), unknowns.size());
  for (std::size_t i = 0; i < freedoms.size(); ++i)
    for (const Space::Term* term = space.begin_of(freedoms[i]); term != space.end_of(freedoms[i]);
         ++term)
      terms(static_cast<Eigen::Index>(i),
            std::lower_bound(unknowns.begin(), unknowns.end(), term->unknown) - unknowns.begin()) +=
          term->weight;
  entries.unknowns = std::move(unknowns);
  Eigen::MatrixXd of_terms(terms.rows(), terms.cols());
  algebra::multiply(of_freedoms, terms, of_terms);
  entries.matrix.resize(terms.cols(), terms.cols());
  algebra::multiply(Eigen::MatrixXd(terms.transpose()), of_terms, entries.matrix);
}

/// Adds an element's matrix to the columns of those groups that are this part's.
void scatter(const Elimination& elimination, const Pattern& pattern, int element,
             const ElementEntries& entries, SparseLower& matrix, int part, int parts) {
  const std::vector<int>& groups = elimination.groups_of_elements[element];
  thread_local std::vector<std::size_t> starts;  // of each group in entries.unknowns, and the end
  starts.clear();
  for (const int g : groups)
    starts.push_back(at(std::lower_bound(entries.unknowns.begin(), entries.unknowns.end(),
                                         elimination.groups[g].first) -
                        entries.unknowns.begin()));
  starts.push_back(entries.unknowns.size());
  for (std::size_t c = 0; c < groups.size(); ++c) {
    const int g = groups[c];
    if (g % parts != part) continue;
    const UnknownGroup& group = elimination.groups[g];
    for (std::size_t r = c; r < groups.size(); ++r) {
      const UnknownGroup& other = elimination.groups[groups[r]];
      long offset = 0;
      if (r != c) {
        const auto& list = pattern.neighbours[g];
        offset = std::lower_bound(list.begin(), list.end(), groups[r],
                                  [](const Neighbour& n, int wanted) { return n.group < wanted; })
                     ->offset;
      }
      for (std::size_t j = starts[c]; j < starts[c + 1]; ++j) {
        const long k = entries.unknowns[j] - group.first;
        double* column = matrix.valuePtr() + pattern.column_start[entries.unknowns[j]];
        const double* source = entries.matrix.col(j).data();
        double* target = r == c ? column - k : column + (group.count - k) + offset;
        for (std::size_t i = r == c ? j : starts[r]; i < starts[r + 1]; ++i)
          target[entries.unknowns[i] - other.first] += source[i];
      }
    }
  }
}

void require_memory(const Elimination& elimination, const Pattern& pattern) {
  const double bytes = 16.0 * static_cast<double>(pattern.column_start.back());
  if (const double available = memory_for(bytes); bytes > available)
    throw NotEnoughMemory(
        fmt::format("the stiffness of {} unknowns needs {:.1f} GB and {:.1f} GB are free; use "
                    "larger elements or a lower element degree",
                    elimination.count, bytes / 1e9, available / 1e9));
}

/// All elements of a space, each by its formulation.
class ElementStiffness {
 public:
  explicit ElementStiffness(const Space& space) : space_(space) {
    if (!space.shells().empty()) shells_ = std::make_unique<ShellStiffness>(space);
  }
  const Eigen::MatrixXd& operator()(int element) {
    const int shells = static_cast<int>(space_.shells().size());
    const int beams = static_cast<int>(space_.beams().size());
    if (element < shells) return (*shells_)(element);
    if (element < shells + beams) return own_ = beam_stiffness(space_, element - shells);
    const Mesh& mesh = space_.mesh();
    const int springs = static_cast<int>(mesh.springs.size());
    if (element >= shells + beams + springs)
      return own_ = solid_stiffness(mesh, mesh.solids[element - shells - beams - springs]);
    const Spring& spring = mesh.springs[element - shells - beams];
    // How far it is stretched by the freedoms of its vertices.
    std::vector<double> row;
    for (std::size_t end = 0; end < 2; ++end) {
      if (spring.vertices[end] < 0) continue;
      const Eigen::Matrix<double, 6, 1> factors =
          (end == 0 ? 1.0 : -1.0) * spring_motion(spring, end);
      row.insert(row.end(), factors.begin(), factors.end());
    }
    const Eigen::Map<const Eigen::VectorXd> stretch(row.data(),
                                                    static_cast<Eigen::Index>(row.size()));
    own_ = spring.stiffness * stretch * stretch.transpose();
    return own_;
  }

 private:
  const Space& space_;
  std::unique_ptr<ShellStiffness> shells_;
  Eigen::MatrixXd own_;
};

/// Where rods and released beams alone meet, nothing may stiffen a rotation about some axis, which
/// need not be one of the world's: along it the node gets a stiffness of its own and stays at rest.
void hold_loose_rotations(const Space& space, SparseLower& stiffness) {
  for (const BeamCell& cell : space.beams()) {
    const Beam& beam = space.mesh().beams[cell.beam];
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const bool is_released = std::any_of(beam.release[end].begin() + 3, beam.release[end].end(),
                                           [](bool released) { return released; });
      if (!beam.is_rod && !is_released) continue;
      const int node = end == 0 ? cell.nodes.front() : cell.nodes.back();
      std::array<long, 3> unknowns{};
      bool is_plain = true;
      for (int c = 0; c < 3; ++c) {
        const Space::Term* term = space.begin_of(6 * node + 3 + c);
        is_plain = is_plain && space.end_of(6 * node + 3 + c) - term == 1;
        if (is_plain) unknowns[c] = term->unknown;
      }
      if (!is_plain) continue;
      const auto entry = [&](int a, int b) -> double& {
        return stiffness.coeffRef(std::max(unknowns[a], unknowns[b]),
                                  std::min(unknowns[a], unknowns[b]));
      };
      Eigen::Matrix3d block;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) block(a, b) = entry(a, b);
      const algebra::SymmetricEigensystem<3> axes = algebra::symmetric_eigensystem(block);
      const double largest = axes.values[2];
      for (int i = 0; i < 3; ++i) {
        if (axes.values[i] > 1e-10 * largest) continue;
        const Vector3 axis = axes.vectors.col(i);
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b <= a; ++b) entry(a, b) += std::max(largest, 1.0) * axis[a] * axis[b];
      }
    }
  }
}

}  // namespace

void take_entries(const std::vector<int>& unknowns, const Eigen::MatrixXd& matrix,
                  ElementEntries& entries) {
  entries.unknowns = unknowns;
  std::sort(entries.unknowns.begin(), entries.unknowns.end());
  entries.unknowns.erase(std::unique(entries.unknowns.begin(), entries.unknowns.end()),
                         entries.unknowns.end());
  std::vector<Eigen::Index> places;
  places.reserve(unknowns.size());
  for (const int unknown : unknowns)
    places.push_back(std::lower_bound(entries.unknowns.begin(), entries.unknowns.end(), unknown) -
                     entries.unknowns.begin());
  const auto size = static_cast<Eigen::Index>(entries.unknowns.size());
  entries.matrix.setZero(size, size);
  for (std::size_t j = 0; j < places.size(); ++j)
    for (std::size_t i = 0; i < places.size(); ++i)
      entries.matrix(places[i], places[j]) +=
          matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

SparseLower assemble(const Elimination& elimination,
                     const std::function<FindEntries()>& make_worker, int threads) {
  if (threads <= 0) threads = parallel::usable_threads();
  const Pattern pattern = make_pattern(elimination, threads);
  require_memory(elimination, pattern);
  SparseLower matrix = make_matrix(elimination, pattern, threads);
  std::vector<FindEntries> workers;
  for (int t = 0; t < threads; ++t) workers.push_back(make_worker());
  // In batches, so that the elements' matrices never take more than some tens of megabytes.
  const int batch = 128, count = static_cast<int>(elimination.groups_of_elements.size());
  std::vector<ElementEntries> entries(at(batch));
  for (int first = 0; first < count; first += batch) {
    const int last = std::min(count, first + batch);
    parallel::in_batches(threads, 1, threads, [&](int thread, int) {
      for (int e = first + thread; e < last; e += threads) workers[thread](e, entries[e - first]);
    });
    parallel::in_batches(threads, 1, threads, [&](int thread, int) {
      for (int e = first; e < last; ++e)
        scatter(elimination, pattern, e, entries[e - first], matrix, thread, threads);
    });
  }
  return matrix;
}

SparseLower assemble(const Space& space, const std::function<ElementMatrix()>& make_worker,
                     int threads) {
  return assemble(
      space.elimination(),
      [&]() -> FindEntries {
        return [&space, matrix_of = make_worker()](int element, ElementEntries& entries) {
          take_freedoms(space, element, matrix_of(element), entries);
        };
      },
      threads);
}

SparseLower assemble_stiffness(const Space& space, int threads) {
  SparseLower stiffness = assemble(
      space,
      [&space] {
        const auto element = std::make_shared<ElementStiffness>(space);
        return [element](int e) -> const Eigen::MatrixXd& { return (*element)(e); };
      },
      threads);
  hold_loose_rotations(space, stiffness);
  for (Eigen::Index k = 0; k < stiffness.cols(); ++k) {
    double& diagonal = stiffness.valuePtr()[stiffness.outerIndexPtr()[k]];
    if (diagonal == 0) diagonal = 1;
  }
  return stiffness;
}

}  // namespace blocklift::structure
