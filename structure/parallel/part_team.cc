#include "structure/parallel/part_team.h"

#include <algorithm>
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/output/part_files.h"

namespace blocklift::structure {

namespace {

enum class Order { solve, write, end };

std::string piece_name(const std::string& stem, int process) {
  return fmt::format("{}_{}.vtu", stem, process);
}

// The own solids of a share, which come first, with the stresses of their nodes; the halo has done
// its work in the averages.
void write_piece(const std::string& stem, const ProcessGroup& group, const PartShare& share,
                 const Eigen::VectorXd& displacement) {
  PartModel model = share.model;
  PartSolution solution;
  solution.displacement = displacement;
  solution.stress = recover_part_stress(model, displacement);
  model.mesh.solids.resize(share.own_solids);
  PartStress& stress = solution.stress;
  int points = 0;
  for (std::size_t solid = 0; solid < model.mesh.solids.size(); ++solid)
    for (int i = 0; i < model.mesh.kind(model.mesh.solids[solid]).nodes; ++i)
      points = std::max(points, 1 + stress.point_of[stress.first_of[solid] + i]);
  stress.node.resize(points);
  write_part_vtu(piece_name(stem, group.rank()), model, solution);
}

// What comes of a collective step: empty, or the first complaint of any process.
std::string outcome(const ProcessGroup& group, const std::string& complaint) {
  Packet own;
  own.put(complaint);
  if (!group.leads()) {
    group.send(0, own);
    return complaint;
  }
  std::string first = complaint;
  for (int process = 1; process < group.size(); ++process) {
    std::string text;
    group.receive(process).take(text);
    if (first.empty()) first = text;
  }
  return first;
}

// A ModelError stops all processes at the same place; after another error this one is alone with
// it, and the rest would wait for it.
template <typename Step>
std::string complaint_of(const Step& step) {
  try {
    step();
  } catch (const ModelError& error) {
    return error.what();
  } catch (const std::exception& error) {
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    ProcessGroup::abort();
  }
  return "";
}

// Displacement at the rows that a share owns.
Eigen::VectorXd own_displacement(const PartShare& share, const Eigen::VectorXd& displacement) {
  Eigen::VectorXd own(3 * (share.end_row - share.first_row));
  for (std::size_t node = 0; node < share.row_of_node.size(); ++node) {
    const int row = share.row_of_node[node];
    if (row >= share.first_row && row < share.end_row)
      own.segment<3>(3 * (row - share.first_row)) =
          displacement.segment<3>(3 * static_cast<Eigen::Index>(node));
  }
  return own;
}

void follow_solution(const ProcessGroup& group, Packet order, PartShare& share,
                     Eigen::VectorXd& displacement) {
  SolverChoice choice;
  order.take(choice);
  share = PartShare::from(group.receive(0));
  const std::string complaint =
      complaint_of([&] { displacement = solve_share(group, share, choice).displacement; });
  outcome(group, complaint);
  if (!complaint.empty()) return;
  Packet result;
  result.put(own_displacement(share, displacement));
  group.send(0, result);
}

}  // namespace

PartTeam::PartTeam(const ProcessGroup& group) : group_(group) {}

PartTeam::~PartTeam() {
  Packet order;
  order.put(Order::end);
  group_.broadcast(order);
}

PartDisplacement PartTeam::solve(const PartModel& model, const std::vector<FixedUnknown>& fixed,
                                 const Eigen::VectorXd& load, const SolverChoice& choice) {
  const PartDistribution distribution(model, group_.size());
  Packet order;
  order.put(Order::solve);
  order.put(choice);
  group_.broadcast(order);
  for (int process = 1; process < group_.size(); ++process) {
    Packet share;
    distribution.share(process, fixed, load).put_into(share);
    group_.send(process, share);
  }
  share_ = distribution.share(0, fixed, load);
  ShareSolution own;
  const std::string complaint =
      outcome(group_, complaint_of([&] { own = solve_share(group_, *share_, choice); }));
  if (!complaint.empty()) throw ModelError(complaint);
  displacement_ = own.displacement;
  PartDisplacement result;
  result.account = own.account;
  result.displacement = Eigen::VectorXd::Zero(load.size());
  // Nodes of no solid stay where they are put.
  for (const FixedUnknown& one : fixed) result.displacement[one.unknown] = one.value;
  const auto place = [&](int process, const Eigen::VectorXd& rows) {
    const int first = distribution.first_rows()[process];
    for (Eigen::Index row = 0; row < rows.size() / 3; ++row)
      result.displacement.segment<3>(3 * distribution.node_of_row()[first + row]) =
          rows.segment<3>(3 * row);
  };
  place(0, own_displacement(*share_, displacement_));
  for (int process = 1; process < group_.size(); ++process) {
    Eigen::VectorXd rows;
    group_.receive(process).take(rows);
    place(process, rows);
  }
  const Eigen::VectorXd forces = part_internal_forces(model, result.displacement);
  result.reactions.resize(fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i)
    result.reactions[i] = forces[fixed[i].unknown] - load[fixed[i].unknown];
  return result;
}

void PartTeam::write_pieces(const std::string& stem) const {
  Packet order;
  order.put(Order::write);
  order.put(stem);
  group_.broadcast(order);
  const std::string complaint =
      outcome(group_, complaint_of([&] { write_piece(stem, group_, *share_, displacement_); }));
  if (!complaint.empty()) throw ModelError(complaint);
  std::vector<std::string> pieces;
  for (int process = 0; process < group_.size(); ++process)
    pieces.push_back(piece_name(stem, process));
  write_part_pvtu(stem + ".pvtu", pieces);
}

void follow_part_team(const ProcessGroup& group) {
  PartShare share;
  Eigen::VectorXd displacement;
  for (;;) {
    Packet order = group.broadcast({});
    Order what = Order::end;
    order.take(what);
    if (what == Order::end) return;
    if (what == Order::solve) {
      follow_solution(group, order, share, displacement);
      continue;
    }
    std::string stem;
    order.take(stem);
    outcome(group, complaint_of([&] { write_piece(stem, group, share, displacement); }));
  }
}

}  // namespace blocklift::structure
