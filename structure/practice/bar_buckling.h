#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/practice/column.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Straight piece of a bar that stands free of plates, from joint to joint: what it ends on (plates,
/// other bars, links, springs) holds it there, nothing between.
struct BarSpan {
  std::string bar;                                     ///< name of its region
  std::string group;                                   ///< name of that region's group
  Vector3 p_BFrom = Vector3::Zero(), p_BTo = p_BFrom;  ///< m
  /// As a column that is pinned at its joints; twice as long as it is where an end is free. Its
  /// axes y and z are the section's principal ones, about which it bends.
  Column column;
};

/// The bars of a block that may buckle, and their section forces for its unit loads.
///
/// Stiffeners along plates are none: plates hold them. Nor are rods without second moments, which
/// are counted. A tapered bar has the smaller figures of both of its ends.
class BlockBars {
 public:
  /// @param motions freedoms x m, m and rad.
  BlockBars(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions);

  const std::vector<BarSpan>& spans() const { return spans_; }
  /// Rods of which nothing says how they resist bending.
  int unknown_rods() const { return unknown_rods_; }

  struct Worst {
    double utilisation = 0;  ///< column_utilisation
    ColumnForces forces;     ///< without the factor, moments about the column's axes y and z
    double share = 0;        ///< of the span's length, where that is
    int instant = 0;
  };
  /// The largest utilisation of each span over instants (a column of factors of the motions each),
  /// forces multiplied by `factor`.
  std::vector<Worst> find_worst(const Eigen::MatrixXd& factors, double factor,
                                int threads = 0) const;

 private:
  struct Station {
    double share = 0;
    Eigen::Index row = 0;  ///< of forces_: N, M_y, M_z
  };

  std::vector<BarSpan> spans_;
  std::vector<std::vector<Station>> stations_;  ///< of each span
  Eigen::MatrixXd forces_;                      ///< rows of stations, a column a motion
  int unknown_rods_ = 0;
};

}  // namespace blocklift::structure
