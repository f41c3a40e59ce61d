#include "structure/envelope/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "parallel/threads.h"
#include "structure/envelope/envelope_search.h"
#include "structure/envelope/leading_stress.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr int batch_size = 64;  // points: their unit responses stay in the cache

using Rows = SearchTables::Rows;

// Responses of a batch to the history's coordinates, `rows` rows a point.
Rows responses_of(const SearchTables& tables, const PointResponses& responses, int first, int count,
                  int rows) {
  const LoadHistory& history = tables.history();
  const bool in_coordinates = responses.are_of_coordinates();
  const Eigen::MatrixXd given = responses(first, count);
  const Eigen::Index columns = in_coordinates ? history.rank() : history.modes().rows();
  if (given.rows() != rows * count || given.cols() != columns)
    throw ModelError("responses do not fit the history: " + std::to_string(given.rows()) + " x " +
                     std::to_string(given.cols()) + " for " + std::to_string(count) +
                     " points and " + std::to_string(columns) +
                     (in_coordinates ? " coordinates" : " unit loads"));
  Rows result = in_coordinates ? Rows(given) : tables.in_coordinates(given);
  if (!result.allFinite())
    throw ModelError("a unit response is not a number, near point " + std::to_string(first));
  return result;
}

PointExtremes sized(int points) {
  return {Eigen::VectorXd::Zero(points), Eigen::VectorXi::Zero(points)};
}

void keep(PointExtremes& extremes, int point, const Found& found, double sign = 1) {
  extremes.value[point] = sign * found.value;
  extremes.instant[point] = found.instant;
}

}  // namespace

StressEnvelope find_stress_envelope(const LoadHistory& history, int points,
                                    const PointResponses& stress, int threads) {
  StressEnvelope envelope{sized(points), sized(points), sized(points)};
  const SearchTables tables(history);
  parallel::in_batches(points, batch_size, threads, [&](int first, int count) {
    const Rows rows = responses_of(tables, stress, first, count, 6);
    SearchWorkspace workspace(tables);
    for (int i = 0; i < count; ++i) {
      const StressFound found = search_stress(rows.data() + 6L * i * rows.cols(), workspace);
      keep(envelope.von_mises, first + i, found.von_mises);
      keep(envelope.largest_principal, first + i, found.largest_principal);
      keep(envelope.smallest_principal, first + i, found.minus_smallest_principal, -1);
    }
  });
  return envelope;
}

PointExtremes find_von_mises_envelope(const LoadHistory& history, int points,
                                      const PointResponses& stress, int threads) {
  PointExtremes extremes = sized(points);
  const SearchTables tables(history);
  parallel::in_batches(points, batch_size, threads, [&](int first, int count) {
    const Rows rows = responses_of(tables, stress, first, count, 6);
    SearchWorkspace workspace(tables);
    for (int i = 0; i < count; ++i)
      keep(extremes, first + i, search_von_mises(rows.data() + 6L * i * rows.cols(), workspace));
  });
  return extremes;
}

Eigen::VectorXd find_leading_von_mises(const LoadHistory& history, int points,
                                       const PointResponses& stress, double share, double known,
                                       int threads) {
  constexpr double just_below = 0.999;  // what may yet come to the share is found
  Eigen::VectorXd values = Eigen::VectorXd::Zero(points);
  if (points == 0) return values;
  double largest = known;
  std::mutex updating;
  const SearchTables tables(history);
  parallel::in_batches(points, batch_size, threads, [&](int first, int count) {
    const Rows rows = responses_of(tables, stress, first, count, 6);
    SearchWorkspace workspace(tables);
    double of_these = 0;
    {
      const std::lock_guard lock(updating);
      of_these = largest;
    }
    for (int i = 0; i < count; ++i) {
      const Found found = search_von_mises(rows.data() + 6L * i * rows.cols(), workspace,
                                           {just_below * share * of_these, -1});
      if (found.instant < 0) continue;
      values[first + i] = found.value;
      of_these = std::max(of_these, found.value);
    }
    const std::lock_guard lock(updating);
    largest = std::max(largest, of_these);
  });
  // Whatever the threads have found first.
  const double least = share * values.maxCoeff();
  return values.unaryExpr([&](double value) { return value < least ? 0.0 : value; });
}

void raise_von_mises(const LoadHistory& history, const std::vector<int>& begin,
                     const PointResponses& stress, Eigen::VectorXd& largest, int threads) {
  const int runs = static_cast<int>(begin.size()) - 1;
  const SearchTables tables(history);
  parallel::in_batches(runs, 16, threads, [&](int first, int count) {
    const int from = begin[first], points = begin[first + count] - from;
    if (points == 0) return;
    const Rows rows = responses_of(tables, stress, from, points, 6);
    SearchWorkspace workspace(tables);
    const auto rows_of = [&](int point) { return rows.data() + 6L * (point - from) * rows.cols(); };
    for (int run = first; run < first + count; ++run) {
      // Where the run before had its largest stress, all points of this one are likely to have
      // theirs, and the most stressed of them rules out most others.
      double known = largest[run];
      for (int point = begin[run]; point < begin[run + 1]; ++point)
        known = std::max(known, likely_von_mises(rows_of(point), workspace));
      Found found{known, -1};
      for (int point = begin[run]; point < begin[run + 1]; ++point)
        found = search_von_mises(rows_of(point), workspace, found);
      largest[run] = found.value;
    }
  });
}

namespace {

// Larger, or as large at an earlier point: whatever the threads have done, the result is the same.
void merge(LargestValue& into, const Found& found, int point) {
  if (into.point < 0 || found.value > into.value ||
      (found.value == into.value && point < into.point))
    into = {found.value, point, found.instant};
}

// Just below what is known, so that equals are found and merged by their places.
Found as_floor(const LargestValue& largest) {
  if (largest.point < 0) return {};
  return {std::nextafter(largest.value, -std::numeric_limits<double>::infinity()), -1};
}

}  // namespace

LargestStresses find_largest_stresses(const LoadHistory& history, int points,
                                      const PointResponses& stress, int sets,
                                      const std::function<int(int)>& set_of, int threads) {
  // Within, the smallest principal stress stands with the opposite sign.
  LargestStresses all;
  all.von_mises.resize(sets);
  std::mutex updating;
  const SearchTables tables(history);
  parallel::in_batches(points, batch_size, threads, [&](int first, int count) {
    const Rows rows = responses_of(tables, stress, first, count, 6);
    SearchWorkspace workspace(tables);
    LargestStresses known;
    {
      const std::lock_guard lock(updating);
      known = all;
    }
    for (int i = 0; i < count; ++i) {
      LargestValue& in_set = known.von_mises[set_of(first + i)];
      const StressFound floor{as_floor(in_set), as_floor(known.largest_principal),
                              as_floor(known.smallest_principal)};
      const StressFound found = search_stress(rows.data() + 6L * i * rows.cols(), workspace, floor);
      const auto raise = [&](LargestValue& known_one, const Found& one) {
        if (one.instant >= 0) merge(known_one, one, first + i);
      };
      raise(in_set, found.von_mises);
      raise(known.largest_principal, found.largest_principal);
      raise(known.smallest_principal, found.minus_smallest_principal);
    }
    const std::lock_guard lock(updating);
    const auto raise = [](LargestValue& into, const LargestValue& from) {
      if (from.point >= 0) merge(into, {from.value, from.instant}, from.point);
    };
    for (std::size_t set = 0; set < known.von_mises.size(); ++set)
      raise(all.von_mises[set], known.von_mises[set]);
    raise(all.largest_principal, known.largest_principal);
    raise(all.smallest_principal, known.smallest_principal);
  });
  all.smallest_principal.value = -all.smallest_principal.value;
  return all;
}

namespace {

/// The largest over batches of points.
/// @param search (first point, count, what is known, which it raises).
template <class Search>
LargestValue find_largest(int points, int threads, const Search& search) {
  LargestValue all;
  std::mutex updating;
  parallel::in_batches(points, batch_size, threads, [&](int first, int count) {
    LargestValue known;
    {
      const std::lock_guard lock(updating);
      known = all;
    }
    search(first, count, known);
    const std::lock_guard lock(updating);
    if (known.point >= 0) merge(all, {known.value, known.instant}, known.point);
  });
  return all;
}

}  // namespace

LargestValue find_largest_in_plane(const LoadHistory& history, int points,
                                   const PointResponses& stress, int threads) {
  const SearchTables tables(history);
  return find_largest(points, threads, [&](int first, int count, LargestValue& known) {
    const Rows in_plane = responses_of(tables, stress, first, count, 3);
    SearchWorkspace workspace(tables);
    Rows rows = Rows::Zero(6, in_plane.cols());
    for (int i = 0; i < count; ++i) {
      rows.topRows<2>() = in_plane.middleRows<2>(3L * i);
      rows.row(3) = in_plane.row(3L * i + 2);
      const Found found = search_von_mises(rows.data(), workspace, as_floor(known));
      if (found.instant >= 0) merge(known, found, first + i);
    }
  });
}

LargestValue find_largest_displacement(const LoadHistory& history, int points,
                                       const PointResponses& displacement, int threads) {
  const SearchTables tables(history);
  return find_largest(points, threads, [&](int first, int count, LargestValue& known) {
    const Rows rows = responses_of(tables, displacement, first, count, 3);
    SearchWorkspace workspace(tables);
    for (int i = 0; i < count; ++i) {
      const Found found =
          search_displacement(rows.data() + 3L * i * rows.cols(), workspace, as_floor(known));
      if (found.instant >= 0) merge(known, found, first + i);
    }
  });
}

}  // namespace blocklift::structure
