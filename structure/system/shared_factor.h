#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/packet.h"
#include "structure/process_group.h"
#include "structure/system/cholesky_factor.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

class FactorPart;

/// While it lives, all processes of a group factorise what this one, which leads them, asks for:
/// each ConstrainedSystem that it makes is dealt out, and so is each iteration
/// (solve_by_iteration). The others follow (follow_factor_team) until it is gone. Systems must be
/// gone before.
class FactorTeam {
 public:
  explicit FactorTeam(const ProcessGroup& group);
  ~FactorTeam();
  FactorTeam(const FactorTeam&) = delete;
  FactorTeam& operator=(const FactorTeam&) = delete;

  /// The team that lives; none: this process factorises alone.
  static const FactorTeam* present();
  const ProcessGroup& group() const { return group_; }
  /// From here on the others iterate with this process: each waits for its rows.
  void begin_iteration() const;

 private:
  const ProcessGroup& group_;
};

/// Does what the leader of the group asks for, until it ends.
void follow_factor_team(const ProcessGroup& group);

/// Cholesky factor of a matrix on several processes, by substructures: each eliminates subtrees of
/// the elimination tree (deal_out_subtrees), the leader one of them and the interface that is left.
/// All calls are the leader's.
class SharedFactor {
 public:
  /// Deals the matrix out and analyses it. @throws NotEnoughMemory
  SharedFactor(const FactorTeam& team, const SparseLower& matrix);
  ~SharedFactor();
  SharedFactor(const SharedFactor&) = delete;
  SharedFactor& operator=(const SharedFactor&) = delete;

  /// Memory that the factor takes on all processes, bytes.
  double bytes() const { return bytes_; }
  /// As CholeskyFactor::factorise.
  void factorise(const Eigen::VectorXd& held);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& loads);

 private:
  void drop() const;
  std::vector<Packet> ask(std::vector<Packet> orders);
  void deal_out(const SparseLower& matrix, const std::vector<int>& process_of);
  void require_memory(std::vector<Packet> answers);
  SparseLower sum_up(const std::vector<Eigen::MatrixXd>& added) const;

  const ProcessGroup& group_;
  int number_ = 0;  ///< tells the factors of a team apart
  double bytes_ = 0;
  std::unique_ptr<FactorPart> own_;
  std::vector<std::vector<int>> inner_;     ///< unknowns that each process eliminates
  std::vector<std::vector<int>> boundary_;  ///< interface unknowns that each touches, by place
  std::vector<int> interface_;              ///< unknowns of the interface
  SparseLower stiffness_;                   ///< of the interface, nothing eliminated yet
  std::unique_ptr<CholeskyFactor> factor_;  ///< of the interface
};

}  // namespace blocklift::structure
