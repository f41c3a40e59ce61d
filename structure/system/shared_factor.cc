#include "structure/system/shared_factor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/system/factor_part.h"
#include "structure/system/iteration.h"
#include "structure/system/linear_solver.h"
#include "structure/system/subtrees.h"

namespace blocklift::structure {

namespace {

const FactorTeam* team_present = nullptr;

enum class Order { deal, eliminate, forward, backward, drop, iterate, end };
enum class State { done, short_of_memory, loose };

void carry_out(Order what, Packet& order, std::unique_ptr<FactorPart>& part, Packet& result) {
  Eigen::MatrixXd given;
  if (what == Order::deal) {
    part = std::make_unique<FactorPart>(PartOfMatrix::from(order));
    result.put(part->bytes());
    result.put(memory_for(std::numeric_limits<double>::infinity()));
  } else if (what == Order::eliminate) {
    result.put(part->eliminate());
  } else {
    order.take(given);
    result.put(what == Order::forward ? part->forward(given) : part->backward(given));
  }
}

/// What comes of an order, its state first. After an error that says nothing of the model this
/// process would be alone with it, and the others would wait: all end.
Packet answer(Order what, Packet& order, std::unique_ptr<FactorPart>& part) {
  Packet failure;
  try {
    Packet result;
    result.put(State::done);
    carry_out(what, order, part, result);
    return result;
  } catch (const LooseUnknown& loose) {
    failure.put(State::loose);
    failure.put(std::string(loose.what()));
    failure.put(loose.unknown);
  } catch (const NotEnoughMemory& error) {
    failure.put(State::short_of_memory);
    failure.put(std::string(error.what()));
  } catch (const std::bad_alloc&) {
    failure.put(State::short_of_memory);
    failure.put(std::string("the memory of a process did not suffice for its share of the factor"));
  } catch (const std::exception& error) {
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    ProcessGroup::abort();
  }
  return failure;
}

Packet make_order(Order what, int number) {
  Packet order;
  order.put(what);
  order.put(number);
  return order;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<int>& rows) {
  return all(rows, Eigen::all);
}

/// Columns and rows of a matrix that have a place, which ascends with them; -1: none.
SparseLower restricted(const SparseLower& matrix, const std::vector<int>& columns,
                       const std::vector<int>& place) {
  const auto each_entry = [&](const auto& take) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (SparseLower::InnerIterator entry(matrix, columns[c]); entry; ++entry)
        if (place[entry.row()] >= 0) take(c, place[entry.row()], entry.value());
  };
  const auto size = static_cast<long>(columns.size());
  SparseLower result(size, size);
  long* const starts = result.outerIndexPtr();
  each_entry([&](std::size_t column, int, double) { ++starts[column + 1]; });
  std::partial_sum(starts, starts + size + 1, starts);
  result.resizeNonZeros(starts[size]);
  long next = 0;
  each_entry([&](std::size_t, int row, double value) {
    result.innerIndexPtr()[next] = row;
    result.valuePtr()[next++] = value;
  });
  return result;
}

}  // namespace

FactorTeam::FactorTeam(const ProcessGroup& group) : group_(group) { team_present = this; }

FactorTeam::~FactorTeam() {
  team_present = nullptr;
  for (int process = 1; process < group_.size(); ++process)
    group_.send(process, make_order(Order::end, 0));
}

const FactorTeam* FactorTeam::present() { return team_present; }

void FactorTeam::begin_iteration() const {
  for (int process = 1; process < group_.size(); ++process)
    group_.send(process, make_order(Order::iterate, 0));
}

void follow_factor_team(const ProcessGroup& group) {
  std::map<int, std::unique_ptr<FactorPart>> parts;
  for (;;) {
    Packet order = group.receive(0);
    Order what = Order::end;
    int number = 0;
    order.take(what);
    order.take(number);
    if (what == Order::end) return;
    if (what == Order::drop)
      parts.erase(number);
    else if (what == Order::iterate)
      follow_iteration(group);
    else
      group.send(0, answer(what, order, parts[number]));
  }
}

SharedFactor::SharedFactor(const FactorTeam& team, const SparseLower& matrix)
    : group_(team.group()) {
  static int count = 0;
  number_ = count++;
  try {
    deal_out(matrix, deal_out_subtrees(CholeskyFactor(matrix).supernodes(), group_.size()));
  } catch (const NotEnoughMemory&) {
    drop();
    throw;
  }
}

SharedFactor::~SharedFactor() { drop(); }

// The others give their parts free.
void SharedFactor::drop() const {
  for (int process = 1; process < group_.size(); ++process)
    group_.send(process, make_order(Order::drop, number_));
}

void SharedFactor::deal_out(const SparseLower& matrix, const std::vector<int>& process_of) {
  const auto count = static_cast<int>(matrix.cols());
  inner_.resize(at(group_.size()));
  boundary_.resize(at(group_.size()));
  std::vector<int> place(at(count), -1);
  for (int unknown = 0; unknown < count; ++unknown) {
    if (process_of[unknown] >= 0) {
      inner_[process_of[unknown]].push_back(unknown);
    } else {
      place[unknown] = static_cast<int>(interface_.size());
      interface_.push_back(unknown);
    }
  }
  stiffness_ = restricted(matrix, interface_, place);
  std::vector<Packet> orders;
  for (int process = 0; process < group_.size(); ++process) {
    std::vector<char> is_touched(interface_.size(), 0);
    for (const int unknown : inner_[process])
      for (SparseLower::InnerIterator entry(matrix, unknown); entry; ++entry)
        if (process_of[entry.row()] < 0) is_touched[place[entry.row()]] = 1;
    PartOfMatrix part;
    part.inner = static_cast<int>(inner_[process].size());
    std::vector<int> columns = inner_[process], place_here(at(count), -1);
    for (std::size_t i = 0; i < interface_.size(); ++i) {
      if (is_touched[i] == 0) continue;
      boundary_[process].push_back(static_cast<int>(i));
      columns.push_back(interface_[i]);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) place_here[columns[i]] = static_cast<int>(i);
    part.matrix = restricted(matrix, columns, place_here);
    orders.push_back(make_order(Order::deal, number_));
    part.put_into(orders.back());
  }
  require_memory(ask(std::move(orders)));
}

std::vector<Packet> SharedFactor::ask(std::vector<Packet> orders) {
  std::vector<Packet> answers;
  for (int process = 1; process < group_.size(); ++process) {
    group_.send(process, orders[process]);
    orders[process] = Packet();
  }
  Order what = Order::end;
  int number = 0;
  orders[0].take(what);
  orders[0].take(number);
  answers.push_back(answer(what, orders[0], own_));
  for (int process = 1; process < group_.size(); ++process)
    answers.push_back(group_.receive(process));
  for (int process = 0; process < group_.size(); ++process) {
    State state = State::done;
    std::string message;
    int unknown = 0;
    answers[process].take(state);
    if (state == State::done) continue;
    answers[process].take(message);
    if (state == State::short_of_memory) throw NotEnoughMemory(message);
    answers[process].take(unknown);
    throw LooseUnknown(message, inner_[process][unknown]);
  }
  return answers;
}

void SharedFactor::require_memory(std::vector<Packet> answers) {
  const bool is_one_machine = group_.on_this_machine() == group_.size();
  // The interface at most: its stiffness when all is eliminated, and its factor, without a zero.
  const double of_interface = 12 * std::pow(static_cast<double>(interface_.size()), 2);
  double all_available = 0, worst_needed = 0, worst_available = 0;
  bytes_ = of_interface;
  for (Packet& one : answers) {
    double bytes = 0, available = 0;
    one.take(bytes);
    one.take(available);
    bytes_ += bytes;
    if (&one == &answers.front()) {
      all_available = available;
      bytes += of_interface;
    }
    const double needed = 1.3 * bytes * group_.on_this_machine();
    if (needed - available > worst_needed - worst_available || worst_needed == 0) {
      worst_needed = needed;
      worst_available = available;
    }
  }
  if (is_one_machine) {
    worst_needed = 1.3 * bytes_;
    worst_available = all_available;
  }
  if (worst_needed > worst_available)
    throw NotEnoughMemory(fmt::format(
        "factorising {} unknowns on {} processes needs about {:.1f} GB on a machine and {:.1f} GB "
        "are free; use larger elements or a lower element degree",
        interface_.size() + std::accumulate(inner_.begin(), inner_.end(), std::size_t{0},
                                            [](std::size_t sum, const std::vector<int>& one) {
                                              return sum + one.size();
                                            }),
        group_.size(), worst_needed / 1e9, worst_available / 1e9));
}

SparseLower SharedFactor::sum_up(const std::vector<Eigen::MatrixXd>& added) const {
  const auto size = static_cast<int>(interface_.size());
  std::vector<std::vector<std::pair<int, int>>> parts_at(at(size));  // part, place in its boundary
  for (int part = 0; part < group_.size(); ++part)
    for (std::size_t i = 0; i < boundary_[part].size(); ++i)
      parts_at[boundary_[part][i]].emplace_back(part, static_cast<int>(i));
  SparseLower sum(size, size);
  std::vector<int> rows;
  Eigen::VectorXd column = Eigen::VectorXd::Zero(size);
  for (int c = 0; c < size; ++c) {
    rows.clear();
    const auto add = [&](int row, double value) {
      rows.push_back(row);
      column[row] += value;
    };
    for (SparseLower::InnerIterator entry(stiffness_, c); entry; ++entry)
      add(static_cast<int>(entry.row()), entry.value());
    for (const auto& [part, place] : parts_at[c])
      for (Eigen::Index i = place; i < added[part].rows(); ++i)
        add(boundary_[part][i], added[part](i, place));
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    sum.startVec(c);
    for (const int row : rows) {
      sum.insertBack(row, c) = column[row];
      column[row] = 0;
    }
  }
  sum.finalize();
  return sum;
}

void SharedFactor::factorise(const Eigen::VectorXd& held) {
  std::vector<Packet> orders(at(group_.size()), make_order(Order::eliminate, number_));
  std::vector<Eigen::MatrixXd> added;
  for (Packet& one : ask(std::move(orders))) one.take(added.emplace_back());
  if (interface_.empty()) return;
  const SparseLower eliminated = sum_up(added);
  added.clear();
  factor_ = std::make_unique<CholeskyFactor>(eliminated);
  try {
    factor_->factorise(eliminated, held(interface_));
  } catch (const LooseUnknown& loose) {
    throw LooseUnknown(loose.what(), interface_[loose.unknown]);
  }
}

Eigen::MatrixXd SharedFactor::solve(const Eigen::MatrixXd& loads) {
  std::vector<Packet> orders;
  for (int process = 0; process < group_.size(); ++process) {
    orders.push_back(make_order(Order::forward, number_));
    orders.back().put(rows_of(loads, inner_[process]));
  }
  Eigen::MatrixXd on_interface = rows_of(loads, interface_);
  std::vector<Packet> answers = ask(std::move(orders));
  for (int process = 0; process < group_.size(); ++process) {
    Eigen::MatrixXd from_inside;
    answers[process].take(from_inside);
    for (std::size_t i = 0; i < boundary_[process].size(); ++i)
      on_interface.row(boundary_[process][i]) += from_inside.row(static_cast<Eigen::Index>(i));
  }
  if (factor_) on_interface = factor_->solve(std::move(on_interface));
  orders.clear();
  for (int process = 0; process < group_.size(); ++process) {
    orders.push_back(make_order(Order::backward, number_));
    orders.back().put(rows_of(on_interface, boundary_[process]));
  }
  Eigen::MatrixXd solution(loads.rows(), loads.cols());
  solution(interface_, Eigen::all) = on_interface;
  answers = ask(std::move(orders));
  for (int process = 0; process < group_.size(); ++process) {
    Eigen::MatrixXd inside;
    answers[process].take(inside);
    if (!inner_[process].empty()) solution(inner_[process], Eigen::all) = inside;
  }
  return solution;
}

}  // namespace blocklift::structure
